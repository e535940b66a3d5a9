#include "gvd/predicates/face_frames.hpp"

namespace gvd::predicates {

ExactFace exact_face(const std::array<Vector<mpq_class>, 3>& side) {
  ExactFace face;
  for (std::size_t k = 0; k < 3; ++k) {
    face.dot[k] = -dot(side[k], side[(k + 2) % 3]);
    face.squared[k] = dot(side[k], side[k]);
  }
  face.radicand = face.squared[0] * face.squared[2] - face.dot[0] * face.dot[0];
  return face;
}

}  // namespace gvd::predicates
