#pragma once
/// Waves in long numbers, as those that doubles with an error may stand for.
#include <cmath>
#include <random>

#include "gvd/predicates/wave.hpp"

namespace gvd::test {

using Long = robust::Ball<robust::Mpfr>;
using LongPoint = predicates::PlanePoint<Long>;

inline Long wide(double x) { return robust::from_double<Long>(x, 400); }
inline LongPoint wide(const predicates::DoublePoint& p) { return {wide(p.x), wide(p.y)}; }
inline double nearest(const Long& x) { return x.mid().to_double(); }

/// A wave that the doubles of another one may stand for.
struct TrueWave {
  LongPoint image;
  Long weight;
};
inline Long distance(const TrueWave& wave, const LongPoint& p) {
  using predicates::operator-;
  return wave.weight + sqrt(squared_norm(p - wave.image));
}

/// Numbers in [-1, 1) and points of them.
class Shares {
 public:
  explicit Shares(unsigned seed) : random_(seed) {}
  double share() { return 2 * unit_(random_) - 1; }
  predicates::DoublePoint point() { return {share(), share()}; }
  std::uint64_t bits() { return random_(); }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> unit_{0, 1};
};

}  // namespace gvd::test
