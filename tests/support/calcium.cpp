#include "calcium.hpp"

// The headers of Calcium 0.4 are C: as C++ they need -fpermissive (tests/CMakeLists.txt).
#include <calcium/ca.h>

namespace gvd::test {
namespace {

ca_ctx_struct* context() {
  static struct Context {
    Context() { ca_ctx_init(ctx); }
    ~Context() { ca_ctx_clear(ctx); }
    ca_ctx_t ctx;
  } it;
  return it.ctx;
}

}  // namespace

struct Calcium::Number {
  Number() { ca_init(x, context()); }
  ~Number() { ca_clear(x, context()); }
  Number(const Number&) = delete;
  Number& operator=(const Number&) = delete;

  static std::shared_ptr<const Number> by(auto function, const Calcium& a, const auto&... others) {
    auto result = std::make_shared<Number>();
    function(result->x, a.number_->x, others.number_->x..., context());
    return result;
  }
  ca_t x;
};

Calcium::Calcium(const mpq_class& q) {
  auto number = std::make_shared<Number>();
  fmpq_t f;
  fmpq_init(f);
  fmpq_set_mpq(f, q.get_mpq_t());
  ca_set_fmpq(number->x, f, context());
  fmpq_clear(f);
  number_ = std::move(number);
}

Calcium operator+(const Calcium& a, const Calcium& b) { return Calcium(Calcium::Number::by(ca_add, a, b)); }
Calcium operator-(const Calcium& a, const Calcium& b) { return Calcium(Calcium::Number::by(ca_sub, a, b)); }
Calcium operator*(const Calcium& a, const Calcium& b) { return Calcium(Calcium::Number::by(ca_mul, a, b)); }
Calcium operator/(const Calcium& a, const Calcium& b) { return Calcium(Calcium::Number::by(ca_div, a, b)); }
Calcium sqrt(const Calcium& a) { return Calcium(Calcium::Number::by(ca_sqrt, a)); }

robust::MaybeSign maybe_sign(const Calcium& a) {
  const Calcium zero(0);
  const truth_t is_zero = ca_check_is_zero(a.number_->x, context());
  if (is_zero == T_TRUE) return robust::Sign::zero;
  const truth_t less = ca_check_lt(a.number_->x, zero.number_->x, context());
  if (is_zero == T_UNKNOWN || less == T_UNKNOWN) return std::nullopt;
  return less == T_TRUE ? robust::Sign::negative : robust::Sign::positive;
}

}  // namespace gvd::test
