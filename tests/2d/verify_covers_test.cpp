// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "mutations.hpp"
#include "verified.hpp"

namespace encase {
namespace {

using namespace verified;

TEST(VerifyCovers, ObjectsToEveryWrongLeaf) {
  // Every leaf of every cover claims something that is not true of another kind of leaf.
  const Encasement e = circle_and_line();
  const auto& tokens = e.crossing_covers[0].tokens;
  for (std::size_t t = 0; t < tokens.size(); ++t) {
    const auto with = [&](int token) {
      Encasement mutant = e;
      mutant.crossing_covers[0].tokens[t] = token;
      return verify(mutant).ok();
    };
    if (tokens[t] == cover::kSplitX || tokens[t] == cover::kSplitY) {
      EXPECT_FALSE(with(cover::kExcluded));
      continue;
    }
    EXPECT_FALSE(with(cover::kOutside));
    EXPECT_FALSE(with(cover::kUnresolved));
    EXPECT_FALSE(with(cover::kSplitX));
    EXPECT_FALSE(with(cover::kSplitZ));
    if (tokens[t] >= 0) {
      EXPECT_FALSE(with(1 - tokens[t]));
    }
  }
  // Leaves around a crossing cannot all be excluded.
  for (int k : {0, 1})
    expect_objection(
        e,
        [&](auto& m) {
          for (int& token : m.crossing_covers[0].tokens)
            if (token == k) token = cover::kExcluded;
        },
        "is not proved free of crossings");

  const auto& critical = e.critical_covers[0].tokens;
  for (std::size_t t = 0; t < critical.size(); ++t) {
    if (critical[t] < 0) continue;
    expect_objection(
        e, [&](auto& m) { m.critical_covers[0].tokens[t] = cover::kOutside; }, "is not outside");
  }
  expect_objection(
      e,
      [&](auto& m) {
        for (int& token : m.critical_covers[0].tokens)
          if (token >= 0) token = cover::kExcluded;
      },
      "is not proved free of critical points");
}

TEST(VerifyCovers, ObjectsToIncompleteCovers) {
  const Encasement e = circle_and_line();
  expect_objection(
      e, [](auto& m) { m.crossing_covers.clear(); }, "has no crossing cover");
  expect_objection(
      e, [](auto& m) { m.critical_covers.pop_back(); }, "has no critical cover");
  expect_objection(
      e, [](auto& m) { m.critical_covers[1] = m.critical_covers[0]; }, "has two critical covers");
  expect_objection(
      e, [](auto& m) { m.crossing_covers.push_back(m.crossing_covers[0]); },
      "have two crossing covers");
  expect_objection(
      e, [](auto& m) { m.crossing_covers[0].tokens.pop_back(); }, "ends before its last leaf");
  expect_objection(
      e, [](auto& m) { m.critical_covers[0].tokens.clear(); }, "ends before its last leaf");
  expect_objection(
      e, [](auto& m) { m.critical_covers[0].tokens.push_back(cover::kExcluded); }, "tokens left");
  expect_objection(
      e, [](auto& m) { m.crossing_covers[0].root.hi[0] = 0.99; }, "does not cover");
  expect_objection(
      e, [](auto& m) { m.crossing_covers[0].tokens.assign(5000, cover::kSplitX); },
      "that doubles cannot split");
}

TEST(VerifyCovers, AcceptsASharedCover) {
  const Encasement e = four_curves();
  ASSERT_FALSE(e.shared_cover.tokens.empty());
  ASSERT_LT(e.crossing_covers.size(), 6u);
  expect_accepted(e);
  // Covers of all pairs prove the same without it.
  Encasement plain = e;
  plain.shared_cover = {};
  expect_objection(plain, "does not cover the region used");
  expect_objection(plain, "Some pair of curves has no crossing cover");
}

TEST(VerifyCovers, ObjectsToAWrongSharedCover) {
  const Encasement e = four_curves();
  const std::size_t leaves = e.shared_cover.alive.size();
  ASSERT_GT(leaves, 3u);
  expect_objection(
      e, [](auto& m) { m.shared_cover.root.hi[0] = 0.99; }, "does not cover the region used");
  expect_objection(
      e, [](auto& m) { m.shared_cover.root.lo[1] = std::nan(""); }, "bad root or token");
  expect_objection(
      e, [](auto& m) { m.shared_cover.tokens.pop_back(); }, "bad root or token");
  expect_objection(
      e,
      [](auto& m) {
        m.shared_cover.tokens.pop_back();
        m.shared_cover.alive.pop_back();
      },
      "ends before its last leaf");
  expect_objection(
      e,
      [](auto& m) {
        m.shared_cover.tokens.push_back(static_cast<int>(m.shared_cover.alive.size()));
        m.shared_cover.alive.push_back({0, 1, 2, 3});
      },
      "tokens left");
  expect_objection(
      e, [](auto& m) { m.shared_cover.alive.push_back({}); }, "bad root or token");
  expect_objection(
      e, [](auto& m) { m.shared_cover.tokens.clear(); }, "bad root or token");
  expect_objection(
      e,
      [](auto& m) {
        m.shared_cover.alive[0] = {1, 0};
      },
      "ascending indices");
  expect_objection(
      e, [](auto& m) { m.shared_cover.alive[0] = {4}; }, "ascending indices");
  expect_objection(
      e, [](auto& m) { m.shared_cover.alive[0] = {-1}; }, "ascending indices");
  expect_objection(
      e,
      [](auto& m) {
        m.shared_cover.tokens.back() = cover::kUnresolved;
        m.shared_cover.alive.pop_back();
      },
      "is in no unresolved box of all curves");
  for (const int bad : {cover::kExcluded, cover::kUnresolved, cover::kSplitZ, 0, 1000000})
    for (std::size_t t = 1; t < e.shared_cover.tokens.size(); ++t) {
      if (e.shared_cover.tokens[t] == bad) continue;
      Encasement mutant = e;
      mutant.shared_cover.tokens[t] = bad;
      EXPECT_FALSE(verify(mutant).ok()) << t;
    }
  // A leaf in the region is not outside.
  for (std::size_t t = 1; t < e.shared_cover.tokens.size(); ++t) {
    if (e.shared_cover.tokens[t] < 0) continue;
    Encasement mutant = e;
    mutant.shared_cover.tokens[t] = cover::kOutside;
    mutant.shared_cover.alive.erase(mutant.shared_cover.alive.begin() + e.shared_cover.tokens[t]);
    for (int& token : mutant.shared_cover.tokens) token -= token > e.shared_cover.tokens[t];
    expect_objection(mutant, "is not outside the region used");
  }
}

TEST(VerifyCovers, ObjectsToCurvesThatAreSaidToBeAbsent) {
  const Encasement e = four_curves();
  // Every crossing lies in leaves in which both curves are alive: one of these without a curve is
  // wrong. The others are tried by the mutations.
  const auto leaf_boxes = [&] {
    std::vector<Box<2>> boxes, stack{e.shared_cover.root};
    for (const int token : e.shared_cover.tokens) {
      const Box<2> box = stack.back();
      stack.pop_back();
      if (token >= 0) boxes.push_back(box);
      if (token != cover::kSplitX && token != cover::kSplitY) continue;
      const int axis = cover::kSplitX - token;
      Box<2> lower = box, upper = box;
      lower.hi[axis] = upper.lo[axis] = box.center()[axis];
      stack.push_back(upper);
      stack.push_back(lower);
    }
    return boxes;
  }();
  ASSERT_EQ(leaf_boxes.size(), e.shared_cover.alive.size());
  int tried = 0;
  for (const Crossing& crossing : e.crossings)
    for (std::size_t k = 0; k < leaf_boxes.size(); ++k) {
      if (crossing.location == Location::Outside || !leaf_boxes[k].contains(crossing.box)) continue;
      for (const int curve : crossing.curves) {
        expect_objection(
            e, [&](auto& m) { std::erase(m.shared_cover.alive[k], curve); },
            "is not proved absent from leaf " + std::to_string(k));
        ++tried;
      }
    }
  EXPECT_GT(tried, 5);
}

TEST(VerifyCovers, ObjectsToCoversThatLeaveOutLeaves) {
  const Encasement e = four_curves();
  for (std::size_t k = 0; k < e.crossing_covers.size(); ++k) {
    expect_objection(
        e,
        [&](auto& m) {
          m.crossing_covers.erase(m.crossing_covers.begin() + static_cast<std::ptrdiff_t>(k));
        },
        "Some pair of curves has no crossing cover");
    for (const int axis : {0, 1})
      expect_objection(
          e,
          [&](auto& m) {
            Box<2>& root = m.crossing_covers[k].root;
            root.hi[axis] -= 0.5 * root.width(axis);
          },
          "Crossing cover " + std::to_string(k) + " does not cover the shared cover's leaves");
  }
  for (std::size_t k = 0; k < e.critical_covers.size(); ++k) {
    expect_objection(
        e,
        [&](auto& m) {
          m.critical_covers.erase(m.critical_covers.begin() + static_cast<std::ptrdiff_t>(k));
        },
        "Some curve has no critical cover");
    expect_objection(
        e,
        [&](auto& m) {
          Box<2>& root = m.critical_covers[k].root;
          root.lo[0] += 0.5 * root.width(0);
        },
        "Critical cover " + std::to_string(k) + " does not cover the shared cover's leaves");
  }
  // Curves that are alive in one leaf more meet others there.
  expect_objection(
      e,
      [](auto& m) {
        for (auto& alive : m.shared_cover.alive) alive = {0, 1, 2, 3};
      },
      "Some pair of curves has no crossing cover");
}

TEST(VerifyCovers, ObjectsToMissingLineCrossingsBesideASharedCover) {
  // Only curves that the shared cover leaves near are looked for on a line: all that are there.
  const Encasement e = four_curves();
  for (std::size_t k = 0; k < e.line_crossings.size(); ++k)
    expect_objection(
        e, [&](auto& m) { m.line_crossings[k].line = (m.line_crossings[k].line + 1) % 4; },
        "is not proved absent");
}

TEST(VerifyCovers, ObjectsToRandomMutationsOfASharedCover) {
  const Encasement e = four_curves();
  mutations::Mutator mutator(3);
  for (int round = 0; round < 1000; ++round) {
    Encasement mutant = e;
    const mutations::Mutation mutation =
        round % 2 == 0 ? mutator.change_shared_cover(mutant) : mutator.apply(mutant);
    const Verification verification = verify(mutant);
    EXPECT_TRUE(mutation.may_hold || !verification.ok()) << mutation.what;
  }
}

TEST(VerifyCovers, ObjectsToWrongCriticalRegions) {
  const Encasement e = circle_and_line();
  ASSERT_EQ(e.critical_regions.size(), 1u);
  expect_objection(
      e, [](auto& m) { m.critical_regions[0].sign = Sign::Positive; }, "sign");
  expect_objection(
      e, [](auto& m) { m.critical_regions[0].sign = Sign::Zero; }, "sign");
  expect_objection(
      e, [](auto& m) { m.critical_regions[0].curve = 1; }, "another curve");
  expect_objection(
      e, [](auto& m) { m.critical_regions[0].boxes.pop_back(); },
      "is not a box of its critical region");
  expect_objection(
      e,
      [](auto& m) {
        m.critical_regions[0].boxes.push_back({{.9, .9}, {1, 1}});
      },
      "sign");
  expect_objection(
      e,
      [](auto& m) {
        m.critical_regions[0].boxes.push_back({{.6, .1}, {.61, .11}});
      },
      "do not hang together");
}

}  // namespace
}  // namespace encase
