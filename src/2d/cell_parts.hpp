// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "encase/arrangement.hpp"

namespace encase {

/// The parts into which branches cut the cells of a certified encasement, and which of them belong
/// together. A line's crossings cut it into gaps: gap k lies behind k crossings in the order of the
/// line's parameter. Both sides of a gap, in whatever cells, belong to one face, since no curve
/// meets it.
struct CellParts {
  std::vector<std::vector<int>> on_line;  ///< the line crossings on each line, in order
  std::vector<Arrangement::Piece> pieces;
  std::vector<int> region_of_piece;             ///< a number for each connected union of parts
  std::vector<std::vector<int>> region_of_gap;  ///< by line and gap; -1 where no cell is
  int regions = 0;

  /// The piece that meets the cell's boundary behind entry `word` of its word.
  int piece(int cell, std::size_t word) const {
    return piece_behind[static_cast<std::size_t>(cell)][word];
  }
  std::vector<std::array<int, 4>> piece_behind;  ///< by cell; as many as its word has entries
};

/// Whether the four branch ends of a cell alternate between its two curves: they cross.
bool branches_cross(const Encasement& encasement, const Cell& cell);

/// Whether a line's crossing comes before a point of that line in the order of the parameter.
/// Exact; the point must not lie on the crossing's curve.
bool comes_before(const Encasement& encasement, const LineCrossing& crossing,
                  const RationalPoint<2>& point);

/// Internal if the cells, words, branches and the history do not fit together.
Result<CellParts> make_cell_parts(const Encasement& encasement);

}  // namespace encase
