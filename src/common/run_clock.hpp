// SPDX-License-Identifier: MIT
#pragma once

#include <time.h>

#include <mutex>
#include <optional>
#include <vector>

namespace encase {

/// Measures the CPU seconds that a computation has used since construction: what the constructing
/// thread uses, or, while it has several work, what those use during their shifts. Reading a
/// thread's clock takes a system call, longer than a small encasement's parts: for one thread,
/// until a millisecond has passed, the time that has passed is taken for it.
class RunClock {
 public:
  /// `threads`: how many have a shift at the same time, at most.
  explicit RunClock(int threads = 1);
  RunClock(const RunClock&) = delete;
  RunClock& operator=(const RunClock&) = delete;

  double seconds();
  /// Whether more than `limit` seconds were used; nearly always without a system call, since no
  /// more can have been used than have passed, times the threads.
  bool exceeds(double limit);

  /// While it lives, the thread that made it is counted by its shifts only. Not while another such
  /// object lives.
  class SharedOut {
   public:
    explicit SharedOut(RunClock& clock);
    ~SharedOut();
    SharedOut(const SharedOut&) = delete;
    SharedOut& operator=(const SharedOut&) = delete;

   private:
    RunClock& clock_;
  };

  /// While it lives, the CPU time of the thread that made it counts. Within SharedOut's life.
  class Shift {
   public:
    explicit Shift(RunClock& clock);
    ~Shift();
    Shift(const Shift&) = delete;
    Shift& operator=(const Shift&) = delete;

   private:
    RunClock& clock_;
    clockid_t thread_;
    double start_;
  };

 private:
  struct Running {
    clockid_t thread;
    double start;
  };
  double own_seconds();

  int threads_;
  double start_;                     ///< of elapsed time
  std::optional<double> cpu_start_;  ///< of the thread's clock; none until it is read
  std::mutex mutex_;                 ///< of what follows
  bool shared_out_ = false;
  double before_ = 0;             ///< own_seconds() when it was shared out
  double of_shifts_ = 0;          ///< CPU seconds of those that have ended
  std::vector<Running> running_;  ///< those that have not
};

}  // namespace encase
