#include "nearest_waves.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "gvd/kernel/error.hpp"
#include "gvd/predicates/wave.hpp"
#include "gvd/robust/rational.hpp"
#include "gvd/robust/rounding.hpp"
#include "wave_numbers.hpp"

namespace gvd::kernel {
namespace {

using predicates::PlanePoint;
using robust::RootSum;
using robust::Sign;

class NearestSearch {
 public:
  NearestSearch(const Resolution& resolution, FieldWaves& waves, const RefinedPoint& at, bool to_one_path)
      : resolution_(resolution), waves_(waves), at_(at), to_one_path_(to_one_path) {
    result_.sites.resize(waves.sites.size());
    std::iota(result_.sites.begin(), result_.sites.end(), 0u);
  }

  NearestWaves run() {
    if (compare<FacetWaves::F>(0) || compare<FacetWaves::DD>(0) || compare_exactly()) return result_;
    for (const int bits : {128, 256, 512, 1024}) {
      const std::size_t before = result_.sites.size();
      if (compare<FacetWaves::M>(bits) || (result_.sites.size() < before && compare_exactly())) break;
    }
    return result_;
  }

 private:
  /// Drops the waves that are certainly not nearest; true if nothing is left to decide.
  template <class NT>
  bool compare(int bits) {
    const auto& frame = frame_in<NT>(waves_, bits);
    const NT b1 = robust::from<NT>(at_.bary[1], bits), b2 = robust::from<NT>(at_.bary[2], bits);
    const PlanePoint<NT> p{b1 + b2 * frame.apex.x, b2 * frame.apex.y};
    std::vector<std::uint32_t> sites;
    std::vector<NT> distance;
    std::vector<bool> certain;  // certainly in the cone; only then the distance counts against others
    for (const std::uint32_t i : result_.sites) {
      const auto& site = site_in<NT>(waves_, i, bits);
      const std::optional<bool> contains = predicates::cone_contains(site, p);
      if (contains && !*contains) continue;
      sites.push_back(i);
      certain.push_back(contains.has_value());
      distance.push_back(predicates::distance(site, p) * frame.length);
    }
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      bool beaten = false;
      for (std::size_t j = 0; j < sites.size() && !beaten; ++j)
        beaten = certain[j] && j != i && maybe_sign(distance[i] - distance[j]) == Sign::positive;
      if (!beaten) kept.push_back(i);
    }
    if (kept.empty()) throw InternalError("no wave reaches a point of face " + std::to_string(waves_.face));
    return conclude<NT>(sites, distance, kept);
  }

  /// The distance is that of one of those kept: so it is rounded if they all round alike.
  template <class NT>
  bool conclude(const std::vector<std::uint32_t>& sites, const std::vector<NT>& distance, const std::vector<std::size_t>& kept) {
    result_.sites.clear();
    for (const std::size_t i : kept) result_.sites.push_back(sites[i]);
    const std::optional<double> value = rounded(distance[kept.front()]);
    bool rounds_alike = value.has_value();
    Enclosed all{0, distance[kept.front()].lower(), distance[kept.front()].upper()};
    for (const std::size_t i : kept) {
      all.low = std::min(all.low, distance[i].lower());
      all.high = std::max(all.high, distance[i].upper());
      const std::optional<double> other = rounded(distance[i]);
      rounds_alike = rounds_alike && other && *other == *value;
    }
    all.value = rounds_alike ? *value : robust::Midpoint<typename NT::Mid>::nearest(distance[kept.front()].mid());
    result_.distance = all;
    result_.is_one_path = kept.size() == 1;
    const LabelSetId labels = waves_.sites[result_.sites.front()].labels;
    const bool same =
        std::all_of(result_.sites.begin(), result_.sites.end(), [&](auto i) { return waves_.sites[i].labels == labels; });
    result_.is_decided = rounds_alike && same;
    return result_.is_decided && (result_.is_one_path || !to_one_path_);
  }

  /// The same with sums of roots; false if the strip of a wave that is left is not of one square class, or its root too involved.
  bool compare_exactly() {
    std::vector<std::uint32_t> sites;
    std::vector<RootSum> distance;
    for (const std::uint32_t i : result_.sites) {
      bool outside = false;
      auto d = exact_distance(i, outside);
      if (outside) continue;
      if (!d) return false;
      sites.push_back(i);
      distance.push_back(std::move(*d));
    }
    if (sites.empty()) throw InternalError("no wave reaches a point of face " + std::to_string(waves_.face));
    std::size_t least = 0;
    for (std::size_t i = 1; i < sites.size(); ++i)
      if (robust::compare(distance[i], distance[least]) == Sign::negative) least = i;
    result_.sites.clear();
    for (std::size_t i = 0; i < sites.size(); ++i)
      if (robust::compare(distance[i], distance[least]) == Sign::zero) result_.sites.push_back(sites[i]);
    constexpr int kBits = 128;
    const auto ball = distance[least].enclosure(kBits);
    result_.distance = {distance[least].rounded(), ball.lower(), ball.upper()};
    result_.is_decided = result_.is_one_path = true;
    return true;
  }

  /// In mesh units. `outside` is set if the point is not in the cone.
  std::optional<RootSum> exact_distance(std::uint32_t i, bool& outside) const {
    const Frames& frames = resolution_.frames();
    const FacetSite& site = waves_.sites[i];
    const std::uint32_t side = site.window == kNone ? 0 : site.side;
    const HalfedgeId h = 3 * waves_.face + side;
    const ExactFace face = frames.exact(waves_.face);
    const QuadraticPoint apex = exact_apex(frames, h, face.radicand);
    const mpq_class &b1 = at_.bary[(side + 1) % 3], &b2 = at_.bary[(side + 2) % 3];
    const QuadraticPoint p{b1 + b2 * apex.x, b2 * apex.y};
    QuadraticPoint image = site.corner == 2 ? apex : QuadraticPoint{site.corner == 1 ? 1 : 0, 0};
    if (site.window != kNone) {
      const auto at = unfold_exact(frames, strip_of(frames.mesh(), resolution_.field(), site.window), h);
      if (!at) return std::nullopt;
      image = at->image;
      const auto turn = [&](const QuadraticPoint& cone) {
        return sgn((cone.x - image.x) * (p.y - image.y) - (cone.y - image.y) * (p.x - image.x));
      };
      outside = turn(at->cone0) > 0 || turn(at->cone1) < 0;
      if (outside) return std::nullopt;
    }
    auto sum = resolution_.exact_distance(site.root);
    if (!sum) return std::nullopt;
    const mpq_class x = p.x - image.x, y = p.y - image.y;
    sum->add(1, (x * x + y * y * face.radicand) * face.squared[side]);
    return *sum * robust::power_of_two(frames.scale());
  }

  const Resolution& resolution_;
  FieldWaves& waves_;
  const RefinedPoint& at_;
  bool to_one_path_;
  NearestWaves result_;
};

}  // namespace

NearestWaves nearest_waves(const Resolution& resolution, FieldWaves& waves, const RefinedPoint& at, bool to_one_path) {
  return NearestSearch(resolution, waves, at, to_one_path).run();
}

}  // namespace gvd::kernel
