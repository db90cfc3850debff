// SPDX-License-Identifier: MIT
#include "3d/certificate_tests.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/box_tests.hpp"
#include "common/taylor_to_bernstein.hpp"

namespace encase {

namespace {

constexpr double kUnit = 0x1p-53;
constexpr double kTiny = 0x1p-1000;  // more than what underflows
constexpr double kUp = 1 + 0x1p-40;  // outweighs the few roundings of the sums it multiplies
constexpr double kInfinite = std::numeric_limits<double>::infinity();

double largest(const std::vector<double>& b) {
  double result = 0;
  for (const double x : b) result = std::max(result, std::fabs(x));
  return result;
}

}  // namespace

BoxChart chart_of(const Box<3>& box) {
  return {centered(box.lo[0], box.hi[0]), centered(box.lo[1], box.hi[1]),
          centered(box.lo[2], box.hi[2])};
}

namespace {

const FilteredInclusion<3>::Local& local_of(const FilteredInclusion<3>& f, const Box<3>& box,
                                            Kernel& kernel) {
  const BoxChart chart = chart_of(box);
  return f.local({chart[0].center, chart[1].center, chart[2].center},
                 {chart[0].half, chart[1].half, chart[2].half}, kernel);
}

}  // namespace

template <int M>
double lower_bound(const NetColumns<M>& nets, const std::array<double, M>& weights,
                   const std::array<double, M>& deviation) {
  // Each of M terms passes a product and at most M - 1 sums.
  double slack = kTiny;
  for (int i = 0; i < M; ++i) {
    const double weight = std::fabs(weights[i]);
    slack += weight * (nets.radius[i] + 1.01 * (M + 1) * kUnit * nets.largest[i]) +
             deviation[i] * (nets.largest[i] + nets.radius[i]);
  }
  if (!std::isfinite(slack)) return -kInfinite;
  double least = kInfinite;
  for (int k = 0; k < nets.count(); ++k) {
    double sum = weights[0] * nets.columns[0][k];
    for (int i = 1; i < M; ++i) sum += weights[i] * nets.columns[i][k];
    least = sum < least ? sum : least;
  }
  return round_down(least - slack * kUp);
}

template double lower_bound<5>(const NetColumns<5>&, const std::array<double, 5>&,
                               const std::array<double, 5>&);

void field_columns(const Bernstein<3>& net, NetColumns<5>* columns) {
  const int n = net.degree[0], m = n + 1;
  const std::size_t count = net.b.size();
  auto& [x, y, z, euler, value] = columns->columns;
  value = net.b;
  euler.assign(count, 0.0);
  int inner = static_cast<int>(count);
  for (std::vector<double>* partial : {&x, &y, &z}) {
    partial->resize(count);
    inner /= m;
    // d/ds has the coefficients (P + Q) / 2, and s d/ds (P - Q) / 2, of degree n:
    // P_j = j (b_j - b_(j-1)), Q_j = (n - j) (b_(j+1) - b_j).
    for (std::size_t block = 0; block < count; block += static_cast<std::size_t>(m * inner)) {
      for (int j = 0; j <= n; ++j) {
        const std::size_t at = block + static_cast<std::size_t>(j * inner);
        const double* b = net.b.data() + at;
        double* d = partial->data() + at;
        double* e = euler.data() + at;
        const int below = j > 0 ? inner : 0, above = j < n ? inner : 0;
        const double p = 0.5 * j, q = 0.5 * (n - j);
        for (int i = 0; i < inner; ++i) {
          const double lower = p * (b[i] - b[i - below]), upper = q * (b[i + above] - b[i]);
          d[i] = lower + upper;
          e[i] += lower - upper;
        }
      }
    }
  }
  for (int i = 0; i < 5; ++i) columns->largest[i] = largest(columns->columns[i]);
  const double size = columns->largest[4];
  for (int i = 0; i < 3; ++i)
    columns->radius[i] = (1.01 * n * (net.radius + 3 * kUnit * size) + kTiny) * kUp;
  columns->radius[3] = (1.01 * n * (3 * net.radius + 16 * kUnit * size) + kTiny) * kUp;
  columns->radius[4] = net.radius;
}

void field_columns(const FilteredInclusion<3>& f, const Box<3>& box, Kernel& kernel,
                   NetColumns<5>* columns) {
  thread_local Bernstein<3> net;
  f.expand(box, f.degree(), Kernel::kDoubleBits, kernel, &net);
  field_columns(net, columns);
  const auto& local = local_of(f, box, kernel);
  // What the net lacks but for the rest is its rounding errors, which field_columns amplifies.
  const double rounding = (net.radius - local.model.error) * kUp + kUnit * net.radius;
  const double n = 1.01 * f.degree(), size = columns->largest[4];
  double sum = 16 * n * kUnit * size;
  for (int i = 0; i < 3; ++i) {
    columns->radius[i] = (local.slope_error[i] + n * (rounding + 3 * kUnit * size) + kTiny) * kUp;
    sum += columns->radius[i];
  }
  columns->radius[3] = sum * kUp;
}

namespace {

/// Weights of the columns, and how far they may be from what they stand for.
struct Weights {
  std::array<double, 5> weight{};
  std::array<double, 5> deviation{};
};

Weights graph_weights(const BoxChart& chart, const GraphCertificate& c) {
  Weights w;
  for (int i = 0; i < 3; ++i) {
    // V_i / half_i at the chart's centre: at most three roundings a term, and the quotient.
    const double moved = c.spread * (chart[i].center - c.center[i]);
    w.weight[i] = (c.direction[i] + moved) / chart[i].half;
    w.deviation[i] =
        0x1p-50 * (std::fabs(c.direction[i]) + std::fabs(moved) + kTiny) / chart[i].half + kTiny;
  }
  w.weight[3] = c.spread;
  w.weight[4] = c.multiplier;
  return w;
}

}  // namespace

bool is_graph(const NetColumns<5>& columns, const BoxChart& chart,
              const GraphCertificate& certificate) {
  const Weights w = graph_weights(chart, certificate);
  return lower_bound<5>(columns, w.weight, w.deviation) > 0;
}

namespace {

/// A polynomial in Taylor form on a box: dense, degree n in every variable, of total degree n.
struct LocalTaylor {
  int n = 0;
  std::vector<double> c;
  double error = 0;        ///< bounds what the polynomial lacks
  Point<3> slope_error{};  ///< bounds what its partial derivatives lack
};

constexpr int kExpressionDegree = 6;

int taylor_degree(const FilteredFunction<3>& f) {
  return f.is_expression() ? kExpressionDegree : f.degree();
}

bool expand(const FilteredFunction<3>& f, const Box<3>& box, int bits, Kernel& kernel,
            LocalTaylor* taylor) {
  taylor->n = taylor_degree(f);
  if (f.is_polynomial()) {
    auto expansion = f.polynomial().taylor(box, bits, kernel);
    taylor->c = std::move(expansion.coefficients);
    taylor->error = expansion.error;
    taylor->slope_error.fill(taylor->n * expansion.error);
    return std::isfinite(taylor->error);
  }
  const BoxChart chart = chart_of(box);
  const auto* local = f.is_inclusion() ? &local_of(f.inclusion(), box, kernel) : nullptr;
  const TaylorModel<3, double>& model =
      local ? local->model
            : f.expression().model({chart[0].center, chart[1].center, chart[2].center},
                                   {chart[0].half, chart[1].half, chart[2].half}, taylor->n, bits,
                                   kernel);
  if (!model.exists()) return false;
  const int m = taylor->n + 1;
  taylor->c.assign(static_cast<std::size_t>(m * m * m), 0.0);
  for (int i = 0; i <= model.span[0]; ++i)
    for (int j = 0; j <= model.span[1]; ++j)
      for (int k = 0; k <= std::min(model.span[2], model.degree - i - j); ++k)
        taylor->c[static_cast<std::size_t>((i * m + j) * m + k)] =
            model.c[static_cast<std::size_t>((i * model.stride + j) * model.stride + k)];
  taylor->error = model.error;
  if (local)
    taylor->slope_error = local->slope_error;
  else
    taylor->slope_error.fill(TaylorModel<3, double>::kSlope * model.error);
  return true;
}

/// The derivative along an axis, of degree n in every variable and total degree n - 1.
void differentiate(const LocalTaylor& f, int axis, LocalTaylor* out) {
  const int m = f.n + 1;
  const int stride = axis == 0 ? m * m : axis == 1 ? m : 1;
  out->n = f.n;
  out->c.assign(f.c.size(), 0.0);
  double sum = 0;
  for (int k = 0; k < static_cast<int>(f.c.size()); ++k) {
    const int exponent = (k / stride) % m;
    if (exponent == 0) continue;
    const double c = exponent * f.c[static_cast<std::size_t>(k)];
    out->c[static_cast<std::size_t>(k - stride)] = c;
    sum += std::fabs(c);
  }
  out->error = (f.slope_error[axis] + kUnit * sum) * kUp + kTiny;
}

double norm(const LocalTaylor& f) {
  double sum = 0;
  for (const double c : f.c) sum += std::fabs(c);
  return sum * (1 + 0x1p-30);
}

/// Adds sign a b, a and b of total degrees a.n - 1 and b.n - 1, to r, which has room for it.
void add_product(double sign, const LocalTaylor& a, const LocalTaylor& b, LocalTaylor* r) {
  const int ma = a.n + 1, mb = b.n + 1, mr = r->n + 1;
  for (int i = 0; i < a.n; ++i)
    for (int j = 0; i + j < a.n; ++j)
      for (int k = 0; i + j + k < a.n; ++k) {
        const double factor = sign * a.c[static_cast<std::size_t>((i * ma + j) * ma + k)];
        if (factor == 0) continue;
        for (int p = 0; p < b.n; ++p)
          for (int q = 0; p + q < b.n; ++q) {
            const double* from = &b.c[static_cast<std::size_t>((p * mb + q) * mb)];
            double* to = &r->c[static_cast<std::size_t>(((i + p) * mr + j + q) * mr + k)];
            for (int l = 0; p + q + l < b.n; ++l) to[l] += factor * from[l];
          }
      }
}

/// The columns' entry from a Taylor form.
void to_column(const LocalTaylor& f, int net_degree, int i, NetColumns<5>* columns) {
  thread_local Bernstein<3> net;
  taylor_to_bernstein<3>(f.c, f.n, f.error, net_degree, &net);
  columns->columns[i] = net.b;
  columns->radius[i] = net.radius;
  columns->largest[i] = largest(net.b);
}

int product_degree(const FilteredFunction<3>& f, const FilteredFunction<3>& g) {
  return taylor_degree(f) + taylor_degree(g) - 2;
}

}  // namespace

bool pair_columns(const FilteredFunction<3>& f, const FilteredFunction<3>& g, const Box<3>& box,
                  int bits, Kernel& kernel, NetColumns<5>* columns) {
  thread_local LocalTaylor of_f, of_g, product;
  thread_local std::array<LocalTaylor, 3> df, dg;
  if (!expand(f, box, bits, kernel, &of_f) || !expand(g, box, bits, kernel, &of_g)) return false;
  std::array<double, 3> norm_f, norm_g;
  for (int i = 0; i < 3; ++i) {
    differentiate(of_f, i, &df[i]);
    differentiate(of_g, i, &dg[i]);
    norm_f[i] = norm(df[i]);
    norm_g[i] = norm(dg[i]);
  }
  const int net_degree = std::max({product_degree(f, g), of_f.n, of_g.n});
  // A coefficient is a sum of at most two products for every term of the shorter factor.
  const int shorter = std::min(of_f.n, of_g.n);
  const double roundings = 2.0 + shorter * (shorter + 1) * (shorter + 2) / 3.0;
  product.n = product_degree(f, g);
  const auto m = static_cast<std::size_t>(product.n + 1);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    product.c.assign(m * m * m, 0.0);
    add_product(1, df[j], dg[k], &product);
    add_product(-1, df[k], dg[j], &product);
    const auto error_of = [&](int a, int b) {
      return norm_f[a] * dg[b].error + df[a].error * norm_g[b] + df[a].error * dg[b].error +
             1.01 * roundings * kUnit * norm_f[a] * norm_g[b];
    };
    product.error = (error_of(j, k) + error_of(k, j)) * kUp + kTiny;
    to_column(product, net_degree, i, columns);
  }
  to_column(of_f, net_degree, 3, columns);
  to_column(of_g, net_degree, 4, columns);
  return true;
}

bool is_monotone(const NetColumns<5>& columns, const BoxChart& chart,
                 const PairCertificate& certificate, double scale_f, double scale_g) {
  // (grad f x grad g)_i is the columns' entry i over half_j half_k, times both scales.
  Weights w;
  for (int i = 0; i < 3; ++i) {
    const double area = chart[(i + 1) % 3].half * chart[(i + 2) % 3].half;
    w.weight[i] = certificate.direction[i] / area;
    w.deviation[i] = 0x1p-50 * std::fabs(w.weight[i]) + kTiny;
    if (!(area > 0x1p-900)) return false;
  }
  w.weight[3] = certificate.alpha / scale_g;
  w.weight[4] = certificate.beta / scale_f;
  for (int i = 3; i < 5; ++i) w.deviation[i] = 0x1p-50 * std::fabs(w.weight[i]) + kTiny;
  const bool scaled = std::isnormal(scale_f) && std::isnormal(scale_g);
  return scaled && lower_bound<5>(columns, w.weight, w.deviation) > 0;
}

bool is_apart(const Bernstein<3>& f, const Bernstein<3>& g, const PairCertificate& certificate,
              double scale_f, double scale_g) {
  // Scales are powers of two: products with them are exact, unless they underflow.
  const double alpha = certificate.alpha * scale_f, beta = certificate.beta * scale_g;
  if (!std::isnormal(scale_f) || !std::isnormal(scale_g)) return false;
  if ((alpha != 0 && !std::isnormal(alpha)) || (beta != 0 && !std::isnormal(beta))) return false;
  thread_local Bernstein<3> sum;
  combine(alpha, f, beta, g, &sum);
  return sign_on_cube(sum) == Sign::Positive;
}

namespace {

/// proves(bits, &radius) with more and more bits, as long as what it says of the error shrinks.
template <class Proves>
bool climb(Kernel& kernel, Proves proves) {
  double before = kInfinite;
  for (int bits = kernel.start_bits; bits > 0; bits = kernel.next(bits)) {
    double radius = kInfinite;
    if (proves(bits, &radius)) {
      kernel.count(bits);
      return true;
    }
    if (bits > Kernel::kDoubleBits && !(radius < 0.5 * before)) break;
    before = radius;
  }
  return false;
}

}  // namespace

bool holds(const AbsenceCertificate& certificate, const FilteredFunction<3>& f, Kernel& kernel) {
  return sign_on_box(f, certificate.box, kernel) == certificate.sign;
}

bool holds(const GraphCertificate& certificate, const FilteredFunction<3>& f, Kernel& kernel) {
  const BoxChart chart = chart_of(certificate.box);
  Bernstein<3> net;
  NetColumns<5> columns;
  return climb(kernel, [&](int bits, double* radius) {
    f.expand(certificate.box, f.degree(), bits, kernel, &net);
    *radius = net.radius;
    if (f.is_inclusion())
      field_columns(f.inclusion(), certificate.box, kernel, &columns);
    else
      field_columns(net, &columns);
    return is_graph(columns, chart, certificate);
  });
}

bool holds(const PairCertificate& certificate, const FilteredFunction<3>& f,
           const FilteredFunction<3>& g, Kernel& kernel) {
  if (certificate.kind == PairCertificate::Kind::Apart) {
    Bernstein<3> net_f, net_g;
    const int degree = std::max(f.degree(), g.degree());
    return climb(kernel, [&](int bits, double* radius) {
      f.expand(certificate.box, degree, bits, kernel, &net_f);
      g.expand(certificate.box, degree, bits, kernel, &net_g);
      *radius = std::max(net_f.radius, net_g.radius);
      return is_apart(net_f, net_g, certificate, f.scale(), g.scale());
    });
  }
  const BoxChart chart = chart_of(certificate.box);
  NetColumns<5> columns;
  return certificate.kind == PairCertificate::Kind::Local &&
         climb(kernel, [&](int bits, double* radius) {
           if (!pair_columns(f, g, certificate.box, bits, kernel, &columns)) return false;
           *radius = *std::max_element(columns.radius.begin(), columns.radius.end());
           return is_monotone(columns, chart, certificate, f.scale(), g.scale());
         });
}

}  // namespace encase
