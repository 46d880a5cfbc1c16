#include "courant/integrators/projector.hpp"

#include <stdexcept>

#include "courant/core/complete_orthogonal_decomposition.hpp"
#include "courant/core/message.hpp"
#include "courant/core/singular_value_decomposition.hpp"

namespace courant {
namespace {

// The sine of the angle between the directions and T_xM_f below which they count as no complement:
// projecting would lose more than half of the digits.
constexpr double kTransversality = 1e-8;

// Of the directions, next to their lengths: half of the digits again.
constexpr double kDataError = 2e-11;

}  // namespace

MatrixXd Projector::directions(const VectorXd& x, const MatrixXd& basis,
                               const MatrixXd& conormals) const {
  if (conormals.cols() == 0) return conormals;
  const MatrixXd W = do_directions(x, basis, conormals);
  if (W.rows() != conormals.rows())
    throw std::invalid_argument(
        "Projector(" + name_ + ")::do_directions: the result has " + std::to_string(W.rows()) +
        " rows, expected dim M = " + std::to_string(conormals.rows()) + ".");
  const CompleteOrthogonalDecomposition decomposition(W, kDataError);
  const MatrixXd orthonormal = decomposition.Q().leftCols(conormals.cols());
  const double sine = decomposition.rank() < conormals.cols()
                          ? 0.0
                          : singular_values(conormals.transpose() * orthonormal).minCoeff();
  if (!(sine > kTransversality))
    throw std::domain_error("Projector(" + name_ +
                            ")::directions: the directions of the projector \"" + name_ +
                            "\" meet T_xM_f, sine of the angle " + number_text(sine) +
                            "; expected a complement of it. Use the orthogonal projector.");
  return orthonormal;
}

MatrixXd OrthogonalProjector::do_directions(const VectorXd&, const MatrixXd&,
                                            const MatrixXd& conormals) const {
  return conormals;
}

MomentumProjector::MomentumProjector(std::shared_ptr<const CotangentBundle> phase_space,
                                     Metric metric)
    : Projector("momentum"), phase_space_(std::move(phase_space)), metric_(std::move(metric)) {
  if (!phase_space_)
    throw std::invalid_argument("MomentumProjector::MomentumProjector: phase_space is null.");
}

MatrixXd MomentumProjector::do_directions(const VectorXd& x, const MatrixXd& basis,
                                          const MatrixXd& conormals) const {
  const Index n = phase_space_->base()->tangent_dimension();
  const MatrixXd momentum_part = basis.bottomRows(n) * conormals;  // β: vectors at q
  MatrixXd covectors = momentum_part;
  if (metric_) covectors = values(metric_(constants(phase_space_->position(x)))) * momentum_part;
  return basis.bottomRows(n).transpose() * covectors;
}

}  // namespace courant
