// The formulas of a step by Method 2.
#pragma once

#include "courant/integrators/certificate/local_formulation.hpp"
#include "courant/integrators/methods/constrain_first_scheme.hpp"
#include "courant/integrators/step/step_formulas.hpp"
#include "courant/integrators/step/transported_conormals.hpp"

namespace courant {

// The formulas of a step and of the projection that follows it.
struct ConstrainFirstTrace {
  using Omissions = ConstrainFirstScheme::Omissions;

  // Without `known`, what steps can do without is found.
  explicit ConstrainFirstTrace(const ConstrainFirstScheme& scheme,
                               const std::optional<Omissions>& known = std::nullopt);

  StepFormulas step, projection;
  Omissions omitted;     // what `constraints` are without, of S_f as LocalFormulation has it
  ExprVector redundant;  // equations of S_f that follow from `constraints`, of the same unknowns
  ExprVector open;       // unknowns of S_f that are held
  ExprVector z;          // with the values of those of it that are
  std::vector<std::pair<Index, double>> held_z;  // these: their places in z, and values
  Index blocks, auxiliaries;
  ExprVector x0, basis_entries, t, near, s, x;  // parameters
  ExprVector constraints, jets;                 // S_f, and its unknowns (ξ, ξ', …, z, …)
  std::vector<std::string> constraint_names;
  ExprVector advanced, projected, shifted, corrected;
  Index dimension, codimension;
  VectorXd conormal_sizes;  // of the projector

  TransportedConormals::Formulas conormals() const;

 private:
  Omissions omissions(const ConstrainFirstScheme& scheme, const LocalFormulation& local) const;
  void describe(const ConstrainFirstScheme& scheme, const LocalFormulation& local,
                const std::optional<Omissions>& known);
};

}  // namespace courant
