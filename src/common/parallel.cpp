// SPDX-License-Identifier: MIT
#include "common/parallel.hpp"

#ifdef ENCASE_HAVE_TBB
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>
#endif

namespace encase {

#ifdef ENCASE_HAVE_TBB

bool has_threads() { return true; }

void parallel_for(int count, int threads, const std::function<void(int)>& work) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  int next = 0;
  while (next < count && (threads <= 1 || Clock::now() - start < std::chrono::milliseconds(1)))
    work(next++);
  const int used = std::min(threads, count - next);
  if (used <= 1) {
    while (next < count) work(next++);
    return;
  }
  // oneTBB has as many threads as there are processors, unless more are asked for.
  std::optional<tbb::global_control> more;
  if (used > tbb::info::default_concurrency())
    more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(used));
  tbb::task_arena arena(used);
  arena.execute([&] { tbb::parallel_for(next, count, work, tbb::simple_partitioner()); });
}

#else

bool has_threads() { return false; }

void parallel_for(int count, int, const std::function<void(int)>& work) {
  for (int i = 0; i < count; ++i) work(i);
}

#endif

}  // namespace encase
