#include "gvd/predicates/strip_program.hpp"

namespace gvd::predicates {

using robust::RootProgram;

namespace {

using RationalMatrix = std::array<std::array<mpq_class, RootProgram::kSize>, RootProgram::kSize>;

/// The multiple of  constant + root factor  with the least whole entries, root = coefficient sqrt(radicand); its `scale` is left behind.
class WholeLayer {
 public:
  WholeLayer(const RationalMatrix& constant, const RationalMatrix& factor, const robust::RootSum& root) {
    const bool rational = root.terms().empty();
    const mpq_class coefficient = rational ? root.constant() : root.coefficient(root.terms().front());
    layer.radicand = rational ? mpz_class(1) : root.terms().front().radicand;
    mpz_class numerators = 0, denominators = 1;
    const auto note = [&](const mpq_class& q) {
      numerators = gcd(numerators, q.get_num());
      denominators = lcm(denominators, q.get_den());
    };
    for_each_entry([&](std::size_t i, std::size_t j) {
      note(constant[i][j]);
      note(factor[i][j] * coefficient);
    });
    scale = mpq_class(denominators) / numerators;
    for_each_entry([&](std::size_t i, std::size_t j) {
      layer.constant[i][j] = mpq_class(constant[i][j] * scale).get_num();
      layer.factor[i][j] = mpq_class(factor[i][j] * coefficient * scale).get_num();
    });
  }

  RootProgram::Layer layer;
  mpq_class scale;

 private:
  template <class Visit>
  static void for_each_entry(const Visit& visit) {
    for (std::size_t i = 0; i < RootProgram::kSize; ++i)
      for (std::size_t j = 0; j < RootProgram::kSize; ++j) visit(i, j);
  }
};

/// Times the squared length of the side that is crossed: z' = z (d - i root) / squared, for the turn at a = 0.
WholeLayer left_turn(const ExactFace& face, std::size_t k, const robust::RootSum& root) {
  const std::size_t from = (k + 1) % 3;
  const mpq_class &d = face.dot[from], &squared = face.squared[k];
  RationalMatrix constant, factor;
  constant[0][0] = face.squared[from];
  constant[1][1] = constant[2][2] = d;
  constant[3][3] = squared;
  factor[1][2] = 1;
  factor[2][1] = -1;
  return {constant, factor, root};
}

/// 1 - z' = (1 - z) (d + i root) / squared, for the turn at b = 1.
WholeLayer right_turn(const ExactFace& face, std::size_t k, const robust::RootSum& root) {
  const mpq_class &d = face.dot[k], &squared = face.squared[k], &from = face.squared[(k + 2) % 3];
  RationalMatrix constant, factor;
  constant[0] = {from, 2 * (d - from), 0, squared - 2 * d + from};
  constant[1] = {0, d, 0, squared - d};
  constant[2][2] = d;
  constant[3][3] = squared;
  factor[0][2] = -2;
  factor[1][2] = -1;
  factor[2] = {0, 1, 0, -1};
  return {constant, factor, root};
}

}  // namespace

StripProgram::StripProgram(const ProgramFace& root_face, std::size_t k) : program_({0, 0, 0, 1}) {
  const ExactFace& face = root_face.face;
  const std::size_t next = (k + 1) % 3;
  RationalMatrix constant, factor;
  constant[0][3] = face.squared[next];
  constant[1][3] = face.dot[next];
  constant[3][3] = face.squared[k];
  factor[2][3] = -1;
  WholeLayer whole(constant, factor, root_face.doubled_area);
  program_.append(std::move(whole.layer));
  denominator_ = whole.scale * face.squared[k];
}

void StripProgram::cross(const ProgramFace& face, std::size_t k, bool left) {
  WholeLayer whole = left ? left_turn(face.face, k, face.doubled_area) : right_turn(face.face, k, face.doubled_area);
  program_.append(std::move(whole.layer));
  denominator_ *= whole.scale * face.face.squared[k];
}

RootProgram StripProgram::value(const std::array<long, 4>& functional) const {
  RootProgram result = program_;
  // The denominator is whole: it is the product of the entries [3][3] of the layers.
  result.finish({functional[0], functional[1], functional[2], functional[3]}, denominator_.get_num());
  return result;
}

/// |z - p|^2 = |z|^2 - 2 z.p + |p|^2 with p = b1 + b2 w: one more layer over the face's root.
RootProgram StripProgram::squared_distance(const ProgramFace& face, std::size_t k, const mpq_class& b1, const mpq_class& b2) const {
  const mpq_class &squared = face.face.squared[k], &dot = face.face.dot[k], &from = face.face.squared[(k + 2) % 3];
  RationalMatrix constant, factor;
  constant[0] = {squared, -2 * (b1 * squared + b2 * dot), 0, b1 * b1 * squared + 2 * b1 * b2 * dot + b2 * b2 * from};
  factor[0][2] = -2 * b2;
  WholeLayer whole(constant, factor, face.doubled_area);
  RootProgram result = program_;
  result.append(std::move(whole.layer));
  const mpq_class denominator = denominator_ * whole.scale;
  result.finish({denominator.get_den(), 0, 0, 0}, denominator.get_num());
  return result;
}

}  // namespace gvd::predicates
