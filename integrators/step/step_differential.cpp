#include "courant/integrators/step/step_differential.hpp"

#include <stdexcept>
#include <string>

#include "courant/core/linear/equilibration.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/linear/rank_decision.hpp"
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

}  // namespace

MatrixXd StepDifferential::operator()(const Step& step, const MatrixXd& V) const {
  if (V.rows() != step.before.x.size())
    throw std::invalid_argument("StepDifferential: V is " + size_text(V.rows(), V.cols()) +
                                "; expected a row for each of the " +
                                std::to_string(step.before.x.size()) + " numbers of a point.");
  return do_images(step, V);
}

MatrixXd implicit_derivative(const char* place, const MatrixXd& A, const MatrixXd& B,
                             Index determined) {
  if (A.cols() == 0 || B.cols() == 0) return MatrixXd::Zero(A.cols(), B.cols());
  const auto [scaled, row_scale, column_scale] = equilibrate(A, kNoiseOfJacobians);
  const MatrixXd right = row_scale.asDiagonal() * B;
  if (A.rows() == A.cols()) {
    const LuDecomposition lu(scaled);
    if (lu.pivot_ratio() > kRegular) return column_scale.asDiagonal() * lu.solve(-right);
  }
  const FundamentalSubspaces spaces(scaled, {.data_error = kSolvedTo});
  const MatrixXd free = spaces.kernel().topRows(determined);
  if (free.size() > 0 && free.cwiseAbs().maxCoeff() > kConsistent)
    throw std::domain_error(std::string(place) +
                            ": the end of the step is not determined by its beginning; expected "
                            "a system without gauge freedom.");
  const MatrixXd X = -spaces.pseudo_solve(right);
  const MatrixXd defect = scaled * X + right,
                 size = scaled.cwiseAbs() * X.cwiseAbs() + right.cwiseAbs();
  for (Index i = 0; i < A.rows(); ++i)
    if (defect.row(i).norm() > kConsistent * size.row(i).norm())
      throw std::domain_error(std::string(place) +
                              ": no step begins in a given direction; expected directions along "
                              "the constraints.");
  return column_scale.asDiagonal() * X;
}

}  // namespace courant
