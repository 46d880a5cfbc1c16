// StepProgram: all that a step evaluates, as formulas.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/integrators/step/space_formulas.hpp"
#include "courant/integrators/step/step_formulas.hpp"
#include "courant/integrators/step/transported_conormals.hpp"
#include "courant/integrators/step/vector_field.hpp"
#include "courant/structures/system_in_units.hpp"

namespace courant {

class Integrator;

// How a step is made, for whoever carries it out without this library: another language, say. Either of
//
//   solves    y with the equations = 0, then (x₁, v, …) = advanced(y; …)      DisplacementStepper
//             the same with a projection after it                             ConstrainFirst
//   explicit  a tableau of evaluations of a VectorField                       ExplicitRungeKutta
//   direct    formulas for where it leads                                     Verlet, where it is explicit
//
// Where the space has equations of its own x₁ is kept to them as RoundOffProjection does, and where tangent vectors
// need a basis it is that of TransportedFrame.
struct StepProgram {
  std::string method;

  // y = (displacements, z); inputs y, x₀, basis, h, t.
  struct Solve {
    StepFormulas formulas;
    SpaceFormulas space;
    bool is_affine = false;  // no step is looked at by continuation
    Index tangent_blocks = 1;
    Index displacements = 0, auxiliaries = 0;
    ExprVector advanced;  // the same inputs ↦ x₁, v, x̄ unless `stage` has it, the effort
    ExprVector effort;    // the last of those
    std::vector<Function::Input> stage_inputs;  // x₀, x₁
    ExprVector stage;                           // x̄
    double stage_time = 0.0;                    // of h
    bool stage_is_advanced = false;

    // Where steps end on M_f: y = (ξ, ξ', …, z, …, μ), in the inputs W after the basis, advanced = (R_d⁺, x̄, v).
    struct Projection {
      StepFormulas formulas;  // inputs y, x of the chart, basis, W, near, t
      Index multipliers = 0;  // the size of μ
      ExprVector projected;   // the same inputs ↦ x, v, z
      std::vector<Function::Input> shift_inputs, correction_inputs;  // near, s; near, s, x₀, x
      ExprVector shifted;                                            // R_near(s)
      ExprVector corrected;  // what leads to x if s leads to x₀

      // Where W changes from point to point: as TransportedConormals and TransportedDirections find it. Elsewhere it is
      // numbers in the formulas.
      struct Turning {
        TransportedConormals::Formulas conormals;
        std::vector<MatrixXd> references;
        Function::Formulas span;  // of the projector
        bool is_always_complement = false;
      };
      std::optional<Turning> turning = {};
    };
    std::optional<Projection> projection = {};
  };
  std::optional<Solve> solve = {};
  // A step is made of steps of these parts of h, each with a workspace of its own.
  std::vector<double> substeps = {1.0};

  // k_i = ẋ(x₀ + h Σ_{j<i} a_ij k_j, t + c_i h), x₁ = x₀ + h Σ b_j k_j, the products h a_ij first; what is not
  // added up is no value.
  struct Explicit {
    std::vector<double> times;                             // c_i
    std::vector<std::vector<std::optional<double>>> rows;  // a_i, in the end b
    bool keeps_rate = false;                     // ẋ(x₁) is the first of the next step
    const VectorFieldFormulas* field = nullptr;  // of the method, which has to outlive this
  };
  std::optional<Explicit> explicit_steps = {};

  // Each of the substeps by formulas: (x₁, r₁) of (x₀, r₀), where r is what one leaves for the next.
  struct Direct {
    Function::Formulas beginning;  // x₀, t ↦ r₀
    Function::Formulas step;       // x₀, r₀, h, t ↦ x₁, r₁
    Function::Formulas ending;     // x₀, r₀, r₁, h, t ↦ v, z
  };
  std::optional<Direct> direct = {};

  // In which all this is, if not in those of the system: states are measured before a step, and restored.
  std::optional<Units> units = {};
};

// That of a method that has one. Throws std::invalid_argument as program() does.
StepProgram step_program(const Integrator& method);

}  // namespace courant
