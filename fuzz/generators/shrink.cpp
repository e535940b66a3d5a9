#include "fuzz/generators/shrink.hpp"

#include <algorithm>
#include <cmath>

#include "fuzz/generators/grids.hpp"

namespace gvd::fuzz {
namespace {

class Shrinker {
 public:
  Shrinker(Case c, const std::function<bool(const Case&)>& fails, std::chrono::steady_clock::time_point deadline)
      : case_(std::move(c)), fails_(fails), deadline_(deadline) {}

  Case run() {
    for (bool smaller = true; smaller && !late();) {
      smaller = fewer_sources();
      smaller = fewer_faces() || smaller;
      smaller = collapsed_edges() || smaller;
      smaller = plainer_sources() || smaller;
      smaller = plainer_coordinates() || smaller;
    }
    return std::move(case_);
  }

 private:
  bool late() const { return std::chrono::steady_clock::now() > deadline_; }

  bool accept(const Case& smaller) {
    if (late() || !is_valid(smaller) || !fails_(smaller)) return false;
    case_ = smaller;
    return true;
  }

  bool fewer_sources() {
    bool any = false;
    for (std::size_t i = case_.sources.size(); i-- > 0 && case_.sources.size() > 1;) {
      Case c = case_;
      c.sources.erase(c.sources.begin() + static_cast<std::ptrdiff_t>(i));
      any = accept(c) || any;
    }
    return any;
  }

  /// Without faces [first, last), unless a source lies there.
  Case without(std::size_t first, std::size_t last) const {
    Case c = case_;
    for (const Place& place : c.sources)
      if (place.face >= first && place.face < last) return {};
    c.mesh = without_faces(case_.mesh, [&](std::size_t f) { return f >= first && f < last; });
    for (Place& place : c.sources)
      if (place.face >= last) place.face -= static_cast<kernel::FaceId>(last - first);
    return c;
  }
  bool fewer_faces() {
    bool any = false;
    for (std::size_t chunk = std::max<std::size_t>(1, case_.mesh.faces.size() / 2); chunk > 0; chunk /= 2)
      for (std::size_t first = 0; first + chunk <= case_.mesh.faces.size() && case_.mesh.faces.size() > 1;) {
        if (late()) return any;
        if (accept(without(first, first + chunk)))
          any = true;
        else
          first += chunk;
      }
    return any;
  }

  /// Vertex `from` moved on to vertex `to`: the faces at their edge go.
  bool collapsed_edges() {
    bool any = false;
    for (std::size_t f = 0; f < case_.mesh.faces.size(); ++f)
      for (std::size_t k = 0; k < 3 && f < case_.mesh.faces.size(); ++k) {
        if (late()) return any;
        const auto from = case_.mesh.faces[f][k], to = case_.mesh.faces[f][(k + 1) % 3];
        any = accept(collapsed(from, to)) || any;
      }
    return any;
  }
  Case collapsed(std::uint32_t from, std::uint32_t to) const {
    Case c = case_;
    std::vector<bool> gone(c.mesh.faces.size());
    for (std::size_t f = 0; f < gone.size(); ++f) {
      auto& face = c.mesh.faces[f];
      for (auto& v : face)
        if (v == from) v = to;
      gone[f] = face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
    }
    for (Place& place : c.sources) {
      if (gone[place.face]) return {};
      place.face -= static_cast<kernel::FaceId>(std::count(gone.begin(), gone.begin() + place.face, true));
    }
    c.mesh = without_faces(c.mesh, [&](std::size_t f) { return gone[f]; });
    return c;
  }

  bool plainer_sources() {
    bool any = false;
    for (std::size_t i = 0; i < case_.sources.size(); ++i) {
      const auto change = [&](const auto& edit) {
        Case c = case_;
        edit(c.sources[i]);
        any = accept(c) || any;
      };
      const Place place = case_.sources[i];
      if (place.weight != 0) change([](Place& p) { p.weight = 0; });
      const auto first = case_.sources[0].face;  // all in one face, if they may be
      if (place.face != first) change([&](Place& p) { p.face = first; });
      for (std::size_t k = 0; k < 3; ++k)
        for (const double w : {0.0, 1.0, 2.0})
          if (place.corner_weights[k] != 0 && place.corner_weights[k] > w) change([&](Place& p) { p.corner_weights[k] = w; });
    }
    return any;
  }

  /// Fewer digits: 0, whole numbers, then short fractions.
  bool plainer_coordinates() {
    bool any = false;
    for (std::size_t v = 0; v < case_.mesh.points.size(); ++v)
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = case_.mesh.points[v][k];
        for (const double unit : {1.0, 0x1p-3, 0x1p-8, 0x1p-20}) {
          const double plain = std::round(x / unit) * unit;
          if (late() || x == plain || !std::isfinite(plain)) break;
          Case c = case_;
          c.mesh.points[v][k] = plain;
          if (!accept(c)) continue;
          any = true;
          break;
        }
      }
    return any;
  }

  Case case_;
  const std::function<bool(const Case&)>& fails_;
  std::chrono::steady_clock::time_point deadline_;
};

}  // namespace

Case shrink(Case c, const std::function<bool(const Case&)>& fails, std::chrono::steady_clock::time_point deadline) {
  return Shrinker(std::move(c), fails, deadline).run();
}

}  // namespace gvd::fuzz
