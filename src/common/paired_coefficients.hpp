// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "encase/geometry.hpp"

/// Polynomials whose coefficients are sums of two doubles: what is done with them before tiles are
/// made, and precise values. docs/error-bounds.md, section 10, derives what is lost.
namespace encase {

struct alignas(64) EightDoubles {
  double x[8];
};

/// Numbers high + low: rows of coefficients, row i those of the power i of one variable, `stride`
/// apart and as many (up to 7 more than there are). Zero beyond the total degree, within blocks of
/// eight rows and columns. The memory is somebody else's.
struct PairedCoefficients {
  EightDoubles* memory = nullptr;
  int stride = 0;

  static int stride_for(int degree) { return (degree / 8 + 1) * 8; }
  /// In eights.
  static std::size_t size_for(int degree) {
    const auto stride = static_cast<std::size_t>(stride_for(degree));
    return stride * stride / 4;
  }
  double* high() const { return memory->x; }
  double* low() const { return high() + static_cast<std::size_t>(stride) * stride; }
};

/// p(s) -> p(origin + half s) in the variable of the rows.
void shift_and_scale(const PairedCoefficients& p, int degree, double origin, double half);

/// Rows become columns.
void turn(const PairedCoefficients& from, int degree, const PairedCoefficients& to);

/// Makes `low` what `high` lacks of the rounded sum of both. Returns the largest |high|.
double normalize(const PairedCoefficients& p, int degree);

/// p((t - 1) / 2) and p((t + 1) / 2) in the variable of the rows (`turned`: of the columns, which
/// become rows), for degrees up to kMaxHalved. `largest`: |high| of `from`; then of both halves.
/// `slices`: room for 3/2 of what `from` takes. False if numbers are too large or small.
inline constexpr int kMaxHalved = 30;
bool halve_rows(const PairedCoefficients& from, bool turned, double largest, int degree,
                double* slices, const PairedCoefficients& lower, const PairedCoefficients& upper,
                double* largest_of_both);

/// What that loses at most, if the coefficients' absolute values add up to `sum`.
double halving_loss(int degree, double largest, double sum);

/// The same of the high parts alone, in doubles: low parts are neither read nor written.
void halve_rows_in_doubles(const PairedCoefficients& from, bool turned, int degree,
                           const PairedCoefficients& lower, const PairedCoefficients& upper);

/// What that loses at most, and the low parts of `from` where high parts are rounded sums of both.
double halving_loss_in_doubles(int degree, double sum);

/// What sums of two doubles do not hold of the roundings of a shift or a value, relative to the sum
/// of absolute values, in units of the square of the unit roundoff.
double unheld_roundings(int degree);

/// The sum of the coefficients times x^i y^j.
double precise_value(const PairedCoefficients& p, int degree, double x, double y);

/// The same at eight points; x, y and the result aligned to 64 bytes.
void precise_values(const PairedCoefficients& p, int degree, const double* x, const double* y,
                    double* result);

}  // namespace encase
