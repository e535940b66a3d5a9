#pragma once

#include <array>

#include "gvd/robust/decision.hpp"
#include "gvd/robust/sign.hpp"

namespace gvd::predicates {

/// What a predicate says, and the stage that proved it. Without a sign (stage `undecided`) no stage could.
struct Decision {
  robust::MaybeSign sign;
  robust::Stage stage = robust::Stage::undecided;
};

/// One try of the ladder: a stage, for `mpfr` with so many bits. Every predicate over strips can be asked at a single rung; then it answers
/// only if that rung alone can prove the answer.
struct Rung {
  robust::Stage stage;
  int bits = 0;
};

/// In the order in which they are tried. What 256 bits cannot tell is a tie more often than not: algebra comes before longer numbers.
inline constexpr std::array<Rung, 7> kRungs = {{{robust::Stage::filter},
                                                {robust::Stage::double_double},
                                                {robust::Stage::mpfr, 128},
                                                {robust::Stage::mpfr, 256},
                                                {robust::Stage::algebra},
                                                {robust::Stage::mpfr, 512},
                                                {robust::Stage::mpfr, 1024}}};

}  // namespace gvd::predicates
