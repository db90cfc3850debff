// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

namespace encase {

/// Measures the CPU seconds that the calling thread has used since construction. Reading the
/// thread's clock takes a system call, longer than a small encasement's parts: until a millisecond
/// has passed, the time that has passed is taken for it.
class RunClock {
 public:
  RunClock();
  double seconds();
  /// Whether more than `limit` seconds were used; nearly always without a system call, since no
  /// more can have been used than have passed.
  bool exceeds(double limit);

 private:
  double start_;                     ///< of elapsed time
  std::optional<double> cpu_start_;  ///< of the thread's clock; none until it is read
};

}  // namespace encase
