#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "fuzz/properties/trial.hpp"

namespace gvd::fuzz {

/// What came of looking at one property of one case.
struct Outcome {
  enum class Kind : std::uint8_t {
    holds,
    violated,   ///< the kernel is wrong
    undecided,  ///< the kernel says that it does not know what the property asks for
    skipped,    ///< the property says nothing about this case
  };
  Kind kind = Kind::holds;
  std::string what;
};
inline Outcome holds() { return {}; }
inline Outcome violated(std::string what) { return {Outcome::Kind::violated, std::move(what)}; }
inline Outcome undecided() { return {Outcome::Kind::undecided, {}}; }
inline Outcome skipped() { return {Outcome::Kind::skipped, {}}; }

struct Property {
  const char* name;
  Outcome (*check)(Trial& trial);
  std::uint32_t one_in;  ///< looked at in one of so many cases, the more it costs the fewer; those of one rate in the same ones, which share solutions
  const char* says;
};

/// All properties, in a fixed order.
std::span<const Property> properties();
/// Null if there is none of that name.
const Property* find_property(const std::string& name);

/// Exceptions and too long runs become outcomes too: an InternalError of the kernel is a violation.
Outcome check(const Property& property, Trial& trial);

// The properties by what they compare; each in a file of that name.
std::span<const Property> labelling_properties();
std::span<const Property> metric_properties();
std::span<const Property> source_set_properties();
std::span<const Property> invariance_properties();
std::span<const Property> remeshing_properties();
std::span<const Property> planar_properties();
std::span<const Property> diagram_properties();
std::span<const Property> facet_properties();
std::span<const Property> stage_properties();
std::span<const Property> identity_properties();
std::span<const Property> region_properties();
std::span<const Property> enumeration_properties();

}  // namespace gvd::fuzz
