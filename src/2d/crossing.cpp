// SPDX-License-Identifier: MIT
#include "encase/crossing.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "common/components.hpp"
#include "common/expression_program.hpp"
#include "common/filtered_inclusion.hpp"
#include "common/interval.hpp"
#include "common/mpfr_interval.hpp"

namespace encase {

namespace {

/// Beyond this many bits a coordinate alone would take a good part of the memory.
constexpr long kMaxBits = 100000000;
/// Likewise for sines and exponentials, and time.
constexpr long kMaxBitsOfExpressions = 1 << 20;
/// How many bits of two coordinates have to agree before it is left open whether they are equal,
/// where no resultant tells.
constexpr long kMaxBitsCompared = 1 << 12;
/// Inclusion functions are called with doubles.
constexpr long kMaxBitsOfInclusions = 60;
/// How many bits of precision, more than the result needs, are tried before giving up.
constexpr long kMaxGuard = 1 << 18;
/// How many boxes a subdivision may hold that narrows a crossing's box for the interval Newton
/// method.
constexpr std::size_t kMaxPieces = 4096;
/// How often such a subdivision may fail, each time with a higher precision.
constexpr int kMaxFailures = 3;
/// How often its pieces are halved, in turns along x and y.
constexpr int kMaxHalvings = 48;

Rational exact(mpfr_srcptr value) {
  Rational q;
  mpfr_get_q(q.get_mpq_t(), value);
  return q;
}

bool is_finite(const MpfrInterval& x) {
  return mpfr_number_p(x.lo()) != 0 && mpfr_number_p(x.hi()) != 0;
}

Rational width(const MpfrInterval& x) { return exact(x.hi()) - exact(x.lo()); }

/// The number of precision p nearest to the middle of [lo, hi].
Rational middle(const Rational& lo, const Rational& hi, int precision) {
  const Rational half = (lo + hi) / 2;
  mpfr_t rounded;
  mpfr_init2(rounded, precision);
  mpfr_set_q(rounded, half.get_mpq_t(), MPFR_RNDN);
  const Rational result = exact(rounded);
  mpfr_clear(rounded);
  return result;
}

Rational largest_width(const RationalBox& box) {
  const Rational x = box.hi[0] - box.lo[0], y = box.hi[1] - box.lo[1];
  return x < y ? y : x;
}

/// The least w with width <= 2^-w (of the right size; a large number for width 0).
long bits_of_width(const Rational& width) {
  if (width == 0) return kMaxBits;
  return static_cast<long>(mpz_sizeinbase(width.get_den_mpz_t(), 2)) -
         static_cast<long>(mpz_sizeinbase(width.get_num_mpz_t(), 2)) - 1;
}

using IntervalBox = std::array<MpfrInterval, 2>;

/// A polynomial with coefficients enclosed at one precision, by Horner's scheme in both variables.
class EnclosedPolynomial {
 public:
  EnclosedPolynomial(const Polynomial<2>& f, int precision) : zero_(precision) {
    rows_.resize(static_cast<std::size_t>(std::max(f.degree(0), 0)) + 1);
    for (const auto& term : f.terms()) {
      auto& row = rows_[static_cast<std::size_t>(term.exponent[0])];
      row.resize(static_cast<std::size_t>(term.exponent[1]) + 1, zero_);
      row.back() = MpfrInterval(precision, term.coefficient);
    }
  }

  MpfrInterval operator()(const IntervalBox& at) const {
    MpfrInterval sum = zero_;
    for (std::size_t i = rows_.size(); i-- > 0;) {
      MpfrInterval inner = zero_;
      for (std::size_t j = rows_[i].size(); j-- > 0;) {
        inner *= at[1];
        inner += rows_[i][j];
      }
      sum *= at[0];
      sum += inner;
    }
    return sum;
  }

 private:
  MpfrInterval zero_;
  std::vector<std::vector<MpfrInterval>> rows_;  // by the exponents of x, then y
};

/// A polynomial and its gradient on boxes.
class PolynomialOnBoxes {
 public:
  explicit PolynomialOnBoxes(const Polynomial<2>& f)
      : exact_{f, f.derivative(0), f.derivative(1)} {}

  void prepare(int precision) {
    enclosed_.clear();
    for (const Polynomial<2>& f : exact_) enclosed_.emplace_back(f, precision);
  }
  MpfrInterval value(const IntervalBox& at) { return enclosed_[0](at); }
  std::optional<IntervalBox> gradient(const IntervalBox& at) {
    return IntervalBox{enclosed_[1](at), enclosed_[2](at)};
  }

 private:
  std::array<Polynomial<2>, 3> exact_;  // f, f_x, f_y
  std::vector<EnclosedPolynomial> enclosed_;
};

/// An expression and its gradient on boxes, at their precision.
class ExpressionOnBoxes {
 public:
  explicit ExpressionOnBoxes(const Expression& f) : program_(f) {}

  void prepare(int) {}
  MpfrInterval value(const IntervalBox& at) { return program_.value(at, workspace_).range(); }
  std::optional<IntervalBox> gradient(const IntervalBox& at) {
    const auto on_box = program_.value_and_gradient(at, workspace_);
    if (!on_box.smooth()) return std::nullopt;
    return IntervalBox{on_box.jet.first(0), on_box.jet.first(1)};
  }

 private:
  ExpressionProgram<2> program_;
  ExpressionProgram<2>::Workspace<MpfrInterval> workspace_;
};

/// An inclusion function on boxes: there is nothing beyond doubles.
class InclusionOnBoxes {
 public:
  explicit InclusionOnBoxes(Inclusion<2> f) : f_(std::move(f)) {}

  void prepare(int precision) { precision_ = precision; }
  MpfrInterval value(const IntervalBox& at) { return widened(on(at).value); }
  std::optional<IntervalBox> gradient(const IntervalBox& at) {
    const EnclosedJet<2> jet = on(at);
    if (!jet.has_gradient || !jet.has_hessian) return std::nullopt;
    return IntervalBox{widened(jet.gradient[0]), widened(jet.gradient[1])};
  }

 private:
  EnclosedJet<2> on(const IntervalBox& at) const {
    Box<2> box;
    for (std::size_t i = 0; i < 2; ++i) {
      box.lo[i] = mpfr_get_d(at[i].lo(), MPFR_RNDD);
      box.hi[i] = mpfr_get_d(at[i].hi(), MPFR_RNDU);
    }
    return enclosed(f_, box);
  }
  MpfrInterval widened(const Interval& a) const { return MpfrInterval(precision_, a.lo, a.hi); }

  Inclusion<2> f_;
  int precision_ = 53;
};

/// The function of a curve, with enclosures at one precision.
class FunctionOnBoxes {
 public:
  explicit FunctionOnBoxes(const Function<2>& f)
      : on_boxes_(f.is_polynomial()   ? OnBoxes(PolynomialOnBoxes(f.polynomial()))
                  : f.is_expression() ? OnBoxes(ExpressionOnBoxes(f.expression()))
                                      : InclusionOnBoxes(f.inclusion())) {}

  void prepare(int precision) {
    std::visit([&](auto& f) { f.prepare(precision); }, on_boxes_);
  }
  /// Holds all values on a box.
  MpfrInterval value(const IntervalBox& at) {
    return std::visit([&](auto& f) { return f.value(at); }, on_boxes_);
  }
  /// Holds all gradients on a box; nothing unless the function is proved to be differentiable
  /// there.
  std::optional<IntervalBox> gradient(const IntervalBox& at) {
    return std::visit([&](auto& f) { return f.gradient(at); }, on_boxes_);
  }

 private:
  using OnBoxes = std::variant<PolynomialOnBoxes, ExpressionOnBoxes, InclusionOnBoxes>;
  OnBoxes on_boxes_;
};

/// The common points of two curves in boxes, by the interval Newton method of Krawczyk.
class CommonPoint {
 public:
  CommonPoint(const Function<2>& f, const Function<2>& g)
      : functions_{FunctionOnBoxes(f), FunctionOnBoxes(g)} {}

  enum class Step {
    Shrunk,  ///< the largest width is at most half of what it was
    Empty,   ///< no common point in the box
    Noise,   ///< the precision is too low
    Wide     ///< the box is too wide for the derivatives to be known well
  };

  /// Intersects the box with its Krawczyk image, which contains every common point of the box: for
  /// such a point z and any m in the box, the mean value theorem (row by row; boxes are convex) has
  /// 0 = F(m) + J (z - m) for a matrix J out of the enclosure of the Jacobian on the box, and so
  /// z = m - C F(m) + (I - C J) (z - m) for every matrix C.
  Step contract(RationalBox* box, int precision) {
    enclose(precision);
    const Rational before = largest_width(*box);
    if (before == 0) return Step::Noise;
    std::array<Rational, 2> m;
    for (int i = 0; i < 2; ++i) {
      m[i] = middle(box->lo[i], box->hi[i], precision);
      if (m[i] < box->lo[i] || m[i] > box->hi[i]) return Step::Noise;
    }
    const IntervalBox at_m{MpfrInterval(precision, m[0]), MpfrInterval(precision, m[1])};
    const IntervalBox at_box = enclosed(*box, precision);
    const MpfrInterval f = functions_[0].value(at_m), g = functions_[1].value(at_m);
    const auto gradient_f = functions_[0].gradient(at_box),
               gradient_g = functions_[1].gradient(at_box);
    if (!gradient_f || !gradient_g) return Step::Wide;
    const auto& [fx, fy] = *gradient_f;
    const auto& [gx, gy] = *gradient_g;
    for (const MpfrInterval* v : {&f, &g, &fx, &fy, &gx, &gy})
      if (!is_finite(*v)) return Step::Wide;

    // C: about the inverse of the Jacobian in the middle of its enclosure.
    const auto mid = [&](const MpfrInterval& v) {
      return MpfrInterval(precision, middle(exact(v.lo()), exact(v.hi()), precision));
    };
    const MpfrInterval a = mid(fx), b = mid(fy), c = mid(gx), d = mid(gy);
    const MpfrInterval determinant = a * d - b * c;
    const std::array<MpfrInterval, 4> inverse{d / determinant, -b / determinant, -c / determinant,
                                              a / determinant};
    for (const MpfrInterval& v : inverse)
      if (!is_finite(v)) return Step::Wide;
    const MpfrInterval p = mid(inverse[0]), q = mid(inverse[1]), r = mid(inverse[2]),
                       s = mid(inverse[3]);

    const MpfrInterval one(precision, 1.0);
    const MpfrInterval dx = at_box[0] - at_m[0], dy = at_box[1] - at_m[1];
    const IntervalBox shift{p * f + q * g, r * f + s * g};
    const IntervalBox image{
        at_m[0] - shift[0] + (one - p * fx - q * gx) * dx - (p * fy + q * gy) * dy,
        at_m[1] - shift[1] - (r * fx + s * gx) * dx + (one - r * fy - s * gy) * dy};
    bool noisy = false;
    for (int i = 0; i < 2; ++i) {
      if (!is_finite(image[i])) return Step::Wide;
      box->lo[i] = std::max(box->lo[i], exact(image[i].lo()));
      box->hi[i] = std::min(box->hi[i], exact(image[i].hi()));
      if (box->lo[i] > box->hi[i]) return Step::Empty;
      noisy = noisy || 8 * width(shift[i]) > before;
    }
    if (2 * largest_width(*box) <= before) return Step::Shrunk;
    return noisy ? Step::Noise : Step::Wide;
  }

  /// Narrows the box to the hull of the pieces of a subdivision that may hold a common point.
  Step subdivide(RationalBox* box, int precision) {
    const Rational before = largest_width(*box);
    std::vector<RationalBox> pieces{*box};
    for (int round = 0; round < kMaxHalvings && pieces.size() <= kMaxPieces; ++round) {
      std::vector<RationalBox> halves;
      for (const RationalBox& piece : pieces) {
        const int axis = piece.hi[0] - piece.lo[0] >= piece.hi[1] - piece.lo[1] ? 0 : 1;
        const Rational cut = (piece.lo[axis] + piece.hi[axis]) / 2;
        for (const bool upper : {false, true}) {
          RationalBox half = piece;
          (upper ? half.lo : half.hi)[axis] = cut;
          if (excluded(half, precision) || contract(&half, precision) == Step::Empty) continue;
          halves.push_back(std::move(half));
        }
      }
      if (halves.empty()) return Step::Empty;
      *box = halves[0];
      for (const RationalBox& half : halves)
        for (int i = 0; i < 2; ++i) {
          box->lo[i] = std::min(box->lo[i], half.lo[i]);
          box->hi[i] = std::max(box->hi[i], half.hi[i]);
        }
      if (2 * largest_width(*box) <= before) return Step::Shrunk;
      pieces = std::move(halves);
    }
    return Step::Wide;
  }

 private:
  static IntervalBox enclosed(const RationalBox& box, int precision) {
    return {MpfrInterval(precision, box.lo[0], box.hi[0]),
            MpfrInterval(precision, box.lo[1], box.hi[1])};
  }

  bool excluded(const RationalBox& box, int precision) {
    enclose(precision);
    const IntervalBox at = enclosed(box, precision);
    for (FunctionOnBoxes& f : functions_) {
      const auto sign = f.value(at).sign();
      if (sign && *sign != Sign::Zero) return true;
    }
    return false;
  }

  void enclose(int precision) {
    if (precision == precision_) return;
    for (FunctionOnBoxes& f : functions_) f.prepare(precision);
    precision_ = precision;
  }

  std::array<FunctionOnBoxes, 2> functions_;
  int precision_ = 0;
};

std::optional<Error> complaint(const Encasement& encasement, int id) {
  if (id < 0 || id >= static_cast<int>(encasement.crossings.size()))
    return Error{Error::Code::BadInput, "there is no crossing " + std::to_string(id)};
  const Crossing& crossing = encasement.crossings[static_cast<std::size_t>(id)];
  for (int i = 0; i < 2; ++i) {
    const int curve = crossing.curves[i];
    if (curve < 0 || curve >= static_cast<int>(encasement.curves.size()) ||
        !std::isfinite(crossing.box.lo[i]) || !std::isfinite(crossing.box.hi[i]))
      return Error{Error::Code::BadInput, "crossing " + std::to_string(id) + " is malformed"};
  }
  return std::nullopt;
}

const Function<2>& curve_of(const Encasement& encasement, int id, int which) {
  const Crossing& crossing = encasement.crossings[static_cast<std::size_t>(id)];
  return encasement.curves[static_cast<std::size_t>(crossing.curves[which])].function;
}

bool are_polynomials(const Encasement& encasement, int id) {
  return curve_of(encasement, id, 0).is_polynomial() && curve_of(encasement, id, 1).is_polynomial();
}

bool has_inclusion(const Encasement& encasement, int id) {
  return curve_of(encasement, id, 0).is_inclusion() || curve_of(encasement, id, 1).is_inclusion();
}

/// Refines a box that holds exactly one common point of two curves.
class Refiner {
 public:
  Refiner(const Encasement& encasement, int id)
      : id_(id),
        max_guard_(has_inclusion(encasement, id) ? 2 * guard_ : kMaxGuard),
        point_(curve_of(encasement, id, 0), curve_of(encasement, id, 1)) {
    const Box<2>& box = encasement.crossings[static_cast<std::size_t>(id)].box;
    for (int i = 0; i < 2; ++i) {
      box_.lo[i] = box.lo[i];
      box_.hi[i] = box.hi[i];
    }
  }

  const RationalBox& box() const { return box_; }

  /// Narrows the box to 2^-bits. A step squares the width at best, so it needs the precision of the
  /// square and a guard, which grows where it turns out too small.
  Status refine(long bits) {
    while (bits_of_width(largest_width(box_)) < bits) {
      const long next = std::min(bits, 2 * std::max(bits_of_width(largest_width(box_)), 16L));
      const int precision = static_cast<int>(next + guard_);
      CommonPoint::Step step = point_.contract(&box_, precision);
      if (step == CommonPoint::Step::Wide) step = point_.subdivide(&box_, precision);
      if (step == CommonPoint::Step::Empty)
        return Error{Error::Code::Internal,
                     "the box of crossing " + std::to_string(id_) + " holds no common point"};
      if (step == CommonPoint::Step::Wide) ++failures_;
      if (step != CommonPoint::Step::Shrunk) guard_ *= 2;
      if (guard_ > max_guard_ + 2 * bits || failures_ == kMaxFailures)
        return Error{Error::Code::Undecided, "crossing " + std::to_string(id_) +
                                                 " cannot be refined to " + std::to_string(bits) +
                                                 " bits: its curves may touch there"};
    }
    return std::nullopt;
  }

 private:
  int id_;
  long guard_ = 64, max_guard_;
  int failures_ = 0;
  CommonPoint point_;
  RationalBox box_;
};

}  // namespace

Result<RationalBox> refine(const Encasement& encasement, int id, int bits) {
  if (const auto error = complaint(encasement, id)) return *error;
  const bool polynomials = are_polynomials(encasement, id);
  const long most = polynomials                     ? kMaxBits
                    : has_inclusion(encasement, id) ? kMaxBitsOfInclusions
                                                    : kMaxBitsOfExpressions;
  if (bits > most)
    return Error{Error::Code::Undecided,
                 std::string("crossings of curves that are ") + (polynomials ? "" : "no ") +
                     "polynomials can be refined to " + std::to_string(most) + " bits at most"};
  Refiner refiner(encasement, id);
  if (const Status error = refiner.refine(bits)) return *error;
  return refiner.box();
}

// Two different coordinates are told apart by refining both. Equal ones never are: but the first is
// a root of R_1, the second of R_2, the resultants of the two pairs that eliminate the other
// coordinate. Once the hull of both enclosures holds a single root of R_1 R_2, both coordinates are
// that root. Where one of the curves is no polynomial there is no such proof.
Result<Sign> compare_coordinate(const Encasement& encasement, int axis, int first, int second) {
  for (int id : {first, second})
    if (const auto error = complaint(encasement, id)) return *error;
  if (axis != 0 && axis != 1) return Error{Error::Code::BadInput, "the axis must be 0 or 1"};
  if (first == second) return Sign::Zero;

  constexpr int kBitsBeforeResultants = 200;
  const bool polynomials =
      are_polynomials(encasement, first) && are_polynomials(encasement, second);
  const long most = polynomials ? kMaxBits : kMaxBitsCompared;
  Refiner a(encasement, first), b(encasement, second);
  std::optional<Polynomial<1>> roots;  // the square-free part of R_1 R_2
  long bits = 50;
  for (; bits <= most; bits *= 2) {
    for (Refiner* refiner : {&a, &b})
      if (const Status error = refiner->refine(bits)) return *error;
    if (a.box().hi[axis] < b.box().lo[axis]) return Sign::Negative;
    if (b.box().hi[axis] < a.box().lo[axis]) return Sign::Positive;
    if (bits < kBitsBeforeResultants || !polynomials) continue;
    if (!roots) {
      roots = Polynomial<1>::constant(1);
      const auto& pairs = encasement.crossings;
      const bool same_pair = pairs[static_cast<std::size_t>(first)].curves ==
                             pairs[static_cast<std::size_t>(second)].curves;
      for (int id : same_pair ? std::vector{first} : std::vector{first, second}) {
        const auto r = resultant(curve_of(encasement, id, 0).polynomial(),
                                 curve_of(encasement, id, 1).polynomial(), 1 - axis);
        if (r.is_zero())
          return Error{Error::Code::Degenerate,
                       "the curves of crossing " + std::to_string(id) + " share a component"};
        const Polynomial<1> part = square_free_part(r);
        roots = same_pair ? part : square_free_part(*roots * part);
      }
    }
    const Rational& lo = std::min(a.box().lo[axis], b.box().lo[axis]);
    const Rational& hi = std::max(a.box().hi[axis], b.box().hi[axis]);
    if (count_real_roots(*roots, lo, hi) == 1) return Sign::Zero;
  }
  return Error{Error::Code::Undecided,
               "the coordinates of crossings " + std::to_string(first) + " and " +
                   std::to_string(second) + " agree to " + std::to_string(bits / 2) + " bits" +
                   (polynomials ? ""
                                : "; whether they are equal is not proved, as not all of the "
                                  "curves are polynomials")};
}

}  // namespace encase
