#include "courant/integrators/certificate/constraint_classes.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/linear/solver_choice.hpp"
#include "courant/core/linear/sparse_rank_decision.hpp"
#include "courant/core/linear/uncertain_rank.hpp"
#include "courant/core/numbers/uncertain.hpp"
#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/dirac_system.hpp"

namespace courant {
namespace {

using UncertainDense = Eigen::Matrix<Uncertain, Eigen::Dynamic, Eigen::Dynamic>;

// As decide_rank wants it: what is within its error is no entry.
UncertainMatrix sparse(const UncertainDense& A) {
  MatrixXd value(A.rows(), A.cols()), error(A.rows(), A.cols());
  for (Index i = 0; i < A.rows(); ++i)
    for (Index j = 0; j < A.cols(); ++j) {
      value(i, j) = A(i, j).is_nonzero() ? A(i, j).value : 0.0;
      error(i, j) = A(i, j).error;
    }
  return {value.sparseView(0.0, 0.0), error.sparseView(0.0, 0.0)};
}

// A matrix that was computed from the equations of a structure. Zeros and numbers like ±1, ½ are
// what the equations say; other entries have the rounding of DiracStructure.
UncertainDense with_errors(const MatrixXd& A) {
  UncertainDense result(A.rows(), A.cols());
  if (A.size() == 0) return result;
  const VectorXd of_row = A.cwiseAbs().rowwise().maxCoeff();
  const VectorXd of_column = A.cwiseAbs().colwise().maxCoeff();
  for (Index i = 0; i < A.rows(); ++i)
    for (Index j = 0; j < A.cols(); ++j) {
      const double size = std::min(of_row[i], of_column[j]);
      const bool exact = Uncertain::rounded(A(i, j)).error == 0.0;
      result(i, j) = {A(i, j), exact ? 0.0 : DiracStructure::rounding.data_error * size};
    }
  return result;
}

UncertainDense product(const UncertainDense& A, const UncertainDense& B) {
  UncertainDense result = UncertainDense::Constant(A.rows(), B.cols(), Uncertain(0.0));
  for (Index i = 0; i < A.rows(); ++i)
    for (Index k = 0; k < A.cols(); ++k) {
      if (A(i, k).is_exactly(0.0)) continue;
      for (Index j = 0; j < B.cols(); ++j) result(i, j) += A(i, k) * B(k, j);
    }
  return result;
}

// -A⁻¹ B, where A is regular and most of its entries are missing.
MatrixXd sparse_quotient(const SparseMatrixXd& A, const MatrixXd& B) {
  MatrixPattern pattern{A.rows(), A.cols(), {}, {}};
  for (Index j = 0; j < A.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(A, j); it; ++it) {
      pattern.row.push_back(it.row());
      pattern.column.push_back(j);
    }
  const std::unique_ptr<LinearSolver> solver = linear_solver(pattern);
  MatrixXd X(A.cols(), B.cols());
  if (!solver->factorize(A.valuePtr())) return X.setConstant(std::nan(""));
  for (Index j = 0; j < B.cols(); ++j) solver->solve(B.col(j).data(), X.col(j).data());
  return -X;
}

// ♯ of the graph of a bivector: v = Λα, or ♭ of the graph of a two-form: α = ω♭ v.
struct Maps {
  std::optional<MatrixXd> bivector, form;
};

Maps maps_at(const DiracStructure& structure, const VectorXd& x) {
  // F v + E α + P u = 0. Without port variables one of the two is solved for as it stands.
  const DiracStructure::Matrices D = structure.matrices(x);
  const Index n = D.F.cols();
  Maps result;
  if (D.P.cols() == 0 && D.F.rows() == n) {
    const auto solve = [&](const MatrixXd& A, const MatrixXd& B) -> std::optional<MatrixXd> {
      constexpr Index dense = 200;  // singular values of larger ones take seconds
      if (n <= dense) {
        if (decide_rank(A, DiracStructure::rounding).rank < n) return std::nullopt;
        return MatrixXd(-LuDecomposition(A).solve(B));
      }
      const SparseMatrixXd sparse = A.sparseView();
      if (decide_rank(sparse, DiracStructure::rounding).rank < n) return std::nullopt;
      return sparse_quotient(sparse, B);
    };
    result.bivector = solve(D.F, D.E);
    if (!result.bivector) result.form = solve(D.E, D.F);
    return result;
  }
  const LinearDirac fibre = structure.linear(x);
  if (const BivectorOnSubspace pair = fibre.bivector(); pair.F.cols() == n)
    result.bivector = pair.F * pair.lambda * pair.F.transpose();
  else if (const FormOnSubspace form = fibre.form(); form.F.cols() == n)
    result.form = form.F * form.omega.transpose() * form.F.transpose();
  return result;
}

// The gradients as rows, in the orthonormal basis of the structure.
UncertainDense gradients(const ConstraintLadder& ladder, const MatrixXd& basis) {
  UncertainDense C(static_cast<Index>(ladder.constraints.size()), basis.cols());
  for (Index a = 0; a < C.rows(); ++a) {
    const PointConstraint& constraint = ladder.constraints[static_cast<std::size_t>(a)];
    for (Index j = 0; j < basis.cols(); ++j) {
      Uncertain sum;
      for (Index i = 0; i < basis.rows(); ++i)
        sum += Uncertain(constraint.gradient[i], constraint.gradient_error[i]) *
               Uncertain::rounded(basis(i, j));
      C(a, j) = sum;
    }
  }
  return C;
}

// [ω♭ Cᵀ; C 0], of rank 2c + the rank of ω on the common kernel of the c rows of C.
UncertainDense bordered(const UncertainDense& form, const UncertainDense& C) {
  const Index n = form.rows(), c = C.rows();
  UncertainDense A = UncertainDense::Constant(n + c, n + c, Uncertain(0.0));
  A.topLeftCorner(n, n) = form;
  A.topRightCorner(n, c) = C.transpose();
  A.bottomLeftCorner(c, n) = C;
  return A;
}

}  // namespace

bool ConstraintClasses::is_ambiguous() const {
  return std::ranges::any_of(decisions, [](const RankDecision& d) { return d.ambiguous(); });
}

std::optional<ConstraintClasses> constraint_classes(const ImplicitSystem& system,
                                                    const ConstraintLadder& ladder) {
  const auto structure = system.structure();
  if (!structure || ladder.index < 0) return std::nullopt;
  // Reactions of constraints on velocities are no vector fields of functions.
  const auto* dirac = dynamic_cast<const DiracSystem*>(&system);
  if (dirac && dirac->exterior().constraint) return std::nullopt;
  // Nothing to classify where equations without ports leave all of M: there D is a graph. The structures of large
  // systems are not written down as matrices for that.
  if (ladder.constraints.empty() && ladder.gauge_dimension == 0 && structure->port_size() == 0) {
    ConstraintClasses none;
    none.degrees_of_freedom_up_to_gauge = ladder.degrees_of_freedom;
    none.brackets = ConstraintClasses::Brackets();
    return none;
  }
  const VectorXd& x = ladder.point.x;
  const Maps maps = maps_at(*structure, x);
  if (!maps.bivector && !maps.form) return std::nullopt;

  ConstraintClasses result;
  const auto rank = [&](const UncertainDense& A) {
    result.decisions.push_back(decide_rank(sparse(A)));
    return result.decisions.back().rank;
  };
  const UncertainDense C = gradients(ladder, system.manifold()->tangent_basis(x));
  const Index all = C.rows();
  for (const PointConstraint& constraint : ladder.constraints)
    ++(constraint.level == 0 ? result.primary : result.secondary);
  const Index dim_M = ladder.degrees_of_freedom;
  if (!maps.bivector) {
    result.degrees_of_freedom_up_to_gauge = rank(bordered(with_errors(*maps.form), C)) - 2 * all;
    return result;
  }
  const UncertainDense fields = product(with_errors(*maps.bivector), C.transpose());
  UncertainDense brackets = product(C, fields), of_primary(result.primary, all);
  for (Index a = 0, row = 0; a < all; ++a) {
    brackets(a, a) = Uncertain(0.0);
    if (ladder.constraints[static_cast<std::size_t>(a)].level == 0)
      of_primary.row(row++) = brackets.row(a);
  }
  ConstraintClasses::Brackets& classes = *(result.brackets = ConstraintClasses::Brackets());
  classes.second_class = rank(brackets);
  classes.first_class = all - classes.second_class;
  classes.primary_first_class = result.primary - rank(of_primary);
  // A constraint whose field vanishes (a Casimir) is first class and moves nothing.
  result.degrees_of_freedom_up_to_gauge = dim_M - (rank(fields) - classes.second_class);
  return result;
}

}  // namespace courant
