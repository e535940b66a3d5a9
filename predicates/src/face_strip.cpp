#include "gvd/predicates/face_strip.hpp"

#include <stdexcept>
#include <string>

#include "strip_access.hpp"

namespace gvd::predicates {

using robust::MaybeSign;
using robust::Sign;
using robust::Stage;

namespace {

FaceCorners corners_of(std::span<const SpacePoint> vertices, const FaceIndices& face) {
  FaceCorners corners;
  for (std::size_t k = 0; k < 3; ++k) {
    if (face[k] >= vertices.size()) throw std::invalid_argument("vertex " + std::to_string(face[k]) + " is out of range");
    corners[k] = vertices[face[k]];
  }
  return corners;
}

/// What comes next is appended without an allocation, which might fail.
template <class T>
void make_room(std::vector<T>& list) {
  if (list.size() == list.capacity()) list.reserve(2 * list.size() + 4);
}

/// The face with its source, seen over a side: that side, and opposite to it the source in the place of the corner.
std::shared_ptr<FaceShape> seen_from_source(const FaceCorners& face, const std::array<mpq_class, 3>& weight, std::size_t side) {
  const SpacePoint &from = face[side], &to = face[(side + 1) % 3], &opposite = face[(side + 2) % 3];
  if (weight[(side + 2) % 3] == 1) return std::make_shared<FaceShape>(FaceCorners{from, to, opposite});
  ExactPoint source{0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const ExactPoint corner = exact_point(face[k]);
    for (std::size_t i = 0; i < 3; ++i) source[i] += weight[k] * corner[i];
  }
  return std::make_shared<FaceShape>(from, to, source);
}

/// Which corner of the face is p; 3 if none.
std::size_t find_corner(const FaceCorners& face, const SpacePoint& p) {
  return static_cast<std::size_t>(std::find(face.begin(), face.end(), p) - face.begin());
}

}  // namespace

FacePoint FacePoint::corner(std::size_t k) {
  FacePoint p;
  p.weight.at(k) = 1;
  return p;
}

FacePoint FacePoint::on_side(std::size_t k, const mpq_class& t) {
  FacePoint p;
  p.weight.at(k) = 1 - t;
  p.weight[(k + 1) % 3] = t;
  return p;
}

std::array<mpq_class, 3> normalised(const FacePoint& p) {
  for (const mpq_class& w : p.weight)
    if (sgn(w) < 0) throw std::invalid_argument("a point of a face has a negative weight");
  const mpq_class sum = p.weight[0] + p.weight[1] + p.weight[2];
  if (sgn(sum) == 0) throw std::invalid_argument("the weights of a point of a face are all zero");
  return {p.weight[0] / sum, p.weight[1] / sum, p.weight[2] / sum};
}

FaceStrip::FaceStrip(const FaceCorners& first, const FacePoint& source)
    : last_(first), source_(normalised(source)), vertices_(first.begin(), first.end()), faces_{std::make_shared<FaceShape>(first)} {
  strip_.opposite = 0;
}

FaceStrip::FaceStrip(std::span<const SpacePoint> vertices, const FaceIndices& first, const FacePoint& source)
    : FaceStrip(corners_of(vertices, first), source) {}

void FaceStrip::cross(std::span<const SpacePoint> vertices, const FaceIndices& face) { cross(corners_of(vertices, face)); }

void FaceStrip::cross(const FaceCorners& face) {
  const FaceCorners shape = faces_.back()->corners();
  const FaceCorners& before = crossings() == 0 ? last_ : shape;
  // The side left: opposite the one corner of the last face that the new one does not have.
  std::size_t side = 3, missing = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (find_corner(face, before[k]) != 3) continue;
    ++missing;
    side = (k + 1) % 3;
  }
  if (missing != 1) throw std::invalid_argument("a face shares no edge with the last one, or all of them");
  const SpacePoint origin = before[(side + 1) % 3], target = before[side];  // of the entry edge, as seen from the new face
  std::size_t apex = 0;
  while (apex < 3 && (face[apex] == origin || face[apex] == target)) ++apex;
  if (apex == 3) throw std::invalid_argument("a face has a repeated corner");
  auto entered = std::make_shared<FaceShape>(FaceCorners{origin, target, face[apex]});
  make_room(faces_);
  make_room(vertices_);
  make_room(strip_.steps);
  if (crossings() == 0) {
    if (sgn(source_[(side + 2) % 3]) == 0) throw std::invalid_argument("the first edge crossed contains the source");
    faces_[0] = seen_from_source(before, source_, side);
    exit_ = static_cast<std::uint8_t>(side);
  } else {
    if (side == 0) throw std::invalid_argument("a strip goes back over the edge by which it came in");
    strip_.steps.push_back({static_cast<std::uint32_t>(3 * crossings() + side), side == 2, false});
  }
  faces_.push_back(std::move(entered));
  vertices_.push_back(face[apex]);
  last_ = face;
  for (std::size_t k = 0; k < 3; ++k) place_[k] = face[k] == origin ? 0 : face[k] == target ? 1 : 2;
}

bool operator==(const FaceStrip& a, const FaceStrip& b) {
  if (a.source_ != b.source_ || a.vertices_ != b.vertices_ || a.exit_ != b.exit_ || a.last_ != b.last_) return false;
  return std::equal(a.strip_.steps.begin(), a.strip_.steps.end(), b.strip_.steps.begin(), b.strip_.steps.end(),
                    [](const StripStep& s, const StripStep& t) { return s.side == t.side; });
}

std::array<mpq_class, 3> StripAccess::placed(const FacePoint& p) const {
  const std::array<mpq_class, 3> given = normalised(p);
  std::array<mpq_class, 3> b;
  for (std::size_t k = 0; k < 3; ++k) b[place(k)] = given[k];
  return b;
}

std::optional<std::size_t> StripAccess::source_corner() const {
  for (std::size_t k = 0; k < 3; ++k)
    if (strip_.source_[k] == 1) return k;
  return std::nullopt;
}

void StripAccess::require_vertex(std::size_t v) const {
  if (v >= strip_.vertex_count()) throw std::invalid_argument("the strip has no vertex " + std::to_string(v));
  if (strip_.crossings() > 0 && v == (strip_.exit_ + 2u) % 3 && !is_source(v))
    throw std::invalid_argument("vertex " + std::to_string(v) + " is not on an edge that the strip crosses");
}

std::pair<std::uint32_t, std::uint8_t> StripAccess::vertex_place(std::size_t v) const {
  if (strip_.crossings() == 0) return {0, static_cast<std::uint8_t>(v)};
  if (v >= 3) return {static_cast<std::uint32_t>(v - 2), 2};
  return {1, v == strip_.exit_ ? 1 : 0};
}

MaybeSign ray_side_at(const Rung& rung, const FaceStrip& strip, std::size_t through, std::size_t v) {
  const StripAccess at(strip);
  at.require_vertex(through);
  at.require_vertex(v);
  const auto turn = [&](auto& numbers) {
    return orientation(numbers.coordinates(at.image(numbers)), numbers.coordinates(at.vertex(numbers, through)),
                       numbers.coordinates(at.vertex(numbers, v)));
  };
  if (rung.stage == Stage::identity)
    return through == v || at.is_source(through) || at.is_source(v) ? MaybeSign(Sign::zero) : std::nullopt;
  if (rung.stage == Stage::algebra) {
    const auto exact = with_roots(at, turn);
    return exact ? maybe_sign(*exact) : std::nullopt;
  }
  return numeric_stage<Sign>(rung, at.is_in_range(),
                             [&]<class T>(int bits) -> MaybeSign { return maybe_sign(with_numbers<T>(at, bits, turn)); });
}

Decision ray_side(const FaceStrip& strip, std::size_t through, std::size_t v) {
  if (ray_side_at({Stage::identity}, strip, through, v)) return {Sign::zero, Stage::identity};
  return decide([&](const Rung& rung) { return ray_side_at(rung, strip, through, v); });
}

ConeDecision cone_of(const FaceStrip& strip) {
  if (strip.crossings() == 0) throw std::invalid_argument("a strip without crossing has no cone");
  const StripAccess at(strip);
  ConeDecision cone{ConeDecision::Sight::interval, at.first_bounds(), Stage::identity};
  const auto side_of = [&](std::size_t end, std::size_t v) -> MaybeSign {
    const Decision d = ray_side(strip, cone.bound[end], v);
    cone.stage = std::max(cone.stage, d.stage);
    if (!d.sign) cone.sight = ConeDecision::Sight::undecided;
    return d.sign;
  };
  for (std::size_t k = 1; k < strip.crossings(); ++k) {
    const std::size_t corner = k + 2;
    const bool left = at.leaves_left(k);
    // The ray on the side of the exit must have the corner strictly on its inner side, or nothing is left.
    const MaybeSign near = side_of(left ? 0 : 1, corner);
    if (!near) return cone;
    if (*near != (left ? Sign::negative : Sign::positive)) return {ConeDecision::Sight::nothing, {0, 0}, cone.stage};
    const MaybeSign far = side_of(left ? 1 : 0, corner);
    if (!far) return cone;
    if (*far == (left ? Sign::positive : Sign::negative)) cone.bound[left ? 1 : 0] = corner;
  }
  return cone;
}

}  // namespace gvd::predicates
