#pragma once

#include <optional>
#include <vector>

#include "gvd/predicates/face_strip.hpp"
#include "gvd/robust/exact.hpp"

/// Lengths of paths that are straight through strips of faces. Units: those of the caller's coordinates.
namespace gvd::predicates {

/// A straight line from the source of a strip to a point of its last face, unfolded. It may pass outside the strip; its length is
/// |image - end| all the same (`cone_of` and `ray_side` tell whether it does).
struct Leg {
  /// `end` in the last face of the strip, weights in the order in which that was given. Throws std::invalid_argument if it is no point.
  Leg(FaceStrip strip, const FacePoint& end);

  FaceStrip strip;
  FacePoint end;  ///< weights with sum 1
  friend bool operator==(const Leg& a, const Leg& b);
};

/// Legs one after the other (through relays), after a length that is given: an additive weight, negative ones included.
struct Path {
  mpq_class given = 0;
  std::vector<Leg> legs;
  friend bool operator==(const Path&, const Path&) = default;
};

/// The sign of length(a) - length(b). Zero is proved equality. Laws: swapping negates; legs that both have count for nothing (identity);
/// invariant under a common similarity by a power of two.
/// The algebra stage cancels legs that are equal: through few independent square classes by sums of roots, through any number by the span test
/// (docs/exactness.md); what is left it decides if that crosses few. Cost: O(crossings) a numeric stage, O(crossings^2) the span test.
Decision compare_lengths(const Path& a, const Path& b);
robust::MaybeSign compare_lengths_at(const Rung& rung, const Path& a, const Path& b);

/// A proved enclosure, lower <= truth <= upper; infinite bounds if nothing is known.
struct Enclosure {
  double lower, upper;
};
/// Of relative width about 1e-30 for ordinary strips, rounded outward to doubles.
Enclosure length(const Path& path);

/// The double nearest to the length, ties to even; empty (stage `undecided`) if no stage could tell on which side of a midpoint it lies.
struct RoundedLength {
  std::optional<double> value;
  robust::Stage stage = robust::Stage::undecided;
};
RoundedLength rounded_length(const Path& path);

/// The length as an exact number; empty if a coordinate of a leg has more than kMostTerms roots (root_strip.hpp; five independent square
/// classes never have).
std::optional<robust::Exact> exact_length(const Path& path);

}  // namespace gvd::predicates
