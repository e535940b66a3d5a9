#include <algorithm>
#include <limits>
#include <new>
#include <stdexcept>
#include <utility>

#include "gvd.h"
#include "gvd/predicates/strip_window.hpp"
#include "gvd/robust/rational.hpp"

namespace predicates = gvd::predicates;
using gvd::robust::MaybeSign;
using gvd::robust::Stage;

struct gvd_strip {
  predicates::FaceStrip strip;
};
struct gvd_path {
  predicates::Path path;
};
struct gvd_window {
  predicates::Window window;
};

namespace {

/// No exception passes the border.
template <class Body>
gvd_status guarded(const Body& body) noexcept {
  try {
    body();
    return GVD_OK;
  } catch (const std::bad_alloc&) {
    return GVD_OUT_OF_MEMORY;
  } catch (const std::invalid_argument&) {
    return GVD_INVALID_ARGUMENT;
  } catch (const std::domain_error&) {  // a weight that is not finite
    return GVD_INVALID_ARGUMENT;
  } catch (...) {
    return GVD_INTERNAL_ERROR;
  }
}

template <class... Pointer>
void require(const Pointer*... pointers) {
  const bool all_there = (... && (pointers != nullptr));
  if (!all_there) throw std::invalid_argument("null");
}

predicates::FaceCorners corners_of(const double c[9]) {
  return {{{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, {c[6], c[7], c[8]}}};
}
predicates::FaceCorners corners_of(const double* vertices, std::size_t count, const std::uint32_t face[3]) {
  predicates::FaceCorners corners;
  for (std::size_t k = 0; k < 3; ++k) {
    if (face[k] >= count) throw std::invalid_argument("index");
    for (std::size_t i = 0; i < 3; ++i) corners[k][i] = vertices[3 * std::size_t{face[k]} + i];
  }
  return corners;
}
predicates::FacePoint point_of(const double w[3]) {
  using gvd::robust::exact_rational;
  return {{exact_rational(w[0]), exact_rational(w[1]), exact_rational(w[2])}};
}

gvd_stage stage_of(Stage stage) { return static_cast<gvd_stage>(stage); }
static_assert(static_cast<int>(Stage::identity) == GVD_IDENTITY && static_cast<int>(Stage::filter) == GVD_FILTER &&
              static_cast<int>(Stage::double_double) == GVD_DOUBLE_DOUBLE && static_cast<int>(Stage::mpfr) == GVD_MPFR &&
              static_cast<int>(Stage::algebra) == GVD_ALGEBRA && static_cast<int>(Stage::undecided) == GVD_UNDECIDED);

gvd_decision decision_of(const predicates::Decision& d) {
  return {d.sign ? static_cast<gvd_sign>(static_cast<int>(*d.sign)) : GVD_UNKNOWN, stage_of(d.stage)};
}

}  // namespace

extern "C" {

const char* gvd_stage_name(gvd_stage stage) {
  const auto i = static_cast<std::size_t>(stage);
  return i < gvd::robust::kStageNames.size() ? gvd::robust::kStageNames[i] : "";
}

gvd_status gvd_strip_create(const double corners[9], const double source[3], gvd_strip** strip) {
  return guarded([&] {
    require(corners, source, strip);
    *strip = new gvd_strip{predicates::FaceStrip(corners_of(corners), point_of(source))};
  });
}

gvd_status gvd_strip_create_indexed(const double* vertices, size_t vertex_count, const uint32_t face[3], const double source[3],
                                    gvd_strip** strip) {
  return guarded([&] {
    require(vertices, face, source, strip);
    *strip = new gvd_strip{predicates::FaceStrip(corners_of(vertices, vertex_count, face), point_of(source))};
  });
}

gvd_status gvd_strip_copy(const gvd_strip* strip, gvd_strip** copy) {
  return guarded([&] {
    require(strip, copy);
    *copy = new gvd_strip(*strip);
  });
}

void gvd_strip_free(gvd_strip* strip) { delete strip; }

gvd_status gvd_strip_cross(gvd_strip* strip, const double corners[9]) {
  return guarded([&] {
    require(strip, corners);
    strip->strip.cross(corners_of(corners));
  });
}

gvd_status gvd_strip_cross_indexed(gvd_strip* strip, const double* vertices, size_t vertex_count, const uint32_t face[3]) {
  return guarded([&] {
    require(strip, vertices, face);
    strip->strip.cross(corners_of(vertices, vertex_count, face));
  });
}

size_t gvd_strip_vertex_count(const gvd_strip* strip) { return strip == nullptr ? 0 : strip->strip.vertex_count(); }

gvd_status gvd_ray_side(const gvd_strip* strip, size_t through, size_t v, gvd_decision* decision) {
  return guarded([&] {
    require(strip, decision);
    *decision = decision_of(predicates::ray_side(strip->strip, through, v));
  });
}

gvd_status gvd_cone_of(const gvd_strip* strip, gvd_cone* cone) {
  return guarded([&] {
    require(strip, cone);
    using Sight = predicates::ConeDecision::Sight;
    const auto found = predicates::cone_of(strip->strip);
    *cone = {found.sight == Sight::interval  ? GVD_SEES_INTERVAL
             : found.sight == Sight::nothing ? GVD_SEES_NOTHING
                                             : GVD_SIGHT_UNKNOWN,
             found.bound[0], found.bound[1], stage_of(found.stage)};
  });
}

gvd_status gvd_path_create(double given, gvd_path** path) {
  return guarded([&] {
    require(path);
    *path = new gvd_path{{gvd::robust::exact_rational(given), {}}};
  });
}

gvd_status gvd_path_add_leg(gvd_path* path, const gvd_strip* strip, const double end[3]) {
  return guarded([&] {
    require(path, strip, end);
    predicates::Leg leg(strip->strip, point_of(end));
    path->path.legs.push_back(std::move(leg));
  });
}

void gvd_path_free(gvd_path* path) { delete path; }

gvd_status gvd_compare_lengths(const gvd_path* a, const gvd_path* b, gvd_decision* decision) {
  return guarded([&] {
    require(a, b, decision);
    *decision = decision_of(predicates::compare_lengths(a->path, b->path));
  });
}

gvd_status gvd_length(const gvd_path* path, gvd_enclosure* length) {
  return guarded([&] {
    require(path, length);
    const auto found = predicates::length(path->path);
    *length = {found.lower, found.upper};
  });
}

gvd_status gvd_rounded_length(const gvd_path* path, double* value, gvd_stage* stage) {
  return guarded([&] {
    require(path, value, stage);
    const auto found = predicates::rounded_length(path->path);
    *value = found.value.value_or(std::numeric_limits<double>::quiet_NaN());
    *stage = stage_of(found.stage);
  });
}

gvd_status gvd_window_create(const gvd_strip* strip, const gvd_path* weight, const size_t cone[2], gvd_window** window) {
  return guarded([&] {
    require(strip, window);
    predicates::Window w{strip->strip, weight == nullptr ? predicates::Path{} : weight->path, std::nullopt};
    if (cone != nullptr) {
      for (std::size_t end = 0; end < 2; ++end) predicates::ray_side_at({Stage::identity}, strip->strip, cone[end], cone[end]);
      w.cone = {cone[0], cone[1]};
    }
    *window = new gvd_window{std::move(w)};
  });
}

void gvd_window_free(gvd_window* window) { delete window; }

gvd_status gvd_ties_on_edge(const gvd_window* a, const gvd_window* b, const double edge[6], gvd_edge_ties* ties) {
  return guarded([&] {
    require(a, b, edge, ties);
    const auto found = predicates::ties_on_edge(a->window, b->window, {{{edge[0], edge[1], edge[2]}, {edge[3], edge[4], edge[5]}}});
    gvd_edge_ties result{};
    result.kind = static_cast<gvd_tie_kind>(found.kind);
    result.a_is_nearer = found.a_is_nearer ? 1 : 0;
    result.count = static_cast<int>(found.ties.size());
    for (std::size_t i = 0; i < found.ties.size(); ++i) {
      const auto& tie = found.ties[i];
      result.ties[i] = {{tie.t.lower, tie.t.upper}, tie.a_before ? 1 : 0, tie.is_contact ? 1 : 0};
    }
    result.stage = stage_of(found.stage);
    *ties = result;
  });
}
static_assert(static_cast<int>(predicates::EdgeTies::Kind::none) == GVD_TIES_NONE &&
              static_cast<int>(predicates::EdgeTies::Kind::points) == GVD_TIES_POINTS &&
              static_cast<int>(predicates::EdgeTies::Kind::everywhere) == GVD_TIES_EVERYWHERE &&
              static_cast<int>(predicates::EdgeTies::Kind::ray) == GVD_TIES_RAY &&
              static_cast<int>(predicates::EdgeTies::Kind::undecided) == GVD_TIES_UNKNOWN);

gvd_status gvd_conflict(const double facet[9], const gvd_window* i, const gvd_window* j, const gvd_window* k, const gvd_window* rival,
                        gvd_conflict_verdict* verdict, gvd_stage* stage) {
  return guarded([&] {
    require(facet, i, j, k, rival, verdict, stage);
    const auto found = predicates::conflict(corners_of(facet), {&i->window, &j->window, &k->window}, rival->window);
    *verdict = found.verdict ? static_cast<gvd_conflict_verdict>(*found.verdict) : GVD_CONFLICT_UNKNOWN;
    *stage = stage_of(found.stage);
  });
}
static_assert(static_cast<int>(predicates::Conflict::no_vertex) == GVD_NO_VERTEX &&
              static_cast<int>(predicates::Conflict::farther) == GVD_FARTHER &&
              static_cast<int>(predicates::Conflict::ties) == GVD_TIES && static_cast<int>(predicates::Conflict::nearer) == GVD_NEARER);

}  // extern "C"
