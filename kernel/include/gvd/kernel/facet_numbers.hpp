#pragma once

#include <array>
#include <vector>

#include "gvd/kernel/facet.hpp"
#include "gvd/predicates/side_tie.hpp"

namespace gvd::kernel {

/// The numbers of a facet's waves in one number type. `sites` has a null pointer where a number type has nothing to offer (Exact only).
template <class NT>
struct FacetNumbers {
  const predicates::FacetFrame<NT>* frame = nullptr;
  std::vector<const predicates::Site<NT>*> sites;
  std::array<predicates::SideLine<NT>, 3> side;
};

/// Asks for the numbers in NT (`bits` for Mpfr only). The result is valid as long as the references of `waves` are.
/// For Exact, `frame` is null if the facet has no exact numbers.
template <class NT>
void load_numbers(FacetWaves& waves, int bits, FacetNumbers<NT>& numbers) {
  constexpr bool kExact = std::is_same_v<NT, robust::Exact>;
  constexpr bool kBits = std::is_same_v<NT, FacetWaves::M>;
  if constexpr (kExact)
    numbers.frame = waves.exact_frame();
  else if constexpr (kBits)
    numbers.frame = &waves.frame(NT(), bits);
  else
    numbers.frame = &waves.frame(NT());
  numbers.sites.clear();
  if (numbers.frame == nullptr) return;
  numbers.sites.reserve(waves.sites.size());
  for (std::size_t i = 0; i < waves.sites.size(); ++i) {
    if constexpr (kExact)
      numbers.sites.push_back(waves.exact_site(i));
    else if constexpr (kBits)
      numbers.sites.push_back(&waves.site(i, NT(), bits));
    else
      numbers.sites.push_back(&waves.site(i, NT()));
  }
  for (std::size_t k = 0; k < 3; ++k) numbers.side[k] = predicates::side_line(*numbers.frame, k);
}

}  // namespace gvd::kernel
