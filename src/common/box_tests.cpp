// SPDX-License-Identifier: MIT
#include "common/box_tests.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

#include "common/interval.hpp"

namespace encase {
namespace {

constexpr double kUp = 1 + 0x1p-40;  // outweighs the few roundings of the sums it multiplies

/// The mean of every partial derivative over the coefficients; a heuristic, proves nothing.
template <int D>
Matrix<D> mean_jacobian(const SystemNets<D>& nets) {
  Matrix<D> jacobian{};
  for (int i = 0; i < D; ++i) {
    const Bernstein<D>& net = nets[i];
    int inner = net.size();
    int outer = 1;
    for (int axis = 0; axis < D; ++axis) {
      const int count = net.degree[axis] + 1;
      inner /= count;
      double sum = 0;
      for (int o = 0; o < outer; ++o) {
        const double* first = net.b.data() + static_cast<std::size_t>(o) * count * inner;
        const double* last = first + static_cast<std::size_t>(count - 1) * inner;
        for (int k = 0; k < inner; ++k) sum += last[k] - first[k];
      }
      jacobian[i][axis] = 0.5 * sum / (outer * inner);
      outer *= count;
    }
  }
  return jacobian;
}

Matrix<1> adjugate(const Matrix<1>&) { return {{{1.0}}}; }
Matrix<2> adjugate(const Matrix<2>& m) { return {{{m[1][1], -m[0][1]}, {-m[1][0], m[0][0]}}}; }
Matrix<3> adjugate(const Matrix<3>& m) {
  Matrix<3> a;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int r = (j + 1) % 3, s = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      a[i][j] = m[r][c] * m[s][d] - m[r][d] * m[s][c];
    }
  return a;
}

/// The combination of nets with one row of weights.
template <int D>
void combine_row(const SystemNets<D>& nets, const std::array<double, D>& row, Bernstein<D>* out) {
  thread_local Bernstein<D> partial;
  if constexpr (D == 1) {
    combine(row[0], nets[0], 0.0, nets[0], out);
  } else {
    combine(row[0], nets[0], row[1], nets[1], out);
    for (int k = 2; k < D; ++k) {
      partial = *out;
      combine(1.0, partial, row[k], nets[k], out);
    }
  }
}

/// The largest |value - center| on the cube, rounded up.
template <int D>
double deviation(const Bernstein<D>& net, double center) {
  double lo = net.b[0], hi = net.b[0];
  for (double x : net.b) {
    lo = std::min(lo, x);
    hi = std::max(hi, x);
  }
  const double d = std::max(std::fabs(lo - center), std::fabs(hi - center));
  return (d + net.radius) * kUp + 0x1p-1000;
}

/// The lower and upper bound on the cube, rounded outward.
struct Range {
  double lo;
  double hi;
};
template <int K>
Range range(const Bernstein<K>& net) {
  double lo = net.b[0], hi = net.b[0];
  for (double x : net.b) {
    lo = std::min(lo, x);
    hi = std::max(hi, x);
  }
  const double slack =
      net.radius * kUp + 0x1p-1000 + 0x1p-50 * std::max(std::fabs(lo), std::fabs(hi));
  return {lo - slack, hi + slack};
}

/// Climbs the ladder: `expand(bits)` fills the nets and returns the largest radius, `proves()`
/// tells whether they prove the claim, `hopeful()` whether less rounding error might.
template <class Expand, class Proves, class Hopeful>
bool climb(Kernel& kernel, Expand expand, Proves proves, Hopeful hopeful) {
  double before = HUGE_VAL;
  for (int bits = kernel.start_bits; bits > 0; bits = kernel.next(bits)) {
    const double radius = expand(bits);
    if (proves()) {
      kernel.count(bits);
      return true;
    }
    if (!hopeful()) break;
    // The Taylor coefficients are rounded to doubles: precision beyond that gains nothing.
    if (bits > Kernel::kDoubleBits && !(radius < 0.5 * before)) break;
    before = radius;
  }
  return false;
}

/// Whether the radius is a noticeable part of the net, so that a sharper net may prove more.
template <int D>
bool coarse(const Bernstein<D>& net) {
  return !(net.radius < 0x1p-46 * largest_coefficient(net));
}

/// Whether the net of an expression lacks little but what roundings take: near zeros of a function
/// of usual size they are small, but not beside its values.
template <int D>
bool may_gain(const FilteredFunction<D>& f, const Bernstein<D>& net) {
  return f.precision_helps(net) || net.radius < 0x1p-32;
}

template <int D>
bool may_gain(const System<D>& system, const SystemNets<D>& nets) {
  for (int i = 0; i < D; ++i)
    if (coarse(nets[i]) && may_gain(*system[i], nets[i])) return true;
  return false;
}

template <int D>
double expand_system(const System<D>& system, const Box<D>& box, int bits, Kernel& kernel,
                     SystemNets<D>* nets) {
  int degree = 0;
  for (const auto* f : system) degree = std::max(degree, f->degree());
  double radius = 0;
  for (int i = 0; i < D; ++i) {
    system[i]->expand(box, degree, bits, kernel, &(*nets)[i]);
    radius = std::max(radius, (*nets)[i].radius);
  }
  return radius;
}

}  // namespace

template <int D>
bool excluded(const SystemNets<D>& nets) {
  for (const auto& net : nets)
    if (sign_on_cube(net)) return true;
  if constexpr (D > 1) {
    thread_local Bernstein<D> combination;
    const Matrix<D> rows = adjugate(mean_jacobian<D>(nets));
    for (int i = 0; i < D; ++i) {
      combine_row<D>(nets, rows[i], &combination);
      if (sign_on_cube(combination)) return true;
    }
  }
  return false;
}

template <int D>
std::optional<std::array<double, D>> contracting_weights(const Matrix<D>& bound, double quality) {
  // E v < v for a positive v bounds the spectral radius of E below 1 (Perron, Frobenius). The fixed
  // point of v = 1 + E v is such a vector; a few iterations come close enough when there is one.
  std::array<double, D> v;
  v.fill(1.0);
  for (int round = 0; round < 60; ++round) {
    std::array<double, D> next;
    bool proved = true;
    for (int i = 0; i < D; ++i) {
      double sum = 0;
      for (int j = 0; j < D; ++j) sum += bound[i][j] * v[j];
      proved = proved && sum * kUp < quality * v[i];
      next[i] = 1 + sum;
    }
    if (proved) return v;
    if (!(next[0] < 1e6)) break;
    v = next;
  }
  return std::nullopt;
}

template <int D>
std::optional<Contraction<D>> contraction(const SystemNets<D>& nets, double quality) {
  const Matrix<D> jacobian = mean_jacobian<D>(nets);
  Matrix<D> y = adjugate(jacobian);
  double determinant = 0;
  for (int k = 0; k < D; ++k) determinant += jacobian[0][k] * y[k][0];
  if (!(std::fabs(determinant) > 0) || !std::isfinite(1.0 / determinant)) return std::nullopt;
  Contraction<D> result;
  thread_local Bernstein<D> row, derivative;
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) result.preconditioner[i][k] = y[i][k] / determinant;
    combine_row<D>(nets, result.preconditioner[i], &row);
    for (int j = 0; j < D; ++j) {
      differentiate(row, j, &derivative);
      result.bound[i][j] = deviation(derivative, i == j ? 1.0 : 0.0);
      if (!(result.bound[i][j] < 1e6)) return std::nullopt;
    }
    if (!(result.bound[i][i] < quality)) return std::nullopt;
  }
  const auto weights = contracting_weights<D>(result.bound, quality);
  if (!weights) return std::nullopt;
  result.weights = *weights;
  return result;
}

namespace {

/// Whether V . grad f keeps a sign on the cube for the affine vector field V that brings it closest
/// to a constant: where f has a long narrow ridge, V follows the ridge, and what is left is the
/// slow change of f along it. Any V proves the claim; this one solves a least squares problem.
bool flows(const Bernstein<2>& net) {
  // The fields (1,0), (s,0), (t,0), (0,1), (0,s), (0,t) applied to f, in equal degrees.
  const int n = std::max(net.degree[0], net.degree[1]);
  std::array<Bernstein<2>, 6> parts;
  Bernstein<2> partial, raised;
  for (int axis = 0; axis < 2; ++axis) {
    differentiate(net, axis, &partial);
    for (int factor = 0; factor < 3; ++factor) {
      Bernstein<2>& part = parts[3 * axis + factor];
      if (factor == 0)
        part = partial;
      else
        multiply_by_coordinate(partial, factor - 1, &part);
      for (int i = 0; i < 2; ++i)
        while (part.degree[i] < n + 1) {
          elevate(part, i, &raised);
          part = raised;
        }
    }
  }
  const Eigen::Index rows = static_cast<Eigen::Index>(parts[0].b.size());
  Eigen::MatrixXd matrix(rows, 6);
  for (int k = 0; k < 6; ++k)
    matrix.col(k) = Eigen::Map<const Eigen::VectorXd>(parts[k].b.data(), rows);
  if (!matrix.allFinite()) return false;
  const Eigen::VectorXd v = matrix.colPivHouseholderQr().solve(Eigen::VectorXd::Ones(rows));
  const double size = v.cwiseAbs().maxCoeff();
  if (!(size > 0) || !std::isfinite(size)) return false;
  Bernstein<2> flow, sum;
  combine(v[0] / size, parts[0], v[1] / size, parts[1], &flow);
  for (int k = 2; k < 6; ++k) {
    combine(1.0, flow, v[k] / size, parts[k], &sum);
    std::swap(flow, sum);
  }
  return sign_on_cube(flow).has_value();
}

}  // namespace

bool no_relevant_critical_point(const Bernstein<2>& net, Effort effort) {
  if (net.degree[0] == 0 || net.degree[1] == 0) return sign_on_cube(net).has_value();
  thread_local SystemNets<2> gradient;
  thread_local Bernstein<2> partial;
  differentiate(net, 0, &partial);
  if (sign_on_cube(partial)) return true;
  elevate(partial, 0, &gradient[0]);
  differentiate(net, 1, &partial);
  if (sign_on_cube(partial)) return true;
  elevate(partial, 1, &gradient[1]);
  if (excluded<2>(gradient)) return true;
  const auto sign = sign_on_cube(net);
  if (!sign) return effort == Effort::Thorough && flows(net);
  // f is not zero here. At a local maximum of |f| the Hessian of f times sign(f) is negative
  // semi-definite: sign(f) f_xx <= 0, sign(f) f_yy <= 0 and det Hess f >= 0.
  thread_local Bernstein<2> second;
  differentiate(net, 0, &partial);
  differentiate(partial, 0, &second);
  if (sign_on_cube(second) == sign) return true;
  const Range xx = range(second);
  differentiate(partial, 1, &second);
  const Range xy = range(second);
  differentiate(net, 1, &partial);
  differentiate(partial, 1, &second);
  if (sign_on_cube(second) == sign) return true;
  const Range yy = range(second);
  const double product =
      std::max(std::max(xx.lo * yy.lo, xx.lo * yy.hi), std::max(xx.hi * yy.lo, xx.hi * yy.hi));
  const double mixed = xy.lo > 0 ? xy.lo : xy.hi < 0 ? -xy.hi : 0.0;
  const double square = mixed * mixed * (1 - 0x1p-40);
  const bool saddle = product <= 0 ? square > 0x1p-900 || product * (1 - 0x1p-40) < -0x1p-900
                                   : product * kUp + 0x1p-900 < square;
  return saddle || (effort == Effort::Thorough && flows(net));
}

namespace {

/// As sign_on_box, by one net.
template <int D>
std::optional<Sign> sign_by_net(const FilteredFunction<D>& f, const Box<D>& box, Kernel& kernel,
                                Bernstein<D>* net_on_box) {
  Bernstein<D>& net = *net_on_box;
  std::optional<Sign> sign;
  climb(
      kernel,
      [&](int bits) {
        f.expand(box, f.degree(), bits, kernel, &net);
        return net.radius;
      },
      [&] {
        sign = sign_on_cube(net);
        return sign.has_value();
      },
      [&] { return drowned(net) && may_gain(f, net); });
  return sign;
}

/// Whether no two of the signs that are proved at the corners, and the one known, are different;
/// notes the sign.
template <int D>
bool corners_agree(const Bernstein<D>& net, std::optional<Sign>* sign) {
  for (int corner = 0; corner < 1 << D; ++corner) {
    std::size_t at = 0;
    for (int i = 0; i < D; ++i)
      at = at * static_cast<std::size_t>(net.degree[i] + 1) +
           static_cast<std::size_t>((corner >> i) % 2 ? net.degree[i] : 0);
    if (!(std::fabs(net.b[at]) > net.radius)) continue;
    const Sign here = net.b[at] > 0 ? Sign::Positive : Sign::Negative;
    if (*sign && **sign != here) return false;
    *sign = here;
  }
  return true;
}

}  // namespace

template <int D>
std::optional<Sign> sign_on_box(const FilteredFunction<D>& f, const Box<D>& box, Kernel& kernel) {
  thread_local Bernstein<D> net;
  if (f.is_polynomial()) return sign_by_net(f, box, kernel, &net);
  // Of an expression on a smaller box nets tell more. (Where it is not analytic none ever will.)
  constexpr int kMostHalvings = 8;
  struct Part {
    Box<D> box;
    int halvings = 0;
  };
  std::optional<Sign> sign;
  std::vector<Part> parts{{box}};
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    const auto here = sign_by_net(f, part.box, kernel, &net);
    if (here && sign && *here != *sign) return std::nullopt;
    if (here) {
      sign = here;
      continue;
    }
    // Across the axis along which f changes most, or the longest one.
    const bool known = std::isfinite(net.radius);
    int axis = 0;
    for (int i = 1; i < D; ++i)
      if (known ? variation(net, i) > variation(net, axis)
                : part.box.width(i) > part.box.width(axis))
        axis = i;
    const double middle = part.box.center()[axis];
    if (part.halvings == kMostHalvings || !corners_agree(net, &sign) ||
        !(part.box.lo[axis] < middle) || !(middle < part.box.hi[axis]))
      return std::nullopt;
    for (const bool upper : {true, false}) {
      parts.push_back({part.box, part.halvings + 1});
      (upper ? parts.back().box.lo : parts.back().box.hi)[axis] = middle;
    }
  }
  return sign;
}

template <int D>
bool no_common_zero(const System<D>& system, const Box<D>& box, Kernel& kernel) {
  SystemNets<D> nets;
  return climb(
      kernel, [&](int bits) { return expand_system<D>(system, box, bits, kernel, &nets); },
      [&] { return excluded<D>(nets); }, [&] { return may_gain<D>(system, nets); });
}

template <int D>
bool at_most_one_zero(const System<D>& system, const Box<D>& box, Kernel& kernel) {
  SystemNets<D> nets;
  return climb(
      kernel, [&](int bits) { return expand_system<D>(system, box, bits, kernel, &nets); },
      [&] { return contraction<D>(nets).has_value(); },
      [&] { return std::any_of(nets.begin(), nets.end(), coarse<D>); });
}

template <int D>
bool exactly_one_zero(const System<D>& system, const Box<D>& box, Kernel& kernel) {
  // Krawczyk: with K(X) = c - Y F(c) + (I - Y J)(X - c), K(X) in the interior of X proves a zero
  // in K(X). In local coordinates X = [-1, 1]^D and c = 0. Nets may cover slightly more than the
  // box where its centre is not a double; then a strictly smaller cube is asked for.
  SystemNets<D> nets;
  double shrink = 1.0;
  for (int i = 0; i < D; ++i) {
    const Centered chart = centered(box.lo[i], box.hi[i]);
    const double least = std::min(chart.center - box.lo[i], box.hi[i] - chart.center);
    if (!(least > 0)) return false;
    if (!chart.exact) shrink = std::min(shrink, least / chart.half * (1 - 0x1p-49));
  }
  if (!(shrink > 0)) return false;
  return climb(
      kernel, [&](int bits) { return expand_system<D>(system, box, bits, kernel, &nets); },
      [&] {
        const auto c = contraction<D>(nets);
        if (!c) return false;
        // F at the centre: de Casteljau's middle point of every net.
        std::array<double, D> residual{}, value_at_center;
        for (int i = 0; i < D; ++i) {
          Bernstein<D> at = nets[i], lower, upper;
          for (int axis = 0; axis < D; ++axis) {
            halve(at, axis, &lower, &upper);
            at = upper;
          }
          for (int k = 0; k < D; ++k) residual[k] += std::fabs(c->preconditioner[k][i]) * at.radius;
          value_at_center[i] = at.b[0];
        }
        for (int k = 0; k < D; ++k) {
          double value = 0, magnitude = 0;
          for (int i = 0; i < D; ++i) {
            value += c->preconditioner[k][i] * value_at_center[i];
            magnitude += std::fabs(c->preconditioner[k][i] * value_at_center[i]);
          }
          residual[k] += std::fabs(value) + 0x1p-49 * magnitude;
          double reach = residual[k];
          for (int j = 0; j < D; ++j) reach += c->bound[k][j] * shrink;
          if (!(reach * kUp < shrink)) return false;
        }
        return true;
      },
      [&] { return std::any_of(nets.begin(), nets.end(), coarse<D>); });
}

bool no_relevant_critical_point(const FilteredFunction<2>& f, const Box<2>& box, Kernel& kernel) {
  Bernstein<2> net;
  return climb(
      kernel,
      [&](int bits) {
        f.expand(box, f.degree(), bits, kernel, &net);
        return net.radius;
      },
      [&] { return no_relevant_critical_point(net, Effort::Thorough); },
      [&] { return coarse(net) && may_gain(f, net); });
}

#define ENCASE_INSTANTIATE(D)                                                                     \
  template bool excluded<D>(const SystemNets<D>&);                                                \
  template std::optional<Contraction<D>> contraction<D>(const SystemNets<D>&, double);            \
  template std::optional<std::array<double, D>> contracting_weights<D>(const Matrix<D>&, double); \
  template std::optional<Sign> sign_on_box(const FilteredFunction<D>&, const Box<D>&, Kernel&);   \
  template bool no_common_zero<D>(const System<D>&, const Box<D>&, Kernel&);                      \
  template bool at_most_one_zero<D>(const System<D>&, const Box<D>&, Kernel&);                    \
  template bool exactly_one_zero<D>(const System<D>&, const Box<D>&, Kernel&);
ENCASE_INSTANTIATE(1)
ENCASE_INSTANTIATE(2)
ENCASE_INSTANTIATE(3)
#undef ENCASE_INSTANTIATE

}  // namespace encase
