#pragma once

#include <algorithm>
#include <vector>

#include "gvd/predicates/strip_program.hpp"
#include "robust/random_numbers.hpp"

namespace gvd::test {

/// A strip of faces with corners in space, by itself: half-edge 3 f + k is side k of face f. Face 0 is that of the root, each other is entered over its side 0.
struct LooseStrip {
  std::vector<predicates::ProgramFace> faces;
  predicates::Strip strip;
  std::uint32_t last = 0;  ///< the apex of this half-edge is the target

  predicates::StripProgram program() const {
    return predicates::strip_program(strip, [&](std::uint32_t h) -> const predicates::ProgramFace& { return faces[h / 3]; });
  }
  robust::RootProgram squared_length() const {
    return program().squared_distance_to_apex(faces[last / 3], last % 3);
  }
};

using Corner = std::array<mpq_class, 3>;

inline predicates::ProgramFace program_face(const Corner& a, const Corner& b, const Corner& c) {
  const auto side = [](const Corner& p, const Corner& q) {
    return predicates::Vector<mpq_class>{q[0] - p[0], q[1] - p[1], q[2] - p[2]};
  };
  predicates::ProgramFace face{predicates::exact_face({side(a, b), side(b, c), side(c, a)}), {}};
  face.doubled_area = robust::RootSum(1, face.face.radicand);
  return face;
}

/// `corner()` gives the corners; `count` faces, at least 2, turning at random.
template <class CornerSource>
LooseStrip loose_strip(std::size_t count, robust::test::RandomNumbers& random, CornerSource&& corner) {
  LooseStrip result;
  Corner a = corner(), b = corner();
  result.faces.push_back(program_face(b, a, corner()));
  result.strip.opposite = 0;
  for (std::uint32_t f = 1; f < count; ++f) {
    const Corner c = corner();
    result.faces.push_back(program_face(a, b, c));
    if (f + 1 == count) break;
    const bool left = random.below(2) == 0;
    result.strip.steps.push_back({3 * f + (left ? 2 : 1), left, false});
    (left ? b : a) = c;
  }
  result.last = static_cast<std::uint32_t>(3 * (count - 1));
  return result;
}

/// The same strip seen in a mirror.
inline LooseStrip mirrored(const LooseStrip& strip) {
  LooseStrip result = strip;
  for (auto& face : result.faces) {
    std::swap(face.face.dot[0], face.face.dot[1]);
    std::swap(face.face.squared[1], face.face.squared[2]);
  }
  for (auto& step : result.strip.steps) {
    step.left = !step.left;
    step.side = step.side / 3 * 3 + (step.left ? 2 : 1);
  }
  return result;
}

/// From the target to the root.
inline LooseStrip turned_round(const LooseStrip& strip) {
  LooseStrip result;
  result.faces = strip.faces;
  result.strip.opposite = strip.last;
  for (auto step = strip.strip.steps.rbegin(); step != strip.strip.steps.rend(); ++step)
    result.strip.steps.push_back({step->side / 3 * 3, !step->left, false});
  result.last = strip.strip.opposite;
  return result;
}

}  // namespace gvd::test
