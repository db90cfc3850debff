// SPDX-License-Identifier: MIT
#include "common/isolate_roots.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace encase {
namespace {

/// What the search asks of a contraction: a checker that recomputes it on a somewhat different box
/// has room, and radii are at most some times the residual.
constexpr double kQuality = 0.7;

double ulp(double x) {
  x = std::fabs(x);
  return std::nextafter(x, HUGE_VAL) - x;
}

/// Solves J(x) d = F for the approximate Jacobian at x; false where it is singular.
template <int D>
bool newton_step(const System<D>& system, const Point<D>& x, const std::array<double, D>& value,
                 Point<D>* d) {
  // Gaussian elimination with partial pivoting on [J | F].
  std::array<std::array<double, D + 1>, D> m;
  for (int i = 0; i < D; ++i) {
    const Point<D> g = system[i]->gradient(x);
    for (int j = 0; j < D; ++j) m[i][j] = g[j];
    m[i][D] = value[i];
  }
  for (int c = 0; c < D; ++c) {
    int pivot = c;
    for (int r = c + 1; r < D; ++r)
      if (std::fabs(m[r][c]) > std::fabs(m[pivot][c])) pivot = r;
    std::swap(m[c], m[pivot]);
    if (m[c][c] == 0) return false;
    for (int r = 0; r < D; ++r) {
      if (r == c) continue;
      const double factor = m[r][c] / m[c][c];
      for (int k = c; k <= D; ++k) m[r][k] -= factor * m[c][k];
    }
  }
  for (int i = 0; i < D; ++i) (*d)[i] = m[i][D] / m[i][i];
  return true;
}

/// A zero near x: a point that Newton's iteration on doubles settles on, within `reach` of x.
template <int D>
std::optional<Point<D>> newton(const System<D>& system, Point<D> x, double reach) {
  const Point<D> start = x;
  double last_step = HUGE_VAL;
  for (int step = 0; step < 12; ++step) {
    std::array<double, D> value;
    for (int i = 0; i < D; ++i) value[i] = system[i]->approximate(x);
    Point<D> d;
    if (!newton_step<D>(system, x, value, &d)) return std::nullopt;
    double size = 0;
    for (int i = 0; i < D; ++i) {
      x[i] -= d[i];
      size = std::max(size, std::fabs(d[i]));
      if (!(std::fabs(x[i] - start[i]) <= reach)) return std::nullopt;
    }
    if (size == 0 || (step > 2 && size >= 0.5 * last_step)) break;
    last_step = size;
  }
  return x;
}

/// The box around one zero near x, by Krawczyk's test within `around`, whose contraction is known.
///
/// With R = radius in local coordinates, |Y F(x)| + E R < R in every coordinate proves a zero in
/// x +- R, if x +- R lies in `around`: the Krawczyk operator maps that box into its interior.
template <int D>
std::optional<Box<D>> enclose_root(const System<D>& system, const Box<D>& around,
                                   const Contraction<D>& c, Point<D> x, Kernel& kernel) {
  constexpr double kUp = 1 + 0x1p-40;
  std::optional<Box<D>> best;
  double best_width = HUGE_VAL;
  // The half widths of the net that the contraction comes from, or a little more.
  Point<D> half;
  for (int k = 0; k < D; ++k) half[k] = centered(around.lo[k], around.hi[k]).half;
  for (int bits = kernel.start_bits; bits > 0; bits = kernel.next(bits)) {
    for (int step = 0; step < 6; ++step) {
      std::array<double, D> correction{}, residual{}, value{};
      for (int i = 0; i < D; ++i) {
        const auto v = system[i]->evaluate(x, bits);
        value[i] = v.value;
        for (int k = 0; k < D; ++k) {
          const double y = c.preconditioner[k][i];
          correction[k] += y * v.value;
          residual[k] += std::fabs(y) * v.error + 0x1p-50 * std::fabs(y * v.value);
        }
      }
      for (int k = 0; k < D; ++k) residual[k] = (residual[k] + std::fabs(correction[k])) * kUp;
      // The smallest multiple t of the weights v that makes a Krawczyk radius (as E v < v), 16
      // times enlarged to leave a checker room, and no less than 16 ulps in any coordinate.
      double t = 0;
      for (int k = 0; k < D; ++k) {
        double image = 0;
        for (int j = 0; j < D; ++j) image += c.bound[k][j] * c.weights[j];
        t = std::max(t, 16 * residual[k] / (c.weights[k] - image * kUp));
        const double size = std::max(std::fabs(x[k]), 0x1p-20 * half[k]);
        t = std::max(t, 16 * ulp(size) / (c.weights[k] * half[k]));
      }
      Box<D> box;
      std::array<double, D> radius;
      bool inside = std::isfinite(t);
      double relative_width = 0;
      for (int k = 0; k < D && inside; ++k) {
        // A multiple of some ulps, so that x is exactly the centre.
        const double wanted = t * c.weights[k] * half[k] * kUp;
        const double unit = 4 * ulp(std::fabs(x[k]) + wanted);
        const double r = std::ceil(wanted / unit) * unit;
        box.lo[k] = x[k] - r;
        box.hi[k] = x[k] + r;
        inside = around.lo[k] < box.lo[k] && box.hi[k] < around.hi[k];
        // What is proved holds for a box inside the rounded one.
        radius[k] = (r - 2 * ulp(x[k])) / half[k] * (1 - 0x1p-40);
        relative_width = std::max(relative_width, r / half[k]);
      }
      if (inside) {
        bool proved = true;
        for (int k = 0; k < D; ++k) {
          double image = residual[k];
          for (int j = 0; j < D; ++j) image += c.bound[k][j] * radius[j];
          proved = proved && image * kUp < radius[k];
        }
        if (proved && relative_width < best_width) {
          best = box;
          best_width = relative_width;
        }
      }
      // A Newton step, as long as it moves the point.
      Point<D> d;
      if (!newton_step<D>(system, x, value, &d)) break;
      bool moved = false;
      for (int k = 0; k < D; ++k) {
        const double next = x[k] - d[k];
        moved = moved || std::fabs(next - x[k]) > 2 * ulp(x[k]);
        x[k] = next;
      }
      if (!moved || bits <= Kernel::kDoubleBits) break;
      for (int k = 0; k < D; ++k)
        if (!(around.lo[k] < x[k] && x[k] < around.hi[k])) return best;
    }
    if (best) {
      double wide = 0;
      for (int k = 0; k < D; ++k) wide = std::max(wide, best->width(k) / (64 * ulp(best->hi[k])));
      if (wide <= 1) break;
    }
    if (bits >= 4 * Kernel::kDoubleBits) break;
  }
  return best;
}

}  // namespace

template <int D>
RootIsolation<D> isolate_roots(const System<D>& system, const Box<D>& box,
                               const std::vector<Hyperplane<D>>& half_spaces,
                               const SubdivisionLimits& limits, Kernel& kernel) {
  RootIsolation<D> result;
  result.root_box = subdivision_root(box);
  int degree = 0;
  for (const auto* f : system) degree = std::max(degree, f->degree());
  SystemNets<D> around_nets;

  // The token of the root that a box with a contraction can contain, if there is one near.
  const auto root_near = [&](const Box<D>& leaf, const Contraction<D>& c) -> std::optional<int> {
    const auto x = newton<D>(system, leaf.center(), 2 * leaf.largest_width());
    if (!x) return std::nullopt;
    double offset = 0;
    for (int i = 0; i < D; ++i)
      offset = std::max(offset, std::fabs((*x)[i] - leaf.center()[i]) / (0.5 * leaf.width(i)));
    if (!(offset < 1.7)) return std::nullopt;
    Box<D> around = leaf;
    const Contraction<D>* valid = &c;
    std::optional<Contraction<D>> wider;
    if (offset > 0.95) {
      // The zero is at the border or outside: argue on a box that has it well inside.
      for (int i = 0; i < D; ++i) {
        around.lo[i] = leaf.lo[i] - 0.5 * leaf.width(i);
        around.hi[i] = leaf.hi[i] + 0.5 * leaf.width(i);
      }
      for (int i = 0; i < D; ++i)
        system[i]->expand(around, degree, kernel.start_bits, kernel, &around_nets[i]);
      wider = contraction<D>(around_nets, kQuality);
      if (!wider) return std::nullopt;
      valid = &*wider;
    }
    const auto root = enclose_root<D>(system, around, *valid, *x, kernel);
    if (!root) return std::nullopt;
    for (std::size_t k = 0; k < result.roots.size(); ++k) {
      if (!result.roots[k].meets(*root)) continue;
      // Both boxes hold a zero and `around` at most one: the same.
      if (around.contains(result.roots[k])) return static_cast<int>(k);
      return std::nullopt;
    }
    result.roots.push_back(*root);
    return static_cast<int>(result.roots.size()) - 1;
  };

  const auto visit = [&](const SystemNets<D>& nets, const Box<D>& leaf) {
    if (excluded<D>(nets)) return cover::kExcluded;
    if (const auto c = contraction<D>(nets, kQuality))
      if (const auto k = root_near(leaf, *c)) return *k;
    int axis = 0;
    double most = -1;
    for (int i = 0; i < D; ++i) {
      double change = 0;
      for (const auto& net : nets)
        change += variation(net, i) / (largest_coefficient(net) + 1e-300);
      if (change > most) {
        most = change;
        axis = i;
      }
    }
    return cover::kSplitX - axis;
  };

  const Subdivision<D> tree =
      subdivide<D, D>(system, result.root_box, half_spaces, limits, kernel, visit);
  result.boxes = tree.size();
  result.tokens = tree.tokens();
  result.unresolved = leaves(result.root_box, result.tokens, cover::kUnresolved);
  return result;
}

template RootIsolation<3> isolate_roots<3>(const System<3>&, const Box<3>&,
                                           const std::vector<Hyperplane<3>>&,
                                           const SubdivisionLimits&, Kernel&);

}  // namespace encase
