#include "courant/integrators/step/step_differential.hpp"

#include <stdexcept>
#include <string>

#include "courant/core/linear/equilibration.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/words/message.hpp"

namespace courant {
namespace {

// Entries of a Jacobian that stand for 0, next to the largest of their row and column.
constexpr double kNoiseOfJacobians = 1e-15;
// The pivot ratio above which a square matrix counts as regular without a look at its rank: the solution
// keeps six digits at worst, and below it the singular values decide.
constexpr double kRegular = 1e-9;
// The equations are solved to about so many digits.
constexpr double kSolvedTo = 1e-12;
constexpr double kConsistent = 1e-6;

// X with A X + B = 0 by `solve`, which is right to round-off of the largest numbers, improved so that each equation holds to
// round-off of its own terms. Where an entry that stands for 0 is a little more than noise, its row and column get
// scales that make a number as the others of it, and a solution that is 1 is one of 10⁻¹⁴ beside others of 1. Each
// improvement gains the digits that these lack, at worst one.
template <class Solve>
MatrixXd improved(const MatrixXd& A, const MatrixXd& B, const Solve& solve) {
  constexpr int improvements = 3;
  MatrixXd X = -solve(B);
  for (int i = 0; i < improvements; ++i) X -= solve(A * X + B);
  return X;
}

void require_determined(const char* place, const MatrixXd& free) {
  if (free.size() > 0 && free.cwiseAbs().maxCoeff() > kConsistent)
    throw std::domain_error(std::string(place) +
                            ": the end of the step is not determined by its beginning; expected "
                            "a system without gauge freedom.");
}

}  // namespace

MatrixXd StepDifferential::operator()(const Step& step, const MatrixXd& V) const {
  if (V.rows() != step.before.x.size())
    throw std::invalid_argument("StepDifferential: V is " + size_text(V.rows(), V.cols()) +
                                "; expected a row for each of the " +
                                std::to_string(step.before.x.size()) + " numbers of a point.");
  return do_images(step, V);
}

MatrixXd StepDifferential::pull_back(const Step& step, const MatrixXd& Lambda) const {
  if (Lambda.rows() != step.after.x.size())
    throw std::invalid_argument("StepDifferential::pull_back: Lambda is " +
                                size_text(Lambda.rows(), Lambda.cols()) +
                                "; expected a row for each of the " +
                                std::to_string(step.after.x.size()) + " numbers of a point.");
  return do_pull_back(step, Lambda);
}

MatrixXd StepDifferential::pull_back_by(const MatrixXd& V, const MatrixXd& images,
                                        const MatrixXd& Lambda) {
  if (V.cols() == 0) return MatrixXd::Zero(V.rows(), Lambda.cols());
  const MatrixXd pairings = images.transpose() * Lambda;
  return V * LuDecomposition(V.transpose() * V).solve(pairings);
}

MatrixXd implicit_adjoint(const char* place, const MatrixXd& A, const MatrixXd& C,
                          Index determined) {
  if (A.cols() == 0 || C.cols() == 0) return MatrixXd::Zero(A.rows(), C.cols());
  const auto [scaled, row_scale, column_scale] = equilibrate(A, kNoiseOfJacobians);
  const MatrixXd transposed = scaled.transpose(), right = column_scale.asDiagonal() * C;
  if (A.rows() == A.cols()) {
    const LuDecomposition lu(transposed);
    if (lu.pivot_ratio() > kRegular)
      return row_scale.asDiagonal() *
             improved(transposed, right, [&](const MatrixXd& B) { return lu.solve(B); });
  }
  const FundamentalSubspaces spaces(transposed, {.data_error = kSolvedTo});
  require_determined(place, spaces.left_kernel().topRows(determined));
  return row_scale.asDiagonal() *
         improved(transposed, right, [&](const MatrixXd& B) { return spaces.pseudo_solve(B); });
}

MatrixXd implicit_derivative(const char* place, const MatrixXd& A, const MatrixXd& B,
                             Index determined) {
  if (A.cols() == 0 || B.cols() == 0) return MatrixXd::Zero(A.cols(), B.cols());
  const auto [scaled, row_scale, column_scale] = equilibrate(A, kNoiseOfJacobians);
  const MatrixXd right = row_scale.asDiagonal() * B;
  if (A.rows() == A.cols()) {
    const LuDecomposition lu(scaled);
    if (lu.pivot_ratio() > kRegular)
      return column_scale.asDiagonal() *
             improved(scaled, right, [&](const MatrixXd& b) { return lu.solve(b); });
  }
  const FundamentalSubspaces spaces(scaled, {.data_error = kSolvedTo});
  require_determined(place, spaces.kernel().topRows(determined));
  const MatrixXd X =
      improved(scaled, right, [&](const MatrixXd& b) { return spaces.pseudo_solve(b); });
  const MatrixXd defect = scaled * X + right,
                 size = scaled.cwiseAbs() * X.cwiseAbs() + right.cwiseAbs();
  // A row whose terms are round-off next to those of the others, as that of a rate which is 0, says nothing.
  const double round_off = kSolvedTo * size.norm();
  for (Index i = 0; i < A.rows(); ++i)
    if (defect.row(i).norm() > kConsistent * size.row(i).norm() + round_off)
      throw std::domain_error(std::string(place) +
                              ": no step begins in a given direction; expected directions along "
                              "the constraints.");
  return column_scale.asDiagonal() * X;
}

}  // namespace courant
