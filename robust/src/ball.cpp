#include "gvd/robust/ball.hpp"

namespace gvd::robust {

Ball<DoubleDouble> to_double_double(const Ball<Mpfr>& a) {
  const double hi = a.mid().to_double();
  int ternary;
  const Mpfr after_hi = Mpfr::subtract(a.mid(), Mpfr(hi), ternary);  // exact: the difference has fewer bits than a.mid(), or 53
  const double lo = after_hi.to_double();
  const double lost = std::fabs((after_hi - Mpfr(lo)).to_double(MPFR_RNDA));
  return {fast_two_sum(hi, lo), (a.rad() + lost) * kRadiusInflation};
}

template <>
Ball<Mpfr> from<Ball<Mpfr>>(const mpq_class& q, int bits) {
  int ternary;
  Mpfr mid(q, bits, &ternary);
  const double error = mid.rounding_error(ternary);
  return {std::move(mid), error};
}

template <>
Ball<DoubleDouble> from<Ball<DoubleDouble>>(const mpq_class& q, int) {
  return to_double_double(from<Ball<Mpfr>>(q, 192));
}

template <>
Ball<double> from<Ball<double>>(const mpq_class& q, int) {
  return narrowed(from<Ball<Mpfr>>(q, 96));
}

}  // namespace gvd::robust
