// The laws of Integrator, measured on a system.
#pragma once

#include <optional>
#include <vector>

#include "courant/integrators/methods/integrator_setting.hpp"
#include "courant/integrators/step/integrator.hpp"
#include "courant/manifolds/law_result.hpp"

namespace courant {

// What was measured, and the laws:
//
//   P1   the measured order is order(): within 0.15, from both sides if both_ways; with the step of the
//        setting, or else with one that is shorter by up to 8⁵ or longer by up to 8²
//   P2   Φ_{-h} ∘ Φ_h = id, if is_symmetric(); not so, if it is denied and both_ways
//   P3   Φ_h*ω = ω on T M_f, if is_symplectic(); ω of the structure
//   P4   Φ_h preserves D, if is_symplectic(): the forward image of D_x is D_y, where M_f is M
//   P5   the step from a state is that of a fresh stepper: nothing else is remembered
//   P6   a step with h < 0 goes back in time, with the order claimed; with a step as for P1
//   P7   a step that fails throws SolveError and leaves state and stepper as they were; none leads
//        to numbers that are not finite
//   P8   v and z of the initial state may be empty (if both_ways: a Lagrangian that is not defined
//        at rest needs them)
//   P9   the time after k steps is t₀ + k h, and k are counted
//   P10  H changes in each step by what is supplied less what is dissipated, to 1e-12 of the energies that
//        take part, if has_exact_energy()
//   P11  differential(), where there is one, is TΦ_h on T M_f as differences of steps show it (if both_ways:
//        differences need coordinates of comparable sizes)
struct IntegratorReport {
  std::vector<LawResult> laws;
  // No value where there is nothing to measure: the steps fail, or they are exact.
  std::optional<double> order;
  std::optional<double> asymmetry;      // ‖Φ_{-h}(Φ_h(x)) - x‖ next to ‖x‖
  std::optional<double> symplecticity;  // ‖Φ_h*ω - ω‖ next to ‖ω‖, on T M_f
  std::optional<double> preservation;   // distance of the image of D_x from D_y
  // |ΔH - supplied + dissipated| next to the energies, the greatest of some steps; no value for a system
  // that knows no powers.
  std::optional<double> imbalance;
  std::vector<VectorXd> states;  // of the first steps
};

// Measures all of it at the setting. Differentials are taken by differences of order 4. Does not
// throw for a wrong integrator: what a step throws counts as an infinite defect, and `where` says
// what it was.
IntegratorReport check_integrator(const Integrator& integrator, const IntegratorSetting& setting,
                                  const IntegratorLawOptions& options = {});

}  // namespace courant
