// The differential of a step, from differences of steps.
#pragma once

#include "courant/integrators/methods/integrator_setting.hpp"

namespace courant {

// One step from the initial point x of a setting, y = Φ_h(x), with TΦ_h on T M_f: by differences of order 4,
// which know it to about ten digits.
class MeasuredDifferential {
 public:
  // `scale` is the size of x: a step begins up to 2e-3 of that away. Directions are as long as the units of
  // the integrator, if it has some. Throws what a step throws.
  MeasuredDifferential(const Integrator& integrator, const IntegratorSetting& setting,
                       double scale);

  const VectorXd& y() const { return y_; }
  // A basis of T_x M_f by columns, in that of T_xM, and their images in that of T_yM.
  const MatrixXd& tangent() const { return tangent_; }
  const MatrixXd& image() const { return image_; }

  // ‖Φ_h*ω - ω‖ next to ‖ω‖ on T M_f, ω that of the structure of the setting, which must be the graph of a
  // form. Throws std::domain_error if ω vanishes there.
  double symplecticity_defect() const;
  // The distance of the image of D_x from D_y, D the structure of the setting.
  double preservation_defect() const;
  // How far an exact differential, told of the step that the integrator makes, is from this one.
  double defect(const StepDifferential& exact) const;

 private:
  MatrixXd form_at(const VectorXd& x) const;

  const Integrator& integrator_;
  const IntegratorSetting& setting_;
  const Manifold& M_;
  VectorXd y_;
  MatrixXd tangent_, image_;
};

// Whether the structure of the setting is the graph of a symplectic form at its initial point.
bool has_symplectic_form(const IntegratorSetting& setting);

}  // namespace courant
