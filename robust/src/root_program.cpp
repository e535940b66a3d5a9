#include "gvd/robust/root_program.hpp"

#include "gvd/robust/proof_limit.hpp"
#include "span_test.hpp"

namespace gvd::robust {

namespace {

using Matrix = RootProgram::Matrix;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c;
  for (std::size_t i = 0; i < RootProgram::kSize; ++i)
    for (std::size_t j = 0; j < RootProgram::kSize; ++j)
      for (std::size_t k = 0; k < RootProgram::kSize; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

Matrix sum(const Matrix& a, const Matrix& b) {
  Matrix c;
  for (std::size_t i = 0; i < RootProgram::kSize; ++i)
    for (std::size_t j = 0; j < RootProgram::kSize; ++j) c[i][j] = a[i][j] + b[i][j];
  return c;
}

Matrix multiple(const Matrix& a, const mpz_class& n) {
  Matrix c = a;
  for (auto& row : c)
    for (auto& entry : row) entry *= n;
  return c;
}

Matrix transposed(const Matrix& a) {
  Matrix c;
  for (std::size_t i = 0; i < RootProgram::kSize; ++i)
    for (std::size_t j = 0; j < RootProgram::kSize; ++j) c[i][j] = a[j][i];
  return c;
}

// Of (constant + sqrt r factor) of both. Pre: one of them has no root (radicand 1, factor 0), or both have the same.
RootProgram::Layer product(const RootProgram::Layer& a, const RootProgram::Layer& b) {
  const mpz_class& radicand = a.radicand == 1 ? b.radicand : a.radicand;
  return {radicand, sum(product(a.constant, b.constant), multiple(product(a.factor, b.factor), radicand)),
          sum(product(a.constant, b.factor), product(a.factor, b.constant))};
}

}  // namespace

void RootProgram::append(Layer layer) {
  if (layer.radicand == 1) {
    layer.constant = sum(layer.constant, layer.factor);
    layer.factor = {};
  }
  if (!layers_.empty() && (layer.radicand == 1 || layers_.back().radicand == 1 || layer.radicand == layers_.back().radicand))
    layers_.back() = product(layer, layers_.back());
  else
    layers_.push_back(std::move(layer));
}

void RootProgram::finish(Vector last, mpz_class denominator) {
  last_ = std::move(last);
  denominator_ = std::move(denominator);
}

RootProgram RootProgram::reversed() const {
  RootProgram result(last_);
  for (auto layer = layers_.rbegin(); layer != layers_.rend(); ++layer)
    result.layers_.push_back({layer->radicand, transposed(layer->constant), transposed(layer->factor)});
  result.finish(first_, denominator_);
  return result;
}

bool are_proved_equal(const RootProgram& a, const RootProgram& b) {
  if (!ProofLimit::allows_one()) return false;
  const RootProgram backwards = b.reversed();
  const Alignment forth = aligned(a, b), back = aligned(a, backwards);
  const bool reverse = back.common > forth.common;
  const RootProgram& other = reverse ? backwards : b;
  const Alignment& alignment = reverse ? back : forth;
  if (SpanTest(a, other, alignment, Unknowns::of_steps).proves_equal()) return true;
  return SpanTest(a, other, alignment, Unknowns::of_basis).proves_equal();
}

}  // namespace gvd::robust
