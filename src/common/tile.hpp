// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <vector>

#include "common/filtered_function.hpp"
#include "common/interval.hpp"
#include "common/kernel.hpp"
#include "common/paired_coefficients.hpp"
#include "encase/geometry.hpp"

namespace encase {

/// A function on a rectangle, as a polynomial in the rectangle's own coordinates: for |s_k| <=
/// kReach
///
///   f(center + half * s) = sum over i + j <= degree of a[i][j] s_0^i s_1^j  +  e(s).
///
/// What the search asks about f inside the rectangle it asks its tile: the coefficients are those
/// of an expansion around the centre, so that rounding errors are small beside the values there,
/// and there are few of them whatever f is. f is scaled as in FilteredFunction. Infinite errors: f
/// is not known to be analytic there, or its terms are too large.
struct Tile {
  static constexpr int kMaxDegree = 15;
  static constexpr int kRow = kMaxDegree + 1;
  static constexpr double kReach = 1 + 0x1p-10;
  /// At least kReach^k, for k up to 60.
  static constexpr double reach_power(int k) { return 1 + 0x1.1p-10 * k; }

  Point<2> center{};
  Point<2> half{};
  int degree = -1;  ///< -1: no tile
  int bits = 0;     ///< the precision of the arithmetic that it comes from
  alignas(64) std::array<std::array<double, kRow>, kRow> a;  ///< zero where i + j > degree
  double sum = 0;    ///< at least sum |a[i][j]| kReach^(i+j)
  double slope = 0;  ///< at least sum (i+j) |a[i][j]| kReach^(i+j): bounds |d/ds_k| of the sum
  double bend = 0;   ///< at least sum (i+j)^2 |a[i][j]| kReach^(i+j)
  double error = 0;  ///< |e| on the rectangle
  double slope_error = 0;  ///< |de/ds_k| on the rectangle
  double bend_error = 0;   ///< the second derivatives of e on the rectangle
  double value_error = 0;  ///< of TiledFunction::value on the rectangle
  bool undefined = false;  ///< f is proved to have no value anywhere on the rectangle
  /// For a guess at what nets of degree 7 in either variable lack on parts of the rectangle: entry
  /// k bounds the sums of the absolute values of the terms with s_0^(8+k), and with s_1^(8+k),
  /// around any point.
  std::array<double, kMaxDegree - 7> high_terms{};
};

/// Whether what is known of a tile holds on the box.
inline bool holds(const Tile& tile, const Box<2>& box) {
  constexpr double kReach = 1 + 0x1p-11;  // with room for roundings
  for (int i = 0; i < 2; ++i) {
    const double reach = kReach * tile.half[i];
    if (!(box.lo[i] - tile.center[i] >= -reach && box.hi[i] - tile.center[i] <= reach))
      return false;
  }
  return true;
}

/// Sums of the absolute values of coefficients, times kReach^degree: of those that a tile has and
/// that it has no room for.
struct CoefficientSums {
  double kept = 0, dropped = 0;
};
/// Makes a tile, but for its place and `value_error`, of Taylor coefficients of a polynomial of
/// degree n, the errors of which add up to at most `error`; each is rounded to a relative
/// `relative`. `turned`: their rows are those of the second variable. `paired`: they have low
/// parts.
CoefficientSums fill(Tile* tile, int n, const PairedCoefficients& coefficients, bool paired,
                     bool turned, double error, double relative);

/// Makes a tile that claims nothing.
void claim_nothing(Tile* tile);

/// A function with tiles that cover a box: one where its degree is low or the box is small, else a
/// quadtree of them, four of which are made when one is first asked for. May be asked by several
/// threads; a tile, and how often the kernel counts, does not depend on who asks when.
class TiledFunction {
 public:
  /// `kernel` is used while a tile is made; nothing else may use it at the same time.
  TiledFunction(const FilteredFunction<2>& f, const Box<2>& box, Kernel& kernel);
  TiledFunction(TiledFunction&&) noexcept;
  ~TiledFunction();

  const FilteredFunction<2>& polynomial() const { return *f_; }
  const Box<2>& box() const { return root_; }
  /// Where f is not proved to be analytic: none of a polynomial.
  const std::vector<Box<2>>& gaps() const { return gaps_; }
  /// Takes those of the same function in a larger box.
  void take_gaps_of(const TiledFunction& outer) { gaps_ = outer.gaps_; }
  /// Whether tiles lack nothing of f but roundings: it is a polynomial of a low degree.
  bool fits_tiles() const { return f_->is_polynomial() && f_->degree() <= Tile::kMaxDegree; }
  /// Whether a smaller tile, and not a more precise one, would be closer to f, as far as the size
  /// of the error tells: roundings are those of numbers of about the size 1, or of the values.
  bool wants_smaller(const Tile& tile) const {
    return !f_->is_polynomial() && !(tile.error < 0x1p-32 * (tile.sum < 1 ? 1 : tile.sum));
  }

  /// The tile whose rectangle holds the point (one of them on borders; the nearest for a point
  /// outside the box).
  const Tile& at(const Point<2>& point);

  /// A tile of its own around a box, from the coefficients in arithmetic of `bits` (53 stands for
  /// sums of two doubles). Its error is large where f needs more terms than a tile has.
  void expand(const Box<2>& box, int bits, Tile* tile);

  /// f at a point of the tile's rectangle, from the coefficients as sums of two doubles, or in
  /// MPFR: good to tile.value_error + 2^-52 |value|, or not a number.
  double value(const Point<2>& point) const;

  /// The same at up to eight points, which takes little more time than at one. The value at a point
  /// does not depend on the others.
  void values(const Point<2>* points, int count, double* result) const;

 private:
  struct Expansion;
  struct Node {
    Point<2> center;
    /// Four of them, once they are complete: bit 0 the upper half in x, bit 1 in y.
    std::atomic<Node*> children{nullptr};
    std::atomic<const Tile*> tile{nullptr};  ///< in place of children; complete too
    int depth = 0;
    Expansion* expansion = nullptr;  ///< where a tile would not serve, until there are children
    Box<2> box;
  };
  struct Workspace;
  void develop(Node& node);
  void halve(Expansion& parent, Node* children);
  void make_quarter(const Expansion& parent, Node& node, Expansion& e);
  bool serves(Node& node, Tile& tile, double dropped);
  double make(const Box<2>& box, int bits, bool in_tree, Tile* tile, Expansion* expansion);
  double make_from_model(int bits, Tile* tile);
  void expand_directly(const Tile& tile, bool in_tree, Expansion* expansion);
  /// What arithmetic with sums of two doubles loses within reach: docs/error-bounds.md.
  double precise_error(const Point<2>& reach) const;

  const FilteredFunction<2>* f_;
  double value_error_ = 0;  ///< of what is no polynomial
  std::vector<Box<2>> gaps_;
  Kernel* kernel_;
  Box<2> root_;
  std::unique_ptr<Workspace> workspace_;
};

/// The value of a tile's polynomial and its partial derivatives at s, computed in doubles; for
/// heuristics and Newton steps.
std::array<double, 3> value_and_gradient(const Tile& tile, const Point<2>& s);

/// The same of two tiles, each at a point of its own.
std::array<std::array<double, 3>, 2> values_and_gradients(const std::array<const Tile*, 2>& tiles,
                                                          const std::array<Point<2>, 2>& s);

/// The same at up to eight points s of one tile.
void values_and_gradients(const Tile& tile, const Point<2>* s, int count, double* value, double* ds,
                          double* dt);

}  // namespace encase
