// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "common/analytic_gaps.hpp"
#include "common/paired_coefficients.hpp"
#include "common/patch.hpp"
#include "common/tile.hpp"

namespace encase {
namespace {

constexpr double kUp = 1 + 0x1p-40;  // outweighs the roundings of the sums it multiplies
constexpr int kMaxDepth = 8;         // of the quadtree of tiles
// The error that a tile of the tree may have from halving, beside the sum of its coefficients.
constexpr double kHalvingError = 0x1p-57;
// The same where doubles serve, and whether they are tried: what a halving loses beside a tile's
// coefficients of low degree.
constexpr double kErrorInDoubles = 0x1p-36, kLossInDoubles = 0x1p-39;
constexpr double kRounded = 0x1.01p-53;  // relative: of a sum of two doubles that becomes one

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

void place(Tile* tile, const Box<2>& box) {
  for (int i = 0; i < 2; ++i) {
    const Centered chart = centered(box.lo[i], box.hi[i]);
    tile->center[i] = chart.center;
    tile->half[i] = chart.half;
  }
}

/// Whether the coordinates of a box are exactly those of a quarter of a rectangle, the upper one
/// along the axes that have their bit in `upper`.
bool is_quarter(const Box<2>& box, int upper, const Point<2>& center, const Point<2>& half) {
  for (int i = 0; i < 2; ++i) {
    const Centered chart = centered(box.lo[i], box.hi[i]);
    const double step = (upper >> i) % 2 ? chart.half : -chart.half;
    if (chart.half != 0.5 * half[i] || chart.center - center[i] != step ||
        !exact_difference(chart.center, center[i]))
      return false;
  }
  return true;
}

/// The part of s^k on [-1,1] that belongs to Chebyshev's polynomials of degrees above 7, at most:
/// s^k is 2^(1-k) times the sum of (k over i) T_(k-2i), over k - 2i > 0 (and half of that for 0).
double beyond_degree_7(int k) {
  double sum = 0, choose = 1;
  for (int i = 0; k - 2 * i > 7; ++i) {
    sum += choose;
    choose = choose * (k - i) / (i + 1);
  }
  return std::ldexp(sum, 1 - k);
}

/// The absolute values of the coefficients of degrees up to 2, in rows.
double size_of_low_terms(const double* rows, int stride) {
  double size = 0;
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; i + j <= 2; ++j) size += std::fabs(rows[i * stride + j]);
  return size;
}

/// Whether the tile serves for the whole rectangle: its terms of higher degree do not matter, and
/// patches some times smaller than the rectangle keep close to it. `tolerated`: beside the others.
bool tile_serves(const Tile& tile, double dropped, double tolerated) {
  if (tile.undefined) return true;
  static const auto weights = [] {
    std::array<double, 8> w;
    for (int k = 0; k < 8; ++k) w[k] = std::ldexp(beyond_degree_7(8 + k), -2 * (8 + k));
    return w;
  }();
  const double size = size_of_low_terms(tile.a[0].data(), Tile::kRow);
  double loss = 0;
  for (int k = 0; k < 8; ++k) loss += weights[k] * tile.high_terms[k];
  return dropped <= tolerated * size && loss <= 0x1p-5 * size;
}

/// The error that values of a function that is no polynomial may have: a small part of the greatest
/// of some values of an expression, or of 1 if there is none; of an inclusion function more than
/// the least errors there are at some points.
double tolerated_error(const FilteredFunction<2>& f, const Box<2>& box) {
  double size = 0, error = 0;
  for (const double u : {0.1, 0.5, 0.8})
    for (const double v : {0.2, 0.5, 0.9}) {
      const Point<2> point{box.lo[0] + u * box.width(0), box.lo[1] + v * box.width(1)};
      if (f.is_expression()) {
        const double value = f.approximate(point);
        if (std::isfinite(value)) size = std::max(size, std::fabs(value));
      } else if (const auto at = f.evaluate(point, Kernel::kDoubleBits); std::isfinite(at.error)) {
        error = std::max(error, at.error);
      }
    }
  return f.is_expression() ? 0x1p-100 * (size > 0 ? size : 1) : 16 * error;
}

}  // namespace

/// A polynomial in the coordinates of a node of the tree.
struct TiledFunction::Expansion {
  PairedCoefficients coefficients;
  Point<2> center{}, half{};
  int rows_axis = 0;        ///< 0: the coefficients of a power of x are a row; 1: of y
  bool halved = false;      ///< comes from halving: low is what high lacks
  bool in_doubles = false;  ///< there are no low parts
  double largest = 0;       ///< |high|, if `halved`
  double sum = 0;           ///< at least the coefficients' absolute values, times kReach^degree
  // What bounds their errors, added up likewise:
  Point<2> origin{};        ///< the centre of the expansion made directly that this comes from
  double halving_loss = 0;  ///< of the halvings since, and what underflows
};

/// What the expansions of one polynomial share, and the memory of its tiles. Whoever changes it, or
/// what a node has, holds the mutex.
struct TiledFunction::Workspace {
  struct Column {
    double center, half;
    PairedCoefficients shifted;  // row j: the coefficients of y^j
  };

  explicit Workspace(int n) : degree(n) {
    // (Zeros are needed in the first one only.)
    const std::size_t size = PairedCoefficients::size_for(n);
    EightDoubles* memory = allocate(3 * size);
    std::fill_n(memory->x, 8 * size, 0.0);
    for (PairedCoefficients* c : {&original, &scratch, &local.coefficients}) {
      *c = {memory, PairedCoefficients::stride_for(n)};
      memory += size;
    }
  }

  EightDoubles* allocate(std::size_t size) {
    blocks.push_back(std::make_unique_for_overwrite<EightDoubles[]>(size));
    return blocks.back().get();
  }

  /// Memory for coefficients that are to be written below the total degree only.
  PairedCoefficients coefficients() {
    const std::size_t size = PairedCoefficients::size_for(degree);
    EightDoubles* memory = allocate(size);
    std::fill_n(memory->x, 8 * size, 0.0);
    return {memory, PairedCoefficients::stride_for(degree)};
  }

  /// The next tile to be made; used when `keep` is called.
  Tile* tile() {
    if (used == room) {
      room = std::min(32, 4 * room);
      used = 0;
      chunks.push_back(std::make_unique_for_overwrite<Tile[]>(static_cast<std::size_t>(room)));
      next_tile = chunks.back().get();
    }
    return next_tile;
  }
  void keep() {
    ++used;
    ++next_tile;
  }

  Expansion* take() {
    if (idle.empty()) {
      expansions.push_back(std::make_unique<Expansion>(Expansion{coefficients()}));
      return expansions.back().get();
    }
    Expansion* last = idle.back();
    idle.pop_back();
    return last;
  }
  void give_back(Expansion* expansion) { idle.push_back(expansion); }

  void prepare_halving() {
    if (slices) return;
    slices = allocate(PairedCoefficients::size_for(degree) / 2 * 3)->x;
    for (PairedCoefficients& half : halves) half = coefficients();
  }

  Node* four_nodes() {
    nodes.push_back(std::make_unique<Node[]>(4));
    return nodes.back().get();
  }

  std::mutex mutex;
  Node root;
  std::vector<std::unique_ptr<Node[]>> nodes;

  int degree;
  std::vector<std::unique_ptr<EightDoubles[]>> blocks;
  PairedCoefficients original, scratch;  ///< row i: the coefficients of x^i
  Expansion local;                       ///< the last one that was made directly
  std::vector<Column> columns;           ///< shifted in x, for the tiles that stand in one column
  double* slices = nullptr;
  std::array<PairedCoefficients, 2> halves;
  std::vector<std::unique_ptr<Expansion>> expansions;  ///< of nodes without a tile or children
  std::vector<Expansion*> idle;

  Tile first_tile;
  std::vector<std::unique_ptr<Tile[]>> chunks;
  Tile* next_tile = &first_tile;
  int used = 0, room = 1;  ///< of the last chunk
};

TiledFunction::TiledFunction(const FilteredFunction<2>& f, const Box<2>& box, Kernel& kernel)
    : f_(&f),
      kernel_(&kernel),
      root_(box),
      workspace_(std::make_unique<Workspace>(f.is_polynomial() ? f.degree() : Tile::kMaxDegree)) {
  workspace_->root.box = box;
  workspace_->root.center = box.center();
  if (!f.is_polynomial()) {
    value_error_ = tolerated_error(f, box);
    gaps_ = find_gaps(f, box, kernel);
    return;
  }
  const std::size_t n = static_cast<std::size_t>(f.degree());
  PairedCoefficients& original = workspace_->original;
  const std::size_t stride = static_cast<std::size_t>(original.stride);
  const double* high = f.polynomial().coefficients().data();
  const double* low = f.polynomial().low_coefficients().data();
  for (std::size_t i = 0; i <= n; ++i) {
    std::copy_n(high + i * (n + 1), n + 1 - i, original.high() + i * stride);
    std::copy_n(low + i * (n + 1), n + 1 - i, original.low() + i * stride);
  }
}

TiledFunction::TiledFunction(TiledFunction&&) noexcept = default;
TiledFunction::~TiledFunction() = default;

const Tile& TiledFunction::at(const Point<2>& point) {
  Node* node = &workspace_->root;
  for (;;) {
    if (const Tile* tile = node->tile.load(std::memory_order_acquire)) return *tile;
    if (Node* children = node->children.load(std::memory_order_acquire))
      node = children + (point[0] > node->center[0]) + 2 * (point[1] > node->center[1]);
    else
      develop(*node);
  }
}

void TiledFunction::expand(const Box<2>& box, int bits, Tile* tile) {
  std::lock_guard lock(workspace_->mutex);
  make(box, bits, false, tile, &workspace_->local);
}

/// Gives a node a tile, or children.
void TiledFunction::develop(Node& node) {
  Workspace& w = *workspace_;
  std::lock_guard lock(w.mutex);
  if (node.tile || node.children) return;  // another thread was first
  Expansion* expansion = std::exchange(node.expansion, nullptr);
  if (!expansion) {
    Tile* tile = w.tile();
    const double dropped = make(node.box, kernel_->start_bits, node.depth > 0, tile, &w.local);
    if (serves(node, *tile, dropped)) return;
  }
  Node* children = w.four_nodes();
  for (int k = 0; k < 4; ++k) {
    Node& child = children[k];
    child.depth = node.depth + 1;
    child.box = node.box;
    for (int i = 0; i < 2; ++i) ((k >> i) % 2 ? child.box.lo : child.box.hi)[i] = node.center[i];
    child.center = child.box.center();
  }
  if (f_->is_polynomial() && f_->degree() <= kMaxHalved &&
      kernel_->start_bits <= Kernel::kDoubleBits &&
      std::isfinite((expansion ? expansion : &w.local)->sum))
    halve(expansion ? *expansion : w.local, children);
  if (expansion) w.give_back(expansion);
  node.children.store(children, std::memory_order_release);
}

/// Whether the tile just made serves for the node: then it is kept.
bool TiledFunction::serves(Node& node, Tile& tile, double dropped) {
  // What an inclusion function's lacks does not shrink fast.
  const double tolerated = f_->is_inclusion() ? 0x1p-4 : 0x1p-14;
  if (node.depth < kMaxDepth && !tile_serves(tile, dropped, tolerated)) return false;
  workspace_->keep();
  node.tile.store(&tile, std::memory_order_release);
  return true;
}

/// Halves an expansion along both axes, for the four children of its node, if their coordinates are
/// exactly those of quarters. A child that would lose too much gets nothing: it is made from the
/// coefficients of f if it is asked for.
void TiledFunction::halve(Expansion& parent, Node* children) {
  for (int k = 0; k < 4; ++k)
    if (!is_quarter(children[k].box, k, parent.center, parent.half)) return;
  const int n = f_->degree();
  Workspace& w = *workspace_;
  PairedCoefficients& c = parent.coefficients;
  if (!parent.halved) parent.largest = normalize(c, n);
  w.prepare_halving();
  const double loss_in_doubles = halving_loss_in_doubles(n, parent.sum);
  const bool in_doubles = parent.in_doubles ||
                          loss_in_doubles <= kLossInDoubles * size_of_low_terms(c.high(), c.stride);
  const auto halve_along = [&](const PairedCoefficients& from, bool second, double largest,
                               const PairedCoefficients& lower, const PairedCoefficients& upper,
                               double* largest_of_both, double* loss) {
    *loss += in_doubles ? loss_in_doubles : halving_loss(n, largest, parent.sum);
    if (!in_doubles)
      return halve_rows(from, second, largest, n, w.slices, lower, upper, largest_of_both);
    halve_rows_in_doubles(from, second, n, lower, upper);
    return true;
  };
  double largest[2] = {0, 0}, loss = parent.halving_loss + 0x1p-900;  // (What underflows.)
  if (!halve_along(c, false, parent.largest, w.halves[0], w.halves[1], largest, &loss)) return;
  for (int first = 0; first < 2; ++first) {
    Expansion* child[2] = {w.take(), w.take()};
    double largest_of[2] = {0, 0}, losses = loss;
    const bool done = halve_along(w.halves[first], true, largest[first], child[0]->coefficients,
                                  child[1]->coefficients, largest_of, &losses);
    for (int second = 0; second < 2; ++second) {
      const int upper = parent.rows_axis == 0 ? first + 2 * second : 2 * first + second;
      Expansion& e = *child[second];
      if (!done) {
        w.give_back(&e);
        continue;
      }
      e.in_doubles = in_doubles;
      e.largest = largest_of[second];
      e.halving_loss = losses * kUp;
      make_quarter(parent, children[upper], e);
    }
  }
}

/// Makes the tile of a quarter of a rectangle from its expansion; keeps one of both, if it serves.
void TiledFunction::make_quarter(const Expansion& parent, Node& node, Expansion& e) {
  ++kernel_->expansions;
  Tile* tile = workspace_->tile();
  place(tile, node.box);
  tile->bits = Kernel::kDoubleBits;
  tile->value_error = precise_error(reach_of(*tile));
  e.rows_axis = 1 - parent.rows_axis;
  e.halved = true;
  e.center = tile->center;
  e.half = tile->half;
  e.origin = parent.origin;
  // What the direct expansion lacks, as far as here.
  Point<2> reach;
  for (int i = 0; i < 2; ++i) {
    const double way = std::fabs(tile->center[i] - e.origin[i]);
    reach[i] = (std::fabs(e.origin[i]) + way + tile->half[i] * Tile::kReach) * kUp;
  }
  const double error = precise_error(reach) + e.halving_loss;
  const CoefficientSums sums = fill(tile, f_->degree(), e.coefficients, !e.in_doubles,
                                    e.rows_axis == 1, error, e.in_doubles ? 0 : kRounded);
  e.sum = (sums.kept + sums.dropped) * kUp;
  const double tolerated = e.in_doubles ? kErrorInDoubles : kHalvingError;
  if (error <= tolerated * tile->sum && !serves(node, *tile, sums.dropped))
    node.expansion = &e;
  else
    workspace_->give_back(&e);
}

/// Makes a tile from the polynomial's coefficients, and the expansion that it comes from (in MPFR
/// only the coefficients of that). Returns the sum of those that the tile has no room for.
double TiledFunction::make(const Box<2>& box, int bits, bool in_tree, Tile* tile,
                           Expansion* expansion) {
  const int n = f_->degree();
  place(tile, box);
  tile->bits = bits;
  if (!f_->is_polynomial()) return make_from_model(bits, tile);
  const Point<2> reach = reach_of(*tile);
  tile->value_error = precise_error(reach);
  PairedCoefficients& c = expansion->coefficients;
  if (bits > Kernel::kDoubleBits) {
    const FilteredPolynomial<2>::Taylor taylor = f_->polynomial().taylor(box, bits, *kernel_);
    std::fill_n(c.memory->x, 8 * PairedCoefficients::size_for(n), 0.0);
    for (std::size_t i = 0, rows = static_cast<std::size_t>(n) + 1; i < rows; ++i)
      std::copy_n(&taylor.coefficients[i * rows], rows - i, c.high() + i * c.stride);
    return fill(tile, n, c, true, false, taylor.error * Tile::reach_power(n), 0).dropped;
  }
  ++kernel_->expansions;
  expand_directly(*tile, in_tree, expansion);
  // What the shifts lose: docs/error-bounds.md.
  const CoefficientSums sums = fill(tile, n, c, true, true, tile->value_error, kRounded);
  expansion->center = expansion->origin = tile->center;
  expansion->half = tile->half;
  expansion->rows_axis = 1;
  expansion->halved = expansion->in_doubles = false;
  expansion->sum = (sums.kept + sums.dropped) * kUp;
  expansion->halving_loss = 0x1p-900 * growth(reach, n);
  return sums.dropped;
}

/// Makes a tile, that has its place, of the Taylor model of what is no polynomial. Returns the
/// error.
double TiledFunction::make_from_model(int bits, Tile* tile) {
  using Model = TaylorModel<2, double>;
  const auto* local =
      f_->is_inclusion() ? &f_->inclusion().local(tile->center, tile->half, *kernel_) : nullptr;
  const Model& model =
      local ? local->model
            : f_->expression().model(tile->center, tile->half, Tile::kMaxDegree, bits, *kernel_);
  PairedCoefficients& c = workspace_->scratch;
  std::fill_n(c.memory->x, 8 * PairedCoefficients::size_for(Tile::kMaxDegree), 0.0);
  for (int i = 0; model.exists() && i <= model.span[0]; ++i)
    std::copy_n(&model.c[static_cast<std::size_t>(i * model.stride)],
                std::min(model.span[1], model.degree - i) + 1, c.high() + i * c.stride);
  fill(tile, std::max(1, model.degree), c, true, false, 0, 0);
  if (!model.exists() || !std::isfinite(tile->error)) {
    claim_nothing(tile);
    tile->undefined = model.undefined;
    return tile->error;
  }
  tile->error = model.error;
  if (local) {
    tile->slope_error = std::max(local->slope_error[0], local->slope_error[1]);
    tile->bend_error = 2 * model.error;
  } else {
    tile->slope_error = Model::kSlope * model.error * kUp;
    tile->bend_error = Model::kBend * model.error * kUp;
  }
  tile->value_error = value_error_;
  return tile->error;
}

/// The coefficients of y^j in row j, shifted and scaled to the coordinates of a tile.
void TiledFunction::expand_directly(const Tile& tile, bool in_tree, Expansion* expansion) {
  const int n = f_->degree();
  Workspace& w = *workspace_;
  PairedCoefficients c = expansion->coefficients;
  const std::size_t size = PairedCoefficients::size_for(n);
  const auto shift_in_x = [&](PairedCoefficients shifted) {
    std::copy_n(w.original.memory, size, w.scratch.memory);
    shift_and_scale(w.scratch, n, tile.center[0], tile.half[0]);
    turn(w.scratch, n, shifted);
  };
  if (in_tree) {
    // Such tiles stand in columns.
    const auto same = [&](const Workspace::Column& column) {
      return column.center == tile.center[0] && column.half == tile.half[0];
    };
    auto column = std::find_if(w.columns.begin(), w.columns.end(), same);
    if (column == w.columns.end()) {
      w.columns.push_back({tile.center[0], tile.half[0], w.coefficients()});
      column = w.columns.end() - 1;
      shift_in_x(column->shifted);
    }
    std::copy_n(column->shifted.memory, size, c.memory);
  } else {
    shift_in_x(c);
  }
  shift_and_scale(c, n, tile.center[1], tile.half[1]);
}

double TiledFunction::precise_error(const Point<2>& reach) const {
  return 0x1.04p-106 * unheld_roundings(f_->degree()) * f_->polynomial().absolute(reach) +
         0x1p-900 * growth(reach, f_->degree());
}

double TiledFunction::value(const Point<2>& point) const {
  if (!f_->is_polynomial()) return f_->precise_value(point, value_error_, kernel_->max_bits);
  return precise_value(workspace_->original, f_->degree(), point[0], point[1]);
}

void TiledFunction::values(const Point<2>* points, int count, double* result) const {
  if (!f_->is_polynomial()) {
    for (int k = 0; k < count; ++k) result[k] = value(points[k]);
    return;
  }
  alignas(64) double x[8] = {}, y[8] = {}, all[8];
  for (int k = 0; k < count; ++k) {
    x[k] = points[k][0];
    y[k] = points[k][1];
  }
  precise_values(workspace_->original, f_->degree(), x, y, all);
  std::copy_n(all, count, result);
}

}  // namespace encase
