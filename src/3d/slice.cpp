// SPDX-License-Identifier: MIT
#include "encase/slice.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "common/expression_program.hpp"

namespace encase {

namespace {

/// The sign of a function that is constant, or Unknown or NoValue; nothing if it has variables.
std::optional<PointSign> constant_sign(const Function<2>& function, Kernel& kernel) {
  if (function.is_polynomial()) {
    if (!function.polynomial().is_constant()) return std::nullopt;
    return function.polynomial().is_zero() ? PointSign::Zero : PointSign::Positive;
  }
  const Expression& f = function.expression();
  if (f.uses(0) || f.uses(1)) return std::nullopt;
  return ExpressionProgram<2>(f).sign_at({0, 0}, kernel);
}

}  // namespace

Result<Slice> slice(const std::vector<NamedSurface>& surfaces, const Polyhedron& region,
                    const std::array<Rational, 4>& plane, const EncaseOptions& options) {
  if (plane[0] == 0 && plane[1] == 0 && plane[2] == 0)
    return Error{Error::Code::BadInput, "the plane has no normal: a, b and c are zero"};
  Slice result{PlaneChart(plane), {}, {}, {}};
  auto polygon = result.chart.restrict(region);
  if (!polygon) return polygon.error();
  Kernel kernel;
  kernel.max_bits = options.max_bits;
  std::vector<NamedCurve> curves;
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    Function<2> function = result.chart.restrict(surfaces[k].function);
    if (const auto sign = constant_sign(function, kernel)) {
      if (*sign == PointSign::Zero) result.containing.push_back(static_cast<int>(k));
      if (*sign == PointSign::Unknown)
        return Error{Error::Code::Undecided, "whether surface '" + surfaces[k].name +
                                                 "' contains the plane cannot be told"};
      continue;
    }
    curves.push_back({surfaces[k].name, std::move(function)});
    result.surfaces.push_back(static_cast<int>(k));
  }
  auto encasement = encase(curves, polygon.value(), options);
  if (!encasement) return encasement.error();
  result.encasement = std::move(encasement).value();
  return result;
}

std::vector<std::array<Rational, 4>> parallel_planes(const Polyhedron& region,
                                                     const std::array<Rational, 3>& normal,
                                                     int count) {
  const auto height = [&](const RationalPoint<3>& p) {
    return Rational(normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2]);
  };
  Rational lowest = height(region.corners[0]), highest = lowest;
  for (const RationalPoint<3>& corner : region.corners) {
    lowest = std::min(lowest, height(corner));
    highest = std::max(highest, height(corner));
  }
  std::vector<std::array<Rational, 4>> planes;
  for (int k = 1; k <= count; ++k) {
    const Rational at = lowest + (highest - lowest) * Rational(k) / Rational(count + 1);
    planes.push_back({normal[0], normal[1], normal[2], -at});
  }
  return planes;
}

}  // namespace encase
