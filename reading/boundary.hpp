// Conditions at both ends of a run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/integrators/boundary/boundary_problem.hpp"
#include "courant/reading/model.hpp"

namespace courant {

// A formula that has a value at an end of the run.
struct BoundaryCondition {
  std::string name;  // "x", "R[0][1]", "x^2 + y^2"
  WrittenFormula formula, value;
};

// Formulas of coordinates, velocities, unknowns and t that conditions may name besides.
using NamedFormulas = std::vector<std::pair<std::string, WrittenFormula>>;

// The key `boundary` of an experiment:
//
//   {"initial": {"x": 0}, "final": {"x^2 + y^2": 4}, "free": ["T"], "periodic": true,
//    "guess": {"x": "1 - t"}, "continuation": {"parameter": "c", "from": 0}, "segments": 8}
struct Boundary {
  std::vector<BoundaryCondition> initial, final;
  // What is guessed of the motion: formulas in t for coordinates.
  std::vector<std::pair<Index, WrittenFormula>> guess = {};
  NamedFormulas named;
  bool has_free_time = false;
  bool is_periodic = false;
  struct Continuation {
    std::string parameter;
    double from = 0.0, to = 0.0;
  };
  std::optional<Continuation> continuation = {};
  long segments = 0;  // 0: as BoundaryProblem has them

  // Of a problem of optimal control: whether transversality adds conditions at the end (or at the beginning).
  bool has_transversality(const Model& model, bool at_end) const;
};

// Reads it. Unknown names, and conditions that depend on nothing, are problems.
std::optional<Boundary> read_boundary(const JsonReader& value, const Model& model,
                                      NamedFormulas named);

// Sets the coordinates of a state to what is guessed of them at its time.
void take_guess(const Boundary& boundary, const Model& model, State& state);

// The conditions at the end, or at the beginning. Where the system is one of optimal control, and conditions g(q, t) =
// 0 are on states and the time alone, with those of transversality, the multipliers ν of g as unknowns:
//
//   p + E(q)ᵀ (Dg(q)ᵀ ν + Dφ(q)) = 0,   and at a free end of the time E(q, p, u) = ν · ∂g/∂t + ∂φ/∂t
//
// with the cost φ of the state at the end. If all states are given, and not as functions of a free time, the first are left out with ν.
EndConditions end_conditions(const Boundary& boundary, const Model& model, bool at_end);

}  // namespace courant
