#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fuzz/properties/property.hpp"
#include "fuzz/properties/surface_points.hpp"

namespace gvd::fuzz {

std::string text_of(double x) { return fmt::format("{}", x); }
std::string text_of(const Sources& sources) {
  std::string text = "{";
  for (const auto s : sources) text += (text.size() > 1 ? " " : "") + std::to_string(s);
  return text + "}";
}

namespace {

using kernel::SourceId;
using kernel::VertexId;

/// A tie means the same double from each of them; of the others none may be less, and an equal double says nothing.
Outcome compare(double distance, const Sources& told, const std::vector<double>& single, bool labels, const std::string& where) {
  const double least = *std::min_element(single.begin(), single.end());
  if (distance != least) return violated(fmt::format("{}: D is {}, the least of the single runs is {}", where, distance, least));
  if (!labels) return holds();
  if (std::isinf(least))
    return told.empty() ? holds() : violated(where + ": unreachable, but it has nearest sources " + text_of(told));
  if (told.empty()) return violated(where + ": no nearest source");
  for (const SourceId s : told)
    if (single[s] != least)
      return violated(fmt::format("{}: labelled {}, but source {} alone gives {} > {}", where, text_of(told), s, single[s], least));
  for (SourceId s = 0; s < single.size(); ++s)
    if (!std::binary_search(told.begin(), told.end(), s) && single[s] < least)
      return violated(fmt::format("{}: labelled {}, but source {} is nearer", where, text_of(told), s));
  return holds();
}

Outcome labels_at_vertices(Trial& t) {
  for (VertexId v = 0; v < t.mesh().vertex_count(); ++v) {
    std::vector<double> single;
    for (SourceId s = 0; s < t.sources().size(); ++s) single.push_back(t.alone(s).distance(v));
    const Outcome outcome = compare(t.solution().distance(v), nearest(t.solution(), v), single, t.certified(), vertex_name(v));
    if (outcome.kind != Outcome::Kind::holds) return outcome;
  }
  return holds();
}

Outcome labels_inside_facets(Trial& t) {
  constexpr int kPoints = 6;
  Draw draw = t.draw("labels_inside_facets");
  bool open = false;
  for (int i = 0; i < kPoints; ++i) {
    const auto at = point_on(draw, t.mesh());
    const auto answer = t.solution().query(at);
    std::vector<double> single;
    for (SourceId s = 0; s < t.sources().size(); ++s) {
      const auto one = t.alone(s).query(at);
      open = open || one.undecided;
      single.push_back(one.distance);
    }
    open = open || answer.undecided;
    if (open) continue;
    const Outcome outcome = compare(answer.distance, answer.nearest, single, true, text_of(at));
    if (outcome.kind != Outcome::Kind::holds) return outcome;
  }
  return open ? undecided() : holds();
}

/// The label sets that the diagram gives the faces are those that queries give inside them.
/// A source that others reach with exactly its own weight has no region, but ties with them on the rays behind it.
bool ties_on_a_ray(Trial& t, const std::vector<kernel::SourceId>& nearest, const std::vector<kernel::SourceId>& labels) {
  return std::includes(nearest.begin(), nearest.end(), labels.begin(), labels.end()) &&
         std::all_of(nearest.begin(), nearest.end(), [&](kernel::SourceId s) {
           const auto at_source = t.solution().query(t.sources()[s].at).nearest;
           return std::includes(at_source.begin(), at_source.end(), labels.begin(), labels.end()) || std::binary_search(labels.begin(), labels.end(), s);
         });
}

Outcome faces_have_their_label(Trial& t) {
  const auto& diagram = t.solution().diagram();
  Draw draw = t.draw("faces_have_their_label");
  constexpr int kFaces = 6;
  for (int i = 0; i < kFaces; ++i) {
    const kernel::FaceId f = draw.below(t.mesh().face_count());
    if (diagram.face_label[f] == kernel::kNone) continue;
    const auto at = point_in(draw, f);
    if (at.bary[0] == 0 || at.bary[1] == 0 || at.bary[2] == 0) continue;  // its sides may have more labels
    const auto answer = t.solution().query(at);
    const auto& labels = diagram.label_sets[diagram.face_label[f]];
    if (!answer.undecided && answer.nearest != labels && !ties_on_a_ray(t, answer.nearest, labels))
      return violated(fmt::format("{}: nearest {}, the face is labelled {}", text_of(at), text_of(answer.nearest),
                                  text_of(diagram.label_sets[diagram.face_label[f]])));
  }
  return holds();
}

constexpr std::array<Property, 3> kProperties = {{
    {"faces_have_their_label", faces_have_their_label, 1, "the label of a face is that of the points inside it"},
    {"labels_at_vertices", labels_at_vertices, 8,
     "a vertex has the least distance of all single-source runs, and is labelled by those"},
    {"labels_inside_facets", labels_inside_facets, 8, "so has any point of a facet or an edge"},
}};

}  // namespace

std::span<const Property> labelling_properties() { return kProperties; }

}  // namespace gvd::fuzz
