// SPDX-License-Identifier: MIT
#include "3d/separation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace encase {

namespace {

constexpr int kMaxSteps = 60;

template <int M>
double dot(const std::array<double, M>& a, const std::array<double, M>& b) {
  double sum = 0;
  for (int i = 0; i < M; ++i) sum += a[i] * b[i];
  return sum;
}

/// The vectors with w . v for each of them.
template <int M>
class Projections {
 public:
  Projections(const VectorList<M>& components, int count, const std::array<double, M>& scale)
      : components_(components), count_(count), scale_(scale), values_(buffer()) {
    values_.resize(static_cast<std::size_t>(count));
  }

  std::array<double, M> vector(int k) const {
    std::array<double, M> v;
    for (int i = 0; i < M; ++i) v[i] = scale_[i] * components_[i][k];
    return v;
  }
  /// The weights of the unscaled vectors.
  std::array<double, M> scaled(std::array<double, M> w) const {
    for (int i = 0; i < M; ++i) w[i] *= scale_[i];
    return w;
  }
  std::array<double, M> mean() const {
    std::array<double, M> v;
    for (int i = 0; i < M; ++i) {
      double sum = 0;
      for (int k = 0; k < count_; ++k) sum += components_[i][k];
      v[i] = scale_[i] * sum / count_;
    }
    return v;
  }
  /// The vector for which w . v is least, and that value.
  std::pair<int, double> least(const std::array<double, M>& w) {
    const std::array<double, M> weights = scaled(w);
    double* values = values_.data();
    for (int k = 0; k < count_; ++k) {
      double sum = weights[0] * components_[0][k];
      for (int i = 1; i < M; ++i) sum += weights[i] * components_[i][k];
      values[k] = sum;
    }
    // (Four independent chains of comparisons; then where the least one is.)
    double least[4] = {values[0], values[0], values[0], values[0]};
    int k = 0;
    for (; k + 4 <= count_; k += 4)
      for (int j = 0; j < 4; ++j) least[j] = values[k + j] < least[j] ? values[k + j] : least[j];
    for (; k < count_; ++k) least[0] = values[k] < least[0] ? values[k] : least[0];
    const double value = *std::min_element(least, least + 4);
    for (k = 0; k + 1 < count_ && values[k] != value;) ++k;
    return {k, value};
  }

 private:
  static std::vector<double>& buffer() {
    thread_local std::vector<double> values;
    return values;
  }
  const VectorList<M>& components_;
  int count_;
  const std::array<double, M>& scale_;
  std::vector<double>& values_;
};

/// Affinely independent vectors, and the weights of a point of their convex hull.
template <int M>
struct Corral {
  int size = 0;
  std::array<int, M + 1> index{};
  std::array<std::array<double, M>, M + 1> vectors{};
  std::array<double, M + 1> weight{};

  std::array<double, M> point() const {
    std::array<double, M> p{};
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < M; ++i) p[i] += weight[j] * vectors[j][i];
    return p;
  }
  bool holds(int k) const {
    return std::find(index.begin(), index.begin() + size, k) != index.begin() + size;
  }
  void add(int k, const std::array<double, M>& v) {
    index[size] = k;
    vectors[size] = v;
    weight[size++] = 0;
  }
  void drop(int j) {
    --size;
    index[j] = index[size];
    vectors[j] = vectors[size];
    weight[j] = weight[size];
  }

  /// The weights of the point of the affine hull that is nearest to the origin: the solution of
  /// (1 + v_i . v_j) y = 1, scaled to the sum one (1: a number of the vectors' size).
  bool nearest(std::array<double, M + 1>* y) const {
    double a[M + 1][M + 2];
    double unit = 0;
    for (int i = 0; i < size; ++i) unit = std::max(unit, dot<M>(vectors[i], vectors[i]));
    if (!(unit > 0)) return false;
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) a[i][j] = 1 + dot<M>(vectors[i], vectors[j]) / unit;
      a[i][size] = 1;
    }
    for (int c = 0; c < size; ++c) {
      int pivot = c;
      for (int i = c + 1; i < size; ++i)
        if (std::fabs(a[i][c]) > std::fabs(a[pivot][c])) pivot = i;
      if (!(std::fabs(a[pivot][c]) > 1e-14)) return false;
      if (pivot != c) std::swap(a[pivot], a[c]);
      for (int i = c + 1; i < size; ++i) {
        const double factor = a[i][c] / a[c][c];
        for (int j = c; j <= size; ++j) a[i][j] -= factor * a[c][j];
      }
    }
    double sum = 0;
    for (int c = size - 1; c >= 0; --c) {
      double value = a[c][size];
      for (int j = c + 1; j < size; ++j) value -= a[c][j] * (*y)[j];
      (*y)[c] = value / a[c][c];
      sum += (*y)[c];
    }
    if (!(std::fabs(sum) > 0)) return false;
    for (int c = 0; c < size; ++c) (*y)[c] /= sum;
    return true;
  }

  /// Moves to the nearest point of the convex hull of some of the vectors; drops the others.
  bool settle() {
    while (size > 0) {
      std::array<double, M + 1> y;
      if (!nearest(&y)) return false;
      double step = 1;
      int leaving = -1;
      for (int j = 0; j < size; ++j) {
        if (y[j] > 1e-12) continue;
        const double theta = weight[j] / std::max(weight[j] - y[j], 1e-300);
        if (leaving < 0 || theta < step) {
          step = std::min(theta, 1.0);
          leaving = j;
        }
      }
      for (int j = 0; j < size; ++j) weight[j] += step * (y[j] - weight[j]);
      if (leaving < 0) return true;
      drop(leaving);
    }
    return false;
  }
};

}  // namespace

template <int M>
std::optional<std::array<double, M>> separate(const VectorList<M>& components, int count,
                                              const std::array<double, M>& scale) {
  Projections<M> all(components, count, scale);
  std::array<double, M> w = all.mean(), best{};
  double best_margin = 0, size = 0;
  Corral<M> corral;
  for (int step = 0; step < kMaxSteps; ++step) {
    const double norm = dot<M>(w, w);
    size = std::max(size, norm);
    if (!(norm > 1e-24 * size) || !std::isfinite(norm)) break;
    const auto [k, least] = all.least(w);
    if (least > best_margin * std::sqrt(norm)) {
      best_margin = least / std::sqrt(norm);
      best = w;
    }
    // No other point is nearer than least / |w|.
    if (step > 0 && least > 0.5 * norm) break;
    if (step > 0 && (corral.holds(k) || corral.size > M)) break;
    corral.add(k, all.vector(k));
    if (corral.size == 1) corral.weight[0] = 1;
    if (!corral.settle()) break;
    w = corral.point();
  }
  if (!(best_margin > 0)) return std::nullopt;
  return all.scaled(best);
}

template std::optional<std::array<double, 2>> separate<2>(const VectorList<2>&, int,
                                                          const std::array<double, 2>&);
template std::optional<std::array<double, 4>> separate<4>(const VectorList<4>&, int,
                                                          const std::array<double, 4>&);
template std::optional<std::array<double, 5>> separate<5>(const VectorList<5>&, int,
                                                          const std::array<double, 5>&);

}  // namespace encase
