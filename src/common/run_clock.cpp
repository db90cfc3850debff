// SPDX-License-Identifier: MIT
#include "common/run_clock.hpp"

#include <time.h>

namespace encase {
namespace {

constexpr double kUnread = 1e-3;

double read(clockid_t clock) {
  timespec t;
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

RunClock::RunClock() : start_(read(CLOCK_MONOTONIC)) {}

double RunClock::seconds() {
  const double passed = read(CLOCK_MONOTONIC) - start_;
  if (passed < kUnread) return passed;
  const double cpu = read(CLOCK_THREAD_CPUTIME_ID);
  if (!cpu_start_) cpu_start_ = cpu - passed;
  return cpu - *cpu_start_;
}

bool RunClock::exceeds(double limit) {
  const double passed = read(CLOCK_MONOTONIC) - start_;
  if (!cpu_start_ && passed >= kUnread) seconds();
  return passed > limit && seconds() > limit;
}

}  // namespace encase
