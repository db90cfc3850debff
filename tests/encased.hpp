// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "encase/encasement.hpp"
#include "encase/verify.hpp"
#include "written.hpp"

/// Encasing curves written as texts, with every answer verified.
namespace encase::encased {

inline Region rectangle(const Rational& xmin, const Rational& xmax, const Rational& ymin,
                        const Rational& ymax) {
  return make_region(xmin, xmax, ymin, ymax).value();
}
inline Region square() { return rectangle(-1, 1, -1, 1); }

/// The curves that texts denote, named c0, c1, ...
inline std::vector<NamedCurve> curves(const std::vector<std::string>& texts) {
  std::vector<NamedCurve> result;
  for (const std::string& text : texts)
    result.push_back({"c" + std::to_string(result.size()), written::polynomial<2>(text)});
  return result;
}

inline void expect_verified(const Encasement& encasement) {
  const Verification verification = verify(encasement);
  for (const std::string& objection : verification.objections) ADD_FAILURE() << objection;
  EXPECT_GT(verification.claims, 0);
}

/// Encases and verifies.
inline Encasement run_curves(const std::vector<NamedCurve>& curves, const Region& region = square(),
                             const EncaseOptions& options = {}) {
  const Result<Encasement> result = encase(curves, region, options);
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return {};
  }
  expect_verified(result.value());
  return result.value();
}
inline Encasement run(const std::vector<std::string>& texts, const Region& region = square(),
                      const EncaseOptions& options = {}) {
  return run_curves(curves(texts), region, options);
}

inline int count(const Encasement& encasement, CellState state) {
  return static_cast<int>(std::count_if(encasement.cells.begin(), encasement.cells.end(),
                                        [&](const Cell& cell) { return cell.state == state; }));
}
inline int count(const Encasement& encasement, Location location) {
  return static_cast<int>(
      std::count_if(encasement.crossings.begin(), encasement.crossings.end(),
                    [&](const Crossing& crossing) { return crossing.location == location; }));
}
inline int inside(const Encasement& encasement) { return count(encasement, Location::Inside); }

/// Number of branches of a curve over all cells.
inline int branches(const Encasement& encasement, int curve) {
  int result = 0;
  for (const Cell& cell : encasement.cells)
    for (const Branch& branch : cell.branches) result += branch.curve == curve;
  return result;
}

/// Everything is proved: no cell but certified and relaxed ones, nothing left in the lists.
inline void expect_certified(const Encasement& encasement) {
  EXPECT_EQ(encasement.outcome, Outcome::Certified);
  EXPECT_TRUE(encasement.degenerate.empty());
  EXPECT_TRUE(encasement.undecided.empty());
  EXPECT_EQ(count(encasement, CellState::Degenerate), 0);
  EXPECT_EQ(count(encasement, CellState::Undecided), 0);
  EXPECT_FALSE(encasement.cells.empty());
}

/// Whether a crossing of the pair has this point in its box, grown by `slack`.
inline bool has_crossing_at(const Encasement& encasement, int first, int second, double x, double y,
                            double slack = 1e-12) {
  for (const Crossing& crossing : encasement.crossings) {
    if (crossing.curves != std::array<int, 2>{first, second}) continue;
    Box<2> box = crossing.box;
    for (int i = 0; i < 2; ++i) {
      box.lo[i] -= slack;
      box.hi[i] += slack;
    }
    if (box.contains(Point<2>{x, y})) return true;
  }
  return false;
}

}  // namespace encase::encased
