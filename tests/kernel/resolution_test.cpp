// What the resolution of candidates answers and does where the solver itself hardly ever asks: each question is put for all windows and vertices of a field, and fields are changed
// in ways in which propagation could leave them.
#include "gvd/kernel/resolution.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../../kernel/src/window_images.hpp"
#include "fuzz/generators/family.hpp"
#include "gvd/robust/proof_limit.hpp"
#include "support/field_facets.hpp"
#include "support/mirrored_terrain.hpp"
#include "support/truth.hpp"

namespace gvd::kernel {
namespace {

using robust::Ball;
using robust::DoubleDouble;
using robust::Mpfr;
using robust::ProofLimit;
using test::MeshArrays;
using robust::Sign;

constexpr int kBits = 600;

std::vector<Source> at_vertices(const Mesh& mesh, const std::vector<VertexId>& vertices) {
  std::vector<Source> sources;
  for (const VertexId v : vertices) sources.push_back(test::at_vertex(mesh, v));
  return sources;
}

bool may_vanish(const Ball<Mpfr>& x) { return maybe_sign(x).value_or(Sign::zero) == Sign::zero; }

/// In scaled units.
Ball<Mpfr> length_through(const test::FieldFacets& field, WindowId w, int bits) {
  const HalfedgeId h = field.field().windows[w].halfedge();
  const auto image = unfold_mpfr(field.frames(), strip_of(field.mesh(), field.field(), w), bits).image;
  return predicates::last_leg(image, field.frames().in_mpfr(Mesh::face(h), bits)[h % 3], predicates::unit<Mpfr>(bits));
}

// --- Images of windows ---

TEST(WindowImages, AreTheSameWhetherAskedForBeforehandOrNot) {
  const Mesh mesh(test::mirrored_terrain());
  const test::FieldFacets field(mesh, test::mirrored_sources(mesh, 0));
  const auto count = static_cast<WindowId>(field.field().windows.size());
  WindowImages added(field.frames(), field.field()), on_demand(field.frames(), field.field());
  std::vector<WindowId> all(count);
  for (WindowId w = 0; w < count; ++w) all[w] = w;
  added.add(all);
  for (WindowId w = count; w-- > 0;) {
    const WindowImages::Image image = on_demand(w), *other = added.find(w);
    ASSERT_NE(other, nullptr);
    EXPECT_EQ(image.mid.x.hi, other->mid.x.hi);
    EXPECT_EQ(image.mid.x.lo, other->mid.x.lo);
    EXPECT_EQ(image.mid.y.hi, other->mid.y.hi);
    EXPECT_EQ(image.radius, other->radius);
    const auto truth = unfold_mpfr(field.frames(), strip_of(field.mesh(), field.field(), w), kBits).image;
    EXPECT_NEAR(truth.mid.x.to_double(), image.mid.x.hi, 1e-12);
    EXPECT_NEAR(truth.mid.y.to_double(), image.mid.y.hi, 1e-12);
    if (HasFailure()) return;
  }
}

// --- Windows that were sent again since ---

/// Copies of all strips, superseded, and with each candidate one through the copy of its window, which claims to be nearer: as if every vertex had sent its waves again.
void add_stale_twins(DistanceField& field, double nearer) {
  field.restarted = true;
  const auto count = static_cast<std::uint32_t>(field.windows.size());
  for (std::uint32_t w = 0; w < count; ++w) {
    WindowRecord twin = field.windows[w];
    if (twin.parent == kNone)
      twin.packed |= WindowRecord::kDead;
    else
      twin.parent += count;
    twin.next = kNone;
    field.windows.push_back(twin);
  }
  for (std::uint32_t& first : field.first_candidate) {
    for (std::uint32_t c = first; c != kNone;) {
      Candidate twin = field.candidates[c];
      c = twin.next;
      if (twin.window == kNone) continue;
      twin.window += count;
      twin.distance -= nearer;
      twin.next = first;
      first = static_cast<std::uint32_t>(field.candidates.size());
      field.candidates.push_back(twin);
    }
  }
}

void expect_same_nearest(const test::FieldFacets& plain, const test::FieldFacets& changed) {
  for (VertexId v = 0; v < plain.mesh().vertex_count(); ++v) {
    SCOPED_TRACE(v);
    ASSERT_TRUE(changed.resolution().is_reached(v));
    EXPECT_EQ(changed.sets()[changed.resolution().labels(v)], plain.sets()[plain.resolution().labels(v)]);
    const auto &d = plain.resolution().distance(v), &other = changed.resolution().distance(v);
    EXPECT_TRUE(d.lower() <= other.upper() && other.lower() <= d.upper());
  }
}

TEST(StaleWindows, AreNotHeard) {
  const Mesh mesh(test::mirrored_terrain());
  for (const auto& sources : {test::mirrored_sources(mesh, 0), at_vertices(mesh, {0, 40})}) {
    const test::FieldFacets plain(mesh, sources);
    for (const double nearer : {0.0, 1e-3}) expect_same_nearest(plain, test::FieldFacets(mesh, sources, [&](DistanceField& field, const Frames&) { add_stale_twins(field, nearer); }));
  }
}

/// Sources of that weight in the first face, closer to one another than pairs of doubles tell, and one of no weight at the last vertex.
std::vector<Source> close_sources(const Mesh& mesh, double weight) {
  const mpq_class step = mpq_class(1) >> 120;
  std::vector<Source> sources{test::at_vertex(mesh, static_cast<VertexId>(mesh.vertex_count()) - 1)};
  for (const auto& [x, y] : {std::pair{0, 0}, {3, 1}, {-1, 2}, {1, -3}, {-2, -2}, {5, 4}})
    sources.push_back({point_in_face(mesh, 0, {mpq_class(1, 2) - (x + y) * step, mpq_class(1, 4) + x * step, mpq_class(1, 4) + y * step}), weight});
  return sources;
}

// Where vertices wait for one another, because doubles do not tell which one is nearer.
TEST(StaleWindows, AreNotWaitedFor) {
  const Mesh mesh(test::random_terrain(3, 0.5, 7));
  for (const double weight : {0.0, 100.0}) {
    const auto sources = close_sources(mesh, weight);
    const test::FieldFacets plain(mesh, sources);
    expect_same_nearest(plain, test::FieldFacets(mesh, sources, [&](DistanceField& field, const Frames&) { add_stale_twins(field, 0); }));
  }
}

// A superseded window crosses the same sides as its twin, so it shows its root as far.
TEST(StaleWindows, ShowTheirRootAsFarAsTheirTwins) {
  const Mesh mesh(test::mirrored_terrain());
  std::uint32_t count = 0;
  const test::FieldFacets field(mesh, test::mirrored_sources(mesh, 0), [&](DistanceField& changed, const Frames&) {
    count = static_cast<std::uint32_t>(changed.windows.size());
    add_stale_twins(changed, 0);
  });
  int attained = 0;
  for (WindowId w = 0; w < count; ++w) {
    const VertexId v = field.mesh().apex(field.field().windows[w].halfedge());
    if (!field.resolution().attains(w, v)) continue;
    ++attained;
    EXPECT_TRUE(field.resolution().is_as_far(w + count, v)) << w;
  }
  EXPECT_GT(attained, 0);
}

TEST(StaleWindows, AreDeadWithAllThatComesFromThem) {
  const Mesh mesh(test::mirrored_terrain());
  const test::FieldFacets field(mesh, test::mirrored_sources(mesh, 0));
  DistanceField changed = field.field();
  changed.restarted = true;
  std::vector<WindowId> all;
  for (WindowId w = 0; w < changed.windows.size(); ++w) {
    all.push_back(w);
    if (changed.windows[w].parent == kNone && w % 3 == 0) changed.windows[w].packed |= WindowRecord::kDead;
  }
  const UnfoldedWindows unfolded(field.frames(), changed, all);
  int dead = 0, alive = 0;
  for (const WindowId w : all) {
    EXPECT_EQ(unfolded.find(w)->dead, changed.is_stale(w));
    EXPECT_EQ(UnfoldedWindows::alone(field.frames(), changed, w).dead, changed.is_stale(w));
    (changed.is_stale(w) ? dead : alive) += changed.windows[w].parent != kNone;
  }
  EXPECT_GT(dead, 0);
  EXPECT_GT(alive, 0);
}

// --- Candidates that are certainly longer ---

/// To each vertex the edges from all its neighbours, as if propagation had not been sure that they are longer; and errors that are larger than they have to be.
void add_all_edges(DistanceField& field, const Frames& frames) {
  const Mesh& mesh = frames.mesh();
  const auto add = [&](VertexId via, VertexId v, double length) {
    if (!std::isfinite(field.distance[via])) return;
    const double distance = field.distance[via] + length;
    field.candidates.push_back({kNone, via, field.first_candidate[v], distance, field.error[via] + 0x1p-40 * distance, {0, 0}});
    field.first_candidate[v] = static_cast<std::uint32_t>(field.candidates.size() - 1);
  };
  for (HalfedgeId h = 0; h < mesh.halfedge_count(); ++h) {
    add(mesh.origin(h), mesh.target(h), frames(h).length);
    if (mesh.twin(h) == kNone) add(mesh.target(h), mesh.origin(h), frames(h).length);
  }
}

TEST(LongerCandidates, ChangeNothing) {
  const Mesh mirrored(test::mirrored_terrain()), rough(test::random_terrain(3, 0.5, 7)), flat(test::flat_grid(4, 3));
  for (const auto& [mesh, sources] : {std::pair{&mirrored, test::mirrored_sources(mirrored, 0)}, {&rough, close_sources(rough, 0)}, {&rough, close_sources(rough, 100)},
                                      {&flat, at_vertices(flat, {0, 19})}, {&rough, at_vertices(rough, {3})}})
    expect_same_nearest(test::FieldFacets(*mesh, sources), test::FieldFacets(*mesh, sources, add_all_edges));
}

// --- Lengths ---

/// Whether each window shows its root as far as its apex is; what is proved must hold in long numbers. Returns how often it did.
int ask_whether_as_far(const test::FieldFacets& field) {
  const Resolution& resolution = field.resolution();
  int proved = 0;
  for (WindowId w = 0; w < field.field().windows.size() && !testing::Test::HasFailure(); ++w) {
    const WindowRecord& record = field.field().windows[w];
    const VertexId v = field.mesh().apex(record.halfedge());
    if (v == record.root || !resolution.is_reached(v) || field.field().is_stale(w)) continue;
    if (!resolution.is_as_far(w, v)) continue;
    ++proved;
    EXPECT_TRUE(may_vanish(resolution.distance(record.root, kBits) + length_through(field, w, kBits) - resolution.distance(v, kBits))) << "window " << w;
  }
  return proved;
}

TEST(Lengths, AsFarThroughAnotherWindow) {
  int proved = 0;
  for (const auto& arrays : {test::flat_grid(4, 3), test::plane_with_hole(6, 4, 2, 4, 1, 3), test::staircase(3, 2), test::roof(4, 2, 4, 4), test::integer_saddle(1), test::cube(2)}) {
    const Mesh mesh(arrays);
    proved += ask_whether_as_far(test::FieldFacets(mesh, at_vertices(mesh, {0})));
  }
  EXPECT_GT(proved, 0);
}

// Behind the middle of a mirrored terrain two windows of one source on the mirror line, or 2^-300 beside it, are as far, or not.
TEST(Lengths, AsFarOverManyClassesOrAlmost) {
  const Mesh mesh(test::mirrored_terrain());
  const auto source = [&](const mpq_class& step) {
    const VertexId on_line = test::kWidth / 2;
    return std::vector<Source>{{point_on_edge(mesh, on_line, on_line + test::kWidth + 1, mpq_class(1, 2)), 0}, {point_on_edge(mesh, on_line - 1, on_line, mpq_class(1) - step), 3.5}};
  };
  EXPECT_GT(ask_whether_as_far(test::FieldFacets(mesh, {source(0)[0]})), 0);
  ask_whether_as_far(test::FieldFacets(mesh, {{point_on_edge(mesh, test::kWidth / 2 - 1, test::kWidth / 2, 1 - (mpq_class(1) >> 300)), 0}}));
}

TEST(Lengths, OfFuzzedCases) {
  test::Random random(2800);
  fuzz::Wish wish;
  wish.size = 3;
  int proved = 0;
  for (int round = 0; round < 60 && !testing::Test::HasFailure(); ++round) {
    const std::uint64_t seed = random.next();
    SCOPED_TRACE(seed);
    const fuzz::Case c = fuzz::make_case(seed, wish);
    const Mesh mesh(c.mesh);
    RefinedSources where;
    const auto sources = fuzz::sources_of(mesh, c.sources);
    proved += ask_whether_as_far(test::FieldFacets(mesh, {sources[0]}));
  }
  EXPECT_GT(proved, 0);
}

/// A flat corridor that goes up and down in `legs` legs of length 5, which bend at vertices 0, 1, 2 ...; and a triangle apart from it with a side just as long in all, whose ends are
/// the last vertices.
MeshArrays corridor_and_straight_line(int legs) {
  MeshArrays mesh;
  const auto count = static_cast<std::uint32_t>(legs) + 1;
  for (std::uint32_t i = 0; i < count; ++i) mesh.points.push_back({4.0 * i, i % 2 == 0 ? 0.0 : 3.0, 0});
  for (std::uint32_t i = 0; i < count; ++i) mesh.points.push_back({4.0 * i, i % 2 == 0 ? -1.0 : 4.0, 0});  // the outer bank
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    const std::uint32_t p = i, q = i + 1, outer_p = i + count, outer_q = q + count;
    if (i % 2 == 0)
      mesh.faces.insert(mesh.faces.end(), {{p, outer_p, q}, {p, q, outer_q}});
    else
      mesh.faces.insert(mesh.faces.end(), {{p, q, outer_p}, {p, outer_q, q}});
  }
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), {{0, 100, 0}, {0, 90, 0}, {5.0 * legs, 100, 0}});
  mesh.faces.push_back({first, first + 1, first + 2});
  return mesh;
}

// Paths of too many legs are not compared, whichever of the two it is; nor have they an exact length.
TEST(Lengths, OfManyLegs) {
  for (const int legs : {60, 70}) {
    const Mesh mesh(corridor_and_straight_line(legs));
    const auto last = static_cast<VertexId>(mesh.vertex_count()) - 1, end = static_cast<VertexId>(legs);
    const test::FieldFacets field(mesh, at_vertices(mesh, {0, last - 2}));
    const Resolution& resolution = field.resolution();
    EXPECT_EQ(resolution.distance(end).mid().hi, resolution.distance(last).mid().hi);
    const bool is_known = legs < 64;
    EXPECT_EQ(resolution.have_equal_distances(end, last), is_known);
    EXPECT_EQ(resolution.have_equal_distances(last, end), is_known);
    EXPECT_EQ(resolution.exact_distance(end).has_value(), is_known);
    EXPECT_EQ(std::ldexp(resolution.distance(end).mid().hi, field.frames().scale()), 5.0 * legs);
  }
}

// Two vertices are as far, by proof, or as numbers say; with proofs refused it is not known.
TEST(Lengths, EqualOrNot) {
  const Mesh mesh(test::mirrored_terrain());
  const test::FieldFacets field(mesh, test::mirrored_sources(mesh, 0));
  const Resolution& resolution = field.resolution();
  int equal = 0, unproved = 0;
  for (VertexId a = 0; a < field.mesh().vertex_count(); ++a) {
    for (VertexId b = 0; b <= a; ++b) {
      const bool are_equal = may_vanish(resolution.distance(a, kBits) - resolution.distance(b, kBits));
      EXPECT_EQ(resolution.have_equal_distances(a, b), are_equal) << a << " and " << b;
      equal += are_equal && a != b;
      if (!are_equal || a == b) continue;
      const ProofLimit none(0);
      unproved += !resolution.have_equal_distances(a, b);
    }
  }
  EXPECT_GT(equal, 0);
  EXPECT_GT(unproved, 0);
}

}  // namespace
}  // namespace gvd::kernel
