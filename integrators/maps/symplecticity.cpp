#include "courant/integrators/maps/symplecticity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"

namespace courant {
namespace {

constexpr Index kMostPairs = 16;

// Block i of four equal ones.
auto block(const ExprVector& z, Index i) { return z.segment(i * (z.size() / 4), z.size() / 4); }

// dz_i ∧ dz_j on the tangent vectors a and b.
Expr wedge(Index i, Index j, const ExprVector& a, const ExprVector& b) {
  return block(a, i).dot(block(b, j)) - block(b, i).dot(block(a, j));
}

// ι(q, p) = (q, C(q)ᵀ p), as a vector.
ExprVector embedded(const CotangentBundle& phase_space, const ExprVector& x) {
  const ExprVector q = phase_space.position(x);
  return joined(q, phase_space.base()->coframe(q).transpose() * phase_space.momentum(x));
}

// Tι at the tangent vector v: (q, P, q̇, Ṗ).
ExprVector embedded(const CotangentBundle& phase_space, const ExprVector& x, const ExprVector& v) {
  Graph graph;
  const ExprVector at = graph.variables("x", x.size());
  const ExprVector direction = graph.variables("dx", x.size());
  const ExprVector velocity = tangent(embedded(phase_space, at), at, direction);
  return joined(embedded(phase_space, x),
                substitute(velocity, joined(at, direction), joined(x, phase_space.frame(x) * v)));
}

// d_Tω = dq ∧ dṖ + dq̇ ∧ dP on (q, P, q̇, Ṗ).
Expr tangent_form(const ExprVector& a, const ExprVector& b) {
  return wedge(0, 3, a, b) + wedge(2, 1, a, b);
}

// Ω₁₂ = dq₁ ∧ dP₁ - dq₀ ∧ dP₀ on (q₀, P₀, q₁, P₁).
Expr difference_form(const ExprVector& a, const ExprVector& b) {
  return wedge(2, 3, a, b) - wedge(0, 1, a, b);
}

std::shared_ptr<const CotangentBundle> phase_space_of(const DiscretizationMap& map) {
  auto result = std::dynamic_pointer_cast<const CotangentBundle>(map.manifold());
  if (!result)
    throw std::invalid_argument("Symplecticity::Symplecticity: map " + map.name() + " lives on " +
                                map.manifold()->name() + "; expected a CotangentBundle.");
  return result;
}

// The two forms on two directions in R^{2d}, traced in charts: `chart` makes (embedded tangent
// vector, embedded pair of points) of (first, second, chart coordinates at first, at second).
template <class Chart>
Function trace(const std::string& name, const CotangentBundle& phase_space, Index second_size,
               const Chart& chart) {
  const Index size = phase_space.tangent_dimension();
  const Index d = phase_space.dimension();
  Graph graph;
  const ExprVector first = graph.variables("first", phase_space.ambient_dimension());
  const ExprVector second = graph.variables("second", second_size);
  const ExprVector bases = graph.variables("bases", 2 * size * d);
  const ExprVector y = graph.variables("y", 2 * d);
  const ExprVector a = graph.variables("a", 2 * d);
  const ExprVector b = graph.variables("b", 2 * d);
  const ExprMatrix first_basis = bases.head(size * d).reshaped(size, d);
  const ExprMatrix second_basis = bases.tail(size * d).reshaped(size, d);
  const auto [vector, pair] =
      chart(first, second, first_basis * y.head(d), second_basis * y.tail(d));
  ExprVector forms(2);
  forms << tangent_form(tangent(vector, y, a), tangent(vector, y, b)),
      difference_form(tangent(pair, y, a), tangent(pair, y, b));
  return Function(
      name, {{"first", first}, {"second", second}, {"bases", bases}, {"y", y}, {"a", a}, {"b", b}},
      forms);
}

}  // namespace

Symplecticity::Symplecticity(const DiscretizationMap& map) : phase_space_(phase_space_of(map)) {
  const CotangentBundle& M = *phase_space_;
  const auto both = [&](const ExprVector& x0, const ExprVector& x1) {
    return joined(embedded(M, x0), embedded(M, x1));
  };
  forward_ = trace("forward", M, M.tangent_dimension(),
                   [&](const ExprVector& x, const ExprVector& v, const ExprVector& along,
                       const ExprVector& across) {
                     const ExprVector moved = M.retract(x, along);
                     const ExprVector velocity = M.tangent_projector(moved) * (v + across);
                     const auto [x0, x1] = map.forward(moved, velocity);
                     return std::pair{embedded(M, moved, velocity), both(x0, x1)};
                   });
  if (map.has_inverse())
    inverse_ = trace("inverse", M, M.ambient_dimension(),
                     [&](const ExprVector& x0, const ExprVector& x1, const ExprVector& along,
                         const ExprVector& across) {
                       const ExprVector moved0 = M.retract(x0, along);
                       const ExprVector moved1 = M.retract(x1, across);
                       const auto [x, v] = map.inverse(moved0, moved1);
                       return std::pair{embedded(M, x, v), both(moved0, moved1)};
                     });
}

double Symplecticity::measure(const Function& forms, const VectorXd& first, const VectorXd& second,
                              const VectorXd& second_base, std::mt19937& generator) const {
  const Index d = phase_space_->dimension();
  MatrixXd bases(phase_space_->tangent_dimension(), 2 * d);
  bases << phase_space_->tangent_basis(first).matrix(),
      phase_space_->tangent_basis(second_base).matrix();
  std::normal_distribution<double> normal;
  double worst = 0.0;
  // A form that differs does so on nearly every pair of random directions, so a few pairs tell as much as all.
  const Index pairs = std::min<Index>(2 * d, kMostPairs);
  for (Index pair = 0; pair < pairs; ++pair) {
    const MatrixXd directions = MatrixXd::NullaryExpr(2 * d, 2, [&] { return normal(generator); });
    const VectorXd values = forms({first, second, bases.reshaped(), VectorXd::Zero(2 * d),
                                   directions.col(0).normalized(), directions.col(1).normalized()});
    const double defect = std::abs(values[0] - values[1]) / (1.0 + std::abs(values[0]));
    if (!std::isfinite(defect)) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, defect);
  }
  return worst;
}

double Symplecticity::defect(const VectorXd& x, const VectorXd& v, std::mt19937& generator) const {
  return measure(forward_, x, v, x, generator);
}

double Symplecticity::inverse_defect(const VectorXd& x0, const VectorXd& x1,
                                     std::mt19937& generator) const {
  return measure(inverse_, x0, x1, x1, generator);
}

}  // namespace courant
