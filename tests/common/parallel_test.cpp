// SPDX-License-Identifier: MIT
#include "common/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace encase {
namespace {

using namespace std::chrono_literals;

TEST(ParallelFor, CallsEveryIndexOnce) {
  for (const int threads : {0, 1, 2, 3, 8})
    for (const int count : {0, 1, 2, 7, 500}) {
      std::vector<std::atomic<int>> calls(static_cast<std::size_t>(count));
      parallel_for(count, threads, [&](int i) {
        if (i % 50 == 0) std::this_thread::sleep_for(2ms);
        ++calls[static_cast<std::size_t>(i)];
      });
      for (const auto& n : calls) EXPECT_EQ(n, 1);
    }
}

TEST(ParallelFor, RunsInOrderOnTheCallersThreadIfThereIsOne) {
  const auto here = std::this_thread::get_id();
  std::vector<int> order;
  parallel_for(100, 1, [&](int i) {
    EXPECT_EQ(std::this_thread::get_id(), here);
    order.push_back(i);
    std::this_thread::sleep_for(50us);
  });
  std::vector<int> expected(100);
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(order, expected);
}

TEST(ParallelFor, UsesAsManyThreadsAsAreAskedForIfTheWorkIsLong) {
  if (!has_threads()) GTEST_SKIP() << "built without oneTBB";
  // More than there may be processors. All wait for each other, but not for ever.
  constexpr int kThreads = 5;
  std::atomic<int> waiting = 0;
  std::mutex mutex;
  std::set<std::thread::id> ids;
  parallel_for(1 + kThreads, kThreads, [&](int i) {
    if (i == 0) {
      std::this_thread::sleep_for(2ms);
      return;
    }
    ++waiting;
    for (int k = 0; k < 2000 && waiting < kThreads; ++k) std::this_thread::sleep_for(5ms);
    std::lock_guard lock(mutex);
    ids.insert(std::this_thread::get_id());
  });
  EXPECT_EQ(ids.size(), static_cast<std::size_t>(kThreads));
  EXPECT_TRUE(ids.count(std::this_thread::get_id()) > 0);
}

TEST(ParallelFor, WakesNobodyForLittleWork) {
  // A busy machine may take a millisecond for it now and then.
  const auto here = std::this_thread::get_id();
  int alone = 0;
  for (int again = 0; again < 100; ++again) {
    std::atomic<int> elsewhere = 0;
    parallel_for(4, 8, [&](int) { elsewhere += std::this_thread::get_id() != here; });
    alone += elsewhere == 0;
  }
  EXPECT_GT(alone, 50);
}

TEST(ParallelFor, ThrowsOnWhatIsThrownAndEnds) {
  for (const int threads : {1, 2, 8}) {
    std::atomic<int> calls = 0, running = 0;
    const auto work = [&](int i) {
      ++calls;
      ++running;
      std::this_thread::sleep_for(100us);
      --running;
      if (i == 20) throw std::runtime_error("twenty");
    };
    try {
      parallel_for(100000, threads, work);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "twenty");
    }
    EXPECT_LT(calls, 100000);
    EXPECT_EQ(running, 0);
  }
}

}  // namespace
}  // namespace encase
