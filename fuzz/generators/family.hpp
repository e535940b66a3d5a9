#pragma once

#include <cstdint>
#include <span>

#include "fuzz/generators/case.hpp"
#include "fuzz/generators/draw.hpp"

namespace gvd::fuzz {

/// Makes a mesh of about 2 size^2 faces. It may be refused now and then (a face without area, say): then another one is drawn.
struct Family {
  const char* name;
  kernel::MeshArrays (*make)(Draw& draw, std::uint32_t size);
  const char* about;
};

/// All families, in a fixed order (a part of the version of the generators). Plain ones need no other family.
std::span<const Family> families();

// The families by what they attack; each in a file of that name.
std::span<const Family> terrain_families();
std::span<const Family> developable_families();
std::span<const Family> relief_families();
std::span<const Family> topology_families();
std::span<const Family> thin_families();
/// Meshes of other families moved far away, or scaled.
std::span<const Family> range_families();

/// How sources are laid on a mesh.
struct Pattern {
  const char* name;
  std::vector<Place> (*lay)(Draw& draw, const kernel::MeshArrays& mesh, std::uint32_t count);
};
std::span<const Pattern> patterns();

/// Changes whenever a seed may give another case.
inline constexpr int kGeneratorVersion = 2;

/// What is asked of a case; what is left out is drawn.
struct Wish {
  std::string family, pattern;  ///< empty: drawn
  std::uint32_t size = 0;       ///< 0: drawn, mostly 2 .. 4, seldom up to 10
  std::uint32_t sources = 0;    ///< 0: drawn, one to some, seldom hundreds
  int weighted = -1;            ///< 0 no, 1 yes, -1 drawn
};

/// The case of a seed. It is valid.
Case make_case(std::uint64_t seed, const Wish& wish = {});

}  // namespace gvd::fuzz
