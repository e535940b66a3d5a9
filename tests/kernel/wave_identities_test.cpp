// What the strips of a facet's waves prove about one another, asked of all waves of a facet, whether or not the tessellation would ask: what is proved must hold in
// long numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "../../kernel/src/edge_images.hpp"
#include "fuzz/generators/family.hpp"
#include "gvd/kernel/surface_point.hpp"
#include "gvd/predicates/wave.hpp"
#include "gvd/robust/proof_limit.hpp"
#include "support/field_facets.hpp"
#include "support/mirrored_terrain.hpp"
#include "support/truth.hpp"

namespace gvd::kernel {
namespace {

using predicates::operator-;
using robust::MaybeSign;
using robust::Sign;
using test::Random;

constexpr int kBits = 600;
using Number = FacetWaves::M;
using Point = predicates::PlanePoint<Number>;

/// Zero to 500 bits: no two of these numbers are that near to one another without being equal.
bool is_zero(const Number& x) { return maybe_sign(x).value_or(Sign::zero) == Sign::zero && x.rad() < 0x1p-500; }
bool are_one(const Point& a, const Point& b) { return is_zero(a.x - b.x) && is_zero(a.y - b.y); }

/// How often each identity was found to hold.
using Found = std::map<std::string, int>;

class Questions {
 public:
  Questions(FieldWaves& waves, Found& found) : waves_(waves), found_(found) {
    for (std::size_t i = 0; i < waves.sites.size(); ++i) site_.push_back(waves.site(i, Number(), kBits));
    for (std::size_t k = 0; k < 3; ++k) side_[k] = predicates::side_line(waves.frame(Number(), kBits), k);
  }
  void ask_all() {
    for (std::size_t a = 0; a < site_.size(); ++a)
      for (std::size_t b = 0; b < site_.size(); ++b)
        if (a != b) ask(a, b);
    for (std::uint32_t a = 0; a < site_.size(); ++a)
      for (std::uint32_t b = 0; b < a; ++b) ask_where_they_part(a, b);
  }

 private:
  bool is_window(std::size_t i) const { return waves_.sites[i].window != kNone; }
  Point mirrored(const Point& p, std::size_t side) const {
    const auto& line = side_[side];
    const Point off = p - line.origin;
    const Number along = dot(line.direction, off) / line.square, across = cross(line.direction, off) / line.square;
    return {line.origin.x + along * line.direction.x + across * line.direction.y, line.origin.y + along * line.direction.y - across * line.direction.x};
  }
  /// Whether a wave from `image` after `weight` comes on the way of wave a.
  bool is_on_way(std::size_t a, const Point& image, const Number& weight) const {
    return is_zero(squared_norm(image - site_[a].image) - square(weight - site_[a].weight));
  }
  void expect(const char* what, bool proved, bool holds) {
    found_[what] += proved;
    EXPECT_TRUE(!proved || holds) << what << " in face " << waves_.face;
  }

  void ask(std::size_t a, std::size_t b) {
    const auto &of_a = site_[a], &of_b = site_[b];
    const FacetSite& other = waves_.sites[b];
    const bool same_weight = is_zero(of_a.weight - of_b.weight), same_image = are_one(of_a.image, of_b.image);
    const bool on_way = is_on_way(a, of_b.image, of_b.weight);
    if (is_window(a) && is_window(b)) {
      expect("one image", waves_.have_one_image(a, b), same_image);
      expect("one wave", waves_.are_proved_one_wave(a, b), same_image && same_weight);
      for (std::size_t end = 0; end < 4; ++end)
        expect("one cone vertex", waves_.share_cone_vertex(a, end / 2, b, end % 2), are_one(of_a.cone[end / 2], of_b.cone[end % 2]));
    }
    for (std::uint8_t k = 0; k < 3; ++k) {
      const Point corner = side_[k].origin;
      expect("as far from a corner", waves_.are_as_far_from_corner(a, b, k), is_zero(distance(of_a, corner) - distance(of_b, corner)));
      const Point image = mirrored(of_b.image, k);
      expect("mirrored on the strip", waves_.is_mirrored_on_strip(a, b, k), is_on_way(a, image, of_b.weight));
      if (!is_window(a)) continue;
      for (std::size_t end = 0; end < 2; ++end)
        expect("mirrored at the cone", waves_.is_mirrored_at_cone_vertex(a, end, b, k), are_one(image, of_a.cone[end]) && is_on_way(a, image, of_b.weight));
    }
    if (!is_window(a)) return;
    expect("mirror images", waves_.are_mirror_images(a, b), same_weight && are_one(of_a.image, mirrored(of_b.image, waves_.sites[a].side)));
    if (waves_.sites[a].root == other.root) return;
    const bool own = waves_.is_own_relay(a, b);
    expect("relay on the way", own, on_way);
    for (std::size_t end = 0; end < 2; ++end) {
      const FacetSite& parent = waves_.sites[a];
      if (parent.cone[end] == other.root && parent.attains_cone[end])
        expect("relay at the cone", waves_.is_at_cone_vertex(a, b), are_one(of_a.cone[end], of_b.image));
      if (own)
        expect(parent.cone[end] == kNone ? "relay on the ray of a corner" : "relay on the ray", waves_.is_relay_on_ray(a, end, b),
               is_zero(cross(of_a.cone[end] - of_a.image, of_b.image - of_a.image)));
    }
  }

  /// Farther back the unit is another one, but weights and images differ in proportion.
  void ask_where_they_part(std::uint32_t a, std::uint32_t b) {
    const auto back = waves_.where_they_part(std::array{a, b});
    if (back.empty() || !back[0].weight.is_defined() || !back[1].weight.is_defined()) return;
    const auto number = [](const robust::Exact& x) { return x.enclosure(kBits); };
    const Number late = number(back[0].weight - back[1].weight), apart = number(squared_norm(back[0].image - back[1].image));
    const Number late_here = site_[a].weight - site_[b].weight, apart_here = squared_norm(site_[a].image - site_[b].image);
    expect("where they part", true, is_zero(square(late) * apart_here - square(late_here) * apart));
  }

  FieldWaves& waves_;
  Found& found_;
  std::vector<predicates::Site<Number>> site_;
  std::array<predicates::SideLine<Number>, 3> side_;
};

/// Of the waves on both sides of an edge; where they are seen from, cones count for nothing.
void ask_across(const Resolution& resolution, FieldWaves& left, FieldWaves& right, HalfedgeId h, Found& found) {
  const HalfedgeId twin = resolution.frames().mesh().twin(h);
  const auto line = [](FieldWaves& waves, HalfedgeId side) { return predicates::side_line(waves.frame(Number(), kBits), side % 3); };
  const auto of_left = line(left, h), of_right = line(right, twin);
  const Number third = robust::from<Number>(mpq_class(1, 3), kBits), length = sqrt(of_left.square), other_length = sqrt(of_right.square);
  for (std::size_t a = 0; a < left.sites.size(); ++a)
    for (std::size_t b = 0; b < right.sites.size(); ++b) {
      if (!are_as_far_along(resolution, h, left.sites[a], right.sites[b])) continue;
      found["across an edge"] += left.sites[a].root != right.sites[b].root;
      for (const Number& t : {Number(0.0), third, Number(1.0)}) {
        const Number x = distance(left.site(a, Number(), kBits), point_at(of_left, t)) / length;
        const Number y = distance(right.site(b, Number(), kBits), point_at(of_right, Number(1.0) - t)) / other_length;
        EXPECT_TRUE(is_zero(x - y)) << "over half-edge " << h;
      }
    }
}

void ask_all(const Mesh& mesh, const std::vector<Source>& sources, Found& found) {
  constexpr std::size_t kMostFacets = 8, kMostSites = 12;
  const test::FieldFacets field(mesh, sources);
  std::vector<std::unique_ptr<FieldWaves>> waves;
  field.for_each_boundary_facet([&](FieldWaves& facet) {
    if (waves.size() == kMostFacets || facet.sites.size() > kMostSites) return;
    Questions(facet, found).ask_all();
    waves.push_back(field.waves_of(facet.face));
  });
  for (const auto& left : waves)
    for (const auto& right : waves)
      for (HalfedgeId h = 3 * left->face; h < 3 * left->face + 3; ++h)
        if (field.mesh().twin(h) != kNone && Mesh::face(field.mesh().twin(h)) == right->face) ask_across(field.resolution(), *left, *right, h, found);
}

void expect_found(const Found& found, std::initializer_list<const char*> names) {
  for (const char* name : names) EXPECT_GT(found.contains(name) ? found.at(name) : 0, 0) << name;
}

std::vector<Source> at_vertices(const Mesh& mesh, const std::vector<VertexId>& vertices) {
  std::vector<Source> sources;
  for (const VertexId v : vertices) sources.push_back(test::at_vertex(mesh, v));
  return sources;
}

TEST(WaveIdentities, OfPlanesAndBlocks) {
  Found found;
  for (const auto& arrays : {test::flat_grid(4, 3), test::plane_with_hole(6, 4, 2, 4, 1, 3), test::cube(2), test::staircase(3, 2), test::roof(4, 2, 4, 4),
                             test::integer_saddle(1), test::flat_grid(3, 3, test::Diagonal::alternating), test::grid(2, 1, [](auto, auto) { return 0.0; })}) {
    const Mesh mesh(arrays);
    const VertexId last = static_cast<VertexId>(mesh.vertex_count()) - 1;
    ask_all(mesh, at_vertices(mesh, {0, last}), found);
    ask_all(mesh, at_vertices(mesh, {0, last / 2, last}), found);
    if (HasFailure()) return;
  }
  expect_found(found, {"one image", "one wave", "mirror images", "as far from a corner", "relay on the way", "relay at the cone", "across an edge", "where they part"});
}

// Two triangles, and a source at the corner of each that is off the edge between them: the edge is as far from both if one is the other's mirror image.
TEST(WaveIdentities, OfCornersAcrossAnEdge) {
  for (const double apex : {-1.0, -1.5}) {
    const Mesh mesh({{{0, 0, 0}, {2, 0, 0}, {0.5, 1, 0}, {0.5, apex, 0}}, {{0, 1, 2}, {1, 0, 3}}});
    Found found;
    ask_all(mesh, at_vertices(mesh, {2, 3}), found);
    EXPECT_EQ(found["across an edge"] > 0, apex == -1.0);
  }
}

// Two faces glued along all their sides: three edges of the input lie between the same two faces.
TEST(WaveIdentities, OfAPillow) {
  const Mesh mesh({{{0, 0, 0}, {4, 0, 0}, {1, 3, 0}}, {{0, 1, 2}, {0, 2, 1}}});
  Found found;
  const auto inside = [&](FaceId f, int a, int b, int c) { return Source{point_in_face(mesh, f, {mpq_class(a), mpq_class(b), mpq_class(c)}), 0}; };
  ask_all(mesh, {inside(0, 1, 1, 1), inside(1, 1, 1, 1)}, found);
  ask_all(mesh, {inside(0, 2, 1, 1), inside(0, 1, 2, 1), inside(1, 1, 1, 2), inside(1, 3, 1, 2)}, found);
  expect_found(found, {"where they part"});
}

// With one proof refused after the other, and all after it: what is proved still holds.
TEST(WaveIdentities, WithProofsRefused) {
  int proved = 0, refused = 0;
  for (const auto& arrays : {test::flat_grid(3, 3, test::Diagonal::alternating), test::plane_with_hole(5, 4, 2, 3, 2, 3), test::roof(4, 2, 4, 4), test::cube(2)}) {
    const Mesh mesh(arrays);
    const test::FieldFacets field(mesh, at_vertices(mesh, {0, static_cast<VertexId>(mesh.vertex_count()) - 1}));
    for (FaceId f = 0; f < field.mesh().face_count(); ++f) {
      const auto waves = field.waves_of(f);
      FieldWaves& facet = *waves;
      for (std::size_t a = 0; a < facet.sites.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
          if (facet.sites[a].window == kNone || facet.sites[b].window == kNone) continue;
          const auto &of_a = facet.site(a, Number(), kBits), &of_b = facet.site(b, Number(), kBits);
          const bool are_one_wave = are_one(of_a.image, of_b.image) && is_zero(of_a.weight - of_b.weight);
          for (const std::uint64_t more : {std::uint64_t{1}, robust::ProofLimit::kAll}) {
            bool goes_on = true;
            for (std::uint64_t proofs = 0; goes_on; ++proofs) {
              const robust::ProofLimit limit(proofs, more);
              const bool said = facet.are_proved_one_wave(a, b);
              EXPECT_TRUE(!said || are_one_wave);
              goes_on = limit.was_reached() && proofs < 20;
              (said ? proved : refused) += are_one_wave;
            }
          }
        }
      }
    }
  }
  EXPECT_GT(proved, 0);
  EXPECT_GT(refused, 0);
}

// What others have unfolded saves work and changes nothing, also where they lack a window.
TEST(WaveIdentities, WindowsThatNobodyUnfolded) {
  const Mesh mesh(test::mirrored_terrain());
  const test::FieldFacets field(mesh, test::mirrored_sources(mesh, 0));
  const UnfoldedWindows none = field.unfolded({});
  field.for_each_boundary_facet([&](FieldWaves& facet) {
    const auto other = field.waves_of(facet.face, &none);
    ASSERT_EQ(other->sites.size(), facet.sites.size());
    for (std::size_t i = 0; i < facet.sites.size(); ++i) {
      EXPECT_EQ(other->sites[i].window, facet.sites[i].window);
      EXPECT_EQ(other->site(i, FacetWaves::F()).image.x.mid(), facet.site(i, FacetWaves::F()).image.x.mid());
    }
  });
}

TEST(WaveIdentities, OfMirroredTerrain) {
  const Mesh mesh(test::mirrored_terrain());
  Found found;
  ask_all(mesh, test::mirrored_sources(mesh, 0), found);
  expect_found(found, {"one cone vertex", "mirror images"});
}

/// Every source at a place of its own.
bool are_apart(const Mesh& mesh, const std::vector<Source>& sources) {
  std::set<ExactPoint> places;
  for (const Source& source : sources) places.insert(exact_position(mesh, source.at));
  return places.size() == sources.size();
}

TEST(WaveIdentities, OfRegressions) {
  constexpr std::size_t kMostFaces = 150;
  Found found;
  for (const auto& file : std::filesystem::directory_iterator(GVD_SOURCE_DIR "/tests/regressions")) {
    SCOPED_TRACE(file.path().filename().string());
    const fuzz::Case c = fuzz::read_case(file.path().string());
    const Mesh mesh(c.mesh);
    const auto sources = fuzz::sources_of(mesh, c.sources);
    if (mesh.face_count() <= kMostFaces && are_apart(mesh, sources)) ask_all(mesh, sources, found);
    if (HasFailure()) return;
  }
  expect_found(found, {"one image", "one cone vertex", "mirror images", "mirrored on the strip", "mirrored at the cone", "relay on the way", "relay on the ray"});
}

// Waves that come once round a vertex and see a corner of the facet where it is and where they passed it: a ray through there has no vertex with that name.
TEST(WaveIdentities, OfCornersPassedBefore) {
  fuzz::Wish wish;
  wish.size = 6;
  wish.sources = 3;
  wish.weighted = 0;
  Found found;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    wish.family = seed % 2 == 0 ? "floating_tin" : "valleys";
    const fuzz::Case c = fuzz::make_case(seed, wish);
    const Mesh mesh(c.mesh);
    const auto sources = fuzz::sources_of(mesh, c.sources);
    if (!are_apart(mesh, sources)) continue;
    const test::FieldFacets field(mesh, sources);
    field.for_each_boundary_facet([&](FieldWaves& facet) {
      const auto has_no_name = [](const FacetSite& site) { return site.window != kNone && (site.cone[0] == kNone || site.cone[1] == kNone); };
      if (std::any_of(facet.sites.begin(), facet.sites.end(), has_no_name)) Questions(facet, found).ask_all();
    });
    if (HasFailure()) return;
  }
  expect_found(found, {"relay on the ray of a corner"});
}

TEST(WaveIdentities, OfFuzzedCases) {
  Random random(2600);
  fuzz::Wish wish;
  wish.size = 3;
  wish.sources = 4;
  Found found;
  for (int round = 0; round < 60; ++round) {
    const std::uint64_t seed = random.next();
    SCOPED_TRACE(seed);
    const fuzz::Case c = fuzz::make_case(seed, wish);
    const Mesh mesh(c.mesh);
    const auto sources = fuzz::sources_of(mesh, c.sources);
    if (are_apart(mesh, sources)) ask_all(mesh, sources, found);
    if (HasFailure()) return;
  }
  expect_found(found, {"one image", "one wave", "one cone vertex", "mirror images", "relay on the way", "relay at the cone"});
}

}  // namespace
}  // namespace gvd::kernel
