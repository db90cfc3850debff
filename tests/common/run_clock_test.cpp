// SPDX-License-Identifier: MIT
#include "common/run_clock.hpp"

#include <gtest/gtest.h>
#include <time.h>

#include <chrono>
#include <thread>

namespace encase {
namespace {

TEST(RunClock, CountsWorkButNotSleep) {
  RunClock clock;
  const auto start = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(20)) clock.exceeds(1);
  const double worked = clock.seconds();
  EXPECT_GT(worked, 0);
  EXPECT_TRUE(clock.exceeds(0));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_LT(clock.seconds(), worked + 0.1);
  EXPECT_FALSE(clock.exceeds(worked + 0.1));
}

TEST(RunClock, ZeroIsExceededAtOnce) {
  RunClock clock;
  while (clock.seconds() == 0) {
  }
  EXPECT_TRUE(clock.exceeds(0));
}

void work_for(std::chrono::milliseconds time) {
  timespec start, now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &start);
  const auto passed = [&] {
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec - start.tv_sec) +
           1e-9 * static_cast<double>(now.tv_nsec - start.tv_nsec);
  };
  while (passed() < 1e-3 * static_cast<double>(time.count())) {
  }
}

TEST(RunClock, AddsTheShiftsOfAllThreads) {
  using std::chrono::milliseconds;
  RunClock clock(3);
  work_for(milliseconds(10));
  {
    const RunClock::SharedOut shared_out(clock);
    const auto shift = [&] {
      const RunClock::Shift on_duty(clock);
      work_for(milliseconds(20));
      EXPECT_TRUE(clock.exceeds(0.03));  // those that have not ended count too
    };
    std::thread first(shift), second(shift);
    work_for(milliseconds(300));  // not on duty
    first.join();
    second.join();
    shift();
    EXPECT_GE(clock.seconds(), 0.07);
    EXPECT_LT(clock.seconds(), 0.2);
  }
  work_for(milliseconds(10));
  EXPECT_GE(clock.seconds(), 0.08);
  EXPECT_LT(clock.seconds(), 0.21);
  EXPECT_FALSE(clock.exceeds(1));
}

}  // namespace
}  // namespace encase
