// SPDX-License-Identifier: MIT
#include "encase/result_json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/sample_encasements.hpp"

namespace encase {
namespace {

using Json = nlohmann::json;

/// Every field that can be stored holds something that is not its default.
Encasement full_sample() {
  Encasement e = sample::circle_and_line();
  e.outcome = Outcome::Undecided;
  e.input[0].name = "a \"quoted\" näme\n";
  e.perturbation = 1e-8;
  e.seed = std::numeric_limits<std::uint64_t>::max();
  e.curves[1].sources = {0, 1};
  e.region =
      make_region({{Rational(-1, 3), -1}, {Rational(7, 2), -1}, {Rational("1/7000"), 1}}).value();
  e.lines[0] = Line::from_rationals({Rational(1, 3), Rational(-2, 7), Rational("1/1000000007")});
  e.lines.push_back(sample::line(0.1, -1 / 3.0, 5e-324));
  e.crossings[0].rounded = true;
  e.crossings[0].location = Location::OnBoundary;
  e.crossings[1].location = Location::Outside;
  e.crossings[1].cell = -1;
  e.cells[0].state = CellState::Relaxed;
  e.cells[1].state = CellState::Degenerate;
  e.cells[2].state = CellState::Undecided;
  Vertex cut = sample::corner(4, 4, 0.0625, 0.1);
  cut.parameter = 0.1;
  e.cells[0].vertices.insert(e.cells[0].vertices.begin() + 2, cut);
  e.line_crossings[0].lo = -0.0;
  e.line_crossings[1].hi = 1e300;
  e.critical_regions[0].sign = Sign::Positive;
  e.critical_regions[0].boxes.push_back({{0.1, 0.2}, {0.3, 0.4}});
  e.shared_cover = {{{-1.5, -1}, {1, 1.25}}, {-1, -2, 0, -5, 1}, {{0, 1}, {}}};
  e.crossing_covers[0].tokens = {-1, -2, -4, -5, -6, 0, 1};
  Unresolved place;
  place.kind = Unresolved::Kind::Concurrency;
  place.box = {{0.1, 0.2}, {0.1, 0.3}};
  place.has_box = true;
  place.curves = {0, 1};
  place.reason = "because";
  e.degenerate = {place};
  place = {};
  place.kind = Unresolved::Kind::SharedComponent;
  place.proved = true;
  e.undecided = {place};
  e.statistics.decisions = {1, 2, 3, 4};
  e.statistics.pairs_met = 14;
  e.statistics.pairs_isolated = 13;
  e.statistics.filter_failures = 12;
  e.statistics.root_boxes = std::numeric_limits<std::int64_t>::max();
  e.statistics.critical_boxes = 5;
  e.statistics.restrictions = 6;
  e.statistics.expansions = 7;
  e.statistics.mpfr_expansions = 8;
  e.statistics.candidate_lines = 9;
  e.statistics.splits = 10;
  e.statistics.loop_splits = 11;
  return e;
}

Encasement read(const std::string& text) {
  Result<Encasement> result = encasement_from_json(text, "result.json");
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return {};
  }
  return std::move(result).value();
}

std::string error_of(const std::string& text) {
  const Result<Encasement> result = encasement_from_json(text, "result.json");
  if (result) return "";
  EXPECT_EQ(result.error().code, Error::Code::BadInput);
  return result.error().message;
}

/// The message after `change` was made to a correct file.
template <class F>
std::string error_after(F change) {
  Json json = Json::parse(to_json(full_sample()));
  change(json);
  return error_of(json.dump());
}

void expect_equal(const Box<2>& a, const Box<2>& b) { EXPECT_TRUE(a == b); }

void expect_equal(const std::vector<Unresolved>& a, const std::vector<Unresolved>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].kind, b[k].kind);
    EXPECT_EQ(a[k].has_box, b[k].has_box);
    expect_equal(a[k].box, b[k].box);
    EXPECT_EQ(a[k].curves, b[k].curves);
    EXPECT_EQ(a[k].proved, b[k].proved);
    EXPECT_EQ(a[k].reason, b[k].reason);
  }
}

void expect_equal(const Cell& a, const Cell& b) {
  EXPECT_EQ(a.state, b.state);
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  for (std::size_t k = 0; k < a.vertices.size(); ++k) {
    EXPECT_EQ(a.vertices[k].line_in, b.vertices[k].line_in);
    EXPECT_EQ(a.vertices[k].line_out, b.vertices[k].line_out);
    EXPECT_EQ(a.vertices[k].parameter, b.vertices[k].parameter);
    EXPECT_EQ(a.vertices[k].point, b.vertices[k].point);
  }
  EXPECT_EQ(a.word, b.word);
  ASSERT_EQ(a.branches.size(), b.branches.size());
  for (std::size_t k = 0; k < a.branches.size(); ++k) {
    EXPECT_EQ(a.branches[k].curve, b.branches[k].curve);
    EXPECT_EQ(a.branches[k].from, b.branches[k].from);
    EXPECT_EQ(a.branches[k].to, b.branches[k].to);
  }
  EXPECT_EQ(a.crossing, b.crossing);
  ASSERT_EQ(a.loop_certificates.size(), b.loop_certificates.size());
  for (std::size_t k = 0; k < a.loop_certificates.size(); ++k) {
    EXPECT_EQ(a.loop_certificates[k].critical_region, b.loop_certificates[k].critical_region);
    EXPECT_EQ(a.loop_certificates[k].from, b.loop_certificates[k].from);
    EXPECT_EQ(a.loop_certificates[k].to, b.loop_certificates[k].to);
  }
  EXPECT_EQ(a.depth, b.depth);
}

void expect_equal(const Encasement& a, const Encasement& b) {
  EXPECT_EQ(a.outcome, b.outcome);
  ASSERT_EQ(a.input.size(), b.input.size());
  for (std::size_t k = 0; k < a.input.size(); ++k) {
    EXPECT_EQ(a.input[k].name, b.input[k].name);
    EXPECT_EQ(a.input[k].function, b.input[k].function);
  }
  EXPECT_EQ(a.perturbation, b.perturbation);
  EXPECT_EQ(a.seed, b.seed);
  ASSERT_EQ(a.curves.size(), b.curves.size());
  for (std::size_t k = 0; k < a.curves.size(); ++k) {
    EXPECT_EQ(a.curves[k].name, b.curves[k].name);
    EXPECT_EQ(a.curves[k].function, b.curves[k].function);
    EXPECT_EQ(a.curves[k].sources, b.curves[k].sources);
  }
  EXPECT_EQ(a.region.corners, b.region.corners);
  EXPECT_EQ(a.region_used.corners, b.region_used.corners);
  ASSERT_EQ(a.lines.size(), b.lines.size());
  for (std::size_t k = 0; k < a.lines.size(); ++k) {
    EXPECT_EQ(a.lines[k].normal, b.lines[k].normal);
    EXPECT_EQ(a.lines[k].offset, b.lines[k].offset);
    EXPECT_EQ(a.lines[k].exact(), b.lines[k].exact());
  }
  ASSERT_EQ(a.line_crossings.size(), b.line_crossings.size());
  for (std::size_t k = 0; k < a.line_crossings.size(); ++k) {
    EXPECT_EQ(a.line_crossings[k].line, b.line_crossings[k].line);
    EXPECT_EQ(a.line_crossings[k].curve, b.line_crossings[k].curve);
    EXPECT_EQ(a.line_crossings[k].lo, b.line_crossings[k].lo);
    EXPECT_EQ(a.line_crossings[k].hi, b.line_crossings[k].hi);
  }
  ASSERT_EQ(a.crossings.size(), b.crossings.size());
  for (std::size_t k = 0; k < a.crossings.size(); ++k) {
    EXPECT_EQ(a.crossings[k].curves, b.crossings[k].curves);
    expect_equal(a.crossings[k].box, b.crossings[k].box);
    EXPECT_EQ(a.crossings[k].point, b.crossings[k].point);
    EXPECT_EQ(a.crossings[k].rounded, b.crossings[k].rounded);
    EXPECT_EQ(a.crossings[k].cell, b.crossings[k].cell);
    EXPECT_EQ(a.crossings[k].location, b.crossings[k].location);
  }
  ASSERT_EQ(a.cells.size(), b.cells.size());
  for (std::size_t k = 0; k < a.cells.size(); ++k) expect_equal(a.cells[k], b.cells[k]);
  ASSERT_EQ(a.history.size(), b.history.size());
  for (std::size_t k = 0; k < a.history.size(); ++k) {
    EXPECT_EQ(a.history[k].line, b.history[k].line);
    EXPECT_EQ(a.history[k].negative, b.history[k].negative);
    EXPECT_EQ(a.history[k].positive, b.history[k].positive);
  }
  expect_equal(a.shared_cover.root, b.shared_cover.root);
  EXPECT_EQ(a.shared_cover.tokens, b.shared_cover.tokens);
  EXPECT_EQ(a.shared_cover.alive, b.shared_cover.alive);
  ASSERT_EQ(a.crossing_covers.size(), b.crossing_covers.size());
  for (std::size_t k = 0; k < a.crossing_covers.size(); ++k) {
    EXPECT_EQ(a.crossing_covers[k].curves, b.crossing_covers[k].curves);
    expect_equal(a.crossing_covers[k].root, b.crossing_covers[k].root);
    EXPECT_EQ(a.crossing_covers[k].tokens, b.crossing_covers[k].tokens);
  }
  ASSERT_EQ(a.critical_covers.size(), b.critical_covers.size());
  for (std::size_t k = 0; k < a.critical_covers.size(); ++k) {
    EXPECT_EQ(a.critical_covers[k].curve, b.critical_covers[k].curve);
    expect_equal(a.critical_covers[k].root, b.critical_covers[k].root);
    EXPECT_EQ(a.critical_covers[k].tokens, b.critical_covers[k].tokens);
  }
  ASSERT_EQ(a.critical_regions.size(), b.critical_regions.size());
  for (std::size_t k = 0; k < a.critical_regions.size(); ++k) {
    EXPECT_EQ(a.critical_regions[k].curve, b.critical_regions[k].curve);
    EXPECT_EQ(a.critical_regions[k].sign, b.critical_regions[k].sign);
    EXPECT_EQ(a.critical_regions[k].boxes, b.critical_regions[k].boxes);
  }
  expect_equal(a.degenerate, b.degenerate);
  expect_equal(a.undecided, b.undecided);
  const Statistics &s = a.statistics, &t = b.statistics;
  EXPECT_EQ(s.decisions.by_double, t.decisions.by_double);
  EXPECT_EQ(s.decisions.by_mpfr, t.decisions.by_mpfr);
  EXPECT_EQ(s.decisions.by_exact, t.decisions.by_exact);
  EXPECT_EQ(s.decisions.undecided, t.decisions.undecided);
  EXPECT_EQ(s.pairs_met, t.pairs_met);
  EXPECT_EQ(s.pairs_isolated, t.pairs_isolated);
  EXPECT_EQ(s.filter_failures, t.filter_failures);
  EXPECT_EQ(s.root_boxes, t.root_boxes);
  EXPECT_EQ(s.critical_boxes, t.critical_boxes);
  EXPECT_EQ(s.restrictions, t.restrictions);
  EXPECT_EQ(s.expansions, t.expansions);
  EXPECT_EQ(s.mpfr_expansions, t.mpfr_expansions);
  EXPECT_EQ(s.candidate_lines, t.candidate_lines);
  EXPECT_EQ(s.splits, t.splits);
  EXPECT_EQ(s.loop_splits, t.loop_splits);
}

TEST(ResultJson, ReadsBackEveryField) {
  const Encasement e = full_sample();
  const std::string text = to_json(e);
  const Encasement back = read(text);
  expect_equal(e, back);
  EXPECT_TRUE(std::signbit(back.line_crossings[0].lo));
  EXPECT_EQ(to_json(back), text);
  expect_equal(sample::circle_and_line(), read(to_json(sample::circle_and_line())));
}

TEST(ResultJson, ReadsBackExpressions) {
  Encasement e = full_sample();
  const Expression x = Expression::variable(0), y = Expression::variable(1);
  const Expression f = y - Expression::apply(Operation::Sin, x * Rational(1, 3)).power(-2);
  // This one is a polynomial, and is not to become one.
  const Expression g = x * x - y;
  e.input[0].function = f;
  e.curves[1].function = g;
  const std::string text = to_json(e);
  EXPECT_NE(text.find("\"expression\":\"y - sin(x*(1/3))^(-2)\""), std::string::npos);
  const Encasement read = encasement_from_json(text, "result").value();
  EXPECT_EQ(read.input[0].function, Function<2>(f));
  EXPECT_EQ(read.curves[1].function, Function<2>(g));
  EXPECT_EQ(to_json(read), text);
  Json broken = Json::parse(text);
  broken["input"]["curves"][0]["expression"] = "y - sinx";
  const auto refused = encasement_from_json(broken.dump(), "result");
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find(
                "input.curves[0].expression: at character 5: unknown variable 'sinx'"),
            std::string::npos)
      << refused.error().message;
}

TEST(ResultJson, ReadsBackRandomDoubles) {
  std::mt19937_64 random(7);
  Encasement e = sample::circle_and_line();
  e.line_crossings.clear();
  for (Cell& cell : e.cells) cell.word.clear(), cell.branches.clear();
  const double tiny = std::numeric_limits<double>::denorm_min();
  const double huge = std::numeric_limits<double>::max();
  e.line_crossings = {{0, 0, 0, tiny}, {0, 0, -huge, huge}, {0, 0, 9007199254740991, 1e23}};
  while (e.line_crossings.size() < 2000) {
    const auto bits = random();
    double value;
    static_assert(sizeof value == sizeof bits);
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value) && value < huge) e.line_crossings.push_back({0, 0, value, huge});
  }
  expect_equal(e, read(to_json(e)));
}

TEST(ResultJson, HasTheDocumentedKeys) {
  const Json json = Json::parse(to_json(full_sample()));
  EXPECT_EQ(json["format"], "encase-result");
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["command"], "curves");
  EXPECT_EQ(json["status"], "undecided");
  EXPECT_EQ(json["input"]["curves"][1]["terms"],
            Json::parse(R"([[0,0,"-1/20"],[0,1,"1"],[1,0,"-1/5"]])"));
  EXPECT_EQ(json["region_used"]["polygon"][0], Json::parse(R"(["-1","-1"])"));
  EXPECT_EQ(json["lines"][0], Json::parse(R"(["1/3","-2/7","1/1000000007"])"));
  EXPECT_EQ(json["lines"][1], Json::parse("[1,0,-1]"));
  EXPECT_EQ(json["crossings"][0]["box"], Json::parse("[[0.681,0.683],[0.185,0.187]]"));
  EXPECT_TRUE(json["crossings"][1]["cell"].is_null());
  EXPECT_EQ(json["cells"][0]["lines"], Json::parse("[0,4,4,2,3]"));
  EXPECT_EQ(json["cells"][0]["cuts"], Json::parse("[[2,0.1]]"));
  EXPECT_EQ(json["cells"][0]["relaxed"], true);
  EXPECT_TRUE(json["cells"][2]["crossing"].is_null());
  EXPECT_TRUE(json["undecided"][0]["box"].is_null());
  EXPECT_FALSE(json.contains("seconds"));
  EXPECT_EQ(
      json["covers"]["shared"],
      Json::parse(R"({"root":[[-1.5,1],[-1,1.25]],"tokens":[-1,-2,0,-5,1],"alive":[[0,1],[]]})"));
  EXPECT_EQ(json["statistics"]["pairs_met"], 14);
  // Only where there is a shared cover.
  const Json pair = Json::parse(to_json(sample::circle_and_line()));
  EXPECT_FALSE(pair["covers"].contains("shared"));
  EXPECT_FALSE(pair["statistics"].contains("pairs_met"));
}

TEST(ResultJson, DoesNotDependOnTheTimeTaken) {
  Encasement e = full_sample();
  const std::string text = to_json(e);
  e.seconds = 17;
  EXPECT_EQ(to_json(e), text);
}

TEST(ResultJson, NamesThePlaceOfAnError) {
  EXPECT_EQ(error_after([](Json& j) { j["cells"][1]["word"][2] = 99; }),
            "result.json: cells[1].word[2]: expected an integer from 0 to 4");
  EXPECT_EQ(error_after([](Json& j) { j.erase("covers"); }), "result.json: 'covers' is missing");
  EXPECT_EQ(error_after([](Json& j) { j["crossings"][0]["location"] = "nowhere"; }),
            "result.json: crossings[0].location: unknown word 'nowhere'");
  EXPECT_EQ(error_after([](Json& j) { j["version"] = 2; }),
            "result.json: version: this version of encase reads version 1 only");
  EXPECT_EQ(error_after([](Json& j) { j["curves"][0]["terms"][0][2] = "1/0"; }),
            "result.json: curves[0].terms[0][2]: the denominator is zero");
  EXPECT_NE(error_of("{\"format\":\n oops").find("line 2, column"), std::string::npos);
}

TEST(ResultJson, RefusesWhatRefersToNothingOrIsOutOfRange) {
  const auto refused = [](auto change) { return !error_after(change).empty(); };
  EXPECT_TRUE(refused([](Json& j) { j["format"] = "other"; }));
  EXPECT_TRUE(refused([](Json& j) { j["curves"][0]["terms"][0][0] = 1000000000; }));
  EXPECT_TRUE(refused([](Json& j) { j["curves"][0]["terms"][0][0] = -1; }));
  EXPECT_TRUE(refused([](Json& j) { j["curves"][0]["terms"] = Json::array(); }));
  EXPECT_TRUE(refused([](Json& j) { j["curves"][0]["terms"][0][2] = "1e999999999"; }));
  EXPECT_TRUE(refused([](Json& j) { j["curves"][0]["terms"][0][2] = ""; }));
  EXPECT_TRUE(refused([](Json& j) { j["curves"][0]["terms"][0][2] = "-"; }));
  EXPECT_TRUE(refused([](Json& j) { j["curves"][0]["terms"][0][2] = 1; }));
  EXPECT_TRUE(refused([](Json& j) { j["curves"][0]["sources"][0] = 2; }));
  EXPECT_TRUE(refused([](Json& j) { j["region"]["polygon"].erase(0); }));
  EXPECT_TRUE(refused([](Json& j) { j["lines"][4] = {0, 0, 1}; }));
  EXPECT_TRUE(refused([](Json& j) { j["lines"][0] = {"1", 2, 3}; }));
  EXPECT_TRUE(refused([](Json& j) { j["lines"] = Json::array(); }));
  EXPECT_TRUE(refused([](Json& j) { j["crossings"][0]["curves"] = {1, 0}; }));
  EXPECT_TRUE(refused([](Json& j) { j["crossings"][0]["curves"] = {0, 0}; }));
  EXPECT_TRUE(refused([](Json& j) { j["crossings"][0]["box"][0] = {1, 0}; }));
  EXPECT_TRUE(refused([](Json& j) { j["crossings"][0]["cell"] = 3; }));
  EXPECT_TRUE(refused([](Json& j) { j["crossings_on_lines"][0]["interval"] = {1, 1}; }));
  EXPECT_TRUE(refused([](Json& j) { j["cells"][0]["lines"].erase(0); }));
  EXPECT_TRUE(refused([](Json& j) { j["cells"][0]["cuts"][0][0] = 5; }));
  EXPECT_TRUE(refused([](Json& j) { j["cells"][0]["relaxed"] = false; }));
  EXPECT_TRUE(refused([](Json& j) { j["cells"][0]["depth"] = 0.5; }));
  EXPECT_TRUE(refused([](Json& j) { j["cells"][0]["branches"][0] = {0, 1}; }));
  EXPECT_TRUE(refused([](Json& j) { j["cells"][0]["loop_certificates"][0]["critical"] = 1; }));
  EXPECT_TRUE(refused([](Json& j) { j["critical"][0]["sign"] = 2; }));
  EXPECT_TRUE(refused([](Json& j) { j["covers"]["crossings"][0]["tokens"][0] = -7; }));
  EXPECT_TRUE(refused([](Json& j) { j["covers"]["crossings"][0]["tokens"][0] = cover::kSplitZ; }));
  EXPECT_TRUE(refused([](Json& j) { j["covers"]["critical"][0]["tokens"][0] = 1; }));
  EXPECT_TRUE(refused([](Json& j) { j["covers"]["shared"]["tokens"][2] = 2; }));
  EXPECT_TRUE(refused([](Json& j) { j["covers"]["shared"]["tokens"][2] = -7; }));
  EXPECT_TRUE(refused([](Json& j) { j["covers"]["shared"]["alive"][0][1] = 2; }));
  EXPECT_TRUE(refused([](Json& j) { j["covers"]["shared"]["alive"] = 1; }));
  EXPECT_TRUE(refused([](Json& j) { j["covers"]["shared"].erase("alive"); }));
  EXPECT_TRUE(refused([](Json& j) { j["covers"]["shared"]["root"][0] = {1, 0}; }));
  EXPECT_TRUE(refused([](Json& j) { j["statistics"]["pairs_met"] = -1; }));
  EXPECT_TRUE(refused([](Json& j) { j["statistics"].erase("filter_failures"); }));
  EXPECT_TRUE(refused([](Json& j) { j["covers"]["critical"][0]["tokens"][0] = 1ull << 63; }));
  EXPECT_TRUE(refused([](Json& j) { j["degenerate"][0]["curves"][0] = 2; }));
  EXPECT_TRUE(refused([](Json& j) { j["input"]["seed"] = -1; }));
  EXPECT_FALSE(refused([](Json& j) { j["more"] = "is ignored"; }));
}

TEST(ResultJson, RefusesAHistoryThatIsNoForest) {
  const auto refused = [](auto change) { return !error_after(change).empty(); };
  EXPECT_TRUE(refused([](Json& j) { j["history"][1][1] = 0; }));
  EXPECT_TRUE(refused([](Json& j) { j["history"][0][2] = 0; }));
  EXPECT_TRUE(refused([](Json& j) { j["history"][1][1] = -1; }));
  EXPECT_TRUE(refused([](Json& j) { j["history"][1][1] = -4; }));
  EXPECT_TRUE(refused([](Json& j) { j["history"][0][0] = 7; }));
}

TEST(ResultJson, RefusesTextThatIsNotJson) {
  EXPECT_NE(error_of(""), "");
  EXPECT_NE(error_of("[]"), "");
  EXPECT_NE(error_of("null"), "");
  EXPECT_NE(error_of("\xff\xfe"), "");
  EXPECT_NE(error_of(std::string(1000000, '[')), "");
  EXPECT_NE(error_of(std::string(1000000, '[') + std::string(1000000, ']')), "");
  std::string text = to_json(full_sample());
  text.replace(text.find("1e-08"), 5, "1e400");
  EXPECT_NE(error_of(text).find("1e400"), std::string::npos);
}

TEST(ResultJson, SurvivesEveryTruncation) {
  const std::string text = to_json(full_sample());
  for (std::size_t size = 0; size + 2 < text.size(); ++size)
    ASSERT_NE(error_of(text.substr(0, size)), "") << size;
}

TEST(ResultJson, SurvivesDamagedBytesAndValues) {
  const std::string text = to_json(full_sample());
  std::mt19937 random(3);
  for (int round = 0; round < 3000; ++round) {
    std::string damaged = text;
    for (int k = 0; k < 3; ++k)
      damaged[random() % damaged.size()] = "0123456789-[]{},\"ae.\0"[random() % 22];
    static_cast<void>(encasement_from_json(damaged, "damaged"));
  }
  // Every value in turn replaced by one of another type.
  const Json values[] = {nullptr,       true,          -1, 1ull << 63, 1e300, "text",
                         Json::array(), Json::object()};
  const Json whole = Json::parse(text);
  const Json flat = whole.flatten();
  for (const auto& [pointer, old] : flat.items()) {
    for (const Json& value : values) {
      Json damaged = whole;
      damaged[Json::json_pointer(pointer)] = value;
      static_cast<void>(encasement_from_json(damaged.dump(), "damaged"));
    }
  }
}

TEST(SummaryJson, CountsWhatItNames) {
  Encasement e = full_sample();
  e.seconds = 0.25;
  EXPECT_EQ(
      summary_json(e),
      R"({"status":"undecided","curves":2,"crossings":1,"cells":3,"relaxed_cells":1,"pairs_met":14,"pairs_isolated":13,"filter_failures":12,"seconds":0.25})");
  const Arrangement a = arrange(sample::circle_and_line()).value();
  const Json json = Json::parse(summary_json(e, &a));
  EXPECT_EQ(json["vertices"], 8);
  EXPECT_EQ(json["edges"], 11);
  EXPECT_EQ(json["faces"], 4);
  EXPECT_EQ(json["components"], 1);
}

}  // namespace
}  // namespace encase
