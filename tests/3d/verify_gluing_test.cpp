// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "3d/verify_space_claims.hpp"
#include "encase/surface_encasement.hpp"
#include "written.hpp"

namespace encase {
namespace {

/// What is objected to in patches and arcs whatever they were read from.
std::string objections(const SurfaceEncasement& e) {
  verification::SpaceClaims claims(e, VerifyOptions{});
  verification::check_space_gluing(claims);
  std::string text;
  for (const std::string& objection : claims.report.objections) text += objection + "\n";
  return text;
}

SurfaceEncasement encased(const std::vector<std::string>& texts) {
  std::vector<NamedSurface> surfaces;
  for (const std::string& text : texts)
    surfaces.push_back({"s" + std::to_string(surfaces.size()), written::polynomial<3>(text)});
  return encase(surfaces, make_box({-3, -3, -3}, {3, 3, 3}).value()).value();
}

/// Two spheres and a plane that meet in two points.
SurfaceEncasement scene() {
  return encased({"x^2 + y^2 + z^2 - 1", "(x - 1)^2 + y^2 + z^2 - 1", "z - y/3 - 1/7"});
}

TEST(VerifyGluing, AcceptsWhatIsRight) {
  const SurfaceEncasement e = scene();
  ASSERT_EQ(e.outcome, Outcome::Certified);
  EXPECT_EQ(objections(e), "");
  EXPECT_TRUE(verify(e).ok());
}

TEST(VerifyGluing, ObjectsToArcsThatCrossWhereTheyMustNot) {
  // Of the two other ways to pair four ends on a rim at least one needs a crossing more or less.
  int tried = 0;
  const SurfaceEncasement e = encased({"z - x^3 + x/4", "z - y/100"});
  ASSERT_EQ(objections(e), "");
  for (std::size_t c = 0; c < e.cells.size(); ++c)
    for (std::size_t a = 0; a < e.cells[c].arcs.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        const SurfaceArc &first = e.cells[c].arcs[a], &second = e.cells[c].arcs[b];
        if (first.surfaces != second.surfaces || first.patches != second.patches) continue;
        bool found = false;
        for (const std::size_t end : {0, 1}) {
          SurfaceEncasement m = e;
          auto& arcs = m.cells[c].arcs;
          std::swap(arcs[a].ends[0], arcs[b].ends[end]);
          found = found || objections(m).find("cannot have these ends") != std::string::npos;
        }
        EXPECT_TRUE(found) << c;
        ++tried;
      }
  EXPECT_GT(tried, 0);
}

TEST(VerifyGluing, ObjectsToATriplePointOnAnotherArc) {
  SurfaceEncasement e = scene();
  ASSERT_EQ(e.triple_points.size(), 2u);
  SpaceCell& cell = e.cells[static_cast<std::size_t>(e.triple_points[0].cell)];
  for (SurfaceArc& arc : cell.arcs)
    if (!arc.triple_points.empty()) {
      arc.triple_points.clear();
      break;
    }
  EXPECT_NE(objections(e).find("cannot have these ends"), std::string::npos);
  EXPECT_NE(objections(e).find("not on three arcs"), std::string::npos);
}

TEST(VerifyGluing, ObjectsToLoopsThatAreNotClosedAndEndsThatAreElsewhere) {
  const SurfaceEncasement e = scene();
  SurfaceEncasement open = e;
  for (SpaceCell& cell : open.cells)
    for (SurfacePatch& patch : cell.patches)
      if (patch.loop.size() > 3) {
        std::swap(patch.loop[0], patch.loop[1]);
        EXPECT_NE(objections(open).find("is not closed"), std::string::npos);
        std::swap(patch.loop[0], patch.loop[1]);
      }
  SurfaceEncasement apart = e;
  for (SpaceCell& cell : apart.cells)
    for (SurfaceArc& arc : cell.arcs) {
      const auto ends = std::exchange(arc.ends, {arc.ends[0], arc.ends[0]});
      EXPECT_NE(objections(apart).find("does not end on the loops"), std::string::npos);
      arc.ends = ends;
    }
}

}  // namespace
}  // namespace encase
