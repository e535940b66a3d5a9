#pragma once

#include <cstdint>

namespace gvd::robust {

/// While it lives, this thread asks algebra so many questions and no more: all further ones are answered as if the proof were out of reach. What is
/// built on algebra must then say the same or be undecided, never something else; so every place can be tested where a proof is wanting, whether or
/// not an input is known that wants it. Of several limits the last one made counts. Without one, nothing is limited.
class ProofLimit {
 public:
  explicit ProofLimit(std::uint64_t questions) noexcept;
  ~ProofLimit();
  ProofLimit(const ProofLimit&) = delete;
  ProofLimit& operator=(const ProofLimit&) = delete;

  /// Whether a question was left without a proof.
  bool was_reached() const noexcept { return reached_; }
  std::uint64_t questions_left() const noexcept { return left_; }

  /// Asked wherever a proof begins. False: there is none.
  static bool allows_one() noexcept;

 private:
  std::uint64_t left_;
  bool reached_ = false;
  ProofLimit* outer_;
};

}  // namespace gvd::robust
