// Two ways from one source over a roof to the vertex behind it: which is shorter, and what does the source see?
//   cmake -S examples/predicates -B build/example -D CMAKE_PREFIX_PATH=PREFIX && cmake --build build/example
#include <cstdio>
#include <vector>

#include "gvd/predicates/strip_window.hpp"

namespace {

using namespace gvd::predicates;

const char* text(const Decision& d) {
  if (!d.sign) return "undecided";
  return *d.sign == gvd::robust::Sign::negative ? "negative" : *d.sign == gvd::robust::Sign::zero ? "zero" : "positive";
}
void print(const char* question, const Decision& d) {
  std::printf("%s: %s, by %s\n", question, text(d), gvd::robust::kStageNames[static_cast<std::size_t>(d.stage)]);
}

}  // namespace

int main() {
  // A roof over the square [-4, 4]^2: the ridge is the edge 4 - 5, at x = 0, 3 high.
  const std::vector<SpacePoint> vertices{{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}, {0, -4, 3}, {0, 4, 3}};
  // The source is the centroid of the face 0 4 3. One way goes over the ridge, the other along the eaves of the left side.
  const FacePoint centroid{{1, 1, 1}};
  FaceStrip over(vertices, {0, 4, 3}, centroid);
  over.cross(vertices, {4, 5, 3});
  over.cross(vertices, {4, 2, 5});
  const Path to_corner{0, {Leg(over, FacePoint::corner(1))}};

  FaceStrip to_ridge(vertices, {0, 4, 3}, centroid);
  to_ridge.cross(vertices, {4, 5, 3});
  const Leg along_ridge(to_ridge, FacePoint::corner(1));
  const Leg down(FaceStrip(vertices, {4, 2, 5}, FacePoint::corner(2)), FacePoint::corner(1));
  const Path by_ridge{0, {along_ridge, down}};

  print("straight over the ridge - by the end of the ridge", compare_lengths(to_corner, by_ridge));
  const Enclosure e = length(to_corner);
  std::printf("straight: in [%.17g, %.17g], rounded %.17g\n", e.lower, e.upper, rounded_length(to_corner).value.value_or(-1));

  print("vertex 2 against the ray through the end of the ridge", ray_side(over, 3, 4));
  const ConeDecision cone = cone_of(over);
  std::printf("sees the ridge between vertices %zu and %zu of the strip\n", cone.bound[0], cone.bound[1]);

  // Two sources, mirror images in the ridge: they tie all along it.
  FaceStrip mirrored(vertices, {1, 2, 4}, centroid);
  mirrored.cross(vertices, {4, 2, 5});
  const Window a{to_ridge, {}, std::nullopt}, b{mirrored, {}, std::nullopt};
  const EdgeTies ties = ties_on_edge(a, b, {vertices[4], vertices[5]});
  const bool all_along = ties.kind == EdgeTies::Kind::everywhere;
  std::printf("two sources that are mirror images in the ridge tie %s\n", all_along ? "all along it" : "not all along it");
  const bool fine = compare_lengths(to_corner, by_ridge).sign == gvd::robust::Sign::negative &&
                    cone.sight == ConeDecision::Sight::interval && all_along;
  return fine ? 0 : 1;
}
