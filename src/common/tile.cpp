// SPDX-License-Identifier: MIT
#include "common/tile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/patch.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/tile.cpp"
#include <hwy/foreach_target.h>

#include "common/simd_rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

/// row += x * next, of numbers high + low: the rounding errors of the high parts go to the low
/// ones.
HWY_INLINE void add_multiple(double* high, double* low, double x, const double* next_high,
                             const double* next_low, int count) {
  const Row factor = Row::all(x);
  for (int j = 0; j < count; j += 8) {
    Row product_error, sum_error;
    const Row product = exact_product(Row::load(next_high + j), factor, &product_error);
    const Row sum = exact_sum(Row::load(high + j), product, &sum_error);
    const Row rest = Row::load(low + j) + factor * Row::load(next_low + j);
    sum.store(high + j);
    (rest + (product_error + sum_error)).store(low + j);
  }
}

/// row *= factor + factor_rest, likewise.
HWY_INLINE void multiply(double* high, double* low, double factor, double factor_rest, int count) {
  const Row f = Row::all(factor), g = Row::all(factor_rest);
  for (int j = 0; j < count; j += 8) {
    Row error;
    const Row a = Row::load(high + j), b = Row::load(low + j);
    const Row product = exact_product(a, f, &error);
    product.store(high + j);
    (error + (a * g + b * f)).store(low + j);
  }
}

/// Row i, of numbers high + low, holds the coefficients of s^i: p(s) -> p(origin + half s). Rows
/// are `stride` apart, and row i has degree + 1 - i entries (the rest are zero).
void shift_and_scale(double* high, double* low, int degree, int stride, double origin,
                     double half) {
  if (origin != 0) {
    // Synthetic division, by the antidiagonals of its table: the steps of one do not wait for each
    // other.
    for (int level = 0; level < degree; ++level)
      for (int i = 0; i <= level; ++i) {
        const int k = degree - 1 - level + i;
        const std::size_t row = static_cast<std::size_t>(k) * stride, next = row + stride;
        add_multiple(high + row, low + row, origin, high + next, low + next, degree - k);
      }
  }
  double power = 1, power_rest = 0;
  for (int i = 1; i <= degree; ++i) {
    // power *= half
    const double product = power * half;
    power_rest = std::fma(power, half, -product) + power_rest * half;
    power = product;
    const std::size_t row = static_cast<std::size_t>(i) * stride;
    multiply(high + row, low + row, power, power_rest, degree + 1 - i);
  }
}

/// The value of sum a[i][j] s^i t^j and its derivatives.
void evaluate(const double* a, int degree, double s, double t, double* result) {
  // In each lane j: sum over i of a[i][j] s^i, and its derivative; then the sum over the lanes.
  const Row at = Row::all(s);
  double value = 0, slope_s = 0, slope_t = 0;
  for (int part = degree / 8; part >= 0; --part) {
    const double* from = a + 8 * part;
    Row v = Row::all(0), d = Row::all(0);
    for (int i = degree - 8 * part; i >= 0; --i) {
      d = d * at + v;
      v = v * at + Row::load(from + i * Tile::kRow);
    }
    HWY_ALIGN double x[8], y[8];
    v.store(x);
    d.store(y);
    for (int j = std::min(7, degree - 8 * part); j >= 0; --j) {
      slope_t = slope_t * t + value;
      value = value * t + x[j];
      slope_s = slope_s * t + y[j];
    }
  }
  result[0] = value;
  result[1] = slope_s;
  result[2] = slope_t;
}

/// A vector of numbers high + low.
struct Pair {
  Row high, low;
};
HWY_INLINE Pair multiply(const Pair& a, const Pair& b) {
  Pair r;
  r.high = exact_product(a.high, b.high, &r.low);
  r.low = r.low + (a.high * b.low + a.low * b.high);
  return r;
}
HWY_INLINE Pair add(const Pair& a, const Pair& b) {
  Pair r;
  r.high = exact_sum(a.high, b.high, &r.low);
  r.low = r.low + (a.low + b.low);
  return r;
}

/// The powers y^0 to y^7 in the lanes, and y^8.
HWY_INLINE Pair powers(double y, Pair* eighth) {
  const Row zero = Row::all(0), one = Row::all(1);
  Pair power{Row::all(y), zero}, lanes{one, zero};
  HWY_ALIGN static constexpr double kBits[3][8] = {
      {0, 1, 0, 1, 0, 1, 0, 1}, {0, 0, 1, 1, 0, 0, 1, 1}, {0, 0, 0, 0, 1, 1, 1, 1}};
  for (const auto& bits : kBits) {
    // Lanes with the bit are multiplied, the others by one.
    const Row bit = Row::load(bits), rest = one - bit;
    lanes = multiply(lanes, Pair{power.high * bit + rest, power.low * bit});
    power = multiply(power, power);
  }
  *eighth = power;
  return lanes;
}

/// The sum of coefficients times x^i y^j: Horner's rule over the rows, all powers of y at once.
double precise_value(const double* high, const double* low, int degree, int stride, double x,
                     double y) {
  const Row zero = Row::all(0);
  const Pair at{Row::all(x), zero};
  Pair eighth, of_y = powers(y, &eighth), total{zero, zero};
  for (int j = 0; j <= degree; j += 8) {
    Pair sum{zero, zero};
    for (int i = degree - j; i >= 0; --i) {
      const std::size_t from = static_cast<std::size_t>(i) * stride + j;
      sum = add(multiply(sum, at), Pair{Row::load(high + from), Row::load(low + from)});
    }
    total = add(total, multiply(sum, of_y));
    of_y = multiply(of_y, eighth);
  }
  // Pairwise over the lanes.
  HWY_ALIGN double h[8], l[8];
  total.high.store(h);
  total.low.store(l);
  for (int width = 4; width >= 1; width /= 2)
    for (int k = 0; k < width; ++k) {
      const double a = h[k], b = h[k + width], s = a + b, b1 = s - a;
      l[k] = (l[k] + l[k + width]) + ((a - (s - b1)) + (b - b1));
      h[k] = s;
    }
  return h[0] + l[0];
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(shift_and_scale);
HWY_EXPORT(evaluate);
HWY_EXPORT(precise_value);

constexpr double kUp = 1 + 0x1p-40;  // outweighs the roundings of the sums it multiplies
constexpr int kMaxDepth = 8;         // of the quadtree of tiles

}  // namespace

/// Numbers high + low, aligned: rows of coefficients, `stride` apart.
struct TiledPolynomial::Coefficients {
  struct alignas(64) Eight {
    double x[8];
  };
  std::vector<Eight> memory;
  int stride = 0;

  void resize(int degree) {
    stride = (degree + 8) / 8 * 8;
    memory.resize(2 * static_cast<std::size_t>(degree + 1) * stride / 8);
  }
  double* high() { return memory.data()->x; }
  double* low() { return high() + 4 * memory.size(); }

  /// Row i becomes column i of `from`; only what the total degree leaves.
  void transpose(Coefficients& from, int degree) {
    resize(degree);
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; i + j <= degree; ++j) {
        high()[j * stride + i] = from.high()[i * stride + j];
        low()[j * stride + i] = from.low()[i * stride + j];
      }
  }
};

namespace {

/// (1 + x + y)^n, rounded up.
double growth(const Point<2>& reach, int n) {
  double result = 1, power = (1 + reach[0] + reach[1]) * kUp;
  for (int rest = n; rest > 0; rest /= 2, power *= power * kUp)
    if (rest % 2) result *= power * kUp;
  return result;
}

Point<2> reach_of(const Tile& tile) {
  Point<2> reach;
  for (int i = 0; i < 2; ++i)
    reach[i] = (std::fabs(tile.center[i]) + tile.half[i] * Tile::kReach) * kUp;
  return reach;
}

/// Nothing is known of a tile where numbers overflow.
void claim_nothing(Tile* tile) {
  for (auto& row : tile->a) row.fill(0.0);
  tile->sum = tile->slope = tile->bend = 0;
  tile->error = tile->slope_error = tile->bend_error = tile->value_error =
      std::numeric_limits<double>::infinity();
}

/// At least kReach^k, for k up to 60.
double reach_power(int k) { return (1 + 0x1.1p-10 * k); }

/// The sums of a tile whose coefficients are known, each to a relative `relative`; what the terms
/// of higher degree (rows of `degree` + 1 coefficients, the exponents swapped) add to the errors is
/// in tile->error and so on already.
void add_up(Tile* tile, double relative) {
  double sum = 0, slope = 0, bend = 0;
  for (int i = 0; i <= tile->degree; ++i)
    for (int j = 0; i + j <= tile->degree; ++j) {
      const int k = i + j;
      const double x = std::fabs(tile->a[i][j]) * reach_power(k);
      sum += x;
      slope += k * x;
      bend += k * k * x;
    }
  tile->sum = sum * kUp;
  tile->slope = slope * kUp;
  tile->bend = bend * kUp;
  tile->error = (tile->error + relative * tile->sum) * kUp;
  tile->slope_error = (tile->slope_error + relative * tile->slope) * kUp;
  tile->bend_error = (tile->bend_error + relative * tile->bend) * kUp;
  if (!(tile->sum < 0x1p900) || !std::isfinite(tile->error + tile->bend_error)) claim_nothing(tile);
}

/// Sums of |a[i][j]| over one index, and Taylor's shift of them to 1: for every exponent from 8 on
/// a bound on the terms that have it, around any point of the rectangle.
void add_high_terms(Tile* tile) {
  const int n = tile->degree;
  auto& high = tile->high_terms;
  high.fill(0.0);
  for (int i = 8; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
      high[i - 8] += std::fabs(tile->a[i][j]) + std::fabs(tile->a[j][i]);
  for (int i = 0; i < n; ++i)
    for (int k = n - 1; k >= std::max(i, 8); --k) high[k - 8] += high[k - 7];
  for (double& x : high) x *= 1.0001;  // outweighs the roundings
}

/// Takes the Taylor coefficients of a polynomial of degree n, the errors of which add up to at most
/// `error`, and each of which is good to a relative `relative`. Returns the sum of those that the
/// tile has no room for.
template <class Coefficient>
double fill(Tile* tile, int n, Coefficient coefficient, double error, double relative) {
  tile->degree = std::min(n, Tile::kMaxDegree);
  for (auto& row : tile->a) row.fill(0.0);
  double dropped = 0, slope = 0, bend = 0;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      const double x = coefficient(i, j);
      const int k = i + j;
      if (k <= Tile::kMaxDegree) {
        tile->a[i][j] = x;
      } else {
        const double size = std::fabs(x) * reach_power(k);
        dropped += size;
        slope += k * size;
        bend += k * k * size;
      }
    }
  tile->error = dropped * kUp + error;
  tile->slope_error = slope * kUp + n * error;
  tile->bend_error = bend * kUp + n * n * error;
  add_up(tile, relative);
  add_high_terms(tile);
  return dropped;
}

void place(Tile* tile, const Box<2>& box) {
  for (int i = 0; i < 2; ++i) {
    const Centered chart = centered(box.lo[i], box.hi[i]);
    tile->center[i] = chart.center;
    tile->half[i] = chart.half;
  }
}

/// Whether the tile serves for the whole rectangle: its terms of higher degree do not matter, and
/// patches some times smaller than the rectangle keep close to it.
bool serves(const Tile& tile, double dropped) {
  double size = 0;
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; i + j <= 2; ++j) size += std::fabs(tile.a[i][j]);
  return dropped <= 0x1p-14 * size && interpolation_loss(tile, 0.25).value <= 0x1p-5 * size;
}

}  // namespace

/// What the expansions of one polynomial share: its coefficients, and those shifted in x for the
/// tiles that stand in one column.
struct TiledPolynomial::Workspace {
  struct Column {
    double center, half;
    Coefficients shifted;  // row j: the coefficients of y^j
  };
  Coefficients original;  // row i: the coefficients of x^i
  Coefficients scratch;
  std::vector<Column> columns;
  Column single;
};

TiledPolynomial::TiledPolynomial(const FilteredPolynomial<2>& f, const Box<2>& box, Kernel& kernel)
    : f_(&f), kernel_(&kernel), root_(box), workspace_(std::make_unique<Workspace>()) {
  const int n = f.degree();
  workspace_->original.resize(n);
  const int stride = workspace_->original.stride;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      const std::size_t from = static_cast<std::size_t>(i) * (n + 1) + j;
      workspace_->original.high()[i * stride + j] = f.coefficients()[from];
      workspace_->original.low()[i * stride + j] = f.low_coefficients()[from];
    }
  nodes_.resize(1);
  nodes_[0].box = box;
}

TiledPolynomial::TiledPolynomial(TiledPolynomial&&) noexcept = default;
TiledPolynomial::~TiledPolynomial() = default;

const Tile& TiledPolynomial::at(const Point<2>& point) {
  int node = 0;
  while (true) {
    const Point<2> center = nodes_[node].box.center();
    if (nodes_[node].tile) return *nodes_[node].tile;
    if (nodes_[node].first_child < 0) {
      auto tile = std::make_unique<Tile>();
      const double dropped = make(nodes_[node].box, kernel_->start_bits, true, tile.get());
      if (serves(*tile, dropped) || nodes_[node].depth == kMaxDepth) {
        nodes_[node].tile = std::move(tile);
        continue;
      }
      const int first = static_cast<int>(nodes_.size());
      nodes_[node].first_child = first;
      nodes_.resize(nodes_.size() + 4);
      for (int k = 0; k < 4; ++k) {
        Node& child = nodes_[first + k];
        child.depth = nodes_[node].depth + 1;
        child.box = nodes_[node].box;
        for (int i = 0; i < 2; ++i) ((k >> i) % 2 ? child.box.lo : child.box.hi)[i] = center[i];
      }
    }
    node = nodes_[node].first_child + (point[0] > center[0]) + 2 * (point[1] > center[1]);
  }
}

void TiledPolynomial::expand(const Box<2>& box, int bits, Tile* tile) {
  make(box, bits, false, tile);
}

double TiledPolynomial::make(const Box<2>& box, int bits, bool in_tree, Tile* tile) {
  const int n = f_->degree();
  place(tile, box);
  tile->bits = bits;
  if (bits > Kernel::kDoubleBits) {
    const FilteredPolynomial<2>::Taylor taylor = f_->taylor(box, bits, *kernel_);
    tile->value_error = precise_error(reach_of(*tile));
    return fill(
        tile, n,
        [&](int i, int j) {
          return taylor.coefficients[static_cast<std::size_t>(i) * (n + 1) + j];
        },
        taylor.error * reach_power(n), 0);
  }
  ++kernel_->expansions;
  Workspace& w = *workspace_;
  w.scratch = shifted_in_x(tile->center[0], tile->half[0], in_tree);
  HWY_DYNAMIC_DISPATCH(shift_and_scale)
  (w.scratch.high(), w.scratch.low(), n, w.scratch.stride, tile->center[1], tile->half[1]);
  const int stride = w.scratch.stride;
  const double *high = w.scratch.high(), *low = w.scratch.low();
  // What the shifts lose: docs/error-bounds.md.
  const Point<2> reach = reach_of(*tile);
  const double shift = precise_error(reach);
  tile->value_error = shift;
  return fill(
      tile, n, [&](int i, int j) { return high[j * stride + i] + low[j * stride + i]; }, shift,
      0x1.01p-53);
}

TiledPolynomial::Coefficients& TiledPolynomial::shifted_in_x(double center, double half,
                                                             bool in_tree) {
  Workspace& w = *workspace_;
  // Tiles of the tree stand in columns.
  Workspace::Column* column = &w.single;
  if (in_tree) {
    for (Workspace::Column& known : w.columns)
      if (known.center == center && known.half == half) return known.shifted;
    column = &w.columns.emplace_back();
  }
  column->center = center;
  column->half = half;
  const int n = f_->degree();
  w.scratch = w.original;
  HWY_DYNAMIC_DISPATCH(shift_and_scale)
  (w.scratch.high(), w.scratch.low(), n, w.scratch.stride, center, half);
  column->shifted.transpose(w.scratch, n);
  return column->shifted;
}

double TiledPolynomial::precise_error(const Point<2>& reach) const {
  return 0x1p-86 * f_->absolute(reach) + 0x1p-900 * growth(reach, f_->degree());
}

double TiledPolynomial::value(const Point<2>& point) const {
  Coefficients& c = workspace_->original;
  return HWY_DYNAMIC_DISPATCH(precise_value)(c.high(), c.low(), f_->degree(), c.stride, point[0],
                                             point[1]);
}

std::array<double, 3> value_and_gradient(const Tile& tile, const Point<2>& s) {
  std::array<double, 3> result;
  HWY_DYNAMIC_DISPATCH(evaluate)(tile.a[0].data(), tile.degree, s[0], s[1], result.data());
  return result;
}

}  // namespace encase
#endif
