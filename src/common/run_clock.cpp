// SPDX-License-Identifier: MIT
#include "common/run_clock.hpp"

#include <pthread.h>

#include <algorithm>

namespace encase {
namespace {

constexpr double kUnread = 1e-3;

double read(clockid_t clock) {
  timespec t;
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// The clock of the calling thread, by a name that other threads can use.
clockid_t clock_of_this_thread() {
  clockid_t clock;
  return pthread_getcpuclockid(pthread_self(), &clock) == 0 ? clock : CLOCK_THREAD_CPUTIME_ID;
}

}  // namespace

RunClock::RunClock(int threads) : threads_(threads), start_(read(CLOCK_MONOTONIC)) {
  if (threads_ > 1) cpu_start_ = read(CLOCK_THREAD_CPUTIME_ID);
}

double RunClock::own_seconds() {
  const double passed = read(CLOCK_MONOTONIC) - start_;
  if (!cpu_start_ && passed < kUnread) return passed;
  const double cpu = read(CLOCK_THREAD_CPUTIME_ID);
  if (!cpu_start_) cpu_start_ = cpu - passed;
  return cpu - *cpu_start_;
}

double RunClock::seconds() {
  std::lock_guard lock(mutex_);
  double sum = (shared_out_ ? before_ : own_seconds()) + of_shifts_;
  for (const Running& shift : running_) sum += read(shift.thread) - shift.start;
  return sum;
}

bool RunClock::exceeds(double limit) {
  const double passed = read(CLOCK_MONOTONIC) - start_;
  if (threads_ == 1 && !cpu_start_ && passed >= kUnread) own_seconds();
  return passed * threads_ > limit && seconds() > limit;
}

RunClock::SharedOut::SharedOut(RunClock& clock) : clock_(clock) {
  std::lock_guard lock(clock_.mutex_);
  clock_.before_ = clock_.own_seconds();
  clock_.shared_out_ = true;
}

RunClock::SharedOut::~SharedOut() {
  std::lock_guard lock(clock_.mutex_);
  // What the thread did meanwhile is in its shifts.
  clock_.cpu_start_ = read(CLOCK_THREAD_CPUTIME_ID) - clock_.before_;
  clock_.shared_out_ = false;
}

RunClock::Shift::Shift(RunClock& clock)
    : clock_(clock), thread_(clock_of_this_thread()), start_(read(thread_)) {
  std::lock_guard lock(clock_.mutex_);
  clock_.running_.push_back({thread_, start_});
}

RunClock::Shift::~Shift() {
  std::lock_guard lock(clock_.mutex_);
  clock_.of_shifts_ += read(thread_) - start_;
  const auto self = std::find_if(clock_.running_.begin(), clock_.running_.end(),
                                 [&](const Running& r) { return r.thread == thread_; });
  clock_.running_.erase(self);
}

}  // namespace encase
