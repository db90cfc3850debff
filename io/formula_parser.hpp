// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "encase/expression.hpp"
#include "source_text.hpp"

namespace encase {

/// Why a formula is refused: nobody could read it; it may be read, but not as a polynomial; it is
/// a polynomial beyond a limit.
enum class Refusal { Syntax, NoPolynomial, Limit };

/// The first error of a formula.
class FormulaError {
 public:
  bool has_failed() const { return error_.has_value(); }
  const SyntaxError& error() const { return *error_; }
  Refusal refusal() const { return refusal_; }

  std::nullopt_t fail(std::string message, std::size_t offset, Refusal refusal = Refusal::Syntax) {
    if (!error_) {
      error_ = SyntaxError{offset, std::move(message)};
      refusal_ = refusal;
    }
    return std::nullopt;
  }

 private:
  std::optional<SyntaxError> error_;
  Refusal refusal_ = Refusal::Syntax;
};

/// A word of a formula.
struct Token {
  enum class Kind { Number, Name, Symbol, End };
  Kind kind = Kind::End;
  std::string_view text;  // "**" is given as "^"
  std::size_t offset = 0;
};

/// Recursive descent over the grammar of expression_parser.hpp; what is read is made by `Algebra`,
/// a FormulaError with
///
///   Value                                 what a part of the formula denotes
///   Sum                                   of terms: add(Value, bool negative), result()
///   number, variable, irrational, negated, times, divided, raised, called
///
/// Every function returns nothing once an error is recorded.
template <int D, class Algebra>
class FormulaParser : public Algebra {
 public:
  using Value = std::optional<typename Algebra::Value>;

  explicit FormulaParser(std::string_view text) : text_(text) { advance(); }

  Value parse() {
    Value result = sum();
    if (result && is_symbol('=')) {
      advance();
      Value right = sum();
      if (right && is_symbol('=')) fail("there is more than one '='");
      if (right) {
        typename Algebra::Sum difference;
        difference.add(std::move(*result), false);
        difference.add(std::move(*right), true);
        result = checked(difference.result(), 0);
      }
    }
    if (!this->has_failed() && token_.kind != Token::Kind::End)
      fail(is_symbol(')') ? "')' without a '(' before it" : "unexpected " + name_of(token_));
    return this->has_failed() ? std::nullopt : std::move(result);
  }

 private:
  static constexpr std::string_view kVariables = std::string_view("xyz").substr(0, D);
  static constexpr int kMaxDepth = 200;

  static bool is_letter(char c) {
    return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || c == '_';
  }
  static bool is_digit(char c) { return '0' <= c && c <= '9'; }

  std::nullopt_t fail(std::string message) {
    return Algebra::fail(std::move(message), token_.offset);
  }
  Value checked(Value value, std::size_t offset) {
    return value ? this->within_limits(std::move(*value), offset) : std::nullopt;
  }

  static std::string name_of(const Token& token) {
    if (token.kind == Token::Kind::End) return "end of the expression";
    return "'" + std::string(token.text) + "'";
  }

  bool is_symbol(char c) const {
    return token_.kind == Token::Kind::Symbol && token_.text.front() == c;
  }

  void advance() {
    previous_ = token_.kind;
    while (position_ < text_.size() && (text_[position_] == ' ' || text_[position_] == '\t' ||
                                        text_[position_] == '\r' || text_[position_] == '\n'))
      ++position_;
    token_ = {Token::Kind::End, {}, position_};
    if (position_ == text_.size()) return;
    const std::size_t begin = position_;
    const char c = text_[begin];
    const auto at = [this](std::size_t k) { return k < text_.size() ? text_[k] : '\0'; };
    if (is_digit(c) || (c == '.' && is_digit(at(begin + 1)))) {
      while (is_digit(at(position_))) ++position_;
      if (at(position_) == '.') ++position_;
      while (is_digit(at(position_))) ++position_;
      if (at(position_) == 'e' || at(position_) == 'E') {
        // An exponent only if digits follow: in `2e` and `2exp(x)` the letter begins a name.
        std::size_t digits = position_ + 1;
        if (at(digits) == '-' || at(digits) == '+') ++digits;
        if (is_digit(at(digits))) {
          while (is_digit(at(digits))) ++digits;
          position_ = digits;
        }
      }
      token_.kind = Token::Kind::Number;
    } else if (is_letter(c)) {
      while (is_letter(at(position_)) || is_digit(at(position_))) ++position_;
      // A run of variables is a product of tokens: in xy^2 the exponent belongs to y alone.
      if (text_.substr(begin, position_ - begin).find_first_not_of(kVariables) ==
          std::string_view::npos)
        position_ = begin + 1;
      token_.kind = Token::Kind::Name;
    } else if (std::string_view("+-*/^(),=").find(c) != std::string_view::npos) {
      token_.kind = Token::Kind::Symbol;
      position_ = begin + 1;
      if (c == '*' && at(position_) == '*') {
        ++position_;
        token_.text = "^";
        return;
      }
    } else {
      Algebra::fail("unexpected character " + quoted_character(text_, begin), begin);
      position_ = text_.size();  // parsing ends here
      return;
    }
    token_.text = text_.substr(begin, position_ - begin);
  }

  Value sum() {
    const std::size_t begin = token_.offset;
    typename Algebra::Sum terms;
    bool negative = false;
    for (;;) {
      Value next = product();
      if (!next) return std::nullopt;
      terms.add(std::move(*next), negative);
      if (!is_symbol('+') && !is_symbol('-')) break;
      negative = is_symbol('-');
      advance();
    }
    return checked(terms.result(), begin);
  }

  bool begins_factor() const {
    return token_.kind == Token::Kind::Number || token_.kind == Token::Kind::Name || is_symbol('(');
  }

  Value product() {
    Value result = factor();
    while (result) {
      const std::size_t offset = token_.offset;
      const bool quotient = is_symbol('/');
      if (quotient || is_symbol('*'))
        advance();
      else if (!begins_factor())
        break;
      else if (token_.kind == Token::Kind::Number && previous_ == Token::Kind::Number)
        return fail("a number follows a number; write '*' between them");
      const std::size_t right_offset = token_.offset;
      Value right = factor();
      if (!right) return std::nullopt;
      result = checked(quotient ? this->divided(*result, *right, right_offset)
                                : this->times(*result, *right, offset),
                       offset);
    }
    return result;
  }

  Value factor() {
    bool negative = false;
    while (is_symbol('+') || is_symbol('-')) {
      negative ^= is_symbol('-');
      advance();
    }
    Value result = power();
    if (result && negative) result = this->negated(*result);
    return result;
  }

  Value power() {
    Value base = primary();
    if (!base || !is_symbol('^')) return base;
    advance();
    const std::size_t offset = token_.offset;
    if (++depth_ > kMaxDepth) return fail("the expression is nested too deeply");
    const Value exponent = factor();
    --depth_;
    if (!exponent) return std::nullopt;
    return checked(this->raised(*base, *exponent, offset), offset);
  }

  Value primary() {
    switch (token_.kind) {
      case Token::Kind::Number:
        return number();
      case Token::Kind::Name:
        return name();
      case Token::Kind::Symbol:
        if (is_symbol('(')) return parenthesis();
        break;
      case Token::Kind::End:
        break;
    }
    return fail("expected a number, a variable or '(' before " + name_of(token_));
  }

  /// What stands after a '(' up to the ')' that belongs to it, or the ',' before the next argument.
  Value inside(std::size_t open, bool comma_follows) {
    if (++depth_ > kMaxDepth) return fail("the expression is nested too deeply");
    advance();
    Value result = sum();
    if (!result) return std::nullopt;
    if (!is_symbol(comma_follows ? ',' : ')')) {
      if (token_.kind == Token::Kind::End && !comma_follows)
        return Algebra::fail("'(' without a ')' after it", open);
      return fail(std::string("expected '") + (comma_follows ? ',' : ')') + "' before " +
                  name_of(token_));
    }
    if (!comma_follows) advance();
    --depth_;
    return result;
  }

  Value parenthesis() { return inside(token_.offset, false); }

  Value number() {
    Rational value;
    if (!parse_rational(std::string(token_.text).c_str(), &value))
      return fail("the exponent of " + name_of(token_) + " is too large");
    advance();
    return this->of_number(value);
  }

  Value name() {
    const Token at = token_;
    if (at.text.size() == 1 && kVariables.find(at.text[0]) != std::string_view::npos) {
      advance();
      return this->of_variable(static_cast<int>(kVariables.find(at.text[0])));
    }
    if (at.text == "pi" || at.text == "e") {
      advance();
      return this->of_irrational(at.text == "pi" ? Operation::Pi : Operation::Euler, at.offset);
    }
    if (at.text == "pow" || operation_named(at.text)) return call();
    return unknown_name(std::string(at.text));
  }

  /// A function with its arguments, of which a '(' comes first.
  Value call() {
    const Token at = token_;
    const auto operation = operation_named(at.text);
    advance();
    if (!is_symbol('('))
      return fail("expected '(' after the function '" + std::string(at.text) + "' before " +
                  name_of(token_));
    const std::size_t open = token_.offset;
    const bool two = !operation || operands(*operation) == 2;
    const Value first = inside(open, two);
    if (!first) return std::nullopt;
    if (!two) return checked(this->called(*operation, *first, at.offset), at.offset);
    const std::size_t comma = token_.offset;
    const Value second = inside(open, false);
    if (!second) return std::nullopt;
    return checked(operation ? this->called(*operation, *first, *second, at.offset)
                             : this->raised(*first, *second, comma + 1),
                   at.offset);
  }

  static std::optional<Operation> operation_named(std::string_view name) {
    if (name == "ln") return Operation::Log;
    if (name == "arcsin") return Operation::Asin;
    if (name == "arccos") return Operation::Acos;
    if (name == "arctan") return Operation::Atan;
    return function_named(name);
  }

  std::nullopt_t unknown_name(const std::string& name) {
    std::string lower = name;
    for (char& c : lower)
      if ('A' <= c && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (lower == "nan" || lower == "inf" || lower == "infinity")
      return fail("'" + name + "' is not a number a function can have");
    if (lower != name && (lower == "pow" || operation_named(lower)))
      return fail("unknown name '" + name + "'; functions are written in small letters");
    if (std::string_view("cot sec csc asinh acosh atanh log10 log2 cbrt sign atan2 floor")
            .find(lower) != std::string_view::npos)
      return fail("the function '" + name +
                  "' is not supported; there are sin cos tan asin acos atan sinh cosh tanh exp log "
                  "sqrt abs min max pow");
    std::string message = "unknown variable '" + name + "'; ";
    if (D == 1)
      message += "the variable is x";
    else
      message += D == 2 ? "the variables are x and y" : "the variables are x, y and z";
    if (kVariables.find(name[0]) != std::string_view::npos && name.size() > 1 &&
        name.find_first_not_of("0123456789", 1) == std::string::npos)
      message += std::string("; a power is written ") + name[0] + "^" + name.substr(1);
    return fail(message);
  }

  std::string_view text_;
  std::size_t position_ = 0;
  Token token_;
  Token::Kind previous_ = Token::Kind::End;
  int depth_ = 0;
};

}  // namespace encase
