// SPDX-License-Identifier: MIT
#include "3d/space_partition.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "3d/certificate_tests.hpp"
#include "3d/pair_critical_points.hpp"
#include "common/isolate_roots.hpp"
#include "common/random_polynomials.hpp"
#include "written.hpp"

namespace encase {
namespace {

const std::string kTorus = "(x^2+y^2+z^2+3)^2-16*(x^2+y^2)";  // radii 2 and 1
const std::string kClebsch =
    "81*(x^3+y^3+z^3)-189*(x^2*y+x^2*z+y^2*x+y^2*z+z^2*x+z^2*y)+54*x*y*z+126*(x*y+x*z+y*z)"
    "-9*(x^2+y^2+z^2)-9*(x+y+z)+1";

Polyhedron cube(Rational half) {
  return make_box({-half, -half, -half}, {half, half, half}).value();
}

std::vector<Polynomial<3>> written_surfaces(const std::vector<std::string>& texts) {
  std::vector<Polynomial<3>> result;
  for (const std::string& text : texts) result.push_back(written::polynomial<3>(text));
  return result;
}

std::vector<Polynomial<3>> random_surfaces(int degree, std::uint64_t seed) {
  RandomOptions options;
  options.degree = degree;
  options.count = 3;
  options.seed = seed;
  return random_polynomials<3>(options);
}

/// A partition with what it refers to.
struct Partitioned {
  Polyhedron region;
  std::vector<FilteredFunction<3>> surfaces;
  std::vector<TriplePoint> triple_points;
  std::vector<TriplePointCover> triple_covers;
  std::vector<CurveCriticalPoints> critical_points;
  Kernel kernel;
  std::unique_ptr<SpacePartition> partition;

  const std::vector<SpacePartition::Leaf>& leaves() const { return partition->leaves(); }
};

std::unique_ptr<Partitioned> partition(const std::vector<Polynomial<3>>& polynomials,
                                       const Polyhedron& region, int max_leaves = 5000) {
  auto p = std::make_unique<Partitioned>();
  p->region = region;
  for (const auto& f : polynomials) p->surfaces.emplace_back(f);
  const Box<3> box = region.bounding_box();
  const int n = static_cast<int>(polynomials.size());
  const auto at = [&](int k) { return &p->surfaces[static_cast<std::size_t>(k)]; };
  SubdivisionLimits limits;
  limits.max_boxes = 20000;
  const Point<3> w{0.36, 0.48, 0.8};
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b) {
      auto found = pair_critical_points(*at(a), *at(b), w, box, {}, limits, p->kernel);
      p->critical_points.push_back(
          {{a, b}, w, found->points.roots, found->points.root_box, found->points.tokens});
      for (int c = b + 1; c < n; ++c) {
        const auto points = isolate_roots<3>({at(a), at(b), at(c)}, box, {}, limits, p->kernel);
        for (const Box<3>& root : points.roots)
          p->triple_points.push_back({{a, b, c}, root, root.center(), false, {}, -1});
        p->triple_covers.push_back({{a, b, c}, points.root_box, points.tokens});
      }
    }
  const SpaceScene scene{p->surfaces, p->region, p->triple_points, p->triple_covers,
                         p->critical_points};
  PartitionLimits partition_limits;
  partition_limits.max_leaves = max_leaves;
  p->partition = std::make_unique<SpacePartition>(scene, partition_limits, p->kernel);
  p->partition->certify();
  return p;
}

int count(const Partitioned& p, CellState state) {
  int result = 0;
  for (const auto& leaf : p.leaves()) result += leaf.state == state ? 1 : 0;
  return result;
}

double volume(const Box<3>& box) { return box.width(0) * box.width(1) * box.width(2); }

/// The box that the splits leave for every leaf.
void replay(const SpacePartition& partition, int child, const Box<3>& box,
            std::map<int, Box<3>>* boxes) {
  if (child < 0) {
    EXPECT_TRUE(boxes->emplace(~child, box).second);
    return;
  }
  const Split& split = partition.history()[static_cast<std::size_t>(child)];
  const Plane& plane = partition.planes()[static_cast<std::size_t>(split.line)];
  int axis = 0;
  while (plane.normal[axis] == 0) ++axis;
  const double at = -plane.offset / plane.normal[axis];
  EXPECT_LT(box.lo[axis], at);
  EXPECT_LT(at, box.hi[axis]);
  for (const int part : {split.negative, split.positive})
    EXPECT_GT(part < 0 ? static_cast<int>(partition.history().size()) : part, child);
  Box<3> lower = box, upper = box;
  lower.hi[axis] = upper.lo[axis] = at;
  replay(partition, split.negative, lower, boxes);
  replay(partition, split.positive, upper, boxes);
}

/// Everything the header promises, for a region that is a box of doubles.
void expect_sound(Partitioned& p) {
  const SpacePartition& partition = *p.partition;
  std::map<int, Box<3>> boxes;
  replay(partition, partition.history().empty() ? ~0 : 0, p.region.bounding_box(), &boxes);
  ASSERT_EQ(boxes.size(), p.leaves().size());
  for (const auto& c : partition.absences())
    EXPECT_TRUE(holds(c, p.surfaces[static_cast<std::size_t>(c.surface)], p.kernel));
  for (const auto& c : partition.graphs())
    EXPECT_TRUE(holds(c, p.surfaces[static_cast<std::size_t>(c.surface)], p.kernel));
  for (const auto& c : partition.pairs()) {
    if (c.kind != PairCertificate::Kind::Listed) {
      EXPECT_TRUE(holds(c, p.surfaces[static_cast<std::size_t>(c.surfaces[0])],
                        p.surfaces[static_cast<std::size_t>(c.surfaces[1])], p.kernel));
      continue;
    }
    const auto& list = p.critical_points[static_cast<std::size_t>(c.critical)];
    EXPECT_EQ(list.surfaces, c.surfaces);
    EXPECT_EQ(list.direction, c.direction);
    for (const Box<3>& point : list.points) EXPECT_FALSE(point.meets(c.box));
  }
  std::vector<int> holders(p.triple_points.size(), 0);
  for (std::size_t k = 0; k < p.leaves().size(); ++k) {
    const auto& leaf = p.leaves()[k];
    EXPECT_EQ(leaf.box, boxes.at(static_cast<int>(k)));
    std::vector<int> certified(p.surfaces.size(), 0);
    for (const int c : leaf.absences) {
      const auto& absence = partition.absences()[static_cast<std::size_t>(c)];
      EXPECT_TRUE(absence.box.contains(leaf.box));
      EXPECT_EQ(leaf.signs[static_cast<std::size_t>(absence.surface)], absence.sign);
      ++certified[static_cast<std::size_t>(absence.surface)];
    }
    std::vector<int> alive;
    for (std::size_t f = 0; f < p.surfaces.size(); ++f) {
      if (leaf.signs[f] != Sign::Zero) continue;
      alive.push_back(static_cast<int>(f));
      for (int corner = 0; corner < 8; ++corner) {
        RationalPoint<3> at;
        bool of_root = true;
        for (int i = 0; i < 3; ++i) {
          const double x = (corner >> i) % 2 != 0 ? leaf.box.hi[i] : leaf.box.lo[i];
          at[i] = Rational(x);
          const Box<3> root = p.region.bounding_box();
          of_root = of_root && (x == root.lo[i] || x == root.hi[i]);
        }
        if (!of_root) {
          EXPECT_NE(p.surfaces[f].sign_at(at, p.kernel), Sign::Zero);
        }
      }
    }
    if (leaf.state != CellState::Certified) continue;
    for (const int c : leaf.graphs) {
      const auto& graph = partition.graphs()[static_cast<std::size_t>(c)];
      EXPECT_TRUE(graph.box.contains(leaf.box));
      ++certified[static_cast<std::size_t>(graph.surface)];
    }
    EXPECT_EQ(certified, std::vector<int>(p.surfaces.size(), 1));
    std::map<std::array<int, 2>, const PairCertificate*> pairs;
    for (const int c : leaf.pairs) {
      const auto& pair = partition.pairs()[static_cast<std::size_t>(c)];
      EXPECT_TRUE(pair.box.contains(leaf.box));
      EXPECT_TRUE(pairs.emplace(pair.surfaces, &pair).second);
    }
    EXPECT_EQ(pairs.size(), alive.size() * (alive.size() - (alive.empty() ? 0 : 1)) / 2);
    for (const int t : leaf.triple_points) {
      const TriplePoint& point = p.triple_points[static_cast<std::size_t>(t)];
      ++holders[static_cast<std::size_t>(t)];
      EXPECT_TRUE(leaf.box.contains(point.box));
      const auto& s = point.surfaces;
      for (const auto& pair :
           {std::array{s[0], s[1]}, std::array{s[0], s[2]}, std::array{s[1], s[2]}}) {
        ASSERT_TRUE(pairs.count(pair) == 1);
        EXPECT_NE(pairs[pair]->kind, PairCertificate::Kind::Apart);
      }
    }
  }
  for (std::size_t t = 0; t < holders.size(); ++t) {
    if (p.region.bounding_box().contains(p.triple_points[t].box)) {
      EXPECT_EQ(holders[t], 1);
    }
  }
}

TEST(SpacePartition, CellsOfKnownSurfacesAreFew) {
  const struct {
    std::vector<std::string> surfaces;
    Rational half;
    int most;
  } scenes[] = {
      {{"x^2+y^2+z^2-1"}, 2, 1},
      {{"x^2+y^2-1"}, 2, 1},
      {{kTorus}, 4, 38},
      {{"4*(x^2+y^2+z^2)+16*x*y*z-1001/1000"}, 1, 50},
      {{kClebsch}, 5, 65},
      {{"(x^2*(1-x^2)-y^2)^2+z^2-1/100"}, Rational(3, 2), 103},
      {{"x^2+y^2+z^2-1", "(x-200000001/100000000)^2+y^2+z^2-1"}, 4, 63},
      {{"x^2+y^2-z^2-1/100000000"}, 1, 31},
  };
  for (const auto& scene : scenes) {
    const auto p = partition(written_surfaces(scene.surfaces), cube(scene.half));
    EXPECT_EQ(count(*p, CellState::Undecided), 0) << scene.surfaces[0];
    EXPECT_LE(p->leaves().size(), static_cast<std::size_t>(scene.most)) << scene.surfaces[0];
    expect_sound(*p);
  }
}

TEST(SpacePartition, RandomTriplesAreCertified) {
  const std::size_t most[] = {0, 0, 39, 129, 300};
  for (int degree = 2; degree <= 4; ++degree)
    for (std::uint64_t seed = 1; seed <= (degree < 4 ? 3 : 1); ++seed) {
      const auto p = partition(random_surfaces(degree, seed), cube(1));
      EXPECT_EQ(count(*p, CellState::Undecided), 0);
      EXPECT_LE(p->leaves().size(), most[degree]);
      expect_sound(*p);
    }
}

TEST(SpacePartition, SignsOfAbsentSurfacesAgreeWithSamples) {
  const auto p = partition(random_surfaces(3, 4), cube(1));
  std::mt19937_64 generator(1);
  double total = 0;
  for (const auto& leaf : p->leaves()) {
    total += volume(leaf.box);
    for (std::size_t f = 0; f < p->surfaces.size(); ++f) {
      if (leaf.signs[f] == Sign::Zero) continue;
      for (int k = 0; k < 20; ++k) {
        Point<3> at;
        for (int i = 0; i < 3; ++i)
          at[i] = leaf.box.lo[i] + (0.5 + 0.5 * symmetric_random(generator)) * leaf.box.width(i);
        EXPECT_EQ(p->surfaces[f].approximate(at) > 0, leaf.signs[f] == Sign::Positive);
      }
    }
  }
  EXPECT_NEAR(total, 8, 1e-12);
}

TEST(SpacePartition, SingularPlacesStayUndecidedWithinTheBudget) {
  // A cone's apex, Whitney's umbrella (a singular line), two equal cylinders (two crossings of the
  // curve with itself) and a contact.
  const auto cone = partition(written_surfaces({"x^2+y^2-z^2"}), cube(1));
  EXPECT_GT(count(*cone, CellState::Undecided), 0);
  EXPECT_GT(count(*cone, CellState::Certified), 20);
  for (const auto& leaf : cone->leaves()) {
    if (leaf.state == CellState::Undecided) {
      EXPECT_LT(leaf.box.largest_width(), 1e-6);
    }
  }
  expect_sound(*cone);
  const auto umbrella = partition(written_surfaces({"x^2-y^2*z"}), cube(1), 300);
  EXPECT_GT(count(*umbrella, CellState::Undecided), 0);
  EXPECT_LE(umbrella->leaves().size(), 300u);
  expect_sound(*umbrella);
  for (const auto& pair : {std::vector<std::string>{"x^2+y^2-1", "y^2+z^2-1"},
                           {"x^2+y^2+z^2-1", "(x-2)^2+y^2+z^2-1"}}) {
    const auto p = partition(written_surfaces(pair), cube(Rational(5, 2)), 2000);
    EXPECT_GT(count(*p, CellState::Undecided), 0);
    expect_sound(*p);
  }
}

TEST(SpacePartition, UnknownTriplePointsAreNotPassedOver) {
  // Three planes through a point, of which nobody says that it is known.
  std::vector<FilteredFunction<3>> surfaces;
  for (const char* text : {"x+y/3-1/7", "y-z/5+1/9", "z+x/7-1/11"})
    surfaces.emplace_back(written::polynomial<3>(text));
  const Polyhedron region = cube(1);
  const SpaceScene scene{surfaces, region, {}, {}, {}};
  PartitionLimits limits;
  limits.max_leaves = 50;
  Kernel kernel;
  SpacePartition p(scene, limits, kernel);
  p.certify();
  int undecided = 0;
  for (const auto& leaf : p.leaves()) undecided += leaf.state == CellState::Undecided ? 1 : 0;
  EXPECT_GT(undecided, 0);
}

TEST(SpacePartition, LeavesCanBeSplitAgain) {
  auto p = partition(random_surfaces(3, 2), cube(1));
  const std::size_t before = p->leaves().size();
  const Box<3> box = p->leaves()[5].box;
  const CutHint hint{1, box.lo[1] + 0.2 * box.width(1), box.lo[1] + 0.3 * box.width(1)};
  ASSERT_TRUE(p->partition->split(5, hint));
  const Box<3> lower = p->leaves()[5].box;
  EXPECT_GE(lower.hi[1], hint.lo);
  EXPECT_LE(lower.hi[1], hint.hi);
  EXPECT_GT(p->leaves().size(), before);
  ASSERT_TRUE(p->partition->split(7));
  EXPECT_EQ(count(*p, CellState::Undecided), 0);
  expect_sound(*p);
}

TEST(SpacePartition, RegionsMayHaveObliqueSides) {
  // A tetrahedron, and a slab that cuts off most of the box around it.
  const Polyhedron tetrahedron =
      make_polyhedron({{-1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 0}, {1, 1, 1, -1}}).value();
  auto p = partition(random_surfaces(3, 1), tetrahedron);
  EXPECT_EQ(count(*p, CellState::Undecided), 0);
  std::mt19937_64 generator(9);
  int inside = 0;
  for (int k = 0; k < 2000; ++k) {
    Point<3> at;
    for (double& x : at) x = 0.5 + 0.5 * symmetric_random(generator);
    if (at[0] + at[1] + at[2] > 1) continue;
    ++inside;
    int found = 0;
    for (const auto& leaf : p->leaves()) found += leaf.box.contains(at) ? 1 : 0;
    EXPECT_EQ(found, 1);
  }
  EXPECT_GT(inside, 200);
  for (const auto& leaf : p->leaves()) {
    std::vector<HalfSpace> sides = tetrahedron.sides;
    for (std::size_t i = 0; i < 3; ++i) {
      HalfSpace below{0, 0, 0, Rational(leaf.box.lo[i])}, above{0, 0, 0, -Rational(leaf.box.hi[i])};
      below[i] = -1;
      above[i] = 1;
      sides.push_back(below);
      sides.push_back(above);
    }
    EXPECT_TRUE(make_polyhedron(sides).ok());
  }
}

TEST(SpacePartition, IsTheSameEveryTime) {
  const auto surfaces = random_surfaces(3, 3);
  const auto first = partition(surfaces, cube(1)), second = partition(surfaces, cube(1));
  ASSERT_EQ(first->leaves().size(), second->leaves().size());
  for (std::size_t k = 0; k < first->leaves().size(); ++k)
    EXPECT_EQ(first->leaves()[k].box, second->leaves()[k].box);
  EXPECT_EQ(first->partition->tests(), second->partition->tests());
}

}  // namespace
}  // namespace encase
