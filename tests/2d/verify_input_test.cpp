// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "verified.hpp"

namespace encase {
namespace {

using namespace verified;

TEST(VerifyInput, ObjectsToOtherCurves) {
  const Encasement e = circle_and_line();
  const auto nudged = linear(Rational(-1, 5), 1, Rational(-1, 20) + Rational(1, 1000000000));
  expect_objection(
      e, [&](auto& m) { m.curves[1].function = nudged; }, "input curve 1");
  expect_objection(
      e, [&](auto& m) { m.input[1].function = nudged; }, "input curve 1");
  const auto moved = linear(Rational(-1, 5), 1, Rational(-1, 10));
  expect_objection(
      e, [&](auto& m) { m.curves[1].function = m.input[1].function = moved; }, "Line crossing");
  expect_objection(
      e, [](auto& m) { std::swap(m.curves[0].function, m.curves[1].function); },
      "components that its sources say");
  expect_objection(
      e, [](auto& m) { m.input.pop_back(); }, "does not name ascending");
  expect_objection(
      e, [](auto& m) { m.curves[1].function = {}; }, "degree 1 to");
  expect_objection(
      e, [](auto& m) { m.curves[1].function = Polynomial<2>::constant(3); }, "degree 1 to");
  expect_objection(
      e,
      [](auto& m) {
        m.input[0].function = m.curves[0].function = Polynomial<2>::variable(0).power(61);
      },
      "degree 1 to");
  expect_objection(
      e, [](auto& m) { m.curves[1].sources = {0}; }, "");
  // A constant factor is no other curve.
  Encasement scaled = e;
  scaled.input[1].function =
      scaled.input[1].function.polynomial() * Polynomial<2>::constant(Rational(-7, 3));
  expect_accepted(scaled);
}

TEST(VerifyInput, TracksSharedAndRepeatedComponents) {
  // Input circle^2 line and line, encased as circle and line.
  Encasement e = circle_and_line();
  const auto c = e.curves[0].function.polynomial(), l = e.curves[1].function.polynomial();
  e.input[0].function = c * c * l;
  e.curves[1].sources = {0, 1};
  e.outcome = Outcome::Degenerate;
  Unresolved repeated, shared;
  repeated.kind = Unresolved::Kind::RepeatedComponent;
  repeated.curves = {0};
  repeated.proved = true;
  shared.kind = Unresolved::Kind::SharedComponent;
  shared.curves = {0, 1};
  shared.proved = true;
  e.degenerate = {repeated, shared};
  expect_accepted(e);
  expect_objection(
      e, [](auto& m) { m.degenerate.pop_back(); }, "share is not reported");
  expect_objection(
      e, [](auto& m) { m.degenerate.erase(m.degenerate.begin()); },
      "repeated component of input curve 0 is not reported");
  expect_objection(
      e,
      [](auto& m) {
        m.degenerate[0].curves = {0, 1};
      },
      "a repeated component that is not there");
  expect_objection(
      e, [&](auto& m) { m.input[0].function = c * l; }, "a repeated component that is not there");
  expect_objection(
      e, [&](auto& m) { m.input[0].function = c * c; }, "components that its sources say");
  expect_objection(
      e, [&](auto& m) { m.input[0].function = c * c * l * linear(1, 1, 9); }, "is in no curve");
  expect_objection(
      e, [](auto& m) { m.curves[1].sources = {1}; }, "components that its sources say");
  expect_objection(
      e, [&](auto& m) { m.curves[0].function = c * c; }, "has a repeated component");
  expect_objection(
      e, [&](auto& m) { m.curves[0].function = c * l; }, "share a component");
}

}  // namespace
}  // namespace encase
