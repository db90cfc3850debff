// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "2d/partition.hpp"
#include "encase/encasement.hpp"

namespace encase {

/// An encasement of some of the curves, made earlier: what it proves about crossings and critical
/// regions still holds when curves join, in the same polygon, and its lines are good guesses for
/// the first cuts. One without curves knows nothing.
class EarlierEncasement {
 public:
  /// Knows nothing.
  EarlierEncasement() = default;
  /// `from` must outlive this.
  explicit EarlierEncasement(const Encasement& from) : from_(&from) {}

  /// To be told before the questions below: which curves are encased now, and in which polygon.
  void match(const std::vector<Curve>& curves, const Region& region_used);

  /// The cover of a pair, with its crossings appended to `crossings`, if there is one that leaves
  /// nothing unresolved and covers `box`.
  bool append_crossings(const std::array<int, 2>& curves, const Box<2>& box,
                        std::vector<Crossing>* crossings, std::vector<CrossingCover>* covers) const;
  /// Likewise of a curve, with its critical regions.
  bool append_critical_regions(int curve, const Box<2>& box, std::vector<CriticalRegion>* regions,
                               std::vector<CriticalCover>* covers) const;

  /// Where cells begin in the history: its root, or -1 if there is none.
  int first_cut() const { return from_ && !from_->history.empty() ? 0 : -1; }
  /// The line of a cut, and the cuts of the negative and the positive part (-1 for cells).
  const Line& line(int cut) const { return from_->lines[from_->history[cut].line]; }
  std::pair<int, int> next_cuts(int cut) const {
    const Split& split = from_->history[cut];
    return {std::max(split.negative, -1), std::max(split.positive, -1)};
  }

 private:
  const Encasement* from_ = nullptr;
  std::map<std::array<int, 2>, int> crossing_covers_;  // of the pairs that have matched
  std::map<int, int> critical_covers_;
};

}  // namespace encase
