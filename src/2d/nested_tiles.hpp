// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <vector>

#include "common/filtered_function.hpp"
#include "common/kernel.hpp"
#include "common/tile.hpp"
#include "encase/geometry.hpp"

namespace encase {

/// About the smallest box around the part of a line between two parameters.
Box<2> box_on_line(const Line& line, double from, double to);

/// Polynomials with tiles that cover a box. Where the box is so wide that around its middle the
/// terms of high degree are large and cancel, tiles are blurred there by their own roundings; then
/// a polynomial has also tiles that cover smaller boxes around the middle, one in the other.
/// Several threads may ask for tiles.
class NestedTiles {
 public:
  /// `whole`: of the same polynomials, over one common box. Inner tiles are made if `nested`.
  NestedTiles(const std::vector<FilteredFunction<2>>& polynomials,
              std::vector<TiledFunction>& whole, const Point<2>& middle, bool nested,
              const Kernel& kernel);

  /// Adds what the making of inner tiles has counted since this was last called.
  void add_counts_to(Kernel* kernel);

  int size() const { return static_cast<int>(whole_.size()); }
  const Box<2>& box() const { return whole_.front().box(); }
  TiledFunction& whole(int polynomial) { return whole_[index(polynomial)]; }
  /// For what happens in a part of the box: the innermost tiles that cover it.
  TiledFunction& about(int polynomial, const Box<2>& part);
  /// For what happens on a part of a line.
  TiledFunction& about(int polynomial, const Line& line, double from, double to) {
    if (inner_[index(polynomial)].empty()) return whole(polynomial);
    return about(polynomial, box_on_line(line, from, to));
  }
  /// Whether there are none inside these.
  bool is_innermost(int polynomial, const TiledFunction& tiles) const {
    const std::vector<TiledFunction>& inner = inner_[index(polynomial)];
    return &tiles == (inner.empty() ? &whole_[index(polynomial)] : &inner.back());
  }
  /// Appends the parameters between `from` and `to` at which a line enters or leaves the boxes of
  /// inner tiles, in ascending order; between two of them it is in the same boxes, about.
  void append_stops(int polynomial, const Line& line, double from, double to,
                    std::vector<double>* stops) const;

 private:
  static std::size_t index(int k) { return static_cast<std::size_t>(k); }

  std::vector<TiledFunction>& whole_;
  std::deque<Kernel> kernels_;                     ///< of inner tiles, one each
  std::vector<std::vector<TiledFunction>> inner_;  ///< of every polynomial, outermost first
};

}  // namespace encase
