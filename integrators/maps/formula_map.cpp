#include "courant/integrators/maps/formula_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/words/message.hpp"

namespace courant {
namespace {

constexpr int kFormulaPoints = 4;
// Of formulas that hold; with a derivative, or an inverse, between.
constexpr double kFormulaExact = 1e-12, kFormulaNear = 1e-9;

double relative_to(const VectorXd& difference, const VectorXd& size) {
  const double result = difference.norm() / (1.0 + size.norm());
  return std::isfinite(result) ? result : std::numeric_limits<double>::infinity();
}

}  // namespace

FormulaMap::FormulaMap(std::shared_ptr<const Manifold> manifold, Formulas formulas)
    : DiscretizationMap("FormulaMap", std::move(manifold)), formulas_(std::move(formulas)) {
  if (!formulas_.minus || !formulas_.plus || !formulas_.point != !formulas_.vector)
    throw std::invalid_argument(
        "FormulaMap::FormulaMap: a function is missing; expected minus and plus, and of point and "
        "vector both or none.");
  std::mt19937 generator(1);
  const VectorXd first = this->manifold()->random_point(generator);
  measure(first, generator);
  for (int point = 1; point < kFormulaPoints; ++point)
    measure(this->manifold()->random_point(generator), generator);
}

void FormulaMap::measure(const VectorXd& x, std::mt19937& generator) {
  const Manifold& M = *manifold();
  if (M.dimension() == 0) return;
  const double length = 0.1 * std::min(1.0, M.injectivity_radius(x));
  const VectorXd w = M.random_tangent(x, 1.0, generator), v = length * w;
  const VectorXd zero = VectorXd::Zero(v.size());
  const auto refuse = [&](const std::string& what, double defect) {
    throw std::domain_error("FormulaMap::FormulaMap: " + what + " is off by " +
                            number_text(defect) + " at a random point; expected 0.");
  };

  const auto at_zero = forward(x, zero), there = forward(x, v);
  const double D1 = std::max(relative_to(at_zero.first - x, x), relative_to(at_zero.second - x, x));
  if (!(D1 <= kFormulaExact)) refuse("R_d(x, 0) = (x, x), law D1,", D1);
  const double off = std::max(M.point_defect(there.first), M.point_defect(there.second));
  if (!(off <= kFormulaNear * (1.0 + x.squaredNorm())))
    refuse("what should lead to " + M.name(), off);

  Graph graph;
  const ExprVector s = graph.variables("s", 1);
  const auto along = forward(constants(x), ExprVector(s[0] * constants(w)));
  const auto rate = [&](const ExprVector& curve) {
    const ExprVector d = tangent(curve, s, ExprVector::Ones(1));
    return VectorXd(M.coframe(x) * values(substitute(d, s, ExprVector::Zero(1))));
  };
  const VectorXd back = -rate(along.first), ahead = rate(along.second);
  const double D2 = relative_to(ahead + back - w, w);
  if (!(D2 <= kFormulaNear)) refuse("d/ds (R⁺ - R⁻)(x, s v) = v at s = 0, law D2,", D2);

  const double theta = back.dot(w) / w.squaredNorm();
  if (!(relative_to(back - theta * w, w) <= kFormulaNear))
    refuse("d/ds R⁻(x, s v) = -θ v at s = 0 with a number θ", relative_to(back - theta * w, w));
  stage_time_ = std::abs(theta - 0.5) <= kFormulaNear ? 0.5 : theta;
  const auto mirrored = forward(x, VectorXd(-v));
  is_symmetric_ = is_symmetric_ && relative_to(mirrored.first - there.second, x) <= kFormulaExact &&
                  relative_to(mirrored.second - there.first, x) <= kFormulaExact;

  if (!formulas_.point) return;
  const auto found = inverse(there.first, there.second);
  const double D3 = std::max(relative_to(found.x - x, x), relative_to(found.v - v, v));
  if (!(D3 <= kFormulaNear)) refuse("the inverse of R_d(x, v), law D3,", D3);
}

DiscretizationMap::PointPair<Expr> FormulaMap::do_forward(const ExprVector& x,
                                                          const ExprVector& v) const {
  return {formulas_.minus(x, v), formulas_.plus(x, v)};
}

DiscretizationMap::TangentVector<Expr> FormulaMap::do_inverse(const ExprVector& x0,
                                                              const ExprVector& x1) const {
  return {formulas_.point(x0, x1), formulas_.vector(x0, x1)};
}

}  // namespace courant
