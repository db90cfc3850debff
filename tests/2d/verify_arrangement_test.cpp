// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>

#include "2d/verify_claims.hpp"
#include "encase/arrangement.hpp"
#include "encased.hpp"
#include "verified.hpp"

namespace encase {
namespace {

using namespace verified;

/// Three nested circles, a line through the largest one, and a loop beside it.
Encasement nested() {
  return encased::run({"x^2 + y^2 - 4", "x^2 + y^2 - 1", "x^2 + y^2 - 1/4", "x - 2 y + 3",
                       "(x - 5/2)^2 + (y + 5/2)^2 - 1/16"},
                      encased::rectangle(-3, 3, -3, 3));
}

void expect_accepted(const Encasement& e, const Arrangement& a) {
  const Verification verification = verify(e, a);
  EXPECT_TRUE(verification.ok()) << text(verification);
  EXPECT_GT(verification.claims, verify(e).claims);
}

TEST(VerifyArrangement, IsAClaimOfEveryCertifiedEncasement) {
  const auto objections = [](const Encasement& e) {
    verification::Facts facts{e, {}};
    verification::Claims claims(facts);
    verification::check_arrangement(claims);
    return text(claims.report);
  };
  for (const Encasement& e : {two_lines(), circle_and_line(), relaxed(), four_curves(), nested()})
    EXPECT_EQ(objections(e), "");
  Encasement e = circle_and_line();
  std::swap(e.cells[0].word[0], e.cells[0].word[1]);
  EXPECT_NE(objections(e).find("The result has no arrangement: "), std::string::npos);
  EXPECT_NE(objections(node()), "");
}

TEST(VerifyArrangement, AcceptsTheArrangementOfTheEncasement) {
  for (const Encasement& e :
       {two_lines(), circle_and_line(), relaxed(), diagonals(), four_curves(), nested()})
    expect_accepted(e, arrange(e).value());
}

TEST(VerifyArrangement, ObjectsToAnArrangementOfAnotherEncasement) {
  const Encasement e = nested();
  EXPECT_FALSE(verify(e, arrange(four_curves()).value()).ok());
  EXPECT_FALSE(verify(e, Arrangement()).ok());
  EXPECT_FALSE(verify(node(), Arrangement()).ok());
}

TEST(VerifyArrangement, ObjectsToEveryChange) {
  const Encasement e = nested();
  const Arrangement right = arrange(e).value();
  const auto objection = [&](const std::function<void(Arrangement&)>& change) {
    Arrangement changed = right;
    change(changed);
    const Verification verification = verify(e, changed);
    EXPECT_FALSE(verification.ok());
    return text(verification);
  };
  const auto expect_names = [&](const std::string& list, std::function<void(Arrangement&)> change) {
    EXPECT_NE(objection(change).find(list), std::string::npos) << list;
  };
  const std::size_t last_vertex = right.vertices.size() - 1, last_edge = right.edges.size() - 1,
                    last_face = right.faces.size() - 1;
  expect_names("vertices", [&](auto& a) { a.vertices[last_vertex].point[1] += 1e-12; });
  expect_names("vertices", [&](auto& a) { a.vertices[last_vertex].index = 0; });
  expect_names("vertices", [&](auto& a) { a.vertices.pop_back(); });
  expect_names("half-edges", [&](auto& a) { std::swap(a.half_edges[0], a.half_edges[1]); });
  expect_names("edges", [&](auto& a) { a.edges[0].strands.pop_back(); });
  expect_names("edges", [&](auto& a) { a.edges[0].strands[0].branch ^= 1; });
  expect_names("edges", [&](auto& a) { a.edges[last_edge].side = 1; });
  expect_names("faces",
               [&](auto& a) { a.faces[last_face].signs[0] = -a.faces[last_face].signs[0]; });
  expect_names("faces", [&](auto& a) { a.faces[last_face].parent = 0; });
  expect_names("faces", [&](auto& a) { a.faces[last_face].pieces.pop_back(); });
  expect_names("pieces", [&](auto& a) { a.pieces[0].face = 2; });
  expect_names("components", [&](auto& a) { ++a.components[1].edges; });
  expect_names("components", [&](auto& a) { a.components.pop_back(); });
  expect_names("curve components", [&](auto& a) { a.curve_components[0].crossings.clear(); });
  expect_names("curve components", [&](auto& a) { a.curve_components.pop_back(); });
  expect_names("outside", [&](auto& a) { a.outside = 1; });
}

}  // namespace
}  // namespace encase
