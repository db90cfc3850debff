// SPDX-License-Identifier: MIT
#include "branch_census.hpp"

#include <numeric>
#include <vector>

namespace encase::benchmark {
namespace {

/// The connected pieces of the curves: line crossings joined by the cells' branches.
class Pieces {
 public:
  explicit Pieces(std::size_t line_crossings) : parent_(line_crossings) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int find(int k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void join(int a, int b) { parent_[find(a)] = find(b); }

 private:
  std::vector<int> parent_;
};

}  // namespace

BranchCensus branch_census(const Encasement& encasement) {
  const std::size_t n = encasement.line_crossings.size();
  Pieces pieces(n);
  std::vector<char> used(n), crossed(n), open(n);
  for (const Cell& cell : encasement.cells)
    for (const Branch& branch : cell.branches) {
      pieces.join(branch.from, branch.to);
      used[branch.from] = used[branch.to] = 1;
    }
  for (const Cell& cell : encasement.cells)
    for (const Branch& branch : cell.branches)
      if (cell.crossing >= 0) crossed[pieces.find(branch.from)] = 1;
  for (std::size_t k = 0; k < n; ++k)
    if (used[k] && encasement.line_crossings[k].line < encasement.region_used.side_count())
      open[pieces.find(static_cast<int>(k))] = 1;

  BranchCensus census;
  for (std::size_t k = 0; k < n; ++k) {
    if (!used[k] || pieces.find(static_cast<int>(k)) != static_cast<int>(k)) continue;
    ++(open[k] ? census.branches : census.ovals);
    if (!crossed[k]) ++(open[k] ? census.bare_branches : census.bare_ovals);
  }
  return census;
}

int least_cells(const Encasement& encasement) {
  const BranchCensus census = branch_census(encasement);
  int crossings = 0;
  for (const Cell& cell : encasement.cells) crossings += cell.crossing >= 0 ? 1 : 0;
  return crossings + census.bare_branches + 2 * census.bare_ovals;
}

}  // namespace encase::benchmark
