// SPDX-License-Identifier: MIT
#include "expression_parser.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string>
#include <utility>

namespace encase {

namespace {

constexpr int kMaxDepth = 200;
constexpr std::size_t kMaxBits = 1000000;

constexpr std::array<std::string_view, 24> kFunctions = {
    "sin",    "cos",    "tan",  "cot",  "asin", "acos", "atan", "arcsin",
    "arccos", "arctan", "sinh", "cosh", "tanh", "exp",  "ln",   "log",
    "log10",  "sqrt",   "cbrt", "abs",  "sign", "min",  "max",  "atan2"};

bool is_letter(char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return '0' <= c && c <= '9'; }

struct Token {
  enum class Kind { Number, Name, Symbol, End };
  Kind kind = Kind::End;
  std::string_view text;  // "**" is given as "^"
  std::size_t offset = 0;
};

/// The number of bits of the largest numerator or denominator.
template <int D>
std::size_t coefficient_bits(const Polynomial<D>& f) {
  std::size_t bits = 1;
  for (const auto& term : f.terms())
    bits = std::max({bits, mpz_sizeinbase(term.coefficient.get_num_mpz_t(), 2),
                     mpz_sizeinbase(term.coefficient.get_den_mpz_t(), 2)});
  return bits;
}

/// Recursive descent. Every function returns nothing once an error is recorded.
template <int D>
class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) { advance(); }

  std::variant<Polynomial<D>, SyntaxError> parse() {
    auto result = sum();
    if (result && is_symbol('=')) {
      advance();
      auto right = sum();
      if (right && is_symbol('=')) fail("there is more than one '='");
      if (right) *result = *result - *right;
    }
    if (!error_ && token_.kind != Token::Kind::End)
      fail(is_symbol(')') ? "')' without a '(' before it" : "unexpected " + name_of(token_));
    if (error_) return *error_;
    return std::move(*result);
  }

 private:
  using Value = std::optional<Polynomial<D>>;
  static constexpr std::string_view kVariables = std::string_view("xyz").substr(0, D);

  /// Records the first error only, at the current token unless told otherwise.
  std::nullopt_t fail(std::string message) { return fail(std::move(message), token_.offset); }
  std::nullopt_t fail(std::string message, std::size_t offset) {
    if (!error_) error_ = SyntaxError{offset, std::move(message)};
    return std::nullopt;
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
    } else if (std::string_view("+-*/^()=").find(c) != std::string_view::npos) {
      token_.kind = Token::Kind::Symbol;
      position_ = begin + 1;
      if (c == '*' && at(position_) == '*') {
        ++position_;
        token_.text = "^";
        return;
      }
    } else {
      fail("unexpected character " + quoted_character(text_, begin), begin);
      position_ = text_.size();  // parsing ends here
      return;
    }
    token_.text = text_.substr(begin, position_ - begin);
  }

  Value sum() {
    // Terms are collected and added up together: one by one they would cost their number squared.
    std::vector<typename Polynomial<D>::Term> terms;
    std::size_t compact = 0;
    bool negative = false;
    for (;;) {
      auto next = product();
      if (!next) return std::nullopt;
      if (negative) *next = -*next;
      terms.insert(terms.end(), next->terms().begin(), next->terms().end());
      if (terms.size() > 2 * compact + 4096) {
        terms = Polynomial<D>::from_terms(std::move(terms)).terms();
        compact = terms.size();
      }
      if (!is_symbol('+') && !is_symbol('-')) break;
      negative = is_symbol('-');
      advance();
    }
    return Polynomial<D>::from_terms(std::move(terms));
  }

  bool begins_factor() const {
    return token_.kind == Token::Kind::Number || token_.kind == Token::Kind::Name || is_symbol('(');
  }

  Value product() {
    auto result = factor();
    while (result) {
      const std::size_t offset = token_.offset;
      if (is_symbol('*')) {
        advance();
        auto right = factor();
        result = right ? times(*result, *right, offset) : std::nullopt;
      } else if (is_symbol('/')) {
        advance();
        const std::size_t divisor = token_.offset;
        auto right = factor();
        result = right ? divided(*result, *right, divisor) : std::nullopt;
      } else if (begins_factor()) {
        if (token_.kind == Token::Kind::Number && previous_ == Token::Kind::Number)
          return fail("a number follows a number; write '*' between them");
        auto right = factor();
        result = right ? times(*result, *right, offset) : std::nullopt;
      } else {
        break;
      }
    }
    return result;
  }

  Value factor() {
    bool negative = false;
    while (is_symbol('+') || is_symbol('-')) {
      negative ^= is_symbol('-');
      advance();
    }
    auto result = power();
    if (result && negative) result = -*result;
    return result;
  }

  Value power() {
    auto base = primary();
    if (!base || !is_symbol('^')) return base;
    advance();
    const std::size_t offset = token_.offset;
    if (++depth_ > kMaxDepth) return fail("the expression is nested too deeply");
    const auto exponent = factor();
    --depth_;
    return exponent ? raised(*base, *exponent, offset) : std::nullopt;
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

  Value parenthesis() {
    const std::size_t open = token_.offset;
    if (++depth_ > kMaxDepth) return fail("the expression is nested too deeply");
    advance();
    auto result = sum();
    if (!result) return std::nullopt;
    if (!is_symbol(')')) {
      if (token_.kind == Token::Kind::End) return fail("'(' without a ')' after it", open);
      return fail("expected ')' before " + name_of(token_));
    }
    advance();
    --depth_;
    return result;
  }

  Value number() {
    Rational value;
    if (!parse_rational(std::string(token_.text).c_str(), &value))
      return fail("the exponent of " + name_of(token_) + " is too large");
    advance();
    return Polynomial<D>::constant(value);
  }

  Value name() {
    const std::string name(token_.text);
    std::string lower = name;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (name.size() == 1 && kVariables.find(name[0]) != std::string_view::npos) {
      advance();
      return Polynomial<D>::variable(static_cast<int>(kVariables.find(name[0])));
    }
    if (lower == "nan" || lower == "inf" || lower == "infinity")
      return fail("'" + name + "' is not a number a polynomial can have");
    if (name == "pi" || name == "e")
      return fail(
          "the constant '" + name +
          "' is irrational; so far only polynomials with rational coefficients are supported");
    if (std::find(kFunctions.begin(), kFunctions.end(), lower) != kFunctions.end())
      return fail("the function '" + name + "' is not supported: so far curves are polynomials");
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

  std::nullopt_t too_high(long long degree, std::size_t offset) {
    return fail("the degree is " + std::to_string(degree) + "; polynomials are limited to degree " +
                    std::to_string(kMaxDegree),
                offset);
  }
  std::nullopt_t too_large(std::size_t offset) {
    return fail("a coefficient has more than a million bits", offset);
  }

  Value times(const Polynomial<D>& a, const Polynomial<D>& b, std::size_t offset) {
    if (a.is_zero() || b.is_zero()) return Polynomial<D>();
    if (a.degree() + b.degree() > kMaxDegree) return too_high(a.degree() + b.degree(), offset);
    if (coefficient_bits(a) + coefficient_bits(b) > kMaxBits) return too_large(offset);
    return a * b;
  }

  Value divided(const Polynomial<D>& a, const Polynomial<D>& b, std::size_t offset) {
    if (b.is_zero()) return fail("division by zero", offset);
    if (!b.is_constant()) return fail("polynomials can only be divided by constants", offset);
    return times(a, Polynomial<D>::constant(1 / b.terms()[0].coefficient), offset);
  }

  Value raised(const Polynomial<D>& base, const Polynomial<D>& exponent, std::size_t offset) {
    constexpr char kRule[] = "the exponent must be an integer that is not negative";
    if (!exponent.is_constant()) return fail(kRule, offset);
    const Rational value = exponent.is_zero() ? Rational(0) : exponent.terms()[0].coefficient;
    if (value.get_den() != 1) return fail(kRule, offset);
    if (value < 0 && !base.is_constant()) return fail(kRule, offset);
    if (value < 0 && base.is_zero()) return fail("division by zero", offset);
    if (value == 0) return Polynomial<D>::constant(1);
    if (base.is_zero()) return Polynomial<D>();
    if (base.is_constant()) {
      const Rational& c = base.terms()[0].coefficient;
      if (abs(c) == 1)
        return Polynomial<D>::constant(mpz_odd_p(value.get_num_mpz_t()) ? c : Rational(1));
    }
    // From here on every unit of the exponent costs a degree or bits.
    const Integer e = abs(value.get_num());
    if (!e.fits_sint_p() || e > kMaxBits) {
      if (base.is_constant()) return too_large(offset);
      return fail("the exponent is " + value.get_str() + "; polynomials are limited to degree " +
                      std::to_string(kMaxDegree),
                  offset);
    }
    const int n = static_cast<int>(e.get_si());
    if (static_cast<long long>(n) * base.degree() > kMaxDegree)
      return too_high(static_cast<long long>(n) * base.degree(), offset);
    if (static_cast<std::size_t>(n) * coefficient_bits(base) > kMaxBits) return too_large(offset);
    auto result = base.power(n);
    if (value < 0) return Polynomial<D>::constant(1 / result.terms()[0].coefficient);
    return result;
  }

  std::string_view text_;
  std::size_t position_ = 0;
  Token token_;
  Token::Kind previous_ = Token::Kind::End;
  int depth_ = 0;
  std::optional<SyntaxError> error_;
};

}  // namespace

template <int D>
std::variant<Polynomial<D>, SyntaxError> parse_expression(std::string_view text) {
  return Parser<D>(text).parse();
}

template std::variant<Polynomial<1>, SyntaxError> parse_expression<1>(std::string_view);
template std::variant<Polynomial<2>, SyntaxError> parse_expression<2>(std::string_view);
template std::variant<Polynomial<3>, SyntaxError> parse_expression<3>(std::string_view);

}  // namespace encase
