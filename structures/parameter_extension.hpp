// ParameterExtension: parameters of a system as coordinates that do not move.
#pragma once

#include <memory>
#include <vector>

#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/structures/implicit_system.hpp"
#include "courant/structures/state.hpp"

namespace courant {

// A system S(θ) ⊂ TM for each value of p parameters as one system on M × Rᵖ:
//
//   {((x, θ), (v, 0)) : (x, v) ∈ S(θ)},   F(x, v, z, t; θ) = 0,   θ' = 0
//
// A method for it makes the steps that it makes for S(θ), and carries θ along. So what is known of
// derivatives by the point is known of derivatives by parameters: T M_f of the extended system is the set of
// all (δx, δθ) for which x + δx is on M_f(θ + δθ) to first order.
//
// Points are (x, θ), tangent vectors (v, w) with w ∈ Rᵖ, covectors (α, β). The system asks for its
// parameters by Parameter::at(); one that does not ask for a name does not depend on it. The manifold is
// that of the values given here: parameters that it is made of (semi-axes, curvatures) are none for this.
// An EnergySystem extends to an EnergySystem.
class ParameterExtension {
 public:
  // Throws std::invalid_argument if the system is null, there are no parameters, or two of one name.
  ParameterExtension(std::shared_ptr<const ImplicitSystem> system,
                     std::vector<Parameter> parameters);

  const std::shared_ptr<const ImplicitSystem>& system() const { return system_; }
  const std::shared_ptr<const ImplicitSystem>& extended() const { return extended_; }
  const std::vector<Parameter>& parameters() const { return parameters_; }
  Index count() const { return static_cast<Index>(parameters_.size()); }  // p
  VectorXd values() const;                                                // θ
  // Which of the extended equations is the first of the p equations θ' = 0.
  Index first_rate() const {
    return system_->tangent_blocks() > 0 ? system_->manifold()->tangent_dimension()
                                         : system_->equation_count();
  }

  // (x, θ) with (v, 0), and back. What a state does not have, v or z, the other one does not have.
  State to_extended(const State& state) const;
  State from_extended(const State& state) const;

 private:
  std::shared_ptr<const ImplicitSystem> system_, extended_;
  std::vector<Parameter> parameters_;
};

// G(x, t) → expressions of a graph that has no parameters of these names, with the last entries of y = (x, θ)
// for them: formulas are traced in a graph of their own.
class AtParameters {
 public:
  explicit AtParameters(const std::vector<Parameter>& parameters);

  // `formula` takes the vectors of a new graph that stand for `arguments`. The parameters are `values`.
  template <class Formula>
  ExprVector operator()(const std::vector<ExprVector>& arguments, const ExprVector& values,
                        const Formula& formula) const {
    Trace trace(names_, arguments);
    return trace.brought(formula(trace.variables), arguments, values);
  }

 private:
  struct Trace {
    Trace(const std::vector<std::string>& names, const std::vector<ExprVector>& arguments);
    ExprVector brought(const ExprVector& result, const std::vector<ExprVector>& arguments,
                       const ExprVector& values) const;

    Graph graph;
    ExprVector parameters;
    std::vector<ExprVector> variables;
  };

  std::vector<std::string> names_;
};

}  // namespace courant
