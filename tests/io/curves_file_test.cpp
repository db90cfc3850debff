// SPDX-License-Identifier: MIT
#include "encase/curves_file.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace encase {
namespace {

const Polynomial<2> kX = Polynomial<2>::variable(0), kY = Polynomial<2>::variable(1);
Polynomial<2> constant(long p, long q = 1) { return Polynomial<2>::constant(Rational(p, q)); }

CurvesFile read(const std::string& text) {
  auto file = read_curves(text, "f");
  if (!file.ok()) {
    ADD_FAILURE() << file.error().message;
    return {};
  }
  return file.value();
}

void expect_refused(const std::string& text, const std::string& message) {
  const auto file = read_curves(text, "f.curves");
  ASSERT_FALSE(file.ok()) << text;
  EXPECT_EQ(file.error().code, Error::Code::BadInput);
  EXPECT_NE(file.error().message.find(message), std::string::npos)
      << "of: " << text << "\ngot: " << file.error().message;
}

TEST(CurvesText, NamesAreKeptOrNumbered) {
  const CurvesFile file = read(
      "\xEF\xBB\xBF# two curves\r\n"
      "region: -2 2, -1/2 0.5  # exact\r\n"
      "\r\n"
      "  circle : x^2 + y^2 = 1 # unit\r\n"
      "y - x\r\n"
      "a.b-c_3: x");
  ASSERT_EQ(file.curves.size(), 3U);
  EXPECT_EQ(file.curves[0].name, "circle");
  EXPECT_EQ(file.curves[0].function.polynomial(), kX * kX + kY * kY - constant(1));
  EXPECT_EQ(file.curves[1].name, "c1");
  EXPECT_EQ(file.curves[1].function.polynomial(), kY - kX);
  EXPECT_EQ(file.curves[2].name, "a.b-c_3");
  ASSERT_TRUE(file.region);
  EXPECT_EQ(file.region->corners[0], (RationalPoint<2>{-2, Rational(-1, 2)}));
  EXPECT_EQ(file.region->corners[2], (RationalPoint<2>{2, Rational(1, 2)}));
  EXPECT_FALSE(file.region->plane);
}

TEST(CurvesText, TheWholePlaneIsARegion) {
  EXPECT_TRUE(read("x\nregion: plane").region->plane);
  EXPECT_TRUE(read(R"({"curves": [{"expr": "x"}], "region": "plane"})").region->plane);
}

TEST(CurvesText, ARegionIsNotRequired) { EXPECT_FALSE(read("x").region); }

TEST(CurvesText, PolygonsOfEitherOrientationAreRegions) {
  const char* const texts[] = {"x\nregion: polygon (0,0) (2,0) (1, 1/3)",
                               "x\nregion: polygon (1 1/3),(2,0),(0,0)"};
  for (const char* text : texts) {
    const CurvesFile file = read(text);
    ASSERT_TRUE(file.region);
    EXPECT_EQ(file.region->side_count(), 3);
  }
}

TEST(CurvesText, ErrorsNameFileLineAndColumnAndShowTheLine) {
  const auto file =
      read_curves("region: -2 2 -2 2\n# \xC3\xA4\n  g: x^2 \t+ w  # tail\ny", "a.curves");
  ASSERT_FALSE(file.ok());
  EXPECT_EQ(file.error().message,
            "a.curves:3:13: unknown variable 'w'; the variables are x and y\n"
            "    g: x^2  + w  # tail\n"
            "              ^");
}

TEST(CurvesText, LongLinesAreCutAroundTheError) {
  std::string line = "c: x";
  for (int k = 0; k < 100; ++k) line += " + x*y";
  const std::size_t place = line.size() + 3;
  line += " + w";
  for (int k = 0; k < 100; ++k) line += " + x*y";
  const auto file = read_curves(line, "f");
  ASSERT_FALSE(file.ok());
  EXPECT_NE(file.error().message.find("f:1:" + std::to_string(place + 1) + ": "),
            std::string::npos);
  std::istringstream lines(file.error().message);
  std::string message, shown, caret;
  std::getline(lines, message);
  std::getline(lines, shown);
  std::getline(lines, caret);
  EXPECT_LT(shown.size(), 120U);
  EXPECT_EQ(shown[caret.find('^')], 'w');
}

TEST(CurvesText, BadInputIsRefusedWithAReason) {
  expect_refused("", "f.curves:1:1: there is no curve");
  expect_refused("# nothing\n\nregion: 0 1 0 1\n", "there is no curve");
  expect_refused("(x", "f.curves:1:1: '(' without a ')'");
  expect_refused("x + w", "f.curves:1:5: unknown variable 'w'");
  expect_refused("zero: x - x", "f.curves:1:7: curve 'zero' is the zero polynomial");
  expect_refused("x\n1", "f.curves:2:1: curve 'c1' is a constant");
  expect_refused("a: sin(1) + pi", "f.curves:1:4: curve 'a' has no variable: it is a constant");
  expect_refused("y + sqrt(-1 - x^2)", "curve 'c0' has no value at any point");
  expect_refused("1 = 1", "curve 'c0' is the zero polynomial");
  expect_refused("sin(x) + y^2000000", "the exponent is 2000000, larger than a million");
  expect_refused("x + NaN", "f.curves:1:5: 'NaN' is not a number");
  expect_refused("y - x^500", "the degree is 500; polynomials are limited to degree 60");
  expect_refused("f:", "f.curves:1:3: expected a number");
  expect_refused(": x", "a curve's name consists of");
  expect_refused("x y: x", "a curve's name consists of");
  expect_refused("f: x\ng: y\nf: y", "f.curves:3:1: there is already a curve 'f', in line 1");
  expect_refused("c1: x\ny", "f.curves:2:1: there is already a curve 'c1', in line 1");
  expect_refused("cbrt(x)", "the function 'cbrt' is not supported");
}

TEST(CurvesText, BadRegionsAreRefusedWithAReason) {
  expect_refused("x\nregion: 1 1 0 1", "f.curves:2:9: the region has no area");
  expect_refused("x\nregion: 2 1 0 1", "xmin = 2 is not less than xmax = 1");
  expect_refused("x\nregion:", "f.curves:2:8: a region is 'xmin xmax ymin ymax'");
  expect_refused("x\nregion: 0 1 0", "f.curves:2:14: a box has four numbers");
  expect_refused("x\nregion: 0 1 0 1 2", "f.curves:2:17: a box has four numbers");
  expect_refused("x\nregion: 0 nan 0 1", "f.curves:2:11: 'nan' is not a number");
  expect_refused("x\nregion: 0 inf 0 1", "'inf' is not a number");
  expect_refused("x\nregion: 0 1 0 1e400", "too far away");
  expect_refused("x\nregion: plane 1", "f.curves:2:15: nothing may follow 'plane'");
  expect_refused("x\nregion: 0 1 0 1\nregion: 0 1 0 1", "f.curves:3:1: the region is given twice");
  expect_refused("x\nregion: polygon (0,0) (1,1)", "at least three corners");
  expect_refused("x\nregion: polygon (0,0) (1,1) (2,2)", "no area");
  expect_refused("x\nregion: polygon (0,0) (2,0) (1,1/2) (0,2)", "not convex");
  expect_refused("x\nregion: polygon (0,0) (2,0 (0,2)", "expected ')'");
  expect_refused("x\nregion: polygon (0,0) (2) (0,2)", "expected a number");
  expect_refused("x\nregion: polygon 0 0 2 0 0 2", "f.curves:2:17: expected a corner '(x,y)'");
}

TEST(CurvesJson, HasExpressionsTermsAndExactNumbers) {
  const CurvesFile file = read(R"( {"region": [-1, 1.5, "-1/3", 0.1], "comment": "any",
    "curves": [{"name": "circle", "expr": "x^2 + y^2 = 1"},
               {"terms": [[0, 1, "1"], [3, 0, "-2/3"], [0, 0, 0.1], [0, 1, 1e1]]}]})");
  ASSERT_EQ(file.curves.size(), 2U);
  EXPECT_EQ(file.curves[0].name, "circle");
  EXPECT_EQ(file.curves[0].function.polynomial(), kX * kX + kY * kY - constant(1));
  EXPECT_EQ(file.curves[1].name, "c1");
  EXPECT_EQ(file.curves[1].function.polynomial(),
            kY * constant(11) - kX.power(3) * constant(2, 3) + constant(1, 10));
  ASSERT_TRUE(file.region);
  EXPECT_EQ(file.region->corners[0], (RationalPoint<2>{-1, Rational(-1, 3)}));
  EXPECT_EQ(file.region->corners[2], (RationalPoint<2>{Rational(3, 2), Rational(1, 10)}));
}

TEST(CurvesJson, RegionsCanBePolygons) {
  const CurvesFile file =
      read(R"({"region": {"polygon": [[0, 0], [1, 0], ["1/3", 1]]}, "curves": [{"expr": "x"}]})");
  ASSERT_TRUE(file.region);
  EXPECT_EQ(file.region->side_count(), 3);
}

TEST(CurvesJson, SyntaxErrorsNameLineAndColumn) {
  const auto file = read_curves("{\"curves\": [\n  {\"expr\": x}]}", "f.json");
  ASSERT_FALSE(file.ok());
  EXPECT_NE(file.error().message.find("f.json:2:12: not valid JSON"), std::string::npos)
      << file.error().message;
  EXPECT_NE(file.error().message.find("\n             ^"), std::string::npos)
      << file.error().message;
  expect_refused("{\"curves\": [", "not valid JSON");
  expect_refused(std::string("{\"a\":") + std::string(1000000, '['), "nested too deeply");
  expect_refused("{\"curves\": [], \"curves\": []}", "appears twice");
}

TEST(CurvesJson, OtherErrorsNameThePath) {
  const auto curve = [](const std::string& members) {
    return "{\"curves\": [{\"expr\": \"x\"}, {" + members + "}]}";
  };
  expect_refused("{}", "f.curves: there is no curve");
  expect_refused("{\"curves\": []}", "there is no curve");
  expect_refused("{\"curves\": 3}", "curves: expected an array");
  expect_refused("{\"curve\": []}", "unknown key \"curve\"");
  expect_refused(curve(""), "curves[1]: a curve needs \"expr\" or \"terms\"");
  expect_refused(curve("\"expr\": 3"), "curves[1].expr: expected a string");
  expect_refused(curve("\"expr\": \"x + w\""), "curves[1].expr:1:5: unknown variable 'w'");
  expect_refused(curve("\"expr\": \"x\", \"terms\": []"), "either \"expr\" or \"terms\"");
  expect_refused(curve("\"terms\": [[0, 0]]"), "curves[1].terms[0]: expected [i, j");
  expect_refused(curve("\"terms\": [[0, -1, 1]]"), "exponents are integers");
  expect_refused(curve("\"terms\": [[0, 0.5, 1]]"), "exponents are integers");
  expect_refused(curve("\"terms\": [[30, 31, 1]]"), "the degree is 61");
  expect_refused(curve("\"terms\": [[0, 99999999999999999999, 1]]"), "limited to degree 60");
  expect_refused(curve("\"terms\": [[1, 0, \"one\"]]"), "curves[1].terms[0][2]: \"one\" is not a");
  expect_refused(curve("\"terms\": [[1, 0, null]]"), "expected a number");
  expect_refused(curve("\"terms\": []"), "curves[1]: curve 'c1' is the zero polynomial");
  expect_refused(curve("\"terms\": [[0, 0, 2]]"), "curve 'c1' is a constant");
  expect_refused(curve("\"expr\": \"y\", \"name\": \"c0\""), "already a curve 'c0'");
  expect_refused(curve("\"expr\": \"y\", \"name\": \"a b\""), "curves[1].name: a curve's name");
  expect_refused("{\"region\": [0, 1, 0], \"curves\": [{\"expr\": \"x\"}]}", "region: expected");
  expect_refused("{\"region\": [0, 0, 0, 1], \"curves\": [{\"expr\": \"x\"}]}", "no area");
  expect_refused("{\"region\": {\"polygon\": [[0, 0], [1]]}, \"curves\": []}",
                 "region.polygon[1]: expected [x, y]");
}

TEST(LoadCurves, FilesThatCannotBeReadAreIoErrors) {
  const auto absent = load_curves("/nonexistent/a.curves");
  ASSERT_FALSE(absent.ok());
  EXPECT_EQ(absent.error().code, Error::Code::Io);
  EXPECT_EQ(absent.error().message, "cannot read /nonexistent/a.curves: No such file or directory");
  const auto directory = load_curves(testing::TempDir());
  ASSERT_FALSE(directory.ok());
  EXPECT_EQ(directory.error().code, Error::Code::Io);
  EXPECT_NE(directory.error().message.find("directory"), std::string::npos);
}

TEST(LoadCurves, ShippedFilesAreRead) {
  int files = 0, analytic = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ENCASE_TEST_DATA "/curves")) {
    if (entry.path().extension() != ".curves") continue;
    const auto file = load_curves(entry.path().string());
    EXPECT_TRUE(file.ok()) << file.error().message;
    if (!file.ok()) continue;
    files += file.value().region.has_value();
    for (const NamedCurve& curve : file.value().curves) analytic += !curve.function.is_polynomial();
  }
  EXPECT_GT(files, 30);
  EXPECT_EQ(analytic, 12);
}

TEST(ParsePolynomial, GivesZeroAndConstantsToo) {
  EXPECT_EQ(parse_polynomial("x = y").value(), kX - kY);
  EXPECT_TRUE(parse_polynomial("0").value().is_zero());
  EXPECT_FALSE(parse_function("y = sin(x)").value().is_polynomial());
  EXPECT_NE(parse_polynomial("y = sin(x)").error().message.find("cannot be part of a polynomial"),
            std::string::npos);
  const auto bad = parse_polynomial("x + (", "-e");
  ASSERT_FALSE(bad.ok());
  EXPECT_NE(bad.error().message.find("-e:1:"), std::string::npos);
}

TEST(ParseRegion, ErrorsNameTheOption) {
  EXPECT_EQ(parse_region("-1 1 -1 1").value().side_count(), 4);
  const auto bad = parse_region("1 2 3", "--region");
  ASSERT_FALSE(bad.ok());
  EXPECT_NE(bad.error().message.find("--region:1:6: a box has four numbers"), std::string::npos);
}

}  // namespace
}  // namespace encase
