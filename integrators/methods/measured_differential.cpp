#include "courant/integrators/methods/measured_differential.hpp"

#include <algorithm>
#include <stdexcept>

#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/structures/dirac_interconnection.hpp"
#include "courant/structures/system_in_units.hpp"

namespace courant {

MeasuredDifferential::MeasuredDifferential(const Integrator& integrator,
                                           const IntegratorSetting& setting, double scale)
    : integrator_(integrator), setting_(setting), M_(*setting.system->manifold()) {
  const VectorXd& x = setting.initial.x;
  const MatrixXd basis = M_.tangent_basis(x);
  MatrixXd directions = MatrixXd::Identity(basis.cols(), basis.cols());
  if (const Units* units = integrator.units()) directions = chart_units(*units, M_, x).asDiagonal();
  const auto step_from = [&](const VectorXd& from) {
    State start = setting.initial;
    start.x = from;
    return integrator.advance(start, setting.step, 1).x;
  };
  tangent_ = directions;
  if (setting.conormals.rows() > 0)
    tangent_ *= kernel(setting.conormals * basis * directions, {.data_error = 1e-9});
  y_ = step_from(x);
  const MatrixXd back = M_.tangent_basis(y_).transpose() * M_.coframe(y_);
  const double epsilon = 1e-3 * scale;
  image_.resize(basis.cols(), tangent_.cols());
  for (Index k = 0; k < tangent_.cols(); ++k) {
    const VectorXd direction = basis * tangent_.col(k);
    const auto at = [&](double s) {
      return step_from(M_.retract(x, VectorXd(s * epsilon * direction)));
    };
    const VectorXd velocity =
        (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * epsilon);
    image_.col(k) = back * velocity;
  }
}

double MeasuredDifferential::defect(const StepDifferential& exact) const {
  const auto stepper = integrator_.stepper();
  stepper->tell_parts();
  State state = setting_.initial;
  stepper->step(state, setting_.step);
  const VectorXd& x = setting_.initial.x;
  const MatrixXd directions = M_.frame(x) * (M_.tangent_basis(x) * tangent_);
  const MatrixXd image = M_.tangent_basis(state.x).matrix().transpose() *
                         (M_.coframe(state.x) * exact(stepper->last(), directions));
  return (image - image_).norm() / std::max(image.norm(), 1e-300);
}

// ω_D at x as a matrix in the basis of T_xM.
MatrixXd MeasuredDifferential::form_at(const VectorXd& x) const {
  const auto [F, omega] = setting_.structure->linear(x).form();
  return F * omega * F.transpose();
}

double MeasuredDifferential::symplecticity_defect() const {
  const MatrixXd before = tangent_.transpose() * form_at(setting_.initial.x) * tangent_;
  const MatrixXd after = image_.transpose() * form_at(y_) * image_;
  if (before.size() == 0 || before.norm() == 0.0)
    throw std::domain_error("the form vanishes on the constraint set");
  return (after - before).norm() / before.norm();
}

double MeasuredDifferential::preservation_defect() const {
  const DiracStructure& D = *setting_.structure;
  return distance(forward_image(image_ * tangent_.transpose(), D.linear(setting_.initial.x)),
                  D.linear(y_));
}

bool has_symplectic_form(const IntegratorSetting& setting) {
  const Index n = setting.system->manifold()->dimension();
  if (!setting.structure || n == 0) return false;
  const PairedSubspace D = setting.structure->fibre(setting.initial.x);
  return D.is_dirac() && D.vector_range().cols() == n && D.covector_range().cols() == n;
}

}  // namespace courant
