// SPDX-License-Identifier: MIT
//
// Searching allocates for what it keeps, not for what it tries; and not much in all.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <vector>

#include "2d/caps_tree.hpp"
#include "2d/critical_regions.hpp"
#include "2d/encaser.hpp"
#include "common/isolate_roots.hpp"
#include "common/random_polynomials.hpp"
#include "encase/encasement.hpp"

namespace {

long allocations = 0;
long live_bytes = 0, most_bytes = 0;

void* counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  ++allocations;
  live_bytes += static_cast<long>(malloc_usable_size(memory));
  most_bytes = std::max(most_bytes, live_bytes);
  return memory;
}
void release(void* memory) {
  live_bytes -= static_cast<long>(malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return counted(std::malloc(size > 0 ? size : 1)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto unit = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(unit, (size + unit - 1) / unit * unit));
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }

namespace encase {
namespace {

TEST(Allocations, OfTheQuadtreeOfCapsDoNotGrowWithItsBoxes) {
  RandomOptions random;
  random.degree = 4;
  random.count = 3;
  std::vector<CurveBounds> curves;
  for (const NamedCurve& curve : random_curves(random)) curves.emplace_back(curve.function);
  CapsOptions options;
  options.self_crossings = true;
  const long before = allocations;
  const CapsTree tree = subdivide(curves, {{-1, -1}, {1, 1}}, options, {});
  EXPECT_GT(tree.nodes.size(), 2000U);
  // Lists that double, and the sets of curves.
  EXPECT_LT(allocations - before, 200);
}

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
    // Every cell keeps its vertices, its word and its branches.
    const auto of_cells = 3 * static_cast<long>(e.cells.size());
    EXPECT_LT(during, of_cells + kept + 80) << "degree " << degree;
    EXPECT_GT(e.statistics.candidate_lines, 2 * kept);
  }
}

/// Two random curves with tiles over the square.
struct Pair {
  explicit Pair(int degree, std::uint64_t seed = 1)
      : curves(random(degree, seed)), f(curves[0], box, kernel), g(curves[1], box, kernel) {}

  static std::vector<FilteredFunction<2>> random(int degree, std::uint64_t seed) {
    RandomOptions options;
    options.degree = degree;
    options.seed = seed;
    std::vector<FilteredFunction<2>> result;
    for (const Polynomial<2>& p : random_polynomials<2>(options)) result.emplace_back(p);
    return result;
  }

  Kernel kernel;
  Box<2> box = subdivision_root<2>({{-1, -1}, {1, 1}});
  std::vector<FilteredFunction<2>> curves;
  TiledFunction f, g;
};

/// Constants are made when they are first asked for; those are not to be counted.
void make_constants() {
  for (const int degree : {6, 20}) {
    Pair pair(degree);
    isolate_roots(pair.f, pair.g, pair.f.box(), {}, SubdivisionLimits{}, pair.kernel);
    critical_regions(pair.f, 0, pair.f.box(), {}, SubdivisionLimits{}, pair.kernel);
  }
}

TEST(Allocations, OfIsolatingRootsAreBoundedByTilesAndRoots) {
  make_constants();
  long boxes = 0, all = 0;
  for (const int degree : {6, 10, 14, 20}) {
    Pair pair(degree);
    const long before = allocations;
    const auto roots =
        isolate_roots(pair.f, pair.g, pair.f.box(), {}, SubdivisionLimits{}, pair.kernel);
    const long during = allocations - before;
    EXPECT_LE(during, 2 * (pair.kernel.expansions + static_cast<long>(roots.roots.size()) + 20))
        << "degree " << degree;
    boxes += roots.boxes;
    all += during;
    std::printf("degree %d: %ld allocations, %d boxes, %ld tiles, %zu roots\n", degree, during,
                roots.boxes, static_cast<long>(pair.kernel.expansions), roots.roots.size());
  }
  EXPECT_GT(boxes, 3 * all);
}

TEST(Allocations, OfCriticalRegionsAreBoundedByTilesAndRegions) {
  make_constants();
  long boxes = 0, all = 0;
  for (const int degree : {6, 10, 14, 20}) {
    Pair pair(degree);
    const long before = allocations;
    const auto found =
        critical_regions(pair.f, 0, pair.f.box(), {}, SubdivisionLimits{}, pair.kernel);
    const long during = allocations - before;
    long kept = 0;
    for (const auto& region : found.regions) kept += 1 + static_cast<long>(region.boxes.size());
    EXPECT_LE(during, 2 * (pair.kernel.expansions + kept + 20)) << "degree " << degree;
    boxes += found.boxes;
    all += during;
    std::printf("degree %d: %ld allocations, %d boxes, %ld tiles, %ld kept\n", degree, during,
                found.boxes, static_cast<long>(pair.kernel.expansions), kept);
  }
  EXPECT_GT(boxes, 3 * all);
}

TEST(Allocations, OfMoreBoxesAreNoMore) {
  // What was made for the first time is there for the second: only lists grow.
  Pair pair(12);
  isolate_roots(pair.f, pair.g, pair.f.box(), {}, SubdivisionLimits{}, pair.kernel);
  const long before = allocations;
  const auto roots =
      isolate_roots(pair.f, pair.g, pair.f.box(), {}, SubdivisionLimits{}, pair.kernel);
  EXPECT_LT(allocations - before, 60);
  EXPECT_GT(roots.boxes, 300);
}

TEST(Memory, OfDegreeTwentyIsUnderFiftyMegabytes) {
  RandomOptions random;
  random.degree = 20;
  const auto curves = random_curves(random);
  const Region region = make_region(-1, 1, -1, 1).value();
  const long before = live_bytes;
  most_bytes = live_bytes;
  const auto result = encase(curves, region);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.value().outcome, Outcome::Certified);
  std::printf("at most %.1f MB\n", static_cast<double>(most_bytes - before) * 1e-6);
  EXPECT_GT(most_bytes - before, 100000);
  EXPECT_LT(most_bytes - before, 50000000);
}

}  // namespace
}  // namespace encase
