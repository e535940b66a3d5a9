#pragma once

#include <cstdint>
#include <limits>

namespace gvd::robust {

/// While it lives, algebra answers so many questions of this thread, then refuses so many (by default all) as if the proof were out of reach. What is
/// built on algebra must then say the same or be undecided, never something else; so every place can be tested where a proof is wanting, whether or
/// not an input is known that wants it. Of several limits the last one made counts. Without one, nothing is limited.
class ProofLimit {
 public:
  static constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();

  explicit ProofLimit(std::uint64_t answered, std::uint64_t refused = kAll) noexcept;
  ~ProofLimit();
  ProofLimit(const ProofLimit&) = delete;
  ProofLimit& operator=(const ProofLimit&) = delete;

  /// Whether a question was refused.
  bool was_reached() const noexcept { return reached_; }
  /// Questions that will still be answered before the first one is refused.
  std::uint64_t questions_left() const noexcept { return answered_; }

  /// Asked wherever a proof begins. False: there is none.
  static bool allows_one() noexcept;

 private:
  std::uint64_t answered_, refused_;
  bool reached_ = false;
  ProofLimit* outer_;
};

}  // namespace gvd::robust
