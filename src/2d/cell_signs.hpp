// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "common/filtered_function.hpp"
#include "common/kernel.hpp"
#include "encase/encasement.hpp"

namespace encase {

inline bool is_certified(const Cell& cell) {
  return cell.state == CellState::Certified || cell.state == CellState::Relaxed;
}

/// The sign that each curve's polynomial has on a whole cell.
class CellSigns {
 public:
  explicit CellSigns(const Encasement& encasement);

  /// -1 or 1 for each curve; 0 where the curve runs through the cell or the cell is not certified.
  /// Exact. Cost: the sign of every other curve at a corner of the cell.
  std::vector<int> of(const Cell& cell);

 private:
  const Encasement& encasement_;
  std::vector<FilteredFunction<2>> polynomials_;
  Kernel kernel_;
};

}  // namespace encase
