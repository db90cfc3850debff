// SPDX-License-Identifier: MIT
//
// The number of threads changes nothing but the time.
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "common/random_polynomials.hpp"
#include "encase/result_json.hpp"
#include "encased.hpp"
#include "mutations.hpp"

namespace encase {
namespace {

constexpr int kThreads[] = {2, 3, 8};

struct Scene {
  std::string name;
  std::vector<NamedCurve> curves;
  Region region = encased::square();
  EncaseOptions options = {};
};

std::vector<NamedCurve> random(int degree, int count, std::uint64_t seed) {
  RandomOptions options;
  options.degree = degree;
  options.count = count;
  options.seed = seed;
  return random_curves(options);
}

std::vector<Scene> scenes() {
  std::vector<Scene> all;
  all.push_back({"a pair", random(12, 2, 1)});
  all.push_back({"a pair with second thoughts", random(5, 2, 27)});
  all.push_back({"six curves", random(8, 6, 2)});
  all.push_back({"twenty curves", random(5, 20, 3)});
  all.push_back({"tiles that are made on the way", random(24, 4, 9)});
  all.push_back({"touching, singular, concurrent and repeated",
                 encased::curves({"x^2 + y^2 - 1/4", "(x-1)^2 + y^2 - 1/4", "y^2 - x^3 - x^2",
                                  "x - 2 y", "x + 3 y", "(x - 1/3)^2 (y + x^2)", "y + x^2"})});
  all.push_back({"through corners", encased::curves({"x - y", "x + y", "y - 1/3", "x^2 - y - 1"})});
  all.push_back({"the plane",
                 encased::curves({"x^2 + y^2 - 3", "x^2 - 3 y^2 - 5/7", "2 x + 3 y - 1", "x y - 4",
                                  "y^2 - 2 x^2 - 20"}),
                 whole_plane()});
  all.push_back({"few cells", random(6, 6, 4)});
  all.back().options.max_cells = 40;
  all.push_back({"one cell", random(6, 3, 4)});
  all.back().options.max_cells = 1;
  all.push_back({"in MPFR", random(4, 4, 5)});
  all.back().options.start_bits = 106;
  all.push_back({"perturbed", encased::curves({"x^2 + y^2 - 1/4", "(x-1)^2 + y^2 - 1/4", "x y"})});
  all.back().options.perturbation = 1e-6;
  return all;
}

std::string bytes(const Scene& scene, int threads) {
  EncaseOptions options = scene.options;
  options.threads = threads;
  const auto result = encase(scene.curves, scene.region, options);
  EXPECT_TRUE(result.ok());
  return result ? to_json(result.value()) : std::string();
}

TEST(Threads, ResultsAreTheSameBytesForAnyNumber) {
  for (const Scene& scene : scenes()) {
    const std::string expected = bytes(scene, 1);
    for (const int threads : kThreads)
      for (int again = 0; again < 2; ++again)
        EXPECT_TRUE(bytes(scene, threads) == expected) << scene.name << ", " << threads;
  }
}

TEST(Threads, VerificationIsTheSameForAnyNumber) {
  const Encasement good = encased::run_curves(random(5, 5, 6));
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    Encasement e = good;
    mutations::Mutator mutator(seed);
    if (seed > 0) mutator.apply(e);
    // Many objections: every box of a crossing too small, say.
    if (seed % 4 == 3)
      for (Crossing& c : e.crossings) c.box.hi[0] = c.box.lo[0] + 0.25 * c.box.width(0);
    VerifyOptions options;
    options.max_objections = seed % 8 == 7 ? 1000 : 20;
    const Verification expected = verify(e, options);
    for (const int threads : kThreads) {
      options.threads = threads;
      const Verification found = verify(e, options);
      EXPECT_EQ(found.claims, expected.claims) << "seed " << seed << ", " << threads;
      EXPECT_EQ(found.objections, expected.objections) << "seed " << seed << ", " << threads;
    }
  }
}

TEST(Threads, CancellationReachesAllAndIsAskedOneAtATime) {
  const std::vector<NamedCurve> curves = random(7, 12, 7);
  for (const int allowed : {0, 1, 2, 5, 20, 60})
    for (const int threads : {1, 2, 8}) {
      EncaseOptions options;
      options.threads = threads;
      std::atomic<int> asking = 0, calls = 0;
      bool refused = false;
      options.progress = [&](const char* stage, double done) {
        EXPECT_EQ(++asking, 1);
        EXPECT_NE(stage, nullptr);
        EXPECT_TRUE(done == -1 || (0 <= done && done <= 1));
        EXPECT_FALSE(refused);
        std::this_thread::yield();
        refused = ++calls > allowed;
        --asking;
        return !refused;
      };
      const Encasement e = encased::run_curves(curves, encased::square(), options);
      EXPECT_TRUE(refused);
      EXPECT_EQ(e.outcome, Outcome::Undecided) << allowed << ", " << threads;
      bool said = false;
      for (const Unresolved& u : e.undecided)
        said = said || u.reason.find("cancelled") != std::string::npos;
      EXPECT_TRUE(said);
    }
}

TEST(Threads, WhatTheCallbackThrowsIsThrownOn) {
  for (const int threads : {1, 2, 8}) {
    EncaseOptions options;
    options.threads = threads;
    std::atomic<int> calls = 0;
    options.progress = [&](const char*, double) {
      if (++calls == 30) throw std::runtime_error("no more");
      return true;
    };
    EXPECT_THROW(static_cast<void>(encase(random(7, 12, 7), encased::square(), options)),
                 std::runtime_error);
  }
}

TEST(Threads, SecondsAreThoseOfAll) {
  for (const int threads : {1, 4}) {
    EncaseOptions options;
    options.threads = threads;
    options.max_seconds = 0.02;
    const Encasement e = encased::run_curves(random(10, 20, 8), encased::square(), options);
    EXPECT_EQ(e.outcome, Outcome::Undecided);
    EXPECT_GE(e.seconds, 0.02);
    bool said = false;
    for (const Unresolved& u : e.undecided)
      said = said || u.reason.find("CPU seconds") != std::string::npos;
    EXPECT_TRUE(said);
  }
}

}  // namespace
}  // namespace encase
