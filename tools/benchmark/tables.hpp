// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "pair_figures.hpp"
#include "table.hpp"

namespace encase::benchmark {

/// What the benchmark was asked to measure.
struct Request {
  std::vector<int> degrees{2, 4, 6, 8, 10, 12, 15, 20};
  std::vector<std::uint64_t> seeds{1, 2, 3};
  int cgal_degrees = 12;    ///< CGAL is run up to this degree
  int most_curves = 10000;  ///< what has more curves is left out
  Repetitions repetitions;
  std::string curves_directory;  ///< of the .curves files
  std::string caps_directory;    ///< of those of CAPS, table 1
};

/// Times, in floors where there is no CGAL to compare with; figures are medians over the seeds.
Table floors_table(RandomPairs& pairs, const Request& request);
/// Cells, and what was done to find them.
Table work_table(RandomPairs& pairs, const Request& request);
/// Times beside CGAL's; the ratios are medians over the seeds.
Table cgal_table(RandomPairs& pairs, const Request& request);
/// Every random pair with all that was measured of it so far; not printed.
Table every_pair_table(RandomPairs& pairs, const Request& request);

/// The files of the directory of curves.
Table files_table(const Request& request);
/// Curves that nearly touch, at a point or along their whole length.
Table near_tangency_table(const Request& request);

/// Ever smaller squares around a crossing (thesis 5.3); figures are medians over the seeds.
Table locality_table(const Request& request);
/// The time per crossing against the degree, and the exponent that fits it.
Table growth_table(RandomPairs& pairs, const Request& request);
/// The most memory a process needs for one encasement. A process that has used much memory before
/// cannot tell: to be called first.
Table memory_table(const Request& request);

/// The seven classes of CAPS, table 1, re-created: sizes and times beside the published ones.
Table caps_table(const Request& request);

/// The common points of three surfaces, and the critical points of two, up to degree 6; times are
/// medians over the seeds.
Table space_table(const Request& request);
Table surfaces_table(const Request& request);

/// Circles that cross in up to half a million points: count, time and memory.
Table circles_table(const Request& request);
/// Many curves with about one branch each in a small region.
Table arcs_table(const Request& request);
/// Quintics in the whole plane, beside CGAL's arrangements.
Table arrangements_table(const Request& request);

/// A square of the given side around a crossing, moved into [-1,1]^2 where it would leave it.
Region square_around(const Point<2>& crossing, double side);
/// The crossing nearest to the origin.
Point<2> central_crossing(const Encasement& encasement);
/// y = factor x^exponent.
struct PowerLaw {
  double factor, exponent;
};
/// The one that fits best, by least squares of the logarithms. At least two points.
PowerLaw fitted_power_law(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace encase::benchmark
