#include "gvd/robust/rounding.hpp"

#include "correct_rounding.hpp"
#include "gvd/robust/rational.hpp"

namespace gvd::robust {

std::optional<double> rounded(const MpfrInterval& x) {
  const double low = x.low().to_double();
  if (low != x.high().to_double()) return std::nullopt;
  return low + 0.0;
}

std::optional<double> rounded(const Ball<Mpfr>& x) {
  if (!std::isfinite(x.rad()) || !x.mid().is_finite()) return std::nullopt;
  constexpr int kExtraBits = 64;  // so that the ends are nearly exact, and the test fails near midpoints only
  Mpfr low(0.0, x.mid().bits() + kExtraBits), high(0.0, x.mid().bits() + kExtraBits);
  mpfr_sub_d(low.get(), x.mid().get(), x.rad(), MPFR_RNDD);
  mpfr_add_d(high.get(), x.mid().get(), x.rad(), MPFR_RNDU);
  const double value = low.to_double();
  if (value != high.to_double()) return std::nullopt;
  return value + 0.0;
}

mpq_class rounding_midpoint_above(double x) {
  const double above = std::nextafter(x, std::numeric_limits<double>::infinity());
  const mpq_class next = std::isfinite(above) ? exact_rational(above) : power_of_two(1024);
  return (exact_rational(x) + next) / 2;
}

}  // namespace gvd::robust
