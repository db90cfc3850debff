// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "encase/geometry.hpp"
#include "encase/polynomial.hpp"

namespace encase {

/// The parts of the cube [-half, half]^3 in which polynomials have constant signs, as the middles
/// of count^3 voxels show them: voxels that share a side and all signs lie in one part. Values come
/// from Horner's rule in doubles; nothing is proved.
class FloodFill {
 public:
  struct Part {
    std::vector<Sign> signs;
    RationalPoint<3> deepest;  ///< the middle of a voxel as far from other parts as any
    int depth = 0;             ///< how many voxels lie between that one and other parts, at most 2
  };

  FloodFill(const std::vector<Polynomial<3>>& polynomials, double half, int count)
      : n_(count), half_(half), part_of_(std::size_t(count) * count * count, -1) {
    sign(polynomials);
    for (std::size_t v = 0; v < part_of_.size(); ++v)
      if (part_of_[v] < 0) fill(v, polynomials.size());
    find_depths();
    count_contacts();
  }

  const std::vector<Part>& parts() const { return parts_; }
  /// For every two parts that border on each other across one surface, the sides of voxels between
  /// them.
  const std::map<std::pair<int, int>, int>& contacts() const { return contacts_; }

 private:
  double coordinate(int k) const { return half_ * (2.0 * k + 1 - n_) / n_; }
  std::size_t index(int i, int j, int k) const { return (std::size_t(i) * n_ + j) * n_ + k; }
  std::array<int, 3> place(std::size_t v) const {
    return {int(v / n_ / n_), int(v / n_ % n_), int(v % n_)};
  }

  /// Bit s of a voxel: surface s is positive.
  void sign(const std::vector<Polynomial<3>>& polynomials) {
    bits_.assign(part_of_.size(), 0);
    for (std::size_t s = 0; s < polynomials.size(); ++s) {
      const int degree = polynomials[s].degree();
      for (int i = 0; i < n_; ++i)
        for (int j = 0; j < n_; ++j) {
          // The coefficients in z at (x, y).
          std::vector<double> in_z(degree + 1, 0.0);
          for (const auto& [exponent, coefficient] : polynomials[s].terms()) {
            double term = coefficient.get_d();
            for (int e = 0; e < exponent[0]; ++e) term *= coordinate(i);
            for (int e = 0; e < exponent[1]; ++e) term *= coordinate(j);
            in_z[exponent[2]] += term;
          }
          for (int k = 0; k < n_; ++k) {
            double value = 0;
            for (int e = degree; e >= 0; --e) value = value * coordinate(k) + in_z[e];
            if (value > 0) bits_[index(i, j, k)] |= std::uint32_t(1) << s;
          }
        }
    }
  }

  template <class Visit>
  void for_neighbours(std::size_t v, Visit visit) const {
    const auto at = place(v);
    const std::size_t step[3] = {std::size_t(n_) * n_, std::size_t(n_), 1};
    for (int axis = 0; axis < 3; ++axis) {
      if (at[axis] > 0) visit(v - step[axis]);
      if (at[axis] + 1 < n_) visit(v + step[axis]);
    }
  }

  void fill(std::size_t from, std::size_t surfaces) {
    const int name = static_cast<int>(parts_.size());
    Part part;
    for (std::size_t s = 0; s < surfaces; ++s)
      part.signs.push_back(bits_[from] >> s & 1 ? Sign::Positive : Sign::Negative);
    parts_.push_back(std::move(part));
    std::vector<std::size_t> open{from};
    part_of_[from] = name;
    while (!open.empty()) {
      const std::size_t v = open.back();
      open.pop_back();
      for_neighbours(v, [&](std::size_t w) {
        if (part_of_[w] >= 0 || bits_[w] != bits_[v]) return;
        part_of_[w] = name;
        open.push_back(w);
      });
    }
  }

  void find_depths() {
    std::vector<std::uint8_t> depth(part_of_.size(), 0);
    for (int layer = 1; layer <= 2; ++layer) {
      std::vector<std::size_t> deeper;
      for (std::size_t v = 0; v < part_of_.size(); ++v) {
        bool inside = depth[v] + 1 == layer;
        for_neighbours(v, [&](std::size_t w) {
          inside = inside && part_of_[w] == part_of_[v] && depth[w] + 1 >= layer;
        });
        if (inside) deeper.push_back(v);
      }
      for (const std::size_t v : deeper) depth[v] = static_cast<std::uint8_t>(layer);
    }
    std::vector<bool> placed(parts_.size(), false);
    for (std::size_t v = 0; v < part_of_.size(); ++v) {
      Part& part = parts_[part_of_[v]];
      if (placed[part_of_[v]] && depth[v] <= part.depth) continue;
      placed[part_of_[v]] = true;
      part.depth = depth[v];
      const auto at = place(v);
      part.deepest = {Rational(coordinate(at[0])), Rational(coordinate(at[1])),
                      Rational(coordinate(at[2]))};
    }
  }

  void count_contacts() {
    for (std::size_t v = 0; v < part_of_.size(); ++v)
      for_neighbours(v, [&](std::size_t w) {
        const std::uint32_t change = bits_[v] ^ bits_[w];
        if (v < w && change != 0 && (change & (change - 1)) == 0)
          ++contacts_[std::minmax(part_of_[v], part_of_[w])];
      });
  }

  int n_;
  double half_;
  std::vector<std::uint32_t> bits_;
  std::vector<int> part_of_;
  std::vector<Part> parts_;
  std::map<std::pair<int, int>, int> contacts_;
};

}  // namespace encase
