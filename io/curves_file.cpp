// SPDX-License-Identifier: MIT
#include "encase/curves_file.hpp"

#include <iostream>
#include <iterator>
#include <utility>
#include <variant>

#include "expression_parser.hpp"
#include "function_file.hpp"
#include "region_text.hpp"

namespace encase {

namespace {

Result<CurvesFile> curves_of(Result<FunctionFile<2>> file) {
  if (!file) return file.error();
  return CurvesFile{std::move(file.value().functions), std::move(file.value().region)};
}

}  // namespace

Result<CurvesFile> read_curves(const std::string& text, const std::string& source) {
  return curves_of(read_functions<2>(text, source));
}

Result<CurvesFile> read_curves(std::istream& stream, const std::string& source) {
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) return Error{Error::Code::Io, "cannot read " + source};
  return read_curves(text, source);
}

Result<CurvesFile> load_curves(const std::string& path) {
  return curves_of(load_functions<2>(path));
}

Result<Polynomial<2>> parse_polynomial(const std::string& text, const std::string& source) {
  return placed(parse_polynomial<2>(text), text, source);
}

Result<Function<2>> parse_function(const std::string& text, const std::string& source) {
  return placed(parse_function<2>(text), text, source);
}

Result<Region> parse_region(const std::string& text, const std::string& source) {
  return placed(parse_plane_region(text), text, source);
}

}  // namespace encase
