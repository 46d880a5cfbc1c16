#include "courant/integrators/methods/discrete_differential.hpp"

#include <array>
#include <utility>

#include "courant/core/algebra/divided_difference.hpp"
#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"

namespace courant {
namespace {

// Points and weights of Gauss's rule with four points on [0, 1].
constexpr std::array<std::pair<double, double>, 4> kGauss = {{
    {0.06943184420297371, 0.17392742256872693},
    {0.33000947820757187, 0.32607257743127307},
    {0.66999052179242813, 0.32607257743127307},
    {0.93056815579702629, 0.17392742256872693},
}};

// Displacements shorter than this, in units, are none: the squares of their squares, by which
// derivatives of a quotient are divided, would have no digits.
constexpr double kShortestDifference = 1e-75;

Expr difference_of(const EnergyDifference& f) { return f.end - f.start; }

ExprVector at(const ExprVector& value, const EnergyDifference& f, const ExprVector& w) {
  return substitute(value, f.w, w);
}

// α + c G v with ⟨·, v⟩ = Ê(v). What is to be corrected is of third order in v, and is known to
// round-off of first order: of α it changes no digit.
ExprVector corrected(const ExprVector& alpha, const EnergyDifference& f, const VectorXd& units) {
  const Index n = f.v.size();
  const ExprVector zero = ExprVector::Zero(n);
  const Expr exact =
      at(divided_difference(ExprVector::Constant(1, difference_of(f)), f.w, f.v, 1.0), f, zero)[0];
  const ExprVector in_units = f.v.cwiseQuotient(constants(units));
  const Expr size = in_units.squaredNorm();
  const Expr missing = exact - alpha.cwiseProduct(f.v).sum();
  const Expr c = select(size > kShortestDifference * kShortestDifference, missing / size, 0.0);
  return alpha + c * in_units.cwiseQuotient(constants(units));
}

}  // namespace

ExprVector GonzalezDifferential::do_value(const EnergyDifference& f, const VectorXd& units) const {
  const ExprVector rate = gradient(difference_of(f), f.w);
  const ExprVector alpha = at(rate, f, ExprVector::Zero(f.w.size()));
  // Where Ê is linear, as of a quadratic E between the ends of the midpoint map, nothing is missing.
  return depends(rate, f.w) ? corrected(alpha, f, units) : alpha;
}

ExprVector AveragedDifferential::do_value(const EnergyDifference& f, const VectorXd& units) const {
  const ExprVector rate = gradient(difference_of(f), f.w);
  if (!depends(rate, f.w)) return at(rate, f, ExprVector::Zero(f.w.size()));
  ExprVector alpha = ExprVector::Zero(f.w.size());
  for (const auto& [s, weight] : kGauss)
    alpha += Expr(weight) * at(rate, f, ExprVector(Expr(s) * f.v));
  return corrected(alpha, f, units);
}

ExprVector ItohAbeDifferential::do_value(const EnergyDifference& f, const VectorXd&) const {
  const Index n = f.v.size();
  const ExprVector function = ExprVector::Constant(1, f.is_symmetric ? f.end : difference_of(f));
  const Expr length = f.is_symmetric ? 2.0 : 1.0;
  ExprVector alpha(n);
  for (Index i = 0; i < n; ++i) {
    ExprVector from = f.is_symmetric ? ExprVector(-f.v) : ExprVector(ExprVector::Zero(n));
    from.head(i) = f.v.head(i);
    ExprVector direction = ExprVector::Zero(n);
    direction[i] = 1.0;
    alpha[i] =
        length * at(divided_difference(function, f.w, direction, length * f.v[i]), f, from)[0];
  }
  return alpha;
}

}  // namespace courant
