#include "courant/core/algebra/divided_difference.hpp"

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/subgraph.hpp"

namespace courant {
namespace {

// Gauss's rule with eight points on [0, 1]: half the distance of the points from 1/2, and weights.
constexpr std::array<std::pair<double, double>, 4> kGauss = {{
    {0.0917173212478249, 0.1813418916891810},
    {0.2627662049581645, 0.1568533229389436},
    {0.3983332387068134, 0.1111905172266872},
    {0.4801449282487682, 0.0506142681451881},
}};

// A quantity at both ends, and its difference over s.
struct Ends {
  Expr first, last, slope;

  Expr mean() const { return 0.5 * (first + last); }
  bool is_fixed() const { return slope.is_constant(0.0); }
};

Ends ends_of_product(const Ends& a, const Ends& b) {
  return {a.first * b.first, a.last * b.last, a.slope * b.mean() + a.mean() * b.slope};
}

Ends quotient(const Ends& a, const Ends& b) {
  return {a.first / b.first, a.last / b.last,
          (a.slope * b.mean() - a.mean() * b.slope) / (b.first * b.last)};
}

class DividedDifference {
 public:
  explicit DividedDifference(const Expr& step) : step_(step) {}

  Ends operator()(const Node& node, const Ends& a, const Ends& b, const Ends& c) const {
    const Ends plain{apply(node.op, node.k, a.first, b.first, c.first),
                     apply(node.op, node.k, a.last, b.last, c.last), 0.0};
    const auto with = [&](const Expr& slope) { return Ends{plain.first, plain.last, slope}; };
    const Expr change = step_ * a.slope, half = square(0.5 * change);
    switch (node.op) {
      case Op::negate:
        return with(-a.slope);
      case Op::add:
        return with(a.slope + b.slope);
      case Op::subtract:
        return with(a.slope - b.slope);
      case Op::multiply:
        return with(ends_of_product(a, b).slope);
      case Op::divide:
        return with(quotient(a, b).slope);
      case Op::sqrt:
        return with(a.slope / (plain.first + plain.last));
      case Op::exp:
        return with(near(half, exp(a.mean()) * stumpff(1, -half) * a.slope, plain));
      case Op::log:
        return with(logarithm(a));
      case Op::sin:
        return with(cos(a.mean()) * stumpff(1, half) * a.slope);
      case Op::cos:
        return with(-(sin(a.mean()) * stumpff(1, half) * a.slope));
      case Op::tan:
        return with(stumpff(1, square(change)) / (cos(a.first) * cos(a.last)) * a.slope);
      case Op::asin:
        return with(arc_sine(a));
      case Op::acos:
        return with(-arc_sine(a));
      case Op::atan:
        return with(angle(a, {1.0, 1.0, 0.0}, plain));
      case Op::sinh:
        return with(cosh(a.mean()) * stumpff(1, -half) * a.slope);
      case Op::cosh:
        return with(sinh(a.mean()) * stumpff(1, -half) * a.slope);
      case Op::tanh:
        return with(near(
            half, stumpff(1, -square(change)) / (cosh(a.first) * cosh(a.last)) * a.slope, plain));
      case Op::abs: {
        const Expr sum = plain.first + plain.last;
        return with(select(sum > 0.0, (a.first + a.last) / sum, 0.0) * a.slope);
      }
      case Op::power:
        return with(node.k > 0 ? power(a, node.k).slope
                               : quotient({1.0, 1.0, 0.0}, power(a, -node.k)).slope);
      case Op::pow:
        return with(general_power(a, b, plain));
      case Op::atan2:
        return with(angle(a, b, plain));
      case Op::min:
        return with(chosen({b.first < a.first, b.last < a.last, 0.0}, b, a, plain));
      case Op::max:
        return with(chosen({a.first < b.first, a.last < b.last, 0.0}, b, a, plain));
      case Op::select:
        return with(chosen(a, b, c, plain));
      case Op::stumpff:
        return with(near(half, averaged(node, a), plain));
      case Op::arccos_factor:
        return with(near(square(20.0 * change / (1.0 + a.mean())), averaged(node, a), plain));
      default:  // conditions and signs, which jump or do not change
        return with(jump(plain));
    }
  }

 private:
  Expr direct(const Ends& y) const { return (y.last - y.first) / step_; }
  Expr jump(const Ends& y) const { return select(equal(y.first, y.last), 0.0, direct(y)); }
  // What is right for small differences; large ones are right as they are.
  Expr near(const Expr& size, const Expr& smooth, const Ends& y) const {
    return select(size < 1.0, smooth, direct(y));
  }

  // θ/sinh θ with 2θ = log(a₁/a₀), cosh θ = mean(a)/√(a₀ a₁).
  Expr logarithm(const Ends& a) const {
    const Expr middle = sqrt(a.first) * sqrt(a.last);
    return arccos_factor(0, a.mean() / middle) / middle * a.slope;
  }

  // Of atan2(a, b): the angle from (b₀, a₀) to (b₁, a₁) has the tangent cross/dot.
  Expr angle(const Ends& a, const Ends& b, const Ends& y) const {
    const Expr cross = a.slope * b.mean() - a.mean() * b.slope;
    const Expr dot = a.first * a.last + b.first * b.last;
    const Expr tangent = cross / dot, length = sqrt(1.0 + square(step_ * tangent));
    // The mean point is nearer to the origin than the ends where the angle is wide.
    return select(square(step_ * cross) < square(dot),
                  select(dot > 0.0, tangent * arccos_factor(0, 1.0 / length) / length, direct(y)),
                  direct(y));
  }

  // asin a = atan2(a, √(1 - a²)).
  Expr arc_sine(const Ends& a) const {
    const Ends inner = ends_of_product({1.0 - a.first, 1.0 - a.last, -a.slope},
                                       {1.0 + a.first, 1.0 + a.last, a.slope});
    const Expr first = sqrt(inner.first), last = sqrt(inner.last);
    return angle(a, {first, last, inner.slope / (first + last)},
                 {asin(a.first), asin(a.last), 0.0});
  }

  static Ends power(const Ends& a, std::int32_t k) {
    if (k == 1) return a;
    const Ends half = power(a, k / 2);
    const Ends even = ends_of_product(half, half);
    return k % 2 == 0 ? even : ends_of_product(even, a);
  }

  // aᵇ = exp(b log a) for a > 0; elsewhere the plain difference, or the derivative.
  Expr general_power(const Ends& a, const Ends& b, const Ends& y) const {
    const Ends exponent = ends_of_product(b, {log(a.first), log(a.last), logarithm(a)});
    const Expr half = square(0.5 * step_ * exponent.slope);
    const Expr smooth = exp(exponent.mean()) * stumpff(1, -half) * exponent.slope;
    const Expr still = a.is_fixed() ? Expr(0.0) : b.first * pow(a.first, b.first - 1.0) * a.slope;
    return select(logical_and(a.first > 0.0, a.last > 0.0), near(half, smooth, y),
                  select(equal(step_ * a.slope, 0.0), still, direct(y)));
  }

  Expr chosen(const Ends& condition, const Ends& then, const Ends& otherwise, const Ends& y) const {
    const Expr both = logical_and(condition.first, condition.last);
    const Expr none = logical_and(logical_not(condition.first), logical_not(condition.last));
    return select(both, then.slope, select(none, otherwise.slope, direct(y)));
  }

  // ∫ f'(a₀ + τ Δa) dτ Δa / s by Gauss's rule.
  static Expr averaged(const Node& node, const Ends& a) {
    const Graph graph = a.mean().graph();
    const Expr argument = graph.variable("a");
    const ExprVector at = ExprVector::Constant(1, argument);
    const Expr rate = gradient(apply(node.op, node.k, argument, {}, {}), at)[0];
    Expr sum = 0.0;
    for (const auto& [distance, weight] : kGauss)
      for (const double sign : {-1.0, 1.0})
        sum += weight * substitute(rate, at,
                                   ExprVector::Constant(
                                       1, a.mean() + (sign * distance) * (a.last - a.first)));
    return sum * a.slope;
  }

  Expr step_;
};

}  // namespace

ExprVector divided_difference(const ExprVector& y, const ExprVector& x, const ExprVector& direction,
                              const Expr& step) {
  // The checks of x are those of tangent.
  tangent(ExprVector(0), x, direction);
  const Subgraph subgraph(y);
  std::vector<Ends> ends(subgraph.size());
  std::vector<bool> is_moving(subgraph.size(), false);
  for (Index i = 0; i < x.size(); ++i) {
    if (x[i].is_constant() || !subgraph.contains(x[i])) continue;
    const std::size_t at = subgraph.position(x[i]);
    if (is_moving[at])
      throw std::invalid_argument("divided_difference: x[" + std::to_string(i) + "] is " +
                                  to_string(x[i], 40) + " again; expected each variable once.");
    ends[at] = {x[i], x[i] + step * direction[i], direction[i]};
    is_moving[at] = true;
  }
  const DividedDifference difference(step);
  for (std::size_t at = 0; at < subgraph.size(); ++at) {
    if (is_moving[at]) continue;
    const Graph& graph = subgraph.graph();
    const Expr value = graph.expression(subgraph.nodes()[at]);
    ends[at] = {value, value, 0.0};
    const Node node = graph.node(subgraph.nodes()[at]);
    const std::uint32_t number[] = {node.a, node.b, node.c};
    Ends operand[3];
    bool moves = false;
    for (int i = 0; i < arity(node.op); ++i) {
      const std::size_t position = subgraph.position(number[i]);
      operand[i] = ends[position];
      moves = moves || is_moving[position];
    }
    if (!moves) continue;
    ends[at] = difference(node, operand[0], operand[1], operand[2]);
    is_moving[at] = true;
  }
  ExprVector result = ExprVector::Zero(y.size());
  for (Index i = 0; i < y.size(); ++i)
    if (!y[i].is_constant()) result[i] = ends[subgraph.position(y[i])].slope;
  return result;
}

}  // namespace courant
