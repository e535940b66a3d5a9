#include "edge_images.hpp"

#include <optional>

#include "gvd/kernel/unfolding.hpp"

namespace gvd::kernel {
namespace {

/// The image of a wave of the facet of h, in the frame of h or of its twin.
struct EdgeImage {
  predicates::StripProgram image;
  bool seen_from_twin;
};

/// None for a corner of the facet on the edge itself.
std::optional<EdgeImage> edge_image(const Resolution& resolution, HalfedgeId h, const FacetSite& site) {
  const Frames& frames = resolution.frames();
  const auto face = frames.for_program(Mesh::face(h));
  const HalfedgeId side = h % 3;
  if (site.window == kNone) {
    if (site.corner != (side + 2) % 3) return std::nullopt;
    return EdgeImage{predicates::StripProgram(*face, side), true};
  }
  EdgeImage result{way_program(frames, sides_of(strip_of(frames.mesh(), resolution.field(), site.window))), false};
  if (site.side == side) return result;
  result.image.cross(*face, side, side == (static_cast<HalfedgeId>(site.side) + 2) % 3);
  result.seen_from_twin = true;
  return result;
}

}  // namespace

bool are_as_far_along(const Resolution& resolution, HalfedgeId h, const FacetSite& left, const FacetSite& right) {
  const auto of_left = edge_image(resolution, h, left), of_right = edge_image(resolution, resolution.frames().mesh().twin(h), right);
  if (!of_left || !of_right || !resolution.have_equal_distances(left.root, right.root)) return false;
  // Each is as far as its mirror image, so the sides that the frames have above count for nothing; only that they run one way.
  const auto x = [](const EdgeImage& at, bool in_twin) { return at.image.value(in_twin ? std::array<long, 4>{0, -1, 0, 1} : std::array<long, 4>{0, 1, 0, 0}); };
  const auto y = [](const EdgeImage& at) { return at.image.value({0, 0, 1, 0}); };
  if (!are_proved_equal(x(*of_left, of_left->seen_from_twin), x(*of_right, !of_right->seen_from_twin))) return false;
  return are_proved_equal(y(*of_left), y(*of_right));
}

}  // namespace gvd::kernel
