// SPDX-License-Identifier: MIT
#include "random_curves.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iterator>

#include "output.hpp"
#include "validators.hpp"

namespace encase {

namespace {

/// Solving for more coefficients than this would take minutes.
constexpr int kMaxUnknowns = 4000;

Error bad(std::string message) { return {Error::Code::BadInput, std::move(message)}; }

/// The coefficient as a decimal where 17 digits say it exactly, else as a fraction.
std::string number(const Rational& value) {
  if (value.get_den() == 1) return value.get_str();
  const std::string decimal = fmt::format("{:.17g}", nearest_double(value));
  Rational read;
  return parse_rational(decimal.c_str(), &read) && read == value ? decimal : value.get_str();
}

template <int D>
std::string text(const Polynomial<D>& f) {
  std::string result;
  for (auto term = f.terms().rbegin(); term != f.terms().rend(); ++term) {
    const bool negative = term->coefficient < 0;
    result += result.empty() ? (negative ? "-" : "") : (negative ? " - " : " + ");
    result += number(abs(term->coefficient));
    for (int i = 0; i < D; ++i) {
      if (term->exponent[i] > 0) result += std::string("*") + "xyz"[i];
      if (term->exponent[i] > 1) result += "^" + std::to_string(term->exponent[i]);
    }
  }
  return result;
}

template <int D>
std::string file(const RandomOptions& options, const RandomRequest& request) {
  std::string result =
      fmt::format("# random: degree {}, seed {}, {}", request.degree, request.seed, request.kind);
  if (options.kind == RandomOptions::Kind::Dense) result += fmt::format(", {} bits", request.bits);
  const std::string side = fmt::format(" {} {}", number(options.lo), number(options.hi));
  result += D == 2 ? "\nregion:" : "\nregion: box";
  for (int i = 0; i < D; ++i) result += side;
  result += '\n';
  int index = 0;
  for (const Polynomial<D>& f : random_polynomials<D>(options))
    result += fmt::format("{}{}: {}\n", D == 2 ? 'c' : 's', index++, text(f));
  return result;
}

}  // namespace

void add_random_options(CLI::App& app, RandomRequest& request) {
  app.add_option("--degree", request.degree, "of each polynomial")->type_name("D")->required();
  app.add_option("--count", request.count, "number of curves")
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--seed", request.seed, "equal seeds give equal polynomials")
      ->check(kNatural)
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--dim", request.dimension, "2: curves; 3: surfaces")
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--box", request.box, "the region [A, B] in every variable (-1 1)")
      ->type_name("A B")
      ->expected(2);
  app.add_option("--kind", request.kind,
                 "interpolating: through random points of the box; dense: random integer "
                 "coefficients")
      ->type_name("KIND")
      ->capture_default_str();
  app.add_option("--bits", request.bits, "of the coefficients of dense")
      ->type_name("B")
      ->capture_default_str();
}

Result<std::string> random_file(const RandomRequest& request) {
  if (request.dimension != 2 && request.dimension != 3) return bad("--dim must be 2 or 3");
  if (request.degree < 1 || request.degree > kMaxDegree)
    return bad(fmt::format("--degree must be between 1 and {}: the degree is limited", kMaxDegree));
  if (request.count < 1 || request.count > 10000) return bad("--count must be between 1 and 10000");
  if (request.bits < 1 || request.bits > 100000) return bad("--bits must be between 1 and 100000");
  RandomOptions options;
  options.degree = request.degree;
  options.count = request.count;
  options.seed = request.seed;
  options.bits = request.bits;
  if (request.kind == "dense")
    options.kind = RandomOptions::Kind::Dense;
  else if (request.kind != "interpolating")
    return bad("--kind must be interpolating or dense");
  if (!request.box.empty()) {
    if (request.box.size() != 2 || !parse_rational(request.box[0].c_str(), &options.lo) ||
        !parse_rational(request.box[1].c_str(), &options.hi))
      return bad("--box needs two numbers, like --box -1 1");
    if (!(nearest_double(options.lo) < nearest_double(options.hi)))
      return bad("--box needs a first number that is less than the second");
    if (abs(options.lo) > Rational(1e5) || abs(options.hi) > Rational(1e5))
      return bad("--box is limited to numbers up to 100000");
  }
  const int d = request.degree;
  const int unknowns =
      request.dimension == 2 ? (d + 1) * (d + 2) / 2 - 1 : (d + 1) * (d + 2) * (d + 3) / 6 - 1;
  if (options.kind == RandomOptions::Kind::Interpolating && unknowns > kMaxUnknowns)
    return bad(
        fmt::format("--degree {} is too high for interpolating surfaces: {} coefficients, at "
                    "most {} can be solved for",
                    d, unknowns, kMaxUnknowns));
  return request.dimension == 2 ? file<2>(options, request) : file<3>(options, request);
}

ExitCode run_random(const RandomRequest& request) {
  const auto text = random_file(request);
  if (!text.ok()) return fail(text.error());
  if (const Status status = print(text.value())) return fail(*status);
  return kCertified;
}

}  // namespace encase
