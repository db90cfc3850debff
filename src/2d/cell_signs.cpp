// SPDX-License-Identifier: MIT
#include "2d/cell_signs.hpp"

#include <algorithm>

#include "2d/cell_complex.hpp"

namespace encase {

CellSigns::CellSigns(const Encasement& encasement) : encasement_(encasement) {
  for (const Curve& curve : encasement.curves) polynomials_.emplace_back(curve.function);
}

std::vector<int> CellSigns::of(const Cell& cell) {
  std::vector<int> signs(polynomials_.size(), 0);
  if (!is_certified(cell)) return signs;
  const RationalPoint<2> vertex = exact_point(encasement_.lines, cell.vertices.front());
  for (std::size_t k = 0; k < signs.size(); ++k) {
    const bool present = std::any_of(cell.word.begin(), cell.word.end(), [&](int crossing) {
      return encasement_.line_crossings[crossing].curve == static_cast<int>(k);
    });
    if (!present) signs[k] = static_cast<int>(polynomials_[k].sign_at(vertex, kernel_));
  }
  return signs;
}

}  // namespace encase
