#include "courant/core/numbers/ball.hpp"

#include <arb.h>

#include <cmath>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "courant/core/numbers/meant_number.hpp"

namespace courant {
namespace {

constexpr slong kBits = 512;

}  // namespace

struct Ball::Access {
  static_assert(sizeof(arb_struct) <= sizeof(Ball::storage_) &&
                alignof(arb_struct) <= alignof(Ball));
  static arb_ptr of(Ball& a) { return std::launder(reinterpret_cast<arb_ptr>(a.storage_.data())); }
  static arb_srcptr of(const Ball& a) {
    return std::launder(reinterpret_cast<arb_srcptr>(a.storage_.data()));
  }

  // What a function of Arb makes of the operands and kBits.
  template <class Operation, class... Operands>
  static Ball result(const Operation& operation, const Operands&... operands) {
    Ball made;
    operation(of(made), of(operands)..., kBits);
    return made;
  }
};

bool Ball::is_available() { return true; }

Ball::Ball() {
  ::new (storage_.data()) arb_struct;
  arb_init(Access::of(*this));
}

Ball::Ball(double number) : Ball() {
  if (std::isfinite(number))
    arb_set_d(Access::of(*this), number);
  else
    arb_indeterminate(Access::of(*this));
}

Ball::Ball(const Ball& other) : Ball() { arb_set(Access::of(*this), Access::of(other)); }

Ball::Ball(Ball&& other) noexcept : Ball() { arb_swap(Access::of(*this), Access::of(other)); }

Ball& Ball::operator=(Ball other) noexcept {
  arb_swap(Access::of(*this), Access::of(other));
  return *this;
}

Ball::~Ball() { arb_clear(Access::of(*this)); }

Ball Ball::written(double number) {
  if (!std::isfinite(number) || number == 0.0) return number;
  const MeantNumber written = meant_number(number);
  Ball value;
  if (const auto& fraction = written.fraction) {
    Ball pi;
    arb_const_pi(Access::of(pi), kBits);
    value = fraction->value(pi);
  } else {
    const std::string text = written.digits + "e" + std::to_string(written.exponent);
    arb_set_str(Access::of(value), text.c_str(), kBits);
  }
  return written.is_negative ? -value : value;
}

bool Ball::is_zero() const { return arb_is_zero(Access::of(*this)) != 0; }

bool Ball::is_exact() const { return arb_is_exact(Access::of(*this)) != 0; }

bool Ball::is_finite() const { return arb_is_finite(Access::of(*this)) != 0; }

bool Ball::contains_zero() const { return arb_contains_zero(Access::of(*this)) != 0; }

bool Ball::contains_inside(const Ball& other) const {
  return arb_contains_interior(Access::of(*this), Access::of(other)) != 0;
}

int Ball::sign() const { return contains_zero() ? 0 : arf_sgn(arb_midref(Access::of(*this))); }

Ball::operator double() const { return arf_get_d(arb_midref(Access::of(*this)), ARF_RND_NEAR); }

double Ball::radius() const { return mag_get_d(arb_radref(Access::of(*this))); }

double Ball::least_size() const {
  arf_t bound;
  arf_init(bound);
  arb_get_abs_lbound_arf(bound, Access::of(*this), kBits);
  const double result = arf_get_d(bound, ARF_RND_DOWN);
  arf_clear(bound);
  return result;
}

Ball Ball::midpoint() const {
  Ball result;
  arb_get_mid_arb(Access::of(result), Access::of(*this));
  return result;
}

Ball Ball::widened_by(const Ball& other, int exponent) const {
  Ball result(*this);
  mag_t bound;
  mag_init(bound);
  arb_get_mag(bound, Access::of(other));
  mag_mul_2exp_si(bound, bound, exponent);
  arb_add_error_mag(Access::of(result), bound);
  mag_clear(bound);
  return result;
}

Ball operator-(const Ball& a) {
  Ball result;
  arb_neg(Ball::Access::of(result), Ball::Access::of(a));
  return result;
}

Ball operator+(const Ball& a, const Ball& b) { return Ball::Access::result(arb_add, a, b); }

Ball operator-(const Ball& a, const Ball& b) { return Ball::Access::result(arb_sub, a, b); }

Ball operator*(const Ball& a, const Ball& b) { return Ball::Access::result(arb_mul, a, b); }

Ball operator/(const Ball& a, const Ball& b) { return Ball::Access::result(arb_div, a, b); }

Ball evaluate(Op op, const Ball& a) {
  switch (op) {
    case Op::sqrt:
      return Ball::Access::result(arb_sqrt, a);
    case Op::exp:
      return Ball::Access::result(arb_exp, a);
    case Op::log:
      return Ball::Access::result(arb_log, a);
    case Op::sin:
      return Ball::Access::result(arb_sin, a);
    case Op::cos:
      return Ball::Access::result(arb_cos, a);
    case Op::tan:
      return Ball::Access::result(arb_tan, a);
    case Op::asin:
      return Ball::Access::result(arb_asin, a);
    case Op::acos:
      return Ball::Access::result(arb_acos, a);
    case Op::atan:
      return Ball::Access::result(arb_atan, a);
    case Op::sinh:
      return Ball::Access::result(arb_sinh, a);
    case Op::cosh:
      return Ball::Access::result(arb_cosh, a);
    case Op::tanh:
      return Ball::Access::result(arb_tanh, a);
    default:
      return std::numeric_limits<double>::quiet_NaN();
  }
}

Ball pow(const Ball& a, const Ball& p) { return Ball::Access::result(arb_pow, a, p); }

Ball atan2(const Ball& y, const Ball& x) { return Ball::Access::result(arb_atan2, y, x); }

}  // namespace courant
