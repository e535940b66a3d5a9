// Whether two waves of different facets at a vertex have one image, asked of all waves round all vertices. In a plane the truth is plain: the image of a wave is where it
// starts. On other surfaces what is proved must hold in doubles.
#include "../../kernel/src/fan_image.hpp"

#include <gtest/gtest.h>

#include <complex>

#include "gvd/robust/proof_limit.hpp"
#include "support/field_facets.hpp"
#include "support/truth.hpp"

namespace gvd::kernel {
namespace {

using robust::ProofLimit;
using Facets = std::vector<std::unique_ptr<FieldWaves>>;

/// The half-edges that start at a vertex, counter-clockwise from that of facet a to that of facet b; empty if the boundary lies between.
std::vector<HalfedgeId> fan_between(const Mesh& mesh, VertexId v, FaceId a, FaceId b) {
  std::vector<HalfedgeId> fan;
  HalfedgeId h = 3 * a;
  while (mesh.origin(h) != v) ++h;
  for (; Mesh::face(h) != b; h = mesh.twin(Mesh::prev(h))) {
    fan.push_back(h);
    if (mesh.twin(Mesh::prev(h)) == kNone) return {};
  }
  fan.push_back(h);
  return fan;
}

/// Calls visit(v, a, site of a, b, site of b) for all waves of all pairs of facets round all vertices.
template <class Visit>
void for_each_pair(const Mesh& mesh, const Facets& facets, const Visit& visit) {
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    std::vector<FieldWaves*> round;
    mesh.for_each_outgoing(v, [&](HalfedgeId h) { round.push_back(facets[Mesh::face(h)].get()); });
    for (FieldWaves* a : round)
      for (FieldWaves* b : round)
        for (std::uint32_t i = 0; i < a->sites.size(); ++i)
          for (std::uint32_t j = 0; j < b->sites.size() && !testing::Test::HasFailure(); ++j) visit(v, *a, i, *b, j);
  }
}

Facets facets_of(const test::FieldFacets& field) {
  Facets facets;
  for (FaceId f = 0; f < field.mesh().face_count(); ++f) facets.push_back(field.waves_of(f));
  return facets;
}

TEST(FanImage, InAPlaneIsWhereTheWaveStarts) {
  const Mesh mesh(test::plane_with_hole(5, 4, 2, 3, 2, 3));
  const test::FieldFacets field(mesh, {test::at_vertex(mesh, 0), test::at_vertex(mesh, 17), test::at_vertex(mesh, 25)});
  const Facets facets = facets_of(field);
  int one = 0, different = 0, behind_the_boundary = 0;
  for_each_pair(field.mesh(), facets, [&](VertexId v, FieldWaves& a, std::uint32_t i, FieldWaves& b, std::uint32_t j) {
    const auto said = have_one_image_round(field.mesh(), v, a, i, b, j);
    const bool is_open = !fan_between(field.mesh(), v, a.face, b.face).empty(), same = a.sites[i].root == b.sites[j].root;
    ASSERT_EQ(said.has_value(), is_open);
    behind_the_boundary += !is_open;
    if (!said) return;
    EXPECT_EQ(*said, same) << "vertex " << v << ", faces " << a.face << " and " << b.face;
    (same ? one : different) += 1;
  });
  EXPECT_GT(one, 0);
  EXPECT_GT(different, 0);
  EXPECT_GT(behind_the_boundary, 0);
}

/// The image as seen from the vertex, along the first edge of the fan, by angles and lengths in space.
std::complex<double> seen_from(FieldWaves& waves, std::uint32_t site, const Mesh& mesh, HalfedgeId h) {
  const auto corner = [&](std::size_t k) {
    const auto& apex = waves.frame(FacetWaves::F()).apex;
    return k == 0 ? std::complex<double>(0) : k == 1 ? std::complex<double>(1) : std::complex<double>(apex.x.mid(), apex.y.mid());
  };
  const auto& image = waves.site(site, FacetWaves::F()).image;
  const std::complex<double> from = corner(h % 3), direction = corner((h + 1) % 3) - from;
  const Point &p = mesh.point(mesh.origin(h)), &q = mesh.point(mesh.target(h));
  return (std::complex<double>(image.x.mid(), image.y.mid()) - from) / direction * std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
}
double angle_at(const Mesh& mesh, HalfedgeId h) {
  const Point &v = mesh.point(mesh.origin(h)), &p = mesh.point(mesh.target(h)), &q = mesh.point(mesh.apex(h));
  double dot = 0, square_p = 0, square_q = 0;
  for (std::size_t k = 0; k < 3; ++k) dot += (p[k] - v[k]) * (q[k] - v[k]), square_p += (p[k] - v[k]) * (p[k] - v[k]), square_q += (q[k] - v[k]) * (q[k] - v[k]);
  return std::acos(dot / std::sqrt(square_p * square_q));
}

// With proofs and, one after the other, without: each answer is the true one, or none.
TEST(FanImage, OnRoughSurfacesHoldsInDoubles) {
  int one = 0, different = 0, too_many_classes = 0, unproved = 0;
  test::Random random(2700);
  for (const auto& arrays : {test::staircase(2, 2), test::integer_saddle(1), test::cube(1), test::grid(2, 2, [&](auto, auto) { return random.uniform(); }),
                             test::fan(9, {0, 0, 0}, [&](std::uint32_t i) -> Point { return {std::cos(0.7 * i), std::sin(0.7 * i), random.uniform()}; })}) {
    const Mesh mesh(arrays);
    const test::FieldFacets field(mesh, {test::at_vertex(mesh, 1), test::at_vertex(mesh, static_cast<VertexId>(mesh.vertex_count()) - 1)});
    for_each_pair(field.mesh(), facets_of(field), [&](VertexId v, FieldWaves& a, std::uint32_t i, FieldWaves& b, std::uint32_t j) {
      const auto fan = fan_between(field.mesh(), v, a.face, b.face);
      const auto said = have_one_image_round(field.mesh(), v, a, i, b, j);
      if (fan.empty() || !said) {
        EXPECT_FALSE(said);
        too_many_classes += !fan.empty();
        return;
      }
      double turn = 0;
      for (std::size_t k = 0; k + 1 < fan.size(); ++k) turn += angle_at(field.mesh(), fan[k]);
      const auto of_a = seen_from(a, i, field.mesh(), fan.front()), of_b = seen_from(b, j, field.mesh(), fan.back()) * std::polar(1.0, turn);
      EXPECT_EQ(*said, std::abs(of_a - of_b) < 1e-9) << "vertex " << v << ", faces " << a.face << " and " << b.face;
      (*said ? one : different) += 1;
    });
    // Numbers remember their signs: facets are made anew.
    for (std::uint64_t proofs = 0; proofs < 40; ++proofs) {
      const Facets facets = facets_of(field), limited_facets = facets_of(field);
      const HalfedgeId h = field.mesh().twin(0) == kNone ? 1 : 0, twin = field.mesh().twin(h);
      const VertexId v = field.mesh().origin(h);
      if (twin == kNone || facets[0]->sites.empty() || facets[Mesh::face(twin)]->sites.empty()) break;
      const auto truth = have_one_image_round(field.mesh(), v, *facets[Mesh::face(twin)], 0, *facets[0], 0);
      const ProofLimit limit(proofs);
      const auto said = have_one_image_round(field.mesh(), v, *limited_facets[Mesh::face(twin)], 0, *limited_facets[0], 0);
      unproved += !said;
      EXPECT_TRUE(!said || said == truth) << "with " << proofs << " proofs";
    }
  }
  EXPECT_GT(one, 0);
  EXPECT_GT(different, 0);
  EXPECT_GT(too_many_classes, 0);
  EXPECT_GT(unproved, 0);
}

}  // namespace
}  // namespace gvd::kernel
