#include "courant/core/expressions/expr.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "courant/core/numbers/operation.hpp"

namespace courant {
namespace {

const Graph& graph_of(const Expr& a, const Expr& b, const Expr& c) {
  if (!a.is_constant()) return a.graph();
  return b.is_constant() ? c.graph() : b.graph();
}

// The operation carried out if every operand is known, a node otherwise.
Expr make(Op op, const Expr& a, const Expr& b = {}, const Expr& c = {}, int k = 0) {
  const Graph& graph = graph_of(a, b, c);
  if (!graph.is_none()) return graph.make(op, k, a, b, c);
  return evaluate(op, k, a.value(), b.value(), c.value());
}

// The operation at the root of a, null for a constant.
const Node* node_of(const Expr& a) { return a.is_constant() ? nullptr : &a.graph().node(a.node()); }

bool is_negation(const Expr& a) {
  const Node* node = node_of(a);
  return node != nullptr && node->op == Op::negate;
}

// What is made of it is so too, whatever the other operand is.
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
bool is_nan(const Expr& a) { return a.is_constant() && std::isnan(a.value()); }

Expr negated(const Expr& a) { return a.graph().expression(node_of(a)->a); }

// 1 where a is not 0.
Expr truth(const Expr& a) {
  if (a.is_constant()) return a.value() != 0 ? 1.0 : 0.0;
  switch (node_of(a)->op) {
    case Op::less:
    case Op::less_equal:
    case Op::equal:
    case Op::logical_and:
    case Op::logical_or:
    case Op::logical_not:
      return a;
    default:
      return make(Op::logical_not, make(Op::logical_not, a));
  }
}

}  // namespace

double Expr::value() const {
  if (!is_constant())
    throw std::logic_error("Expr::value: " + to_string(*this, 60) +
                           " depends on a variable; expected a constant.");
  return constant_;
}

Expr& Expr::operator+=(const Expr& other) { return *this = *this + other; }
Expr& Expr::operator-=(const Expr& other) { return *this = *this - other; }
Expr& Expr::operator*=(const Expr& other) { return *this = *this * other; }
Expr& Expr::operator/=(const Expr& other) { return *this = *this / other; }

Expr operator-(const Expr& a) { return is_negation(a) ? negated(a) : make(Op::negate, a); }

Expr operator+(const Expr& a, const Expr& b) {
  if (is_nan(a) || is_nan(b)) return not_a_number;
  if (a.is_constant(0.0)) return b;
  if (b.is_constant(0.0)) return a;
  if (is_negation(b)) return a - negated(b);
  if (is_negation(a)) return b - negated(a);
  return make(Op::add, a, b);
}

Expr operator-(const Expr& a, const Expr& b) {
  if (is_nan(a) || is_nan(b)) return not_a_number;
  if (b.is_constant(0.0)) return a;
  if (a.is_constant(0.0)) return -b;
  if (!a.is_constant() && a == b) return 0.0;
  if (is_negation(b)) return a + negated(b);
  if (is_negation(a)) return -(negated(a) + b);
  return make(Op::subtract, a, b);
}

Expr operator*(const Expr& a, const Expr& b) {
  if (is_nan(a) || is_nan(b)) return not_a_number;
  if (a.is_constant(1.0)) return b;
  if (b.is_constant(1.0)) return a;
  if (a.is_constant(0.0) && !b.is_constant()) return 0.0;
  if (b.is_constant(0.0) && !a.is_constant()) return 0.0;
  if (a.is_constant(-1.0)) return -b;
  if (b.is_constant(-1.0)) return -a;
  if (is_negation(a)) return -(negated(a) * b);
  if (is_negation(b)) return -(a * negated(b));
  return make(Op::multiply, a, b);
}

Expr operator/(const Expr& a, const Expr& b) {
  if (is_nan(a) || is_nan(b)) return not_a_number;
  if (b.is_constant(1.0)) return a;
  if (b.is_constant(-1.0)) return -a;
  if (a.is_constant(0.0) && !b.is_constant()) return 0.0;
  if (is_negation(a)) return -(negated(a) / b);
  if (is_negation(b)) return -(a / negated(b));
  return make(Op::divide, a, b);
}

Expr sqrt(const Expr& a) { return make(Op::sqrt, a); }
Expr exp(const Expr& a) { return make(Op::exp, a); }
Expr log(const Expr& a) { return make(Op::log, a); }
Expr sin(const Expr& a) { return make(Op::sin, a); }
Expr cos(const Expr& a) { return make(Op::cos, a); }
Expr tan(const Expr& a) { return make(Op::tan, a); }
Expr asin(const Expr& a) { return make(Op::asin, a); }
Expr acos(const Expr& a) { return make(Op::acos, a); }
Expr atan(const Expr& a) { return make(Op::atan, a); }
Expr sinh(const Expr& a) { return make(Op::sinh, a); }
Expr cosh(const Expr& a) { return make(Op::cosh, a); }
Expr tanh(const Expr& a) { return make(Op::tanh, a); }
Expr abs(const Expr& a) { return make(Op::abs, a); }
Expr sign(const Expr& a) { return make(Op::sign, a); }

Expr pow(const Expr& a, int k) {
  if (k == 0) return 1.0;
  if (k == 1) return a;
  if (k == 2) return a * a;
  return make(Op::power, a, {}, {}, k);
}

Expr pow(const Expr& a, const Expr& b) {
  if (b.is_constant()) {
    const double exponent = b.value();
    if (exponent == std::floor(exponent) && std::fabs(exponent) <= 1e6)
      return pow(a, static_cast<int>(exponent));
    if (exponent == 0.5) return sqrt(a);
  }
  return make(Op::pow, a, b);
}

Expr square(const Expr& a) { return a * a; }
Expr atan2(const Expr& y, const Expr& x) { return make(Op::atan2, y, x); }
Expr min(const Expr& a, const Expr& b) { return make(Op::min, a, b); }
Expr max(const Expr& a, const Expr& b) { return make(Op::max, a, b); }
Expr stumpff(int k, const Expr& s) { return make(Op::stumpff, s, {}, {}, k); }
Expr arccos_factor(int k, const Expr& c) { return make(Op::arccos_factor, c, {}, {}, k); }

Expr operator<(const Expr& a, const Expr& b) { return make(Op::less, a, b); }
Expr operator<=(const Expr& a, const Expr& b) { return make(Op::less_equal, a, b); }
Expr operator>(const Expr& a, const Expr& b) { return b < a; }
Expr operator>=(const Expr& a, const Expr& b) { return b <= a; }
Expr equal(const Expr& a, const Expr& b) { return make(Op::equal, a, b); }

Expr logical_and(const Expr& a, const Expr& b) {
  if (a.is_constant()) return a.value() != 0 ? truth(b) : 0.0;
  if (b.is_constant()) return logical_and(b, a);
  return a == b ? truth(a) : make(Op::logical_and, a, b);
}

Expr logical_or(const Expr& a, const Expr& b) {
  if (a.is_constant()) return a.value() != 0 ? 1.0 : truth(b);
  if (b.is_constant()) return logical_or(b, a);
  return a == b ? truth(a) : make(Op::logical_or, a, b);
}

Expr logical_not(const Expr& a) {
  const Node* node = node_of(a);
  if (node == nullptr || node->op != Op::logical_not) return make(Op::logical_not, a);
  return truth(a.graph().expression(node->a));
}

Expr select(const Expr& condition, const Expr& then, const Expr& otherwise) {
  if (condition.is_constant()) return condition.value() != 0 ? then : otherwise;
  if (then == otherwise) return then;
  return make(Op::select, condition, then, otherwise);
}

bool operator==(const Expr& a, const Expr& b) {
  if (!(a.graph() == b.graph())) return false;
  return a.is_constant() ? a.value() == b.value() : a.node() == b.node();
}

Expr apply(Op op, std::int32_t k, const Expr& a, const Expr& b, const Expr& c) {
  switch (op) {
    case Op::negate:
      return -a;
    case Op::add:
      return a + b;
    case Op::subtract:
      return a - b;
    case Op::multiply:
      return a * b;
    case Op::divide:
      return a / b;
    case Op::power:
      return pow(a, k);
    case Op::pow:
      return pow(a, b);
    case Op::select:
      return select(a, b, c);
    case Op::constant:
    case Op::variable:
      throw std::invalid_argument("apply: op is a constant or a variable; expected an operation.");
    case Op::logical_and:
      return logical_and(a, b);
    case Op::logical_or:
      return logical_or(a, b);
    case Op::logical_not:
      return logical_not(a);
    default:
      return make(op, a, b, c, k);
  }
}

}  // namespace courant
