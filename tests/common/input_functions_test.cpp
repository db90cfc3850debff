// SPDX-License-Identifier: MIT
#include "common/input_functions.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/verify_functions.hpp"
#include "encase/expression.hpp"
#include "written.hpp"

namespace encase {
namespace {

using verification::FunctionClaims;
using verification::Reporter;

template <int D>
Function<D> polynomial(const std::string& text) {
  return written::polynomial<D>(text);
}

template <int D>
Function<D> sine_of(int axis) {
  return Expression::apply(Operation::Sin, Expression::variable(axis));
}

/// x^2 y and y (x + 1), and the sine of y twice.
template <int D>
std::vector<NamedFunction<D>> inputs() {
  return {{"s", sine_of<D>(1)},
          {"f", polynomial<D>("x^2 y")},
          {"g", polynomial<D>("y (x + 1)")},
          {"t", sine_of<D>(1)},
          {"h", polynomial<D>("x + y")}};
}

/// The objections to the claim that `separate` is what of the inputs is encased.
template <int D>
std::vector<std::string> objections(const std::vector<NamedFunction<D>>& input,
                                    const SeparateFunctions<D>& separate) {
  FunctionClaims<D> claims{input};
  for (const auto& f : separate.functions) claims.encased.push_back({f.function, f.sources});
  for (const auto& note : separate.notes) claims.degenerate.push_back({note.kind, note.inputs});
  Reporter reporter{VerifyOptions{}};
  check_functions(reporter, claims);
  return reporter.report.objections;
}

template <class Dimension>
class InputFunctions : public ::testing::Test {
 protected:
  static constexpr int kD = Dimension::value;
  static std::string message(const Function<kD>& f, double delta = 0) {
    Box<kD> box;
    box.hi.fill(1);
    const Status bad = check_functions<kD>({{"f", f}}, box, delta);
    return bad ? bad->message : "";
  }
};

using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(InputFunctions, Dimensions);

TYPED_TEST(InputFunctions, AreSeparatedIntoComponents) {
  constexpr int D = TypeParam::value;
  const auto separate = separate_functions(inputs<D>());
  std::vector<std::string> names, texts;
  std::vector<std::vector<int>> sources;
  for (const auto& f : separate.functions) {
    names.push_back(f.name);
    texts.push_back(f.function.to_string());
    sources.push_back(f.sources);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"s & t", "f & g", "f", "g", "h"}));
  EXPECT_EQ(sources, (std::vector<std::vector<int>>{{0, 3}, {1, 2}, {1}, {2}, {4}}));
  EXPECT_EQ(texts[1], "y");
  EXPECT_EQ(texts[2], "x");
  EXPECT_EQ(texts[3], polynomial<D>("x + 1").to_string());
  const std::string noun = D == 2 ? "curve" : "surface";
  ASSERT_EQ(separate.notes.size(), 3u);
  EXPECT_EQ(separate.notes[0].reason,
            noun + "s 'f & g' share the component y = 0; it is encased as one " + noun);
  EXPECT_EQ(separate.notes[0].inputs, (std::vector<int>{1, 2}));
  EXPECT_EQ(separate.notes[1].reason,
            noun + " 'f' contains the component x = 0 2 times; it is encased once");
  EXPECT_EQ(separate.notes[1].inputs, std::vector<int>{1});
  EXPECT_EQ(separate.notes[2].reason,
            noun + "s 's & t' are the same; they are encased as one " + noun);
  EXPECT_EQ(separate.notes[2].inputs, (std::vector<int>{0, 3}));
}

TYPED_TEST(InputFunctions, OfOneInputAloneAreNumbered) {
  constexpr int D = TypeParam::value;
  const auto separate = separate_functions<D>({{"f", polynomial<D>("x^2 (y + 1)")}});
  ASSERT_EQ(separate.functions.size(), 2u);
  EXPECT_EQ(separate.functions[0].name, "f");
  EXPECT_EQ(separate.functions[1].name, "f (2)");
}

TYPED_TEST(InputFunctions, PassTheCheckerAndNothingElseDoes) {
  constexpr int D = TypeParam::value;
  const auto input = inputs<D>();
  const auto right = separate_functions(input);
  EXPECT_EQ(objections(input, right), std::vector<std::string>{});
  const auto wrong = [&](auto change, const std::string& part) {
    auto changed = right;
    change(changed);
    const auto found = objections(input, changed);
    ASSERT_FALSE(found.empty()) << part;
    EXPECT_NE(found[0].find(part), std::string::npos) << found[0];
  };
  const std::string noun = D == 2 ? "curve" : "surface", capital = D == 2 ? "Curve" : "Surface";
  wrong([](auto& s) { s.functions[2].function = polynomial<D>("x^2"); },
        capital + " 2 has a repeated component");
  wrong([](auto& s) { s.functions[3].function = polynomial<D>("y (x + 1)"); },
        capital + "s 1 and 3 share a component");
  wrong([](auto& s) { s.functions[3].function = polynomial<D>("x + 2"); },
        "A component of input " + noun + " 2 is in no " + noun);
  wrong([](auto& s) { s.functions.erase(s.functions.begin() + 4); },
        "A component of input " + noun + " 4 is in no " + noun);
  wrong([](auto& s) { s.functions[1].sources = {1}; },
        capital + " 1 does not have the components that its sources say");
  wrong([](auto& s) { s.functions[0].sources = {0}; }, "is not the function of its sources");
  wrong([](auto& s) { s.functions.erase(s.functions.begin()); },
        "The function of input " + noun + " 0 is not that of one " + noun);
  wrong([](auto& s) { s.notes.erase(s.notes.begin() + 1); },
        "The repeated component of input " + noun + " 1 is not reported");
  wrong([](auto& s) { s.notes.erase(s.notes.begin()); },
        "The component that input " + noun + "s 1 and 2 share is not reported");
  wrong([](auto& s) { s.notes[1].inputs = {2}; }, "a repeated component that is not there");
  wrong([](auto& s) { s.notes[0].inputs = {1, 4}; }, "a shared component that is not there");
}

TYPED_TEST(InputFunctions, WithoutZeroSetsAreRefused) {
  constexpr int D = TypeParam::value;
  const auto message = [](const Function<D>& f, double delta = 0) {
    return TestFixture::message(f, delta);
  };
  const std::string f = D == 2 ? "curve 'f'" : "surface 'f'";
  EXPECT_EQ(message(Polynomial<D>()), f + " is the zero polynomial: every point lies on it");
  EXPECT_EQ(message(Polynomial<D>::constant(2)), f + " is a constant: no point lies on it");
  EXPECT_EQ(message(Polynomial<D>::variable(0).power(61)),
            f + " has degree 61, above the limit of 60");
  EXPECT_NE(message(Expression::apply(Operation::Sin, Expression::pi()))
                .find(f + " is a constant: it has no x"),
            std::string::npos);
  EXPECT_EQ(
      message(Expression::apply(Operation::Min, Expression::variable(0), Expression::variable(2))),
      D == 2 ? "curve 'f' has a z: a curve in the plane has x and y only" : "");
  EXPECT_EQ(message(sine_of<D>(0)), "");
  EXPECT_EQ(message(sine_of<D>(0), 1e-8), f + " is no polynomial: only those can be perturbed");
  EXPECT_EQ(message(Polynomial<D>::variable(0), -1),
            "the perturbation must be a number that is not negative");
}

TYPED_TEST(InputFunctions, ArePerturbedAlikeBesideOthersThatAreNot) {
  constexpr int D = TypeParam::value;
  std::vector<NamedFunction<D>> all{{"f", polynomial<D>("x y")}, {"g", polynomial<D>("x^2 - y")}};
  auto later = all;
  perturb_functions(&all, 0, 1e-3, 5);
  perturb_functions(&later, 1, 1e-3, 5);
  EXPECT_NE(all[0].function, polynomial<D>("x y"));
  EXPECT_EQ(later[0].function, polynomial<D>("x y"));
  EXPECT_EQ(later[1].function, all[1].function);
}

}  // namespace
}  // namespace encase
