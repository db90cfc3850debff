// SPDX-License-Identifier: MIT
//
// Splitting allocates for what it keeps, not for what it tries.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "2d/encaser.hpp"
#include "common/random_polynomials.hpp"

namespace {
long allocations = 0;
}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace encase {
namespace {

TEST(Allocations, OfSplittingAreBoundedByWhatItKeeps) {
  for (const int degree : {6, 10, 14}) {
    RandomOptions random;
    random.degree = degree;
    const EncaseOptions options;
    Encaser run(random_curves(random), make_region(-1, 1, -1, 1).value(), options);
    run.separate_components();
    ASSERT_TRUE(run.open_region());
    run.find_critical_regions();
    run.collect_zones();
    const long before = allocations;
    run.split_cells();
    const long during = allocations - before;
    run.finish_cells();
    run.decide_outcome();
    const Encasement e = run.take_result();
    const auto kept = static_cast<long>(e.cells.size() + e.lines.size() + e.crossings.size());
    EXPECT_LT(during, 2 * kept) << "degree " << degree;
    EXPECT_GT(e.statistics.candidate_lines, 2 * kept);
  }
}

}  // namespace
}  // namespace encase
