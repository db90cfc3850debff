// SPDX-License-Identifier: MIT
#include "encase/space_arrangement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "3d/segment_crossings.hpp"
#include "common/random_polynomials.hpp"
#include "flood_fill.hpp"
#include "random_triples.hpp"
#include "written.hpp"

namespace encase {
namespace {

struct Scene {
  std::string name;
  std::vector<std::string> surfaces;
  std::string box;  ///< half its side
  int regions;
};

std::ostream& operator<<(std::ostream& out, const Scene& scene) { return out << scene.name; }

struct Arranged {
  SurfaceEncasement encasement;
  SpaceArrangement arrangement;
};

Arranged arranged(const std::vector<std::string>& texts, const Rational& half) {
  std::vector<NamedSurface> surfaces;
  for (const std::string& text : texts)
    surfaces.push_back({"s" + std::to_string(surfaces.size()), written::polynomial<3>(text)});
  auto encasement = encase(surfaces, make_box({-half, -half, -half}, {half, half, half}).value());
  EXPECT_TRUE(encasement);
  EXPECT_EQ(encasement.value().outcome, Outcome::Certified);
  auto arrangement = arrange(encasement.value());
  EXPECT_TRUE(arrangement) << arrangement.error().message;
  return {std::move(encasement).value(), std::move(arrangement).value()};
}

const std::string kSphere = "x^2+y^2+z^2-1";
const std::string kTorus = "(x^2+y^2+z^2+3)^2-16*(x^2+y^2)";  // radii 2 and 1

class SpaceScenes : public testing::TestWithParam<Scene> {};

/// The regions, and which border on which, are those of a flood fill of signs on a grid.
TEST_P(SpaceScenes, AgreeWithAFloodFill) {
  const Scene& scene = GetParam();
  Rational half;
  ASSERT_TRUE(parse_rational(scene.box.c_str(), &half));
  const Arranged a = arranged(scene.surfaces, half);
  if (scene.regions > 0) {
    EXPECT_EQ(static_cast<int>(a.arrangement.regions.size()), scene.regions);
  }
  std::vector<Polynomial<3>> polynomials;
  for (const Surface& surface : a.encasement.surfaces)
    polynomials.push_back(surface.function.polynomial());
  const FloodFill fill(polynomials, nearest_double(half), 200);
  const RegionLocator locator(a.encasement, a.arrangement);
  // Every part of the grid lies in one region, and no region is met by two.
  std::vector<int> region_of(fill.parts().size(), -1);
  std::set<int> found, deep;
  std::size_t thin = 0;
  for (std::size_t k = 0; k < fill.parts().size(); ++k) {
    const auto& part = fill.parts()[k];
    const auto place = locator.locate(part.deepest);
    ASSERT_EQ(place.kind, RegionLocator::Place::Kind::Region);
    region_of[k] = place.region;
    EXPECT_EQ(a.arrangement.regions[place.region].signs, part.signs);
    found.insert(place.region);
    if (part.depth < 2)
      ++thin;  // a grain of the grid, where a region is thin
    else
      EXPECT_TRUE(deep.insert(place.region).second)
          << "region " << place.region << " is met by two parts of the grid";
  }
  EXPECT_EQ(found.size(), a.arrangement.regions.size()) << "the grid does not see all regions";
  RecordProperty("thin", static_cast<int>(thin));
  for (const auto& [pair, count] : fill.contacts()) {
    if (count < 4) continue;
    const int r = region_of[pair.first], s = region_of[pair.second];
    const std::vector<int> beside = a.arrangement.neighbours(r);
    EXPECT_TRUE(r == s || std::count(beside.begin(), beside.end(), s) == 1)
        << "regions " << r << " and " << s << " share " << count << " sides of voxels";
  }
  std::set<std::pair<int, int>> seen;
  for (const auto& [pair, count] : fill.contacts()) {
    seen.emplace(region_of[pair.first], region_of[pair.second]);
    seen.emplace(region_of[pair.second], region_of[pair.first]);
  }
  for (std::size_t r = 0; r < a.arrangement.regions.size(); ++r)
    for (const int s : a.arrangement.neighbours(static_cast<int>(r)))
      EXPECT_TRUE(seen.count({static_cast<int>(r), s})) << r << " and " << s;
}

INSTANTIATE_TEST_SUITE_P(
    All, SpaceScenes,
    testing::Values(
        Scene{"sphere", {kSphere}, "2", 2}, Scene{"torus", {kTorus}, "4", 2},
        Scene{"two_spheres", {kSphere, "(x-1)^2+y^2+z^2-1"}, "3", 4},
        Scene{"sphere_and_torus", {"x^2+y^2+(z-1/2)^2-4", kTorus}, "4", 0},
        Scene{
            "bubble_between_planes", {"x-1/100", "y-1/50", "(x+1/7)^2+(y+1/9)^2+z^2-1/2"}, "2", 8},
        Scene{"three_concentric_spheres", {kSphere, "x^2+y^2+z^2-2", "x^2+y^2+z^2-3"}, "2", 4},
        Scene{"sphere_in_a_sphere_beside_a_third",
              {kSphere, "(x-1/4)^2+y^2+z^2-1/4", "(x-8/5)^2+(y-1/3)^2+z^2-1/9"},
              "2",
              4},
        Scene{"torus_around_a_sphere", {kTorus, "x^2+y^2+z^2-1/2"}, "4", 3},
        Scene{"spheres_beside_a_plane",
              {"x^2+y^2+z^2-1/4", "(x-5/4)^2+y^2+z^2-1/4", "x+y/5+z/7+1"},
              "2",
              4},
        Scene{"five_nested_spheres",
              {"x^2+y^2+z^2-3", "(x-1/5)^2+y^2+z^2-2", "(x-1/3)^2+(y+1/4)^2+z^2-1",
               "(x-1/2)^2+(y+1/4)^2+(z-1/5)^2-2/5", "(x-1/2)^2+(y+1/3)^2+(z-1/5)^2-1/9"},
              "2",
              6},
        Scene{"four_spheres",
              {kSphere, "(x-1)^2+y^2+z^2-1", "(x-1/2)^2+(y-4/5)^2+z^2-1",
               "(x-1/2)^2+(y-1/4)^2+(z-4/5)^2-1"},
              "3",
              16}),
    [](const auto& scene) { return scene.param.name; });

/// Random surfaces have regions, and necks of regions, thinner than the grid: those of degree 4 are
/// seen whole at 400 to 800 voxels a side only, so that a region may be met by two parts here.
TEST(SpaceArrangement, OfRandomTriplesAgreesWithAFloodFill) {
  struct Triple {
    int degree;
    std::uint64_t seed;
    std::size_t necks;
  };
  for (const auto& [degree, seed, necks] :
       {Triple{2, 2, 0}, {2, 3, 0}, {2, 4, 0}, {2, 6, 0}, {3, 1, 0}, {3, 3, 0}, {4, 2, 1}}) {
    RandomOptions random;
    random.degree = degree;
    random.count = 3;
    random.seed = seed;
    std::vector<NamedSurface> surfaces;
    const auto polynomials = random_polynomials<3>(random);
    for (const Polynomial<3>& f : polynomials) surfaces.push_back({"s", f});
    const auto e = encase(surfaces, make_box({-1, -1, -1}, {1, 1, 1}).value());
    ASSERT_TRUE(e);
    ASSERT_EQ(e.value().outcome, Outcome::Certified) << degree << ' ' << seed;
    const auto arrangement = arrange(e.value());
    ASSERT_TRUE(arrangement) << arrangement.error().message;
    const RegionLocator locator(e.value(), arrangement.value());
    const FloodFill fill(polynomials, 1, 200);
    std::set<int> found, deep;
    std::size_t thin = 0, met_twice = 0;
    for (const auto& part : fill.parts()) {
      const auto place = locator.locate(part.deepest);
      if (part.depth < 2) ++thin;
      // Grains of the grid lie where ways to a facet are narrow.
      if (place.kind == RegionLocator::Place::Kind::Undecided && part.depth < 2) continue;
      ASSERT_EQ(place.kind, RegionLocator::Place::Kind::Region);
      EXPECT_EQ(arrangement.value().regions[place.region].signs, part.signs);
      found.insert(place.region);
      if (part.depth >= 2) met_twice += !deep.insert(place.region).second;
    }
    EXPECT_LE(met_twice, necks) << degree << ' ' << seed;
    const std::size_t missed = arrangement.value().regions.size() - found.size();
    std::printf("degree %d, seed %d: %zu regions, %zu parts of the grid (%zu thin), %zu not seen\n",
                degree, static_cast<int>(seed), arrangement.value().regions.size(),
                fill.parts().size(), thin, missed);
    EXPECT_LE(missed, 2u) << degree << ' ' << seed;
  }
}

TEST(SpaceArrangement, ComponentsHaveTheEulerCharacteristicOfTheirSurface) {
  const Arranged sphere = arranged({kSphere}, 2);
  ASSERT_EQ(sphere.arrangement.components.size(), 1u);
  EXPECT_TRUE(sphere.arrangement.components[0].closed);
  EXPECT_EQ(sphere.arrangement.components[0].euler, 2);
  const Arranged torus = arranged({kTorus}, 4);
  ASSERT_EQ(torus.arrangement.components.size(), 1u);
  EXPECT_TRUE(torus.arrangement.components[0].closed);
  EXPECT_EQ(torus.arrangement.components[0].euler, 0);
  // A tube has two boundary loops, and so have two discs.
  const Arranged tube = arranged({"x^2+y^2-1"}, 2);
  ASSERT_EQ(tube.arrangement.components.size(), 1u);
  EXPECT_FALSE(tube.arrangement.components[0].closed);
  EXPECT_EQ(tube.arrangement.components[0].euler, 0);
  const Arranged sheets = arranged({"z^2-x^2/9-y^2/9-1"}, 2);
  ASSERT_EQ(sheets.arrangement.components.size(), 2u);
  for (const auto& sheet : sheets.arrangement.components) EXPECT_EQ(sheet.euler, 1);
}

TEST(SpaceArrangement, ACurvedSheetMeetsARegionOfEqualSignsTwice) {
  // The plane cuts the inside of the parabolic cylinder z = x^2 - 1, below 0: outside of it the
  // plane's lower side has two regions with the same signs.
  const Arranged a = arranged({"z-x^2+1", "z+1/2"}, 2);
  std::map<std::vector<Sign>, int> count;
  for (const auto& region : a.arrangement.regions) ++count[region.signs];
  EXPECT_EQ(a.arrangement.regions.size(), 5u);
  EXPECT_EQ((count[{Sign::Negative, Sign::Positive}]), 2);
  EXPECT_EQ((count[{Sign::Negative, Sign::Negative}]), 1);
}

/// A closed sphere is alone in its cell: that it shares none is proved again by `verify`.
TEST(SpaceArrangement, ClosedSpheresInOneCellAreTakenApart) {
  const Arranged a = arranged({kSphere, "x^2+y^2+z^2-2", "(x-3)^2+y^2+z^2-1"}, 5);
  std::map<int, int> next_to;  // how many regions have so many neighbours
  for (std::size_t r = 0; r < a.arrangement.regions.size(); ++r)
    ++next_to[static_cast<int>(a.arrangement.neighbours(static_cast<int>(r)).size())];
  EXPECT_EQ(next_to, (std::map<int, int>{{1, 2}, {2, 2}}));
  for (const SpaceCell& cell : a.encasement.cells)
    for (const SurfacePatch& patch : cell.patches)
      EXPECT_TRUE(!patch.loop.empty() || cell.patches.size() == 1);
  const Verification proof = verify(a.encasement, a.arrangement);
  EXPECT_TRUE(proof.ok()) << proof.objections.front();
}

/// Small spheres at random places, some within others, all of them closed: the region around a
/// sphere is that around its smallest neighbour that holds it, which their centres tell.
TEST(SpaceArrangement, OfRandomSmallSpheresIsATree) {
  struct Sphere {
    int x, y, z, r;  // in hundredths
  };
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> place(-90, 90), size(4, 60);
    std::vector<Sphere> spheres;
    std::vector<std::string> texts;
    while (spheres.size() < 12) {
      const Sphere s{place(random), place(random), place(random), size(random)};
      if (std::max({std::abs(s.x), std::abs(s.y), std::abs(s.z)}) + s.r >= 100) continue;
      const auto apart = [&](const Sphere& t) {
        const int d =
            (s.x - t.x) * (s.x - t.x) + (s.y - t.y) * (s.y - t.y) + (s.z - t.z) * (s.z - t.z);
        return d > (s.r + t.r) * (s.r + t.r) || d < (s.r - t.r) * (s.r - t.r);
      };
      if (!std::all_of(spheres.begin(), spheres.end(), apart)) continue;
      spheres.push_back(s);
      const auto term = [](char axis, int at) {
        return std::string("(100*") + axis + (at < 0 ? "+" : "-") + std::to_string(std::abs(at)) +
               ")^2";
      };
      texts.push_back(term('x', s.x) + "+" + term('y', s.y) + "+" + term('z', s.z) + "-" +
                      std::to_string(s.r * s.r));
    }
    const Arranged a = arranged(texts, 1);
    ASSERT_EQ(a.arrangement.regions.size(), 13u);
    ASSERT_EQ(a.arrangement.components.size(), 12u);
    std::set<int> inner;
    for (const auto& component : a.arrangement.components) {
      EXPECT_TRUE(component.closed);
      EXPECT_EQ(component.euler, 2);
    }
    for (const auto& face : a.arrangement.faces) {
      const auto& inside = a.arrangement.regions[face.regions[0]];
      const auto& outside = a.arrangement.regions[face.regions[1]];
      inner.insert(face.regions[0]);
      for (int t = 0; t < 12; ++t) {
        const Sphere &s = spheres[face.surface], &other = spheres[t];
        const int d = (s.x - other.x) * (s.x - other.x) + (s.y - other.y) * (s.y - other.y) +
                      (s.z - other.z) * (s.z - other.z);
        const bool holds = t != face.surface && d < other.r * other.r && other.r > s.r;
        EXPECT_EQ(outside.signs[t] == Sign::Negative, holds);
        EXPECT_EQ(inside.signs[t] == Sign::Negative, holds || t == face.surface);
      }
    }
    EXPECT_EQ(inner.size(), 12u);
    const Verification proof = verify(a.encasement, a.arrangement);
    EXPECT_TRUE(proof.ok()) << proof.objections.front();
  }
}

/// Two points of cells with several regions of the same signs, from which every straight way to the
/// cell's boundary meets a surface: what it crosses tells the region.
TEST(SpaceArrangement, PointsWithoutAFreeWayAreLocated) {
  RandomOptions random;
  random.degree = 2;
  random.count = 3;
  random.seed = 3;
  std::vector<NamedSurface> surfaces;
  for (const Polynomial<3>& f : random_polynomials<3>(random)) surfaces.push_back({"s", f});
  const auto e = encase(surfaces, make_box({-1, -1, -1}, {1, 1, 1}).value());
  ASSERT_TRUE(e);
  const auto arrangement = arrange(e.value());
  ASSERT_TRUE(arrangement);
  const RegionLocator locator(e.value(), arrangement.value());
  for (const Point<3>& p :
       {Point<3>{-0.30726218157654905, 0.11959127308779727, -0.27739462068311671},
        Point<3>{-0.20326053281844125, 0.15693728504235649, -0.15089273464264386}}) {
    const RationalPoint<3> point{Rational(p[0]), Rational(p[1]), Rational(p[2])};
    const auto place = locator.locate(point);
    ASSERT_EQ(place.kind, RegionLocator::Place::Kind::Region);
    for (std::size_t s = 0; s < surfaces.size(); ++s)
      EXPECT_EQ(arrangement.value().regions[place.region].signs[s],
                sign_of(sgn(surfaces[s].function.polynomial()(point))));
  }
}

/// What a straight way crosses tells more than signs: points of cells with several regions of the
/// same signs, found among thousands, and others to which a straight way is free.
TEST(SpaceArrangement, PointsWithAFreeWayBetweenThemLieInOneRegion) {
  const auto thousandths = [](int x, int y, int z) {
    return RationalPoint<3>{Rational(x, 1000), Rational(y, 1000), Rational(z, 1000)};
  };
  const std::vector<std::pair<int, RationalPoint<3>>> places = {
      {1, thousandths(-72, -108, -523)}, {4, thousandths(-300, -119, -339)},
      {5, thousandths(716, 364, 747)},   {5, thousandths(770, 181, 329)},
      {5, thousandths(124, 241, 883)},
  };
  std::mt19937_64 random(11);
  std::uniform_int_distribution<int> coordinate(-999, 999);
  for (const auto& [seed, point] : places) {
    const auto triple = named(random_triple(2, seed));
    const std::vector<NamedSurface> surfaces(triple.begin(), triple.end());
    const auto e = encase(surfaces, cube(1));
    ASSERT_TRUE(e);
    const auto arrangement = arrange(e.value());
    ASSERT_TRUE(arrangement);
    const RegionLocator locator(e.value(), arrangement.value());
    std::vector<const Function<3>*> functions;
    for (const NamedSurface& surface : surfaces) functions.push_back(&surface.function);
    const auto place = locator.locate(point);
    ASSERT_EQ(place.kind, RegionLocator::Place::Kind::Region) << seed;
    int others = 0;
    for (int k = 0; k < 200; ++k) {
      const RationalPoint<3> other =
          thousandths(coordinate(random), coordinate(random), coordinate(random));
      const auto changes = sign_changes(functions, point, other);
      if (!changes || !changes->empty()) continue;
      const auto beside = locator.locate(other);
      if (beside.kind != RegionLocator::Place::Kind::Region) continue;
      ++others;
      EXPECT_EQ(beside.region, place.region) << seed;
    }
    EXPECT_GT(others, 3) << seed;
  }
}

TEST(SpaceArrangement, FacesGoOnFromCellToCell) {
  const Arranged torus = arranged({kTorus}, 4);
  EXPECT_GT(torus.encasement.cells.size(), 10u);
  EXPECT_EQ(torus.arrangement.faces.size(), 1u);
  EXPECT_EQ(torus.arrangement.regions.size(), 2u);
  const Arranged spheres = arranged({"x^2+y^2+z^2-1", "(x-1)^2+y^2+z^2-1"}, 3);
  EXPECT_EQ(spheres.arrangement.faces.size(), 4u);
  EXPECT_EQ(spheres.arrangement.regions.size(), 4u);
}

TEST(SpaceArrangement, PointsAreLocatedByTheirSigns) {
  const Arranged a = arranged({kSphere, "z-x^2+1/2", "x+y+z"}, 2);
  const RegionLocator locator(a.encasement, a.arrangement);
  std::mt19937_64 random(7);
  std::uniform_int_distribution<int> coordinate(-1999, 1999);
  for (int k = 0; k < 500; ++k) {
    RationalPoint<3> point;
    for (Rational& c : point) c = Rational(coordinate(random), 1000);
    const auto place = locator.locate(point);
    ASSERT_EQ(place.kind, RegionLocator::Place::Kind::Region);
    for (std::size_t s = 0; s < a.encasement.surfaces.size(); ++s) {
      const Rational value = a.encasement.surfaces[s].function.polynomial()(point);
      EXPECT_EQ(a.arrangement.regions[place.region].signs[s], sign_of(sgn(value)));
    }
  }
  EXPECT_EQ(locator.locate({3, 0, 0}).kind, RegionLocator::Place::Kind::Outside);
  const auto on = locator.locate({Rational(3, 5), Rational(4, 5), 0});
  EXPECT_EQ(on.kind, RegionLocator::Place::Kind::OnSurface);
  EXPECT_EQ(on.surfaces, std::vector<int>{0});
}

}  // namespace
}  // namespace encase
