// SPDX-License-Identifier: MIT
#include "branch_census.hpp"

#include <vector>

#include "common/union_find.hpp"

namespace encase::benchmark {
BranchCensus branch_census(const Encasement& encasement) {
  const std::size_t n = encasement.line_crossings.size();
  UnionFind pieces(n);  // line crossings joined by the cells' branches
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
