#include "nearest_waves.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "gvd/kernel/error.hpp"
#include "gvd/predicates/orientation.hpp"
#include "gvd/predicates/wave.hpp"
#include "gvd/robust/rational.hpp"
#include "gvd/robust/rounding.hpp"
#include "wave_numbers.hpp"

namespace gvd::kernel {
namespace {

using predicates::PlanePoint;
using robust::Exact;
using robust::RootSum;
using robust::Sign;

template <class NT>
constexpr robust::Stage kStageOf = std::is_same_v<NT, FacetWaves::F>    ? robust::Stage::filter
                                   : std::is_same_v<NT, FacetWaves::DD> ? robust::Stage::double_double
                                                                        : robust::Stage::mpfr;

class NearestSearch {
 public:
  NearestSearch(const Resolution& resolution, FieldWaves& waves, const RefinedPoint& at, bool to_one_path)
      : resolution_(resolution), waves_(waves), at_(at), to_one_path_(to_one_path) {
    result_.sites.resize(waves.sites.size());
    std::iota(result_.sites.begin(), result_.sites.end(), 0u);
  }

  NearestWaves run() {
    compare<FacetWaves::F>(0);  // leaves fewer; doubles cannot tell how they round themselves
    if (compare<FacetWaves::DD>(0) || compare_exactly()) return result_;
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
    constexpr robust::Stage stage = kStageOf<NT>;
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
    result_.stage = stage;
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
      if (rounded(distance[i]) != value) rounds_alike = false;
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

  /// The same with exact numbers; false if those of a wave that is left are not to be had, or no sign of them.
  bool compare_exactly() {
    std::vector<std::uint32_t> nearest;
    std::optional<Exact> least;
    for (const std::uint32_t i : result_.sites) {
      bool outside = false;
      const auto distance = exact_distance(i, outside);
      if (outside) continue;
      if (!distance) return false;
      const robust::MaybeSign sign = least ? maybe_sign(*distance - *least) : Sign::negative;
      if (!sign) return false;
      if (*sign == Sign::negative) {
        nearest.clear();
        least = distance;
      }
      if (*sign != Sign::positive) nearest.push_back(i);
    }
    if (!least) throw InternalError("no wave reaches a point of face " + std::to_string(waves_.face));
    const std::optional<double> value = rounded(*least);
    if (!value) return false;
    result_.sites = std::move(nearest);
    constexpr int kBits = 128;
    const auto ball = least->enclosure(kBits);
    result_.distance = {*value, ball.lower(), ball.upper()};
    result_.is_decided = result_.is_one_path = true;
    result_.stage = robust::Stage::algebra;
    return true;
  }

  /// In mesh units. `outside` is set if the point is not in the cone.
  std::optional<Exact> exact_distance(std::uint32_t i, bool& outside) const {
    const Frames& frames = resolution_.frames();
    const FacetSite& site = waves_.sites[i];
    const std::uint32_t side = site.window == kNone ? 0 : site.side;
    const HalfedgeId h = 3 * waves_.face + side;
    const predicates::RootPoint apex = exact_apex(frames, h);
    const mpq_class &b1 = at_.bary[(side + 1) % 3], &b2 = at_.bary[(side + 2) % 3];
    const predicates::RootPoint p{RootSum(b1) + b2 * apex.x, b2 * apex.y};
    predicates::RootPoint image = site.corner == 2 ? apex : predicates::RootPoint{RootSum(site.corner == 1 ? 1 : 0), RootSum()};
    if (site.window != kNone) {
      const auto at = resolution_.exact_unfolding(site.window);
      if (!at) return std::nullopt;
      image = at->image;
      const auto side_of = [&](const predicates::RootPoint& cone) { return predicates::orientation(image, cone, p).sign(); };
      outside = side_of(at->cone0) == Sign::positive || side_of(at->cone1) == Sign::negative;
      if (outside) return std::nullopt;
    }
    const auto distance = resolution_.exact_distance(site.root);
    if (!distance) return std::nullopt;
    const RootSum x = p.x - image.x, y = p.y - image.y;
    return (*distance + sqrt(Exact((x * x + y * y) * frames.exact(waves_.face)->squared[side]))).scaled(frames.scale());
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
