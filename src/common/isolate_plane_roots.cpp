// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "common/isolate_roots.hpp"
#include "common/plane_subdivision.hpp"

namespace encase {
namespace {

/// What the search asks of a contraction: a checker that recomputes it on a somewhat different box
/// has room, and radii are at most some times the residual.
constexpr double kQuality = 0.8;
constexpr int kQuarter = PlaneSubdivision<2>::kQuarter;
constexpr double kUp = 1 + 0x1p-40;
constexpr int kCloserLooks = 3;
constexpr double kSmallPart = 0.3;    // of a box's area
constexpr int kSimpleLevels = 16;     // of halvings, after which most crossings are told apart
constexpr double kNearlyAll = 0.999;  // so that roundings do not break symmetry's ties

/// The distance to the next double away from zero, and towards it.
double ulp(double x) {
  x = std::fabs(x);
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) + 1) - x;
}
double ulp_below(double x) {
  x = std::fabs(x);
  return x > 0 ? x - std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) - 1) : 0;
}

/// A radius not below `wanted`, a multiple of some ulps of x +- it, so that x is their middle, with
/// no more than five binary digits: they hardly ever tell how `wanted` was rounded.
double radius_around(double x, double wanted) {
  const double unit = std::max(4 * ulp(std::fabs(x) + wanted), 0x1p48 * ulp(wanted));
  return std::ceil(wanted / unit) * unit;
}

/// As narrow as doubles allow, some units in the last place.
bool narrow(const Box<2>& box) {
  return box.largest_width() <= 128 * ulp(std::max(std::fabs(box.hi[0]), std::fabs(box.hi[1])));
}

/// The common zeros of two polynomials that have been found, and how: from boxes of a subdivision.
class PlaneRoots {
 public:
  explicit PlaneRoots(Kernel& kernel) : kernel_(kernel) {}

  void use(const std::array<TiledFunction*, 2>& system) { system_ = system; }

  std::vector<Box<2>> roots;
  std::vector<bool> rounded;  // as in RootIsolation

  using Tiles = std::array<const Tile*, 2>;

  /// The number of the root that a box can contain which holds at most one, or kQuarter.
  int near(const Tiles& node_tiles, const Box<2>& leaf, const SystemVerdict& verdict);

  /// What becomes of a box on which the nets are given: the token that settles it, or kQuarter and
  /// the part (in the box's coordinates) that holds all zeros.
  int settle(const PlaneSubdivision<2>::Node& node, Box<2>* part);

 private:
  struct Step {
    Point<2> d;
    Matrix<2> jacobian;
  };
  /// Where Newton's iteration came to, and the Jacobian at the point before.
  struct Approximation {
    Point<2> x, before;
    Matrix<2> jacobian;
  };
  std::optional<Step> newton_step(const Tiles& tiles, const Point<2>& x,
                                  const std::array<double, 2>* values) const;
  std::optional<Approximation> newton(const Tiles& tiles, const Box<2>& leaf,
                                      const Box<2>& zeros) const;
  /// A box around one zero; `rounded`: its centre is proved to be the zero, correctly rounded.
  struct Enclosure {
    Box<2> box;
    bool rounded = false;
  };
  std::optional<Enclosure> tight_box(const Tiles& tiles, const Box<2>& around,
                                     Approximation a) const;
  std::optional<Enclosure> tight_box_at(const Tiles& tiles, const Box<2>& around,
                                        const Approximation& a, Point<2>* d) const;
  std::optional<Contraction<2>> contraction_around(const Box<2>& around, Tiles* tiles);
  std::optional<Box<2>> enclose(const Tiles& tiles, const Box<2>& around, const Contraction<2>& c,
                                Point<2> x) const;
  std::optional<Box<2>> krawczyk_box(const Box<2>& around, const Contraction<2>& c,
                                     const Point<2>& x,
                                     const std::array<double, 2>& residual) const;

  std::array<TiledFunction*, 2> system_{};
  Kernel& kernel_;
  std::vector<std::size_t> strays_;  ///< the roots that were not found inside their leaf
  std::array<Tile, 2> around_tiles_;
  std::array<SystemNet, 2> nets_;
  SystemVerdict verdict_;
};

/// J(x) d = F(x), with the approximate Jacobian; F from the tiles where no values are given.
std::optional<PlaneRoots::Step> PlaneRoots::newton_step(const Tiles& tiles, const Point<2>& x,
                                                        const std::array<double, 2>* values) const {
  Step step;
  std::array<double, 2> value;
  std::array<Point<2>, 2> local, per_half;
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k) {
      per_half[i][k] = 1 / tiles[i]->half[k];
      local[i][k] = (x[k] - tiles[i]->center[k]) * per_half[i][k];
    }
  const auto jets = values_and_gradients(tiles, local);
  for (int i = 0; i < 2; ++i) {
    value[i] = values ? (*values)[i] : jets[i][0];
    step.jacobian[i] = {jets[i][1] * per_half[i][0], jets[i][2] * per_half[i][1]};
  }
  const auto& j = step.jacobian;
  const double scale = 1 / (j[0][0] * j[1][1] - j[0][1] * j[1][0]);
  step.d = {(value[0] * j[1][1] - value[1] * j[0][1]) * scale,
            (value[1] * j[0][0] - value[0] * j[1][0]) * scale};
  if (!std::isfinite(step.d[0]) || !std::isfinite(step.d[1])) return std::nullopt;
  return step;
}

/// Newton's iteration from the middle of the part of a leaf that can hold zeros.
std::optional<PlaneRoots::Approximation> PlaneRoots::newton(const Tiles& tiles, const Box<2>& leaf,
                                                            const Box<2>& zeros) const {
  const double width = leaf.largest_width(), reach = 2 * width;
  Approximation a;
  const Point<2> center = leaf.center();
  for (int i = 0; i < 2; ++i) {
    const double middle = 0.5 * (std::max(-1.0, zeros.lo[i]) + std::min(1.0, zeros.hi[i]));
    a.x[i] = center[i] + 0.5 * leaf.width(i) * middle;
  }
  const Point<2> start = a.x;
  double last = HUGE_VAL;
  for (int round = 0; round < 12; ++round) {
    const auto step = newton_step(tiles, a.x, nullptr);
    if (!step) return std::nullopt;
    a.before = a.x;
    a.jacobian = step->jacobian;
    double size = 0;
    for (int i = 0; i < 2; ++i) {
      a.x[i] -= step->d[i];
      size = std::max(size, std::fabs(step->d[i]));
      if (!(std::fabs(a.x[i] - start[i]) <= reach)) return std::nullopt;
    }
    // Quadratic convergence: what remains is the business of more precise values.
    if (size <= 1e-6 * width || (round > 2 && size >= 0.5 * last)) break;
    last = size;
  }
  return a;
}

/// A box some units in the last place wide around the zero near a.x, from one precise value there:
/// with Y the inverse of the Jacobian J0 known at a point nearby, and |J - J0| bounded on
/// X = a.x +- reach, every zero z in X has |z - (a.x - Y F(a.x))| <= E reach, E = |I - Y J|; if
/// that is inside X there is one. (docs/error-bounds.md, section 5.)
std::optional<PlaneRoots::Enclosure> PlaneRoots::tight_box_at(const Tiles& tiles,
                                                              const Box<2>& around,
                                                              const Approximation& a,
                                                              Point<2>* step) const {
  const Matrix<2>& j = a.jacobian;
  const double determinant = j[0][0] * j[1][1] - j[0][1] * j[1][0];
  if (!(std::fabs(determinant) > 0x1p-900)) return std::nullopt;  // its products may underflow
  const double scale = 1 / determinant;
  const Matrix<2> y{{{j[1][1] * scale, -j[0][1] * scale}, {-j[1][0] * scale, j[0][0] * scale}}};
  Point<2>& d = *step;
  d = {0, 0};
  Point<2> error{0x1p-1020, 0x1p-1020}, reach;  // what underflows
  for (int i = 0; i < 2; ++i) {
    const double value = system_[i]->value(a.x);
    const double bound = tiles[i]->value_error + 0x1p-52 * std::fabs(value);
    for (int k = 0; k < 2; ++k) {
      d[k] += y[k][i] * value;
      error[k] += (std::fabs(y[k][i]) * bound + 0x1p-50 * std::fabs(y[k][i] * value)) * kUp;
    }
  }
  double far = 0;  // of X from the point of the Jacobian, in the tiles' coordinates
  for (int k = 0; k < 2; ++k) {
    reach[k] = 2 * std::fabs(d[k]) + 4 * error[k] + 8 * ulp(a.x[k]);
    // What is known of the tiles holds on their rectangles.
    for (const Tile* tile : tiles)
      if (!(std::fabs(a.x[k] - tile->center[k]) + reach[k] <= tile->half[k] &&
            std::fabs(a.before[k] - tile->center[k]) <= tile->half[k]))
        return std::nullopt;
    const double half = std::min(tiles[0]->half[k], tiles[1]->half[k]);
    far = std::max(far, (std::fabs(a.x[k] - a.before[k]) + reach[k]) / half * kUp);
  }
  // The change of the Jacobian, the rounding of its evaluation (Horner's rule twice) and of the
  // point in the tile's coordinates, and what the tile is off.
  Matrix<2> spread;  // of row i, in x
  for (int i = 0; i < 2; ++i) {
    const Tile& tile = *tiles[i];
    const double local = (tile.bend * (far + 0x1p-48) + tile.slope_error +
                          0x1p-52 * (4 * tile.degree + 8) * tile.slope) *
                         kUp;
    for (int m = 0; m < 2; ++m) spread[i][m] = local / tile.half[m] * kUp;
  }
  // Y J0 is the identity but for the rounding of Y.
  const double off =
      0x1p-50 * (std::fabs(j[0][0] * j[1][1]) + std::fabs(j[0][1] * j[1][0])) * std::fabs(scale);
  Point<2> image;
  for (int k = 0; k < 2; ++k) {
    image[k] = error[k];
    for (int m = 0; m < 2; ++m) {
      double e = 0x1p-48 * (std::fabs(y[k][0] * j[0][m]) + std::fabs(y[k][1] * j[1][m]));
      for (int i = 0; i < 2; ++i) e += std::fabs(y[k][i]) * spread[i][m];
      image[k] += (e + off) * reach[m] * kUp;
    }
    if (!((std::fabs(d[k]) + image[k]) * kUp < reach[k])) return std::nullopt;
  }
  Box<2> box;
  bool nearest = true;
  for (int k = 0; k < 2; ++k) {
    // Around a double, with room for a checker.
    const double x = a.x[k] - d[k];
    // What the difference lost (Knuth), and how far the zero may be from the exact one: less than
    // half the distance to the next double?
    const double back = x - a.x[k];
    const double lost = (a.x[k] - (x - back)) + (-d[k] - back);
    nearest = nearest && (std::fabs(lost) + image[k]) * kUp < 0.5 * ulp_below(x);
    const double wanted = std::max(16 * (image[k] + ulp(x)),
                                   16 * ulp(std::max(std::fabs(x), 0x1p-20 * around.width(k))));
    const double r = radius_around(x, wanted);
    box.lo[k] = x - r;
    box.hi[k] = x + r;
    if (!(around.lo[k] < box.lo[k] && box.hi[k] < around.hi[k])) return std::nullopt;
    // The ends round where x lies next to a power of two.
    nearest = nearest && box.center()[k] == x;
  }
  return Enclosure{box, nearest};
}

/// The same, with the Jacobian from closer by where that makes the box narrower.
std::optional<PlaneRoots::Enclosure> PlaneRoots::tight_box(const Tiles& tiles, const Box<2>& around,
                                                           Approximation a) const {
  for (int round = 0;; ++round) {
    Point<2> d{};
    const auto enclosure = tight_box_at(tiles, around, a, &d);
    if (round == 2 || (enclosure && enclosure->rounded && narrow(enclosure->box))) return enclosure;
    const auto step = newton_step(tiles, a.x, nullptr);
    if (!step) return enclosure;
    a = {{a.x[0] - d[0], a.x[1] - d[1]}, a.x, step->jacobian};
  }
}

std::optional<Contraction<2>> PlaneRoots::contraction_around(const Box<2>& around, Tiles* tiles) {
  for (int i = 0; i < 2; ++i) {
    const Tile*& tile = (*tiles)[i];
    bool contained = true;
    for (int k = 0; k < 2; ++k)
      contained = contained && std::fabs(around.lo[k] - tile->center[k]) <= tile->half[k] &&
                  std::fabs(around.hi[k] - tile->center[k]) <= tile->half[k];
    if (!contained) {
      system_[i]->expand(around, kernel_.start_bits, &around_tiles_[i]);
      tile = &around_tiles_[i];
    }
  }
  SystemNet net;
  const int count = std::max(patch_count((*tiles)[0]->degree), patch_count((*tiles)[1]->degree));
  for (int i = 0; i < 2; ++i) expand(*(*tiles)[i], around, count, &net.of[i]);
  SystemVerdict verdict;
  test_system(net, kQuality, &verdict);
  if (!verdict.contracts) return std::nullopt;
  return verdict.contraction;
}

/// The box around one zero near x by Krawczyk's test within `around`, whose contraction is known:
/// with R = radius in local coordinates, |Y F(x)| + E R < R in every coordinate proves a zero in
/// x +- R, if x +- R lies in `around`. `residual` bounds |Y F(x)|.
std::optional<Box<2>> PlaneRoots::krawczyk_box(const Box<2>& around, const Contraction<2>& c,
                                               const Point<2>& x,
                                               const std::array<double, 2>& residual) const {
  // The half widths of the net that the contraction comes from, or a little more.
  Point<2> half;
  for (int k = 0; k < 2; ++k) half[k] = centered(around.lo[k], around.hi[k]).half;
  // The smallest multiple t of the weights v that makes a Krawczyk radius (as E v < v), 16 times
  // enlarged to leave a checker room, and no less than 16 ulps in any coordinate.
  double t = 0;
  for (int k = 0; k < 2; ++k) {
    const double image = c.bound[k][0] * c.weights[0] + c.bound[k][1] * c.weights[1];
    t = std::max(t, 16 * residual[k] / (c.weights[k] - image * kUp));
    const double size = std::max(std::fabs(x[k]), 0x1p-20 * half[k]);
    t = std::max(t, 16 * ulp(size) / (c.weights[k] * half[k]));
  }
  if (!std::isfinite(t)) return std::nullopt;
  Box<2> box;
  std::array<double, 2> radius;
  for (int k = 0; k < 2; ++k) {
    const double wanted = t * c.weights[k] * half[k] * kUp;
    const double r = radius_around(x[k], wanted);
    box.lo[k] = x[k] - r;
    box.hi[k] = x[k] + r;
    if (!(around.lo[k] < box.lo[k] && box.hi[k] < around.hi[k])) return std::nullopt;
    // What is proved holds for a box inside the rounded one.
    radius[k] = (r - 2 * ulp(x[k])) / half[k] * (1 - 0x1p-40);
  }
  for (int k = 0; k < 2; ++k) {
    const double image = residual[k] + c.bound[k][0] * radius[0] + c.bound[k][1] * radius[1];
    if (!(image * kUp < radius[k])) return std::nullopt;
  }
  return box;
}

std::optional<Box<2>> PlaneRoots::enclose(const Tiles& tiles, const Box<2>& around,
                                          const Contraction<2>& c, Point<2> x) const {
  std::optional<Box<2>> best;
  // Values from sums of two doubles, then from MPFR where those are too coarse.
  for (int bits = kernel_.start_bits; bits > 0 && bits <= 4 * Kernel::kDoubleBits;
       bits = kernel_.next(bits)) {
    if (bits == Kernel::kExtendedBits) continue;
    for (int round = 0; round < 4; ++round) {
      std::array<double, 2> value, correction{}, residual{};
      for (int i = 0; i < 2; ++i) {
        double error;
        if (bits > Kernel::kDoubleBits) {
          const auto v = system_[i]->polynomial().evaluate(x, bits);
          value[i] = v.value;
          error = v.error;
        } else {
          value[i] = system_[i]->value(x);
          error = tiles[i]->value_error + 0x1p-52 * std::fabs(value[i]);
        }
        for (int k = 0; k < 2; ++k) {
          const double y = c.preconditioner[k][i];
          correction[k] += y * value[i];
          residual[k] += std::fabs(y) * error + 0x1p-50 * std::fabs(y * value[i]);
        }
      }
      for (int k = 0; k < 2; ++k) residual[k] = (residual[k] + std::fabs(correction[k])) * kUp;
      const auto step = newton_step(tiles, x, &value);
      bool moves = false;
      if (step)
        for (int k = 0; k < 2; ++k) moves = moves || std::fabs(step->d[k]) > 2 * ulp(x[k]);
      // A box is only wanted around the last point.
      if (!moves || round == 3) {
        const auto box = krawczyk_box(around, c, x, residual);
        if (box && (!best || box->largest_width() < best->largest_width())) best = box;
        break;
      }
      for (int k = 0; k < 2; ++k) {
        x[k] -= step->d[k];
        if (!(around.lo[k] < x[k] && x[k] < around.hi[k])) return best;
      }
    }
    if (best && narrow(*best)) break;
  }
  return best;
}

int PlaneRoots::near(const Tiles& node_tiles, const Box<2>& leaf, const SystemVerdict& verdict) {
  Tiles tiles = node_tiles;
  const auto approximation = newton(tiles, leaf, verdict.zeros);
  if (!approximation) return kQuarter;
  const Point<2>& x = approximation->x;
  double offset = 0;
  for (int i = 0; i < 2; ++i)
    offset = std::max(offset, std::fabs(x[i] - leaf.center()[i]) / (0.5 * leaf.width(i)));
  if (!(offset < 1.7)) return kQuarter;
  Box<2> around = leaf;
  const Contraction<2>* valid = &verdict.contraction;
  std::optional<Contraction<2>> wider;
  const bool inside = offset <= 0.95;
  if (!inside) {
    // The zero is at the border or outside: argue on a box that has it well inside.
    for (int i = 0; i < 2; ++i) {
      around.lo[i] = leaf.lo[i] - 0.5 * leaf.width(i);
      around.hi[i] = leaf.hi[i] + 0.5 * leaf.width(i);
    }
    wider = contraction_around(around, &tiles);
    if (!wider) return kQuarter;
    valid = &*wider;
  }
  std::optional<Enclosure> root;
  if (kernel_.start_bits <= Kernel::kDoubleBits)
    root = tight_box(node_tiles, around, *approximation);
  if (!root || !narrow(root->box)) {
    const auto box = enclose(tiles, around, *valid, x);
    if (!box) return kQuarter;
    root = Enclosure{*box, false};
  }
  // What lies inside its leaf can only meet what does not.
  const std::size_t others = inside ? strays_.size() : roots.size();
  for (std::size_t n = 0; n < others; ++n) {
    const std::size_t k = inside ? strays_[n] : n;
    if (!roots[k].meets(root->box)) continue;
    // Both boxes hold a zero and `around` at most one: the same.
    if (around.contains(roots[k])) return static_cast<int>(k);
    return kQuarter;
  }
  if (!inside) strays_.push_back(roots.size());
  roots.push_back(root->box);
  rounded.push_back(root->rounded);
  return static_cast<int>(roots.size()) - 1;
}

/// The part of a box with given local coordinates, or a little more. (Neighbouring doubles may be
/// far apart for a small box.)
Box<2> inner_box(const Box<2>& box, const Box<2>& local) {
  Box<2> part = box;
  for (int i = 0; i < 2; ++i) {
    const Centered chart = centered(box.lo[i], box.hi[i]);
    const double lo = chart.center + (local.lo[i] - 1e-9) * chart.half;
    const double hi = chart.center + (local.hi[i] + 1e-9) * chart.half;
    part.lo[i] = std::max(box.lo[i], round_down(lo));
    part.hi[i] = std::min(box.hi[i], round_up(hi));
  }
  return part;
}

int PlaneRoots::settle(const PlaneSubdivision<2>::Node& node, Box<2>* part) {
  test_system(*node.net, kQuality, &verdict_);
  Box<2> box = node.box;
  const SystemNet* net = node.net;
  for (int round = 0;; ++round) {
    if (verdict_.excluded) return cover::kExcluded;
    if (verdict_.contracts) return near(node.tile, box, verdict_);
    Box<2> zeros = verdict_.zeros;
    for (int i = 0; i < 2; ++i) {
      zeros.lo[i] = std::max(-1.0, zeros.lo[i]);
      zeros.hi[i] = std::min(1.0, zeros.hi[i]);
    }
    if (round == 0) {
      *part = zeros;
      // Patches from halving have the box's coordinates, fresh ones those of its chart.
      if (!halves_exactly(box)) return kQuarter;
    }
    // Where all zeros lie in a small part, a closer look at that part is worth its price.
    if (round == kCloserLooks || zeros.width(0) * zeros.width(1) > 4 * kSmallPart) return kQuarter;
    const Box<2> inner = inner_box(box, zeros);
    if (!(inner.width(0) > 0 && inner.width(1) > 0)) return kQuarter;
    SystemNet& next = nets_[round % 2];
    restrict_to(*net, part_of(chart_of(box), inner), &next);
    if (next.excluded()) return cover::kExcluded;
    test_system(next, kQuality, &verdict_);
    net = &next;
    box = inner;
  }
}

}  // namespace

RootIsolation<2> isolate_roots(Sought<2> sought, const std::vector<Line>& half_planes,
                               const SubdivisionLimits& limits, Kernel& kernel) {
  RootIsolation<2> result;
  result.root_box = sought.root;
  const auto known = sought.tokens.size() - sought.leaves.size();
  if (sought.leaves.empty()) {
    result.tokens = std::move(sought.tokens);
    return result;
  }
  PlaneRoots roots(kernel);
  PlaneSubdivision<2> subdivision(std::move(sought), half_planes, limits, kernel);
  const auto visit = [&](PlaneSubdivision<2>::Node& node) {
    roots.use(subdivision.polynomials());
    const int token = roots.settle(node, &node.part);
    if (token != kQuarter || node.level < kSimpleLevels) return token;
    // Across the axis along which they change more: curves that touch or share a tangent there.
    const auto [x, y] = relative_variation(*node.net);
    return x >= kNearlyAll * y ? cover::kSplitX : cover::kSplitY;
  };
  result.tokens = subdivision.run(visit);
  result.boxes = static_cast<int>(result.tokens.size() - known);
  result.roots = std::move(roots.roots);
  result.rounded = std::move(roots.rounded);
  if (subdivision.unresolved())
    result.unresolved = leaves(result.root_box, result.tokens, cover::kUnresolved);
  return result;
}

RootIsolation<2> isolate_roots(TiledFunction& f, TiledFunction& g, const Box<2>& root,
                               const std::vector<Line>& half_planes,
                               const SubdivisionLimits& limits, Kernel& kernel) {
  return isolate_roots(sought_in<2>(root, {&f, &g}), half_planes, limits, kernel);
}

template <>
RootIsolation<2> isolate_roots<2>(const System<2>& system, const Box<2>& box,
                                  const std::vector<Line>& half_planes,
                                  const SubdivisionLimits& limits, Kernel& kernel) {
  const Box<2> root = subdivision_root(box);
  TiledFunction f(*system[0], root, kernel), g(*system[1], root, kernel);
  return isolate_roots(f, g, root, half_planes, limits, kernel);
}

}  // namespace encase
