#include "courant/integrators/certificate/refined_array.hpp"

#include <cmath>

#include "courant/core/linear/complete_orthogonal_decomposition.hpp"

namespace courant {

RefinedArray::RefinedArray(const DerivativeArray& array, Index size)
    : Prolongation(array.base_size(), array.auxiliary_size(), array.equation_count()),
      array_(&array),
      correction_(static_cast<std::size_t>(size), Quadruple(0.0)),
      rounded_(VectorXd::Zero(size)) {}

std::optional<RefinedArray> RefinedArray::at(const DerivativeArray& array, const Zero& zero) {
  constexpr Index dense_limit = 200;
  constexpr int most_steps = 6;
  constexpr double negligible = 2e-12;  // singular values, of the largest
  constexpr double solved = 10.0;       // times the bound of rounding errors
  if (!zero.found || zero.y.size() > dense_limit) return std::nullopt;
  RefinedArray result(array, zero.y.size());
  const GenericScaling units(array, zero.y, zero.nominal);
  if (!units.scaled.coeffs().isFinite().all()) return std::nullopt;
  const CompleteOrthogonalDecomposition inverse(MatrixXd(units.scaled), negligible);
  for (int step = 0; step < most_steps; ++step) {
    const Linearization at = result.linearize(zero.y, zero.uncertainty);
    if (!is_finite(at)) return std::nullopt;
    const VectorXd delta = units.column_scale.cwiseProduct(
        VectorXd(inverse.solve(units.row_scale.cwiseProduct(at.value))));
    const bool is_solved = (at.value.cwiseAbs().array() <= solved * at.value_error.array()).all();
    if (is_solved) {
      result.rounded_ = result.rounded_.cwiseMax(Quadruple::finer * delta.cwiseAbs());
      return result;
    }
    for (Index j = 0; j < delta.size(); ++j) {
      Quadruple& correction = result.correction_[static_cast<std::size_t>(j)];
      correction -= delta[j];
      // A small integer, which doubles do not round, is none any more.
      if (delta[j] != 0.0)
        result.rounded_[j] = std::max(std::fabs(static_cast<double>(correction)),
                                      Uncertain::unit * std::fabs(zero.y[j]));
    }
  }
  return std::nullopt;
}

VectorXd RefinedArray::correction() const {
  VectorXd result(std::ssize(correction_));
  for (Index j = 0; j < result.size(); ++j)
    result[j] = static_cast<double>(correction_[static_cast<std::size_t>(j)]);
  return result;
}

std::vector<Quadruple> RefinedArray::refined(const VectorXd& y) const {
  std::vector<Quadruple> result(correction_.begin(), correction_.begin() + y.size());
  for (Index j = 0; j < y.size(); ++j) result[static_cast<std::size_t>(j)] += y[j];
  return result;
}

Linearization RefinedArray::do_linearize(const VectorXd& y, const VectorXd& uncertainty,
                                         Index /*k*/) const {
  Linearization at = array_->linearize(refined(y));
  const Linearization rough = array_->linearize(y, uncertainty.cwiseMax(rounded_.head(y.size())));
  at.value_error =
      rough.value_error / Quadruple::finer + Uncertain::unit * VectorXd(at.value.cwiseAbs());
  at.error =
      rough.error / Quadruple::finer + Uncertain::unit * SparseMatrixXd(at.jacobian.cwiseAbs());
  at.jacobian.prune(
      [&](Index i, Index j, double entry) { return std::fabs(entry) > at.error.coeff(i, j); });
  return at;
}

VectorXd RefinedArray::do_residual(const VectorXd& y, Index /*k*/) const {
  return array_->linearize(refined(y)).value;
}

}  // namespace courant
