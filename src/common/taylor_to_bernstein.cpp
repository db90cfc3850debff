// SPDX-License-Identifier: MIT
#include "common/taylor_to_bernstein.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include "common/rounding_bound.hpp"
#include "encase/number.hpp"
#include "encase/polynomial.hpp"

namespace encase {
namespace {

/// Rows k, columns j: the Bernstein coefficients of s^k on [-1,1] in degree n. The blossom of s^k
/// at j ones and n - j minus ones: an average of products of signs, hence at most 1 in absolute
/// value.
std::vector<double> make_conversion(int n) {
  std::vector<double> table(static_cast<std::size_t>(n + 1) * (n + 1));
  Integer chosen, p, q;
  for (int k = 0; k <= n; ++k) {
    mpz_bin_uiui(chosen.get_mpz_t(), n, k);
    for (int j = 0; j <= n; ++j) {
      Integer sum = 0;
      for (int i = std::max(0, k - (n - j)); i <= std::min(j, k); ++i) {
        mpz_bin_uiui(p.get_mpz_t(), j, i);
        mpz_bin_uiui(q.get_mpz_t(), n - j, k - i);
        if ((k - i) % 2)
          sum -= p * q;
        else
          sum += p * q;
      }
      Rational entry(sum, chosen);
      entry.canonicalize();
      table[static_cast<std::size_t>(k) * (n + 1) + j] = entry.get_d();
    }
  }
  return table;
}

const std::vector<double>& conversion(int n) {
  static std::array<std::once_flag, 2 * kMaxDegree + 2> once;
  static std::array<std::vector<double>, 2 * kMaxDegree + 2> tables;
  std::call_once(once[n], [n] { tables[n] = make_conversion(n); });
  return tables[n];
}

}  // namespace

template <int K>
void taylor_to_bernstein(const std::vector<double>& taylor, int n, double taylor_error,
                         int net_degree, Bernstein<K>* net) {
  double sum = 0;
  for (double a : taylor) sum += std::fabs(a);
  const double radius = 1.0000001 * taylor_error +
                        gamma(K * (n + 4) + static_cast<int>(taylor.size()) / 64, 53) * sum;
  net->degree.fill(net_degree);
  const std::vector<double>& table = conversion(net_degree);
  const int m = net_degree + 1;
  thread_local std::vector<double> scratch;
  net->b = taylor;
  // From the last variable to the first: [outer: powers][n + 1][inner: already converted].
  int inner = 1, outer = 1;
  for (int i = 1; i < K; ++i) outer *= n + 1;
  for (int axis = K - 1; axis >= 0; --axis) {
    scratch.assign(static_cast<std::size_t>(outer) * m * inner, 0.0);
    for (int o = 0; o < outer; ++o) {
      int used = 0;
      for (int rest = o; rest > 0; rest /= n + 1) used += rest % (n + 1);
      for (int k = 0; k <= n - used; ++k) {
        const double* row = &table[static_cast<std::size_t>(k) * m];
        const double* from = &net->b[(static_cast<std::size_t>(o) * (n + 1) + k) * inner];
        double* to = &scratch[static_cast<std::size_t>(o) * m * inner];
        if (inner == 1) {
          const double a = *from;
          for (int j = 0; j < m; ++j) to[j] += row[j] * a;
        } else {
          for (int j = 0; j < m; ++j)
            for (int i = 0; i < inner; ++i) to[j * inner + i] += row[j] * from[i];
        }
      }
    }
    net->b.swap(scratch);
    inner *= m;
    outer /= n + 1;
  }
  net->radius = radius;
  // Far from overflow, or nothing is claimed.
  if (!std::isfinite(radius) || !(sum < 0x1p900)) {
    net->b.assign(net->b.size(), 0.0);
    net->radius = std::numeric_limits<double>::infinity();
  }
}

template void taylor_to_bernstein<1>(const std::vector<double>&, int, double, int, Bernstein<1>*);
template void taylor_to_bernstein<2>(const std::vector<double>&, int, double, int, Bernstein<2>*);
template void taylor_to_bernstein<3>(const std::vector<double>&, int, double, int, Bernstein<3>*);

}  // namespace encase
