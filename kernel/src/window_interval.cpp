#include "window_interval.hpp"

#include <algorithm>
#include <cmath>

#include "gvd/predicates/filter_error.hpp"

namespace gvd::kernel {
namespace {

using predicates::kDistanceError;
using predicates::kUnit;

/// A stretch of the edge; empty unless from < to.
struct Stretch {
  double from = 1, to = 0;
};

/// second - first over the stretch that the intervals of both contain.
class Difference {
 public:
  Difference(const WindowInterval& first, const WindowInterval& second, double length)
      : first_(first), second_(second), length_(length), low_(std::max(first.begin, second.begin)), high_(std::min(first.end, second.end)) {}

  bool is_empty() const { return !(low_ < high_); }
  /// Where the first, and where the second, is certainly shorter; nothing beyond what can be told from the ends and from one root.
  void compare(Stretch& first_shorter, Stretch& second_shorter);

 private:
  struct Reach {
    double first, second;  // distances of the two images, in units of the frame
  };
  Reach reach(double x) const {
    const double dx = x - first_.image.x, ex = x - second_.image.x;
    return {std::sqrt(dx * dx + first_.image.y * first_.image.y), std::sqrt(ex * ex + second_.image.y * second_.image.y)};
  }
  double value(const Reach& r) const { return (second_.weight + length_ * r.second) - (first_.weight + length_ * r.first); }
  /// -1, 0 or 1; 0 also where the slope is uncertain.
  int slope_sign(double x, const Reach& r) const {
    const double of_first = 1 / r.first, of_second = 1 / r.second;
    const double slope = (x - second_.image.x) * of_second - (x - first_.image.x) * of_first;
    const double error = 4 * (first_.image_error + second_.image_error) / length_ * (of_first + of_second) + 16 * kUnit;
    return slope > error ? 1 : slope < -error ? -1 : 0;
  }
  int sign(double value) const { return value > error_ ? 1 : value < -error_ ? -1 : 0; }
  double leave_tie(double end, int sign_elsewhere) const;
  void bracket_root(double g0, double g1, double& left, double& right) const;

  const WindowInterval &first_, &second_;
  double length_, low_, high_, error_ = 0;
};

void Difference::compare(Stretch& first_shorter, Stretch& second_shorter) {
  const Reach r0 = reach(low_), r1 = reach(high_);
  error_ = (first_.weight_error + first_.image_error) + (second_.weight_error + second_.image_error) +
           2 * kDistanceError * (first_.weight + second_.weight) +
           kDistanceError * length_ * ((r0.first + r0.second) + (r1.first + r1.second));
  const double g0 = value(r0), g1 = value(r1);
  const int s0 = sign(g0), s1 = sign(g1);
  if (s0 == 0 && s1 == 0) return;
  Stretch& of_sign0 = s0 > 0 ? first_shorter : second_shorter;
  Stretch& of_sign1 = s1 > 0 ? first_shorter : second_shorter;
  if (s0 == s1) {
    // The difference has at most one critical point: it keeps its sign unless it dips in between.
    if (slope_sign(low_, r0) == s0 || slope_sign(high_, r1) == -s1) of_sign0 = {low_, high_};
  } else if (s0 != 0 && s1 != 0) {
    double left = low_, right = high_;
    bracket_root(g0, g1, left, right);
    of_sign0 = {low_, left};
    of_sign1 = {right, high_};
  } else if (s0 != 0) {
    of_sign0 = {low_, leave_tie(high_, s0)};
  } else {
    of_sign1 = {leave_tie(low_, s1), high_};
  }
}

/// A point near the end, where the two may tie, from which on to the other end the difference has the sign it has there; else that other end.
double Difference::leave_tie(double end, int sign_elsewhere) const {
  const double other = end == high_ ? low_ : high_;
  const int inwards = end == high_ ? -1 : 1;
  for (const double part : {0x1p-18, 0x1p-9}) {
    const double x = end + (other - end) * part;
    const Reach r = reach(x);
    if (sign(value(r)) == sign_elsewhere && slope_sign(x, r) * inwards == sign_elsewhere) return x;
  }
  return other;
}

/// Narrows [left, right], at whose ends the difference has opposite signs.
void Difference::bracket_root(double g0, double g1, double& left, double& right) const {
  double gl = g0, gr = g1;
  for (int i = 0; i < 2 && right - left > kShortOverlap; ++i) {
    const double width = right - left, x = left + width * (gl / (gl - gr));
    for (const double probe : {x - width * 0x1p-10, x + width * 0x1p-10}) {
      if (!(probe > left && probe < right)) continue;
      const double g = value(reach(probe));
      const int s = sign(g);
      if (s == 0) continue;
      if (s == sign(g0)) {
        left = probe;
        gl = g;
      } else {
        right = probe;
        gr = g;
      }
    }
  }
}

/// Takes the stretch, in which `winner` is certainly shorter, off `loser` as far as the winner certainly sees it; only an end can be taken off.
/// True if nothing is left.
bool cut(WindowInterval& loser, Stretch shorter, const WindowInterval& winner) {
  const double from = std::max(shorter.from, winner.begin + winner.slack.begin);
  const double to = std::min(shorter.to, winner.end - winner.slack.end);
  if (!(from < to)) return false;
  const bool has_begin = from <= loser.begin, has_end = loser.end <= to;
  if (has_begin && has_end) return true;
  if (has_begin && to > loser.begin + loser.slack.begin) {
    loser.begin = to;
    loser.slack.begin = 0;
    loser.trimmed |= kAtBegin;
  } else if (has_end && from < loser.end - loser.slack.end) {
    loser.end = from;
    loser.slack.end = 0;
    loser.trimmed |= kAtEnd;
  }
  return false;
}

}  // namespace

Trim trim(WindowInterval& first, WindowInterval& second, double length) {
  if (is_only_touched(first, second)) return Trim::none;
  Difference difference(first, second, length);
  if (difference.is_empty()) return Trim::none;
  Stretch first_shorter, second_shorter;
  difference.compare(first_shorter, second_shorter);
  if (cut(second, first_shorter, first)) return Trim::drop_second;
  return cut(first, second_shorter, second) ? Trim::drop_first : Trim::none;
}

}  // namespace gvd::kernel
