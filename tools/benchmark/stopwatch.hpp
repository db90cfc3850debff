// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace encase::benchmark {

/// CPU seconds of the calling thread.
double thread_seconds();

class Stopwatch {
 public:
  Stopwatch() : start_(thread_seconds()) {}
  /// CPU seconds since the last lap or the construction.
  double lap() {
    const double now = thread_seconds(), seconds = now - start_;
    start_ = now;
    return seconds;
  }

 private:
  double start_;
};

/// How often something is run to time it.
struct Repetitions {
  int count = 0;          ///< 0: until `seconds` are spent, and at least three times
  double seconds = 0.05;  ///< what takes longer than this is run once
};

/// The middle one of the values, the mean of the two middle ones of an even number; 0 of none.
double median(std::vector<double> values);

/// The median CPU seconds of a run. Runs too short for the clock are timed in batches. A first run,
/// which fills the processor's caches, counts only where it is the only one.
template <class Run>
double time_of(const Repetitions& repetitions, Run run) {
  constexpr double kShortest = 1e-4;
  Stopwatch watch;
  run();
  const double first = watch.lap();
  if (repetitions.count == 1 && first > kShortest) return first;
  if (repetitions.count == 0 && first > repetitions.seconds) return first;
  const int batch = first < kShortest ? static_cast<int>(kShortest / (first + 1e-7)) : 1;
  std::vector<double> times;
  for (double spent = 0; repetitions.count > 0 ? static_cast<int>(times.size()) < repetitions.count
                                               : spent < repetitions.seconds || times.size() < 3;) {
    watch.lap();
    for (int k = 0; k < batch; ++k) run();
    const double seconds = watch.lap();
    times.push_back(seconds / batch);
    spent += seconds;
  }
  return median(std::move(times));
}

}  // namespace encase::benchmark
