#pragma once

#include <array>
#include <string>
#include <vector>

#include "gvd/kernel/error.hpp"
#include "gvd/kernel/facet.hpp"
#include "gvd/predicates/side_tie.hpp"

namespace gvd::kernel {

/// The sites of a facet in one number type. Those that hardly any facet needs are asked for when they are first looked at.
template <class NT>
class SiteNumbers {
 public:
  using Site = predicates::Site<NT>;

  SiteNumbers() = default;
  /// None yet.
  explicit SiteNumbers(std::size_t n) : known_(n, nullptr) {}
  /// All of a facet. Filters look at all of them anyhow.
  SiteNumbers(FacetWaves& waves, int bits) : known_(waves.sites.size(), nullptr), waves_(&waves), bits_(bits) {
    if constexpr (std::is_same_v<NT, FacetWaves::F>)
      for (std::size_t i = 0; i < known_.size(); ++i) known_[i] = ask(i);
  }

  std::size_t size() const noexcept { return known_.size(); }
  const Site* operator[](std::size_t i) const {
    if (known_[i] == nullptr) known_[i] = ask(i);
    return known_[i];
  }
  void set(std::size_t i, const Site& site) { known_[i] = &site; }

 private:
  const Site* ask(std::size_t i) const {
    if (waves_ == nullptr) throw InternalError("wave " + std::to_string(i) + " was not added to the numbers of its facet");
    if constexpr (std::is_same_v<NT, robust::Exact>)
      return waves_->exact_site(i);
    else if constexpr (std::is_same_v<NT, FacetWaves::M>)
      return &waves_->site(i, NT(), bits_);
    else if constexpr (requires { waves_->site(i, NT()); })
      return &waves_->site(i, NT());
    else
      return nullptr;  // a number type that waves do not know: all sites are set
  }

  mutable std::vector<const Site*> known_;
  FacetWaves* waves_ = nullptr;
  int bits_ = 0;
};

/// The numbers of a facet's waves in one number type. Used by one thread at a time.
template <class NT>
struct FacetNumbers {
  const predicates::FacetFrame<NT>* frame = nullptr;
  SiteNumbers<NT> sites;
  std::array<predicates::SideLine<NT>, 3> side;
};

/// The numbers in NT (`bits` for Mpfr only). The result is valid as long as the references of `waves` are.
/// For Exact, `frame` is null if the facet has no exact numbers.
template <class NT>
void load_numbers(FacetWaves& waves, int bits, FacetNumbers<NT>& numbers) {
  if constexpr (std::is_same_v<NT, robust::Exact>)
    numbers.frame = waves.exact_frame();
  else if constexpr (std::is_same_v<NT, FacetWaves::M>)
    numbers.frame = &waves.frame(NT(), bits);
  else
    numbers.frame = &waves.frame(NT());
  if (numbers.frame == nullptr) return;
  numbers.sites = SiteNumbers<NT>(waves, bits);
  for (std::size_t k = 0; k < 3; ++k) numbers.side[k] = predicates::side_line(*numbers.frame, k);
}

}  // namespace gvd::kernel
