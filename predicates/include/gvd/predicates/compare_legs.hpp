#pragma once

#include <algorithm>
#include <vector>

#include "gvd/robust/exact.hpp"

namespace gvd::predicates {

/// The sign of  given + (the lengths of a) - (the lengths of b).  A leg has a member `squared`: its squared length, empty if that is too long
/// a sum of roots. Legs that are equal cancel; `equal(x, y)`: true is a proof. Empty if a leg without a sum is left over, or the rest is out of
/// reach.
template <class Leg, class Equal>
robust::MaybeSign compare_legs(const mpq_class& given, const std::vector<Leg>& a, const std::vector<Leg>& b, const Equal& equal) {
  std::vector<const Leg*> more, less;
  for (const Leg& leg : a) more.push_back(&leg);
  for (const Leg& leg : b) {
    const auto twin = std::find_if(more.begin(), more.end(), [&](const Leg* other) { return equal(leg, *other); });
    if (twin == more.end())
      less.push_back(&leg);
    else
      more.erase(twin);
  }
  for (const auto* legs : {&more, &less})
    for (const Leg* leg : *legs)
      if (!leg->squared) return std::nullopt;
  if (sgn(given) == 0 && more.size() == 1 && less.size() == 1) return compare(*more[0]->squared, *less[0]->squared);
  robust::Exact difference(given);
  for (const Leg* leg : more) difference += sqrt(robust::Exact(*leg->squared));
  for (const Leg* leg : less) difference -= sqrt(robust::Exact(*leg->squared));
  return maybe_sign(difference);
}

}  // namespace gvd::predicates
