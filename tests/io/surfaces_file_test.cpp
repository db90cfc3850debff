// SPDX-License-Identifier: MIT
#include "encase/surfaces_file.hpp"

#include <gtest/gtest.h>

#include <string>

#include "written.hpp"

namespace encase {
namespace {

std::string message(const std::string& text) {
  const auto file = read_surfaces(text, "file");
  return file ? "" : file.error().message;
}

TEST(SurfacesFile, HasSurfacesAndARegion) {
  const SurfacesFile file =
      read_surfaces("# two\nball: x^2 + y^2 + z^2 = 1\nz - sin(x y)\nregion: box -1 1 -2 2 -3 3\n",
                    "file")
          .value();
  ASSERT_EQ(file.surfaces.size(), 2u);
  EXPECT_EQ(file.surfaces[0].name, "ball");
  EXPECT_EQ(file.surfaces[0].function.polynomial(), written::polynomial<3>("x^2 + y^2 + z^2 - 1"));
  EXPECT_EQ(file.surfaces[1].name, "s1");
  EXPECT_FALSE(file.surfaces[1].function.is_polynomial());
  EXPECT_EQ(file.region->corners.size(), 8u);
}

TEST(SurfacesFile, RegionsMayBeHalfSpaces) {
  const SurfacesFile file =
      read_surfaces("x y z - 1\nregion: halfspaces (-1,0,0,0) (0,-1,0,0) (0,0,-1,0) (1,1,1,-2)\n",
                    "file")
          .value();
  EXPECT_EQ(file.region->corners.size(), 4u);
}

TEST(SurfacesFile, JsonSaysTheSame) {
  const SurfacesFile file =
      read_surfaces(R"({"surfaces": [{"name": "a", "terms": [[1, 1, 1, "1/2"], [0, 0, 0, -1]]},
                        {"expr": "z = x exp(y) + 1"}], "region": [0, 1, 0, 1, 0, "3/2"]
})",
                    "file")
          .value();
  EXPECT_EQ(file.surfaces[0].function.polynomial(), written::polynomial<3>("x y z/2 - 1"));
  EXPECT_EQ(file.surfaces[1].name, "s1");
  EXPECT_EQ(file.region->corners.back(), (RationalPoint<3>{1, 1, Rational(3, 2)}));
  const auto halves = read_surfaces(
      R"({"surfaces": [{"expr": "x"}], "region": {"halfspaces":
          [[-1,0,0,0], [0,-1,0,0], [0,0,-1,0], [1,1,1,-2]]}})",
      "file");
  EXPECT_EQ(halves.value().region->corners.size(), 4u);
}

TEST(SurfacesFile, ErrorsNameTheirPlace) {
  EXPECT_NE(message("").find("there is no surface"), std::string::npos);
  EXPECT_NE(message("x + w").find("the variables are x, y and z"), std::string::npos);
  EXPECT_NE(message("a: x\na: y").find("already a surface 'a'"), std::string::npos);
  EXPECT_NE(message("x\nregion: 0 1 0 1").find("file:2:9"), std::string::npos);
  EXPECT_NE(message("x\nregion: box 0 1 0 1").find("six numbers"), std::string::npos);
  EXPECT_NE(message("x\nregion: box 0 1 0 1 1 1").find("no volume"), std::string::npos);
  EXPECT_NE(message("x\nregion: halfspaces (1,0,0)").find("expected a number"), std::string::npos);
  EXPECT_NE(message("3").find("surface 's0' is a constant"), std::string::npos);
  EXPECT_NE(message(R"({"surfaces": []})").find("there is no surface"), std::string::npos);
  EXPECT_NE(message(R"({"surfaces": [{"terms": [[1, 1, "1"]]}]})").find("[i, j, k"),
            std::string::npos);
  EXPECT_NE(message(R"({"surfaces": [{"expr": "x"}], "region": [0, 1]})").find("x0, x1"),
            std::string::npos);
}

}  // namespace
}  // namespace encase
