// Pieces of bisectors in plain doubles against long numbers (docs/error-bounds.md#pieces-of-bisectors).
#include "gvd/predicates/bisector_piece.hpp"

#include <gtest/gtest.h>

#include "gvd/predicates/cone_row.hpp"
#include "support/true_wave.hpp"

namespace {

using gvd::predicates::BisectorPiece;
using gvd::predicates::DoubleLine;
using gvd::predicates::DoublePoint;
using gvd::predicates::DoubleWave;
using gvd::test::distance;
using gvd::test::Long;
using gvd::test::LongPoint;
using gvd::test::nearest;
using gvd::test::TrueWave;
using gvd::test::wide;
using gvd::predicates::operator-;

/// Waves round the unit circle with errors, and the true ones.
class Family : public gvd::test::Shares {
 public:
  using Shares::Shares;
  DoubleWave wave() {
    const double size = std::ldexp(1.0, static_cast<int>(bits() % 8));
    return {{size * share(), size * share()}, size * std::fabs(share()), std::ldexp(std::fabs(share()), -20 - static_cast<int>(bits() % 30))};
  }
  TrueWave member(const DoubleWave& wave) {
    const double part = 0.4 * wave.error;
    return {{wide(wave.image.x) + wide(part * share()), wide(wave.image.y) + wide(part * share())}, wide(wave.weight) + wide(part * share())};
  }
};

struct Pair {
  DoubleWave left, right;
  TrueWave true_left, true_right;
  double lead(const DoublePoint& p) const { return nearest(distance(true_left, wide(p)) - distance(true_right, wide(p))); }
};

/// The tie on the segment from p to q, if the difference changes its sign there.
std::optional<DoublePoint> tie(const Pair& pair, DoublePoint p, DoublePoint q) {
  const bool rises = pair.lead(p) < 0;
  if (rises == (pair.lead(q) < 0)) return std::nullopt;
  for (int step = 0; step < 60; ++step) {
    const DoublePoint middle{0.5 * (p.x + q.x), 0.5 * (p.y + q.y)};
    ((pair.lead(middle) < 0) == rises ? p : q) = middle;
  }
  return p;
}

/// Two ties of two waves, with `left` on the left of the way from one to the other.
struct Ends {
  Pair pair;
  DoublePoint from, to;
};
std::optional<Ends> random_ends(Family& family) {
  Ends ends;
  Pair& pair = ends.pair;
  pair.left = family.wave(), pair.right = family.wave();
  const DoublePoint at = family.point();
  pair.left.weight = std::fmax(0.0, pair.right.weight + gvd::predicates::distance({pair.right.image, 0, 0}, at) - gvd::predicates::distance({pair.left.image, 0, 0}, at));
  pair.true_left = family.member(pair.left), pair.true_right = family.member(pair.right);
  const DoublePoint u = gradient(pair.left, at), v = gradient(pair.right, at), rise{u.x - v.x, u.y - v.y};
  const double length = std::ldexp(1.0, -static_cast<int>(6 + 5 * family.share())), wide_by = 0.5 * length;
  const auto near = [&](double along) -> std::optional<DoublePoint> {
    const DoublePoint p{at.x - along * rise.y, at.y + along * rise.x};
    return tie(pair, {p.x - wide_by * rise.x, p.y - wide_by * rise.y}, {p.x + wide_by * rise.x, p.y + wide_by * rise.y});
  };
  const auto from = near(0), to = near(length);
  if (!from || !to) return std::nullopt;
  ends.from = *from, ends.to = *to;
  return ends;
}

/// A tie between the two ends, across the way between them.
std::optional<DoublePoint> tie_between(const Ends& ends, double share) {
  const DoublePoint chord{ends.to.x - ends.from.x, ends.to.y - ends.from.y};
  const DoublePoint p{ends.from.x + share * chord.x, ends.from.y + share * chord.y};
  return tie(ends.pair, {p.x + chord.y, p.y - chord.x}, {p.x - chord.y, p.y + chord.x});
}

std::pmr::memory_resource* room() { return std::pmr::new_delete_resource(); }
/// Whether another wave is certainly farther than the left one all along the piece, whatever its place in a row.
bool is_farther(const BisectorPiece& piece, const DoubleWave& left, const DoubleWave& other) {
  std::vector<DoubleWave> waves(6, left);
  waves[1] = waves[5] = other;
  const gvd::predicates::WaveRow row(waves, room());
  gvd::predicates::WaveRow::Reading middle(row, room());
  gvd::predicates::WaveRow::Marks marks(row, room());
  row.read(piece.middle, middle);
  row.mark_farther(piece, middle, 0, marks);
  EXPECT_EQ(marks[1], marks[5]);
  EXPECT_FALSE(marks[0] || marks[4]);
  return marks[1];
}
/// Whether a wave whose cone ends at the line, on either side of it, certainly does not see the piece.
bool is_right_of(const BisectorPiece& piece, const DoubleLine& line) {
  const DoubleLine other{piece.middle, {0, 0}, 0, 0};
  gvd::predicates::ConeRow row(5, room());
  gvd::predicates::WaveRow::Marks marks(gvd::predicates::WaveRow(std::vector<DoubleWave>(5), room()), room());
  for (std::size_t i = 0; i < 5; ++i) marks.data()[i] = i == 2 ? -1 : 0;
  row.set(0, {line, other}, {false, false, false});
  row.set(4, {other, line}, {false, false, false});
  row.mark_blind(piece, marks);
  EXPECT_EQ(marks[0], marks[4]);
  EXPECT_TRUE(marks[2] && !marks[1]);
  return marks[0];
}

TEST(BisectorPiece, WhatIsCalledFartherIsFartherAtEveryTie) {
  Family family(1);
  int pieces = 0, farther = 0, others = 0, beyond = 0;
  for (int round = 0; round < 1500; ++round) {
    const auto ends = random_ends(family);
    if (!ends) continue;
    const auto piece = BisectorPiece::between(ends->pair.left, ends->pair.right, ends->from, ends->to, 0x1p-50);
    if (!piece) continue;
    ++pieces;
    std::vector<DoublePoint> ties;
    for (const double share : {0.02, 0.25, 0.5, 0.75, 0.98}) {
      const auto at = tie_between(*ends, share);
      ASSERT_TRUE(at) << "round " << round << ": the bisector does not lead from one end to the other";
      ties.push_back(*at);
    }
    for (int n = 0; n < 4; ++n, ++others) {
      DoubleWave other = family.wave();
      const DoublePoint& near = ties[static_cast<std::size_t>(n)];
      const double later = std::ldexp(1 + family.share(), -static_cast<int>(8 + 8 * family.share()));  // a little farther at a tie
      other.weight = gvd::predicates::distance(ends->pair.left, near) - gvd::predicates::distance({other.image, 0, 0}, near) + later;
      const TrueWave truth = family.member(other);
      const DoublePoint to{near.x + later * family.share(), near.y + later * family.share()};
      const DoubleLine line{to, family.point(), 0x1p-30, 0x1p-30};
      const bool is_nearer = is_farther(*piece, ends->pair.left, other), is_right = is_right_of(*piece, line);
      farther += is_nearer, beyond += is_right;
      for (const DoublePoint& at : ties) {
        const double lead = nearest(distance(truth, wide(at)) - distance(ends->pair.true_left, wide(at)));
        ASSERT_TRUE(!is_nearer || lead > 0) << "round " << round;
        ASSERT_TRUE(!is_right || nearest(cross(wide(line.along), wide(at) - wide(line.from))) < 0) << "round " << round;
      }
    }
  }
  EXPECT_GT(pieces, 250);
  EXPECT_GT(farther, others / 8);
  EXPECT_GT(beyond, others / 8);
}

TEST(BisectorPiece, WhatTiesOnThePieceIsNeverCalledFarther) {
  Family family(2);
  int asked = 0;
  for (int round = 0; round < 1500; ++round) {
    const auto ends = random_ends(family);
    if (!ends) continue;
    const auto piece = BisectorPiece::between(ends->pair.left, ends->pair.right, ends->from, ends->to, 0x1p-50);
    const auto at = tie_between(*ends, 0.5 + 0.5 * family.share());
    if (!piece || !at) continue;
    ++asked;
    DoubleWave other = family.wave();
    other.weight = gvd::predicates::distance(ends->pair.left, *at) - gvd::predicates::distance({other.image, 0, 0}, *at);
    EXPECT_FALSE(is_farther(*piece, ends->pair.left, other)) << "round " << round;
    const DoublePoint chord{ends->to.x - ends->from.x, ends->to.y - ends->from.y};
    for (const DoublePoint& along : {family.point(), chord, DoublePoint{-chord.x, -chord.y}})
      EXPECT_FALSE(is_right_of(*piece, {*at, along, 0, 0})) << "round " << round;
  }
  EXPECT_GT(asked, 250);
}

TEST(BisectorPiece, TheWavesLieOnTheirSides) {
  Family family(3);
  int asked = 0;
  for (int round = 0; round < 600; ++round) {
    const auto ends = random_ends(family);
    if (!ends || !BisectorPiece::between(ends->pair.left, ends->pair.right, ends->from, ends->to, 0x1p-50)) continue;
    ++asked;
    EXPECT_FALSE(BisectorPiece::between(ends->pair.right, ends->pair.left, ends->from, ends->to, 0x1p-50)) << "round " << round;
    EXPECT_FALSE(BisectorPiece::between(ends->pair.left, ends->pair.right, ends->to, ends->from, 0x1p-50)) << "round " << round;
    const DoublePoint chord{ends->to.x - ends->from.x, ends->to.y - ends->from.y};
    EXPECT_LT(ends->pair.lead({ends->from.x - chord.y, ends->from.y + chord.x}), 0) << "round " << round;
  }
  EXPECT_GT(asked, 100);
}

TEST(BisectorPiece, AWaveBehindTheOtherHasNone) {
  const DoubleWave parent{{-2, 0}, 0, 0x1p-50}, relay{{-1, 0}, 1, 0x1p-50};
  EXPECT_FALSE(BisectorPiece::between(parent, relay, {0, 0}, {0.25, 0}, 0x1p-50));
  EXPECT_FALSE(BisectorPiece::between(relay, parent, {0, 0}, {0.25, 0}, 0x1p-50));
}

// A short piece between waves far away. Each bound by itself: a little below it there is a piece, a little above it there is none.
TEST(BisectorPiece, EachBoundCounts) {
  struct Numbers {
    double half_length = 0.125, radius = 0x1p-50, reach_left = 8, reach_right = 8, error_left = 0, error_right = 0;
    bool has_piece() const {
      const DoubleWave left{{-reach_left, 0}, 0, error_left}, right{{reach_right, 0}, reach_left - reach_right, error_right};
      return BisectorPiece::between(left, right, {0, -half_length}, {0, half_length}, radius).has_value();
    }
  };
  const auto expect_bound = [](double Numbers::*which, double most) {
    Numbers numbers;
    numbers.*which = most * (1 - 0x1p-10);
    EXPECT_TRUE(numbers.has_piece()) << most;
    numbers.*which = most * (1 + 0x1p-10);
    EXPECT_FALSE(numbers.has_piece()) << most;
  };
  EXPECT_TRUE(Numbers().has_piece());
  expect_bound(&Numbers::radius, 0.125 / 3);
  expect_bound(&Numbers::error_left, 1);
  expect_bound(&Numbers::error_right, 1);
  for (double Numbers::*const reach : {&Numbers::reach_left, &Numbers::reach_right}) {
    Numbers numbers;
    numbers.*reach = 1.25 * 4 * 0.125 * (1 + 0x1p-10);
    EXPECT_TRUE(numbers.has_piece());
    numbers.*reach = 1.25 * 4 * 0.125 * (1 - 0x1p-10);
    EXPECT_FALSE(numbers.has_piece());
  }
}

}  // namespace
