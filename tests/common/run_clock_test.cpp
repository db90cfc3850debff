// SPDX-License-Identifier: MIT
#include "common/run_clock.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace encase
