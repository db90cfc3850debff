// SPDX-License-Identifier: MIT
//
// Crossings against CGAL's resultant-based roots. This test program links CGAL's algebraic kernel
// (GPL); nothing of it is part of the library.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cgal_roots.hpp"
#include "common/random_polynomials.hpp"
#include "encase/curves_file.hpp"
#include "encase/encasement.hpp"
#include "encase/verify.hpp"

namespace encase {
namespace {

using Enclosure = CgalRoots::Enclosure;

/// The range of a line's affine form over a rational box.
std::array<Rational, 2> range(const Line& line, const Enclosure& box) {
  const auto c = line.exact();
  std::array<Rational, 2> r{c[2], c[2]};
  for (int i = 0; i < 2; ++i) {
    const Rational a = c[i] * box.lo[i], b = c[i] * box.hi[i];
    r[0] += a < b ? a : b;
    r[1] += a < b ? b : a;
  }
  return r;
}

enum class Place { Inside, Outside, Unclear };

Place place(const Region& region, const Enclosure& root) {
  bool inside = true;
  for (int k = 0; k < region.side_count(); ++k) {
    const auto [lo, hi] = range(region.side(k), root);
    if (lo > 0) return Place::Outside;
    if (hi >= 0) inside = false;
  }
  return inside ? Place::Inside : Place::Unclear;
}

bool contains(const Box<2>& box, const Enclosure& e) {
  for (int i = 0; i < 2; ++i)
    if (e.lo[i] < box.lo[i] || e.hi[i] > box.hi[i]) return false;
  return true;
}

bool meets(const Box<2>& box, const Enclosure& e) {
  for (int i = 0; i < 2; ++i)
    if (e.hi[i] < box.lo[i] || e.lo[i] > box.hi[i]) return false;
  return true;
}

std::string text(const Enclosure& e) {
  return "(" + std::to_string(e.lo[0].get_d()) + ", " + std::to_string(e.lo[1].get_d()) + ")";
}

/// Whether a box that the result reports as unresolved may hold the root of this pair.
bool is_reported(const Encasement& encasement, const Enclosure& root) {
  for (const auto* list : {&encasement.degenerate, &encasement.undecided})
    for (const Unresolved& u : *list)
      if (u.has_box && meets(u.box, root)) return true;
  return false;
}

/// Every root of the pair in the closed region is in exactly one crossing's box or in a reported
/// box, and every crossing's box holds exactly one root.
void expect_roots_match(const Encasement& encasement, int first, int second,
                        const CgalRoots& roots) {
  std::map<int, int> roots_in;  // of each crossing of the pair
  for (int k = 0; k < static_cast<int>(encasement.crossings.size()); ++k)
    if (encasement.crossings[k].curves == std::array<int, 2>{first, second}) roots_in[k] = 0;
  for (int i = 0; i < roots.size(); ++i) {
    std::vector<int> holders;
    Enclosure root;
    bool clear = false;
    for (int bits = 80; !clear && bits <= 1280; bits *= 2) {
      root = roots.enclose(i, bits);
      holders.clear();
      clear = true;
      for (const auto& [k, count] : roots_in) {
        const Box<2>& box = encasement.crossings[k].box;
        if (contains(box, root))
          holders.push_back(k);
        else if (meets(box, root))
          clear = false;
      }
    }
    ASSERT_TRUE(clear) << "a root at the boundary of a crossing's box, " << text(root);
    ASSERT_LE(holders.size(), 1u) << text(root);
    const Place where = place(encasement.region, root);
    if (holders.empty()) {
      if (where == Place::Inside) {
        EXPECT_TRUE(is_reported(encasement, root)) << text(root);
      }
      continue;
    }
    ++roots_in[holders[0]];
    EXPECT_EQ(roots.multiplicity(i), 1) << text(root);
    const Location location = encasement.crossings[holders[0]].location;
    if (where == Place::Inside) {
      EXPECT_EQ(location, Location::Inside) << text(root);
    }
    if (where == Place::Outside) {
      EXPECT_EQ(location, Location::Outside) << text(root);
    }
  }
  for (const auto& [k, count] : roots_in)
    EXPECT_EQ(count, 1) << "crossing " << k << " at " << encasement.crossings[k].point[0] << ", "
                        << encasement.crossings[k].point[1];
}

void expect_verified(const Encasement& encasement) {
  const Verification verification = verify(encasement);
  for (const std::string& objection : verification.objections) ADD_FAILURE() << objection;
}

Region polygon(const std::vector<std::array<Rational, 2>>& corners) {
  return make_region({corners.begin(), corners.end()}).value();
}

Region triangle() {
  return polygon({{Rational(-9, 10), Rational(-7, 10)},
                  {Rational(19, 20), Rational(-3, 5)},
                  {Rational(1, 10), Rational(9, 10)}});
}

Region hexagon() {
  return polygon({{Rational(1), Rational(1, 20)},
                  {Rational(1, 2), Rational(9, 10)},
                  {Rational(-11, 20), Rational(4, 5)},
                  {Rational(-1), Rational(-1, 10)},
                  {Rational(-2, 5), Rational(-17, 20)},
                  {Rational(3, 5), Rational(-4, 5)}});
}

struct RandomPair {
  int degree;
  int seed;
};

void PrintTo(const RandomPair& pair, std::ostream* out) {
  *out << "degree " << pair.degree << ", seed " << pair.seed;
}

/// Two curves of the degree with many crossings in the box [lo, hi]^2.
std::vector<NamedCurve> random_pair(const RandomPair& pair, const Rational& lo,
                                    const Rational& hi) {
  RandomOptions options;
  options.degree = pair.degree;
  options.seed = static_cast<std::uint64_t>(pair.seed);
  options.lo = lo;
  options.hi = hi;
  return random_curves(options);
}

class CgalMatch : public testing::TestWithParam<RandomPair> {};

void expect_match_in(const std::vector<NamedCurve>& curves, const CgalRoots& roots,
                     const Region& region) {
  const auto result = encase(curves, region);
  ASSERT_TRUE(result.ok()) << result.error().message;
  const Encasement& encasement = result.value();
  EXPECT_TRUE(encasement.outcome == Outcome::Certified);
  for (const auto* list : {&encasement.degenerate, &encasement.undecided})
    for (const Unresolved& u : *list) ADD_FAILURE() << u.reason;
  ASSERT_EQ(encasement.curves.size(), 2u);
  expect_roots_match(encasement, 0, 1, roots);
  expect_verified(encasement);
}

TEST_P(CgalMatch, WhenTheRegionIsASquareTriangleOrHexagon) {
  const auto curves = random_pair(GetParam(), -1, 1);
  const CgalRoots roots(curves[0].function.polynomial(), curves[1].function.polynomial());
  {
    SCOPED_TRACE("square");
    expect_match_in(curves, roots, make_region(-1, 1, -1, 1).value());
  }
  {
    SCOPED_TRACE("triangle");
    expect_match_in(curves, roots, triangle());
  }
  SCOPED_TRACE("hexagon");
  expect_match_in(curves, roots, hexagon());
}

/// Crossings far away make CGAL slow where the degree is higher.
class CgalMatchInThePlane : public CgalMatch {};

TEST_P(CgalMatchInThePlane, HasAllRoots) {
  const auto curves = random_pair(GetParam(), -1, 1);
  const Result<Encasement> result = encase(curves, whole_plane());
  ASSERT_TRUE(result.ok()) << result.error().message;
  EXPECT_EQ(result.value().outcome, Outcome::Certified);
  expect_verified(result.value());
  const CgalRoots roots(curves[0].function.polynomial(), curves[1].function.polynomial());
  EXPECT_EQ(static_cast<int>(result.value().crossings.size()), roots.size());
  expect_roots_match(result.value(), 0, 1, roots);
}

TEST_P(CgalMatch, WhenTheRegionIsSmall) {
  const Rational lo(-1, 10), hi(1, 10);
  const auto curves = random_pair(GetParam(), lo, hi);
  const CgalRoots roots(curves[0].function.polynomial(), curves[1].function.polynomial());
  expect_match_in(curves, roots, make_region(lo, hi, lo, hi).value());
}

/// CGAL's time grows steeply with the degree: fewer seeds there.
std::vector<RandomPair> random_pairs(int most_degree) {
  std::vector<RandomPair> pairs;
  for (int degree = 2; degree <= most_degree; ++degree)
    for (int seed = 1; seed <= (degree < 6 ? 5 : degree < 8 ? 3 : 2); ++seed)
      pairs.push_back({degree, seed});
  return pairs;
}

std::string name_of(const testing::TestParamInfo<RandomPair>& test) {
  return "Degree" + std::to_string(test.param.degree) + "Seed" + std::to_string(test.param.seed);
}

INSTANTIATE_TEST_SUITE_P(RandomPairs, CgalMatch, testing::ValuesIn(random_pairs(8)), name_of);
INSTANTIATE_TEST_SUITE_P(RandomPairs, CgalMatchInThePlane, testing::ValuesIn(random_pairs(5)),
                         name_of);

/// The files with two curves at least, all polynomials.
std::vector<std::string> files_with_pairs() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(ENCASE_TEST_DATA "/curves")) {
    if (entry.path().extension() != ".curves") continue;
    const auto file = load_curves(entry.path().string());
    if (!file.ok() || file.value().curves.size() < 2) continue;
    const auto& curves = file.value().curves;
    if (std::all_of(curves.begin(), curves.end(),
                    [](const NamedCurve& curve) { return curve.function.is_polynomial(); }))
      names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class CgalMatchOfFile : public testing::TestWithParam<std::string> {};

TEST_P(CgalMatchOfFile, HoldsForEveryPair) {
  const auto file = load_curves(ENCASE_TEST_DATA "/curves/" + GetParam() + ".curves");
  ASSERT_TRUE(file.ok()) << file.error().message;
  ASSERT_TRUE(file.value().region.has_value());
  const auto result = encase(file.value().curves, *file.value().region);
  ASSERT_TRUE(result.ok()) << result.error().message;
  const Encasement& encasement = result.value();
  const int n = static_cast<int>(encasement.curves.size());
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      expect_roots_match(encasement, i, j,
                         CgalRoots(encasement.curves[i].function.polynomial(),
                                   encasement.curves[j].function.polynomial()));
  expect_verified(encasement);
}

INSTANTIATE_TEST_SUITE_P(Data, CgalMatchOfFile, testing::ValuesIn(files_with_pairs()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace encase
