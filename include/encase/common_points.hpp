// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "encase/cover.hpp"
#include "encase/encasement.hpp"
#include "encase/polyhedron.hpp"
#include "encase/result.hpp"
#include "encase/slice.hpp"
#include "encase/verify.hpp"

namespace encase {

/// A simple common point of three surfaces, their tangent planes in general position. The closed
/// box holds exactly one common point of them, in its interior.
struct CommonPoint {
  Box<3> box;
  Point<3> point{};      ///< the common point, each coordinate rounded as `rounded` says
  bool rounded = false;  ///< proved: `point` is the correctly rounded common point
  Location location = Location::Inside;
};

/// All common points of three surfaces in a polyhedron, with the proof that none is missing: the
/// box `root`, which contains the region, is subdivided, and in every leaf
///   - kExcluded: the surfaces have no common point;
///   - kOutside: the leaf lies outside a side of the region;
///   - k >= 0: a box that contains the leaf and point k's box holds at most one common point;
///   - kUnresolved: nothing is claimed; the leaf lies in a box of `degenerate` or `undecided`.
struct CommonPoints {
  Outcome outcome = Outcome::Undecided;
  std::array<NamedSurface, 3> surfaces;
  Polyhedron region;
  std::vector<CommonPoint> points;  ///< those outside the region are not all that are there
  Box<3> root;
  std::vector<int> tokens;
  /// Boxes that resist at the precision cap: the surfaces touch there, have a curve in common, or
  /// nearly so.
  std::vector<Box<3>> degenerate;
  /// Boxes for which the budget ran out, and those of points the location of which is open.
  std::vector<Box<3>> undecided;
  int boxes = 0;  ///< visited
  double seconds = 0;
};

struct CommonPointsOptions {
  int max_boxes = 200000;   ///< of the subdivision
  double max_seconds = 60;  ///< CPU seconds
  int max_bits = 848;       ///< precision cap of the MPFR rung
  int start_bits = 53;      ///< 53: doubles first; more: MPFR from there
};

/// Finds them. BadInput for a zero or constant polynomial, a degree above kMaxDegree, an expression
/// without variables. Every other input gets an answer, of the three kinds of `Outcome`.
/// Deterministic, unless seconds run out. Cost: about a hundred boxes a point, each O(degree^4)
/// operations.
Result<CommonPoints> common_points(const std::array<NamedSurface, 3>& surfaces,
                                   const Polyhedron& region,
                                   const CommonPointsOptions& options = {});

/// Proves all of it again from the surfaces and the region, without the search.
Verification verify(const CommonPoints& points, const VerifyOptions& options = {});

}  // namespace encase
