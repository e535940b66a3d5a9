#pragma once

#include "laid_out.hpp"
#include "meshes.hpp"

/// Strips over a plane that is folded along parallel lines, so that their unfolding is known without unfolding: the corner (column, y) lies at (the sum of
/// the panels' widths, y). Widths are roots of whole numbers.
namespace gvd::test {

/// What a panel is wide and rises: its width is sqrt(dx^2 + dz^2).
struct Panel {
  int dx, dz;
};

/// Panels from column 0 on. Columns that are marked lie at whole multiples of one length.
struct FoldedBand {
  struct Mark {
    std::size_t column;
    int multiple;
  };
  std::vector<Panel> panels;
  std::vector<Mark> marks;

  void append(const Panel& panel) { panels.push_back(panel); }
  void mark(int multiple) { marks.push_back({panels.size(), multiple}); }
};

/// Whole numbers of axes permuted, moved and scaled, which changes no length but by a power of two.
struct Placement {
  std::array<std::size_t, 3> axis{0, 1, 2};
  std::array<double, 3> offset{0, 0, 0};
  int exponent = 0;

  static Placement random(Random& random) {
    Placement p;
    for (std::size_t k = 2; k > 0; --k) std::swap(p.axis[k], p.axis[random.below(static_cast<std::uint32_t>(k + 1))]);
    for (double& x : p.offset) x = random.below(4) == 0 ? 1e7 : 1 + random.below(9);
    const auto kind = random.below(8);
    p.exponent = kind == 0 ? 600 : kind == 1 ? -600 : 0;
    return p;
  }
  predicates::SpacePoint operator()(double x, double y, double z) const {
    const std::array<double, 3> at{x, y, z};
    predicates::SpacePoint p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = std::ldexp(at[axis[k]] + offset[k], exponent);
    return p;
  }
};

/// A strip along a band, from column 0 to its last one, between an upper and a lower bank with a corner at each column.
class BandStrip {
 public:
  /// Where a corner is to lie on a column: on the upper or lower bank, at y. Two of one column must have the upper one above.
  struct Anchor {
    std::size_t column;
    int y;
    bool upper;
  };
  struct Result {
    LaidOut strip;
    std::vector<std::size_t> anchor;  ///< corners
    std::array<std::size_t, 2> end;   ///< the lower and the upper corner of the last column
  };

  /// The source lies on column 0 at y = 0: in a corner, or inside an edge along the fold. On its column an anchor comes last. The other corners are about as
  /// far above as below `middle` of their column, or 0.
  static Result build(const FoldedBand& band, const Placement& place, const std::vector<Anchor>& anchors, bool source_on_edge, Random& random,
                      const std::vector<int>& middle = {}) {
    BandStrip b(band, place, anchors, random, middle);
    b.start(source_on_edge);
    for (std::size_t column = b.reached_; column < band.panels.size();) {
      ++column;
      bool upper_first = random.below(2) == 0;
      for (const Anchor& a : anchors)
        if (a.column == column) upper_first = !a.upper;
      b.extend(upper_first, column);
      b.extend(!upper_first, column);
    }
    return {b.strip_, b.found_, {b.lower_, b.upper_}};
  }

 private:
  BandStrip(const FoldedBand& band, const Placement& place, const std::vector<Anchor>& anchors, Random& random, const std::vector<int>& middle)
      : place_(place), anchors_(anchors), found_(anchors.size()) {
    int x = 0, z = 0;
    const auto column = [&](std::size_t c) {
      const int at = middle.empty() ? 0 : middle[c];
      Column next{x, z, at - static_cast<int>(1 + random.below(6)), at + static_cast<int>(1 + random.below(6))};
      const int apart = next.upper - next.lower;
      for (const Anchor& a : anchors_)
        if (a.column == c) (a.upper ? next.upper : next.lower) = a.y;
      for (const Anchor& a : anchors_)
        if (a.column == c && next.lower >= next.upper) (a.upper ? next.lower : next.upper) = a.upper ? a.y - apart : a.y + apart;
      columns_.push_back(next);
    };
    column(0);
    for (const Panel& panel : band.panels) {
      x += panel.dx;
      z += panel.dz;
      column(columns_.size());
    }
  }
  predicates::SpacePoint at(std::size_t c, int y) const { return place_(columns_[c].x, y, columns_[c].z); }

  void start(bool source_on_edge) {
    if (source_on_edge) {  // between (0, upper) and (0, lower); the lower one is the first bank
      const int above = columns_[0].upper, below = columns_[0].lower;
      strip_.corner = {at(0, above), at(0, below), at(1, columns_[1].upper)};
      strip_.source.weight = {-below, above, 0};
      note(2, 1, true);
      upper_ = 2;
      lower_ = 1;
      extend(false, 1);
    } else {
      strip_.corner = {at(0, 0), at(1, columns_[1].lower), at(1, columns_[1].upper)};
      note(1, 1, false);
      note(2, 1, true);
      lower_ = 1;
      upper_ = 2;
    }
    reached_ = 1;
  }
  void extend(bool upper, std::size_t column) {
    strip_.edge.push_back({lower_, upper_});
    const std::size_t v = strip_.corner.size();
    strip_.corner.push_back(at(column, upper ? columns_[column].upper : columns_[column].lower));
    note(v, column, upper);
    (upper ? upper_ : lower_) = v;
  }
  void note(std::size_t v, std::size_t column, bool upper) {
    for (std::size_t i = 0; i < anchors_.size(); ++i)
      if (anchors_[i].column == column && anchors_[i].upper == upper) found_[i] = v;
  }

  struct Column {
    int x, z, lower, upper;
  };
  const Placement& place_;
  const std::vector<Anchor>& anchors_;
  std::vector<std::size_t> found_;
  std::vector<Column> columns_;
  LaidOut strip_;
  std::size_t lower_ = 0, upper_ = 0, reached_ = 0;
};

}  // namespace gvd::test
