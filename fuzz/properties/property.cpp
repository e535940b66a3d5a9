#include "fuzz/properties/property.hpp"

#include <vector>

namespace gvd::fuzz {

std::span<const Property> properties() {
  static const std::vector<Property> all = [] {
    std::vector<Property> list;
    for (const auto& group :
         {labelling_properties(), diagram_properties(), facet_properties(), stage_properties(), identity_properties(), region_properties(), planar_properties(),
          metric_properties(), source_set_properties(), invariance_properties(), remeshing_properties(), enumeration_properties()})
      list.insert(list.end(), group.begin(), group.end());
    return list;
  }();
  return all;
}

const Property* find_property(const std::string& name) {
  for (const Property& p : properties())
    if (name == p.name) return &p;
  return nullptr;
}

Outcome check(const Property& property, Trial& trial) {
  try {
    return property.check(trial);
  } catch (const TookTooLong& e) {
    return {Outcome::Kind::undecided, e.what()};
  } catch (const std::exception& e) {
    return violated(std::string("the kernel threw: ") + e.what());
  }
}

}  // namespace gvd::fuzz
