// SPDX-License-Identifier: MIT
//
// encase(), step by step as in src/2d/encasement.cpp, with a watch between the steps.
#include <cmath>
#include <vector>

#include "2d/encaser.hpp"
#include "encase/crossing.hpp"
#include "pair_figures.hpp"

namespace encase::benchmark {
namespace {

constexpr int kBits = 53;

/// Whether a coordinate is known as well as CGAL is asked for it.
bool is_known(const Crossing& crossing) {
  return crossing.rounded || crossing.box.largest_width() <= std::ldexp(1.0, -kBits);
}

Stages run_once(const std::vector<NamedCurve>& curves, const Region& region) {
  const EncaseOptions options;
  Stages stages;
  Stopwatch watch;
  Encaser run(curves, region, options);
  if (run.check_input()) return stages;
  run.separate_components();
  stages.curves += watch.lap();

  const bool open = run.open_region();
  stages.roots += watch.lap();
  if (!open) return stages;
  run.find_critical_regions();
  stages.curves += watch.lap();
  run.collect_zones();
  run.split_cells();
  run.finish_cells();
  run.decide_outcome();
  const Encasement encasement = run.take_result();
  stages.roots += watch.lap();

  for (std::size_t k = 0; k < encasement.crossings.size(); ++k)
    if (!is_known(encasement.crossings[k])) refine(encasement, static_cast<int>(k), kBits);
  stages.coordinates = watch.lap();
  return stages;
}

}  // namespace

Stages stages_of(const std::vector<NamedCurve>& curves, const Region& region,
                 const Repetitions& repetitions) {
  std::vector<double> first, second, third;
  time_of(repetitions, [&] {
    const Stages stages = run_once(curves, region);
    first.push_back(stages.curves);
    second.push_back(stages.roots);
    third.push_back(stages.coordinates);
  });
  return {median(first), median(second), median(third)};
}

}  // namespace encase::benchmark
