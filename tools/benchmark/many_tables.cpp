// SPDX-License-Identifier: MIT
//
// Many curves: circles whose crossings are known in closed form, and random curves as in tables 1
// to 3 of M. Kerber, *On filter methods in CGAL's 2D curved kernel*, 2008.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <random>

#include "cgal_arrangement.hpp"
#include "common/random_polynomials.hpp"
#include "encase/arrangement.hpp"
#include "tables.hpp"

namespace encase::benchmark {
namespace {

constexpr double kMilli = 1e3;

/// What is measured of one encasement and its arrangement.
struct ManyFigures {
  double encasing = 0, arranging = 0;  // CPU seconds
  double arranging_bare = 0;           // without the points on the boundary
  std::int64_t crossings = 0, cells = 0, vertices = 0, edges = 0, faces = 0;
  std::int64_t pairs_met = 0, pairs_isolated = 0, filter_failures = 0;
  bool certified = false, arranged = false;
};

ManyFigures figures_of(const std::vector<NamedCurve>& curves, const Region& region) {
  EncaseOptions options;
  options.max_cells = 10000000;
  options.max_seconds = 10000;
  ManyFigures figures;
  Stopwatch watch;
  const Encasement encasement = encase(curves, region, options).value();
  figures.encasing = watch.lap();
  // (First, and gone before the other one takes memory.)
  figures.arranged = arrange(encasement, {.boundary_points = false}).ok();
  figures.arranging_bare = watch.lap();
  const Result<Arrangement> arrangement = arrange(encasement);
  figures.arranging = watch.lap();
  figures.crossings = std::count_if(encasement.crossings.begin(), encasement.crossings.end(),
                                    [](const auto& c) { return c.location == Location::Inside; });
  figures.cells = static_cast<std::int64_t>(encasement.cells.size());
  figures.pairs_met = encasement.statistics.pairs_met;
  figures.pairs_isolated = encasement.statistics.pairs_isolated;
  figures.filter_failures = encasement.statistics.filter_failures;
  figures.certified = encasement.outcome == Outcome::Certified;
  figures.arranged = figures.arranged && arrangement.ok();
  if (!arrangement.ok()) return figures;
  figures.vertices = static_cast<std::int64_t>(arrangement.value().vertices.size());
  figures.edges = static_cast<std::int64_t>(arrangement.value().edges.size());
  figures.faces = static_cast<std::int64_t>(arrangement.value().faces.size());
  return figures;
}

/// The same, with the times' medians.
ManyFigures median_figures(const std::vector<NamedCurve>& curves, const Region& region,
                           const Repetitions& repetitions) {
  ManyFigures figures;
  std::vector<double> encasing, arranging, arranging_bare;
  time_of(repetitions, [&] {
    figures = figures_of(curves, region);
    encasing.push_back(figures.encasing);
    arranging.push_back(figures.arranging);
    arranging_bare.push_back(figures.arranging_bare);
  });
  figures.encasing = median(encasing);
  figures.arranging = median(arranging);
  figures.arranging_bare = median(arranging_bare);
  return figures;
}

/// The same in a process of its own, and the kilobytes that this needs at most; none if that fails.
struct Apart {
  ManyFigures figures;
  long kilobytes = -1;
};
Apart figures_apart(const std::vector<NamedCurve>& curves, const Region& region) {
  Apart apart;
  int ends[2];
  if (pipe(ends) != 0) return apart;
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    const ManyFigures figures = figures_of(curves, region);
    _exit(write(ends[1], &figures, sizeof figures) == sizeof figures ? 0 : 1);
  }
  close(ends[1]);
  int status = 0;
  rusage usage{};
  const bool complete = child > 0 && read(ends[0], &apart.figures, sizeof apart.figures) ==
                                         static_cast<ssize_t>(sizeof apart.figures);
  close(ends[0]);
  if (child > 0 && wait4(child, &status, 0, &usage) == child && status == 0 && complete)
    apart.kilobytes = usage.ru_maxrss;
  return apart;
}

/// Millionths: circles with random centres and radii inside the unit square.
struct Circle {
  std::int64_t x, y, r;
};

struct CircleScene {
  int count;
  std::int64_t least, most;  ///< radii
};

std::vector<Circle> random_circles(const CircleScene& scene) {
  constexpr std::int64_t kSide = 1000000, kMargin = 100;
  std::mt19937_64 random(1);
  const auto between = [&](std::int64_t lo, std::int64_t hi) {
    return lo + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(hi - lo + 1));
  };
  std::vector<Circle> circles;
  for (int k = 0; k < scene.count; ++k) {
    const std::int64_t r = between(scene.least, scene.most), from = kMargin + r, to = kSide - from;
    const std::int64_t x = between(from, to);
    circles.push_back({x, between(from, to), r});
  }
  return circles;
}

/// Two circles cross, twice, where the distance of their centres lies between the difference and
/// the sum of their radii.
std::int64_t crossings_of(const std::vector<Circle>& circles) {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < circles.size(); ++i)
    for (std::size_t j = i + 1; j < circles.size(); ++j) {
      const Circle &a = circles[i], &b = circles[j];
      const std::int64_t dx = a.x - b.x, dy = a.y - b.y, square = dx * dx + dy * dy;
      const std::int64_t sum = a.r + b.r, difference = a.r - b.r;
      if (difference * difference < square && square < sum * sum) count += 2;
    }
  return count;
}

std::vector<NamedCurve> curves_of(const std::vector<Circle>& circles) {
  std::vector<NamedCurve> curves;
  for (const Circle& c : circles) {
    const Rational x(c.x, 1000000), y(c.y, 1000000), r(c.r, 1000000);
    curves.push_back({fmt::format("c{}", curves.size()),
                      Polynomial<2>::from_terms({{{2, 0}, 1},
                                                 {{0, 2}, 1},
                                                 {{1, 0}, Rational(-2 * x)},
                                                 {{0, 1}, Rational(-2 * y)},
                                                 {{0, 0}, Rational(x * x + y * y - r * r)}})});
  }
  return curves;
}

std::vector<NamedCurve> dense_curves(int degree, int count) {
  RandomOptions options;
  options.kind = RandomOptions::Kind::Dense;
  options.degree = degree;
  options.count = count;
  options.bits = 50;
  return random_curves(options);
}

std::string yes_or_no(bool value) { return value ? "yes" : "no"; }

}  // namespace

Table circles_table(const Request& request) {
  Table table{"circles",
              "Random circles in the unit square, and in how many points they cross by the "
              "distances of their centres",
              {"circles", "radii", "crossings", "by distances", "cells", "faces", "pairs met",
               "isolated", "isolated per crossing", "encasement s", "arrangement s",
               "us per "
               "crossing",
               "MB", "certified"},
              {}};
  for (const CircleScene& scene :
       {CircleScene{30, 100000, 242000}, CircleScene{100, 100000, 242000},
        CircleScene{300, 100000, 242000}, CircleScene{1000, 100000, 242000},
        CircleScene{10000, 1000, 4600}}) {
    if (scene.count > request.most_curves) continue;
    const auto circles = random_circles(scene);
    const Apart apart = figures_apart(curves_of(circles), make_region(0, 1, 0, 1).value());
    const ManyFigures& f = apart.figures;
    Value memory;
    if (apart.kilobytes >= 0) memory = static_cast<double>(apart.kilobytes) / 1024;
    const auto crossings = static_cast<double>(std::max<std::int64_t>(1, f.crossings));
    table.add({std::int64_t{scene.count},
               fmt::format("{}-{}", static_cast<double>(scene.least) / 1e6,
                           static_cast<double>(scene.most) / 1e6),
               f.crossings, crossings_of(circles), f.cells, f.faces, f.pairs_met, f.pairs_isolated,
               static_cast<double>(f.pairs_isolated) / crossings, f.encasing, f.arranging,
               1e6 * f.encasing / crossings, std::move(memory), yes_or_no(f.certified)});
  }
  return table;
}

Table arcs_table(const Request& request) {
  Table table{
      "arcs",
      "Random dense curves with 50-bit coefficients in [1/2, 3/2]^2, in which each has about one "
      "branch (as Kerber's tables 2 and 3)",
      {"degree", "curves", "nodes", "edges", "crossings", "pairs met", "isolated",
       "filter failures", "encasement ms", "arrangement ms", "certified"},
      {}};
  struct Scene {
    int degree, step, most;
  };
  const Region region =
      make_region(Rational(1, 2), Rational(3, 2), Rational(1, 2), Rational(3, 2)).value();
  for (const Scene& scene : {Scene{5, 50, 300}, Scene{9, 20, 100}}) {
    const auto all = dense_curves(scene.degree, std::min(scene.most, request.most_curves));
    for (int count = scene.step; count <= static_cast<int>(all.size()); count += scene.step) {
      const std::vector<NamedCurve> curves(all.begin(), all.begin() + count);
      const ManyFigures f = median_figures(curves, region, request.repetitions);
      table.add({std::int64_t{scene.degree}, std::int64_t{count}, f.vertices, f.edges, f.crossings,
                 f.pairs_met, f.pairs_isolated, f.filter_failures, kMilli * f.encasing,
                 kMilli * f.arranging, yes_or_no(f.certified && f.arranged)});
    }
  }
  return table;
}

Table arrangements_table(const Request& request) {
  const bool beside_cgal = request.cgal_degrees >= 5;
  Table table{
      "arrangements",
      "Random dense quintics with 50-bit coefficients in the whole plane (as Kerber's "
      "table 1)",
      {"curves", "crossings", "vertices", "edges", "faces", "encasement ms", "arrangement ms"},
      {}};
  if (beside_cgal) {
    table.title += ", beside CGAL's Arrangement_2 with Arr_algebraic_segment_traits_2";
    for (const char* column : {"CGAL without coordinates ms", "ratio without coordinates",
                               "CGAL ms", "ratio", "the same"})
      table.columns.emplace_back(column);
  }
  // Ours all before CGAL's, which leaves the heap in many pieces.
  std::vector<std::vector<NamedCurve>> scenes;
  std::vector<ManyFigures> figures;
  for (int count = 10; count <= std::min(50, request.most_curves); count += 10) {
    scenes.push_back(dense_curves(5, count));
    // CGAL takes so long that repeating ours costs nothing.
    Repetitions repetitions = request.repetitions;
    if (repetitions.count == 0) repetitions.count = 5;
    figures.push_back(median_figures(scenes.back(), whole_plane(), repetitions));
  }
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    const ManyFigures& f = figures[k];
    std::vector<Value> row{static_cast<std::int64_t>(scenes[k].size()),
                           f.crossings,
                           f.vertices,
                           f.edges,
                           f.faces,
                           kMilli * f.encasing,
                           kMilli * f.arranging};
    if (beside_cgal) {
      std::vector<Polynomial<2>> polynomials;
      for (const NamedCurve& curve : scenes[k]) polynomials.push_back(curve.function.polynomial());
      const CgalArrangement theirs = cgal_arrangement(polynomials, true);
      const double ours = f.encasing + f.arranging, bare = f.encasing + f.arranging_bare,
                   all = theirs.seconds + theirs.coordinate_seconds;
      // One of our faces is all that lies beyond the rectangle around everything.
      const bool same =
          f.arranged && f.crossings == theirs.crossings && f.faces - 1 == theirs.faces;
      row.insert(row.end(), {kMilli * theirs.seconds, theirs.seconds / bare, kMilli * all,
                             all / ours, yes_or_no(same)});
    }
    table.add(std::move(row));
  }
  return table;
}

}  // namespace encase::benchmark
