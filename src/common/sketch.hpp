// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/tile.hpp"
#include "encase/geometry.hpp"

/// What heuristics look at: values without error bounds, many at once, as cheaply as possible. All
/// instruction sets give the same bits.
namespace encase {

/// A polynomial in and near a box, about, of the lowest degree that does. Multiplied by a positive
/// constant.
struct Sketch {
  static constexpr int kLanes = 16;
  using Lanes = std::array<double, kLanes>;

  Sketch() {}  // leaves the coefficients to `make_sketch`

  Point<2> center{};
  Point<2> scale{};  ///< (point - center) * scale lies in [-1, 1] in either coordinate
  int degree = 0;
  /// Entry i of row j: the coefficient of s^i t^j.
  alignas(64) std::array<Lanes, Tile::kRow> a;
};

/// False if the polynomial is not known well enough there.
bool make_sketch(TiledFunction& f, const Box<2>& box, Sketch* sketch);

/// How often f changes sign between neighbours among 16 points spread over the inside of a segment:
/// nearly always the number of its roots there, and never more but for errors.
int count_sign_changes(const Sketch& f, const Point<2>& from, const Point<2>& to);

/// Values and gradients at 16 points, all in the box's coordinates.
struct alignas(64) SketchSlopes {
  Sketch::Lanes value, s, t;
};
/// `s` and `t` are aligned like the result.
void slopes(const Sketch& f, const Sketch::Lanes& s, const Sketch::Lanes& t, SketchSlopes* result);

/// Points of the plane in rows of eight, some of them in groups.
struct PointGroups {
  using Bits = std::uint64_t;

  std::vector<double> x, y;  ///< whole rows
  int groups = 0;
  /// Bit k of word w of group g, in member[w * groups + g]: point 64 w + k belongs to the group.
  std::vector<Bits> member;

  /// Room for so many points, in whole rows, all of which are at `point`; the groups are empty.
  void reset(int group_count, int point_count, const Point<2>& point);
  int size() const { return static_cast<int>(x.size()); }
  void place(int point, const Point<2>& at) {
    x[static_cast<std::size_t>(point)] = at[0];
    y[static_cast<std::size_t>(point)] = at[1];
  }
  void join(int group, int point) {
    member[static_cast<std::size_t>(point / 64 * groups + group)] |= Bits{1} << (point % 64);
  }
};

/// On which side of a line, about, points lie: the heights of the first `near` ones (whole rows),
/// the least absolute value of those, and how many of each group are on the positive side.
double divide(const PointGroups& points, const Line& line, int near, double* heights,
              int* positive);

}  // namespace encase
