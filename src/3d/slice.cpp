// SPDX-License-Identifier: MIT
#include "encase/slice.hpp"

#include <algorithm>
#include <iterator>
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
  if (function.is_inclusion()) return std::nullopt;
  const Expression& f = function.expression();
  if (f.uses(0) || f.uses(1)) return std::nullopt;
  return ExpressionProgram<2>(f).sign_at({0, 0}, kernel);
}

/// What a plane has of surfaces and of a region.
struct OnPlane {
  Region region;
  std::vector<NamedCurve> curves;
  std::vector<int> surface_of;  ///< of every curve
  std::vector<int> containing;
};

Result<OnPlane> restrict(const PlaneChart& chart, const std::vector<NamedSurface>& surfaces,
                         const Polyhedron& region, int max_bits) {
  auto polygon = chart.restrict(region);
  if (!polygon) return polygon.error();
  OnPlane result{std::move(polygon).value(), {}, {}, {}};
  Kernel kernel;
  kernel.max_bits = max_bits;
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    Function<2> function = chart.restrict(surfaces[k].function);
    if (const auto sign = constant_sign(function, kernel)) {
      if (*sign == PointSign::Zero) result.containing.push_back(static_cast<int>(k));
      if (*sign == PointSign::Unknown)
        return Error{Error::Code::Undecided, "whether surface '" + surfaces[k].name +
                                                 "' contains the plane cannot be told"};
      continue;
    }
    result.curves.push_back({surfaces[k].name, std::move(function)});
    result.surface_of.push_back(static_cast<int>(k));
  }
  return result;
}

}  // namespace

Result<Slice> slice(const std::vector<NamedSurface>& surfaces, const Polyhedron& region,
                    const std::array<Rational, 4>& plane, const EncaseOptions& options) {
  if (plane[0] == 0 && plane[1] == 0 && plane[2] == 0)
    return Error{Error::Code::BadInput, "the plane has no normal: a, b and c are zero"};
  if (options.perturbation > 0)
    return Error{Error::Code::BadInput, "slices are not perturbed: their surfaces would not be"};
  const PlaneChart chart(plane);
  auto on_plane = restrict(chart, surfaces, region, options.max_bits);
  if (!on_plane) return on_plane.error();
  auto& [polygon, curves, surface_of, containing] = on_plane.value();
  auto encasement = encase(curves, polygon, options);
  if (!encasement) return encasement.error();
  return Slice{{surfaces, region, chart, std::move(surface_of), std::move(containing)},
               std::move(encasement).value()};
}

Verification verify_source(const SliceSource& source, const Encasement& e,
                           const VerifyOptions& options) {
  Verification result;
  const auto require = [&](bool holds, const char* objection) {
    if (holds)
      ++result.claims;
    else
      result.objections.emplace_back(objection);
  };
  const auto expected = restrict(source.chart, source.surfaces, source.region, options.max_bits);
  require(expected.ok(), "The plane, the surfaces and the region have no slice.");
  if (!expected) return result;
  const auto& [region, curves, surface_of, containing] = expected.value();
  require(e.region.corners == region.corners && !e.region.plane,
          "The region of the slice is not the plane's part of the region.");
  require(
      source.surface_of == surface_of && source.containing == containing,
      "The surfaces that have a curve on the plane, or contain it, are not those of the slice.");
  bool same = e.input.size() == curves.size() && e.perturbation == 0;
  for (std::size_t k = 0; same && k < curves.size(); ++k)
    same = e.input[k].function == curves[k].function && e.input[k].name == curves[k].name;
  require(same, "The curves of the slice are not those of the surfaces on the plane.");
  return result;
}

Verification verify(const Slice& slice, const VerifyOptions& options) {
  Verification result = verify(slice.encasement, options);
  Verification source = verify_source(slice.source, slice.encasement, options);
  result.claims += source.claims;
  std::move(source.objections.begin(), source.objections.end(),
            std::back_inserter(result.objections));
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
