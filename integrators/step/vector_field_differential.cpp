#include "courant/integrators/step/vector_field_differential.hpp"

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/linear/equilibration.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"
#include "courant/integrators/step/step_differential.hpp"

namespace courant {
namespace {

// What an evaluation is solved to, next to the entries of its Jacobian.
constexpr double kEvaluatedTo = 1e-12;

}  // namespace

VectorFieldDifferential::VectorFieldDifferential(const VectorFieldFormulas& formulas)
    : system_(formulas.system) {
  const Manifold& M = *system_->manifold();
  const ExprVector &x = formulas.inputs[1].variables, &entries = formulas.inputs[2].variables;
  // The basis at x + δx is Π(x + δx) B.
  const auto turning = [&](const ExprVector& formula) {
    if (entries.size() == 0) return formula;
    const LinearMap<Expr> basis =
        ExprMatrix(entries.reshaped(M.tangent_dimension(), M.dimension()));
    return substitute(formula, entries,
                      ExprVector((M.tangent_projector(x) * basis).entries().reshaped()));
  };
  const auto traced = [&](const char* name, const ExprVector& formula) {
    return Function(name, formulas.inputs, turning(formula), {.differentiate = {"y", "x"}});
  };
  equations_ = traced("vector field", formulas.equations);
  rate_ = traced("rate", formulas.rate);
  all_ = traced("equations of S_f", formulas.all);
}

VectorFieldDifferential::Images VectorFieldDifferential::operator()(const Place& at,
                                                                    const MatrixXd& V) const {
  const VectorXd entries = at.basis.entries().reshaped(), t = VectorXd::Constant(1, at.t);
  const Index unknowns = at.unknowns.size(), N = at.x.size();
  const MatrixXd G = equations_.jacobian({at.unknowns, at.x, entries, t});
  const MatrixXd r = rate_.jacobian({at.unknowns, at.x, entries, t});
  const MatrixXd change = implicit_derivative("VectorFieldDifferential", G.leftCols(unknowns),
                                              G.rightCols(N) * V, system_->manifold()->dimension());
  const MatrixXd images = r.rightCols(N) * V + r.leftCols(unknowns) * change;
  const Index n = system_->manifold()->tangent_dimension();
  return {images.topRows(N), images.middleRows(N, n), images.bottomRows(images.rows() - N - n)};
}

std::pair<MatrixXd, MatrixXd> VectorFieldDifferential::split(const Place& at,
                                                             Index codimension) const {
  const Manifold& M = *system_->manifold();
  const Index n = M.dimension(), unknowns = at.unknowns.size();
  if (codimension == 0) return {MatrixXd::Identity(n, n), MatrixXd(n, 0)};
  const MatrixXd J = all_.jacobian(
      {at.unknowns, at.x, at.basis.entries().reshaped(), VectorXd::Constant(1, at.t)});
  const MatrixXd along = J.rightCols(at.x.size()) * (M.frame(at.x) * at.basis).matrix();
  // The combinations of the equations that no change of y can keep.
  const MatrixXd left =
      FundamentalSubspaces(J.leftCols(unknowns), {.data_error = kEvaluatedTo}).left_kernel();
  MatrixXd seen = left.transpose() * along;
  const MatrixXd all = singular_value_decomposition(seen).V.rowwise().reverse();
  return {all.leftCols(n - codimension), all.rightCols(codimension)};
}

}  // namespace courant
