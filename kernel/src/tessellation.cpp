#include "gvd/kernel/tessellation.hpp"

#include "contenders.hpp"
#include "growth.hpp"
#include "outline.hpp"

namespace gvd::kernel {
FacetTessellation tessellate(FacetWaves& waves, predicates::Decisions& decisions) {
  FacetTessellation result;
  FacetLadder ladder(waves, decisions);
  const Contenders contenders(waves, ladder);
  const std::vector<Occurrence> outline = OutlineWalk(waves, contenders, ladder, result).walk();
  if (!ladder.failed()) Growth(waves, contenders, ladder, result).run(outline);
  if (ladder.failed()) {
    result = {};
    result.undecided = true;
    return result;
  }
  result.representative = contenders.representatives();
  return result;
}

}  // namespace gvd::kernel
