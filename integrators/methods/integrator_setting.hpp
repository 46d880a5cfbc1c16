// A system and a state that an integrator is measured on, and how its claims are taken.
#pragma once

#include <memory>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/step/integrator.hpp"
#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// What an integrator is measured on.
struct IntegratorSetting {
  std::shared_ptr<const ImplicitSystem> system;
  State initial;  // on M_f
  double step = 0.0;
  // Conormals of M_f at initial.x, as rows of Ñ numbers (ConstraintLadder::conormals()). Empty: M_f
  // is M.
  MatrixXd conormals = MatrixXd();
  // With gauge freedom a step is one of many: how far along the gauge it goes has no order, and
  // restarts take another one of them. Claims of order and restarts are not measured then.
  bool is_gauge = false;
  // The structure that a symplectic method is to preserve; null: none is known.
  std::shared_ptr<const DiracStructure> structure = nullptr;
};

// How strictly the claims of a method are measured.
struct IntegratorLawOptions {
  // Whether claims are measured in both directions: an order that is higher than claimed, and a
  // symmetry that is denied, fail too. For systems without symmetries of their own, where nothing
  // cancels by accident.
  bool both_ways = false;
};

}  // namespace courant
