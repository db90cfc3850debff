// SPDX-License-Identifier: MIT
#include "2d/least_cells.hpp"

#include "common/union_find.hpp"

namespace encase {

int least_cells(const std::vector<Cell>& cells, const std::vector<LineCrossing>& line_crossings,
                int sides) {
  const std::size_t n = line_crossings.size();
  UnionFind pieces(n);  // line crossings joined by the cells' branches
  std::vector<char> used(n), crossed(n), open(n);
  for (const Cell& cell : cells)
    for (const Branch& branch : cell.branches) {
      pieces.join(branch.from, branch.to);
      used[branch.from] = used[branch.to] = 1;
    }
  int least = 0;
  for (const Cell& cell : cells) {
    if (cell.crossing < 0) continue;
    ++least;
    for (const Branch& branch : cell.branches) crossed[pieces.find(branch.from)] = 1;
  }
  for (std::size_t k = 0; k < n; ++k)
    if (used[k] && line_crossings[k].line < sides) open[pieces.find(static_cast<int>(k))] = 1;
  for (std::size_t k = 0; k < n; ++k) {
    const bool stands = used[k] && pieces.find(static_cast<int>(k)) == static_cast<int>(k);
    if (stands && !crossed[k]) least += open[k] ? 1 : 2;
  }
  return least;
}

}  // namespace encase
