// Systems with known ladders, and what one can do to a system without changing them.
#pragma once

#include <functional>
#include <memory>
#include <random>
#include <string>

#include "courant/integrators/certificate/certificate.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant::examples {

// F(x, v, z, t) = 0 written as a function.
class FormulaSystem final : public ImplicitSystem {
 public:
  using Formula = std::function<ExprVector(const ExprVector& x, const ExprVector& v,
                                           const ExprVector& z, const Expr& t)>;
  FormulaSystem(std::shared_ptr<const Manifold> manifold, Index auxiliary_size,
                Index equation_count, Formula formula, Names names = {})
      : ImplicitSystem(std::move(manifold), auxiliary_size, equation_count, std::move(names)),
        formula_(std::move(formula)) {}

 private:
  ExprVector do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                         const Expr& t) const override {
    return formula_(x, v, z, t);
  }
  Formula formula_;
};

using SystemPointer = std::shared_ptr<const ImplicitSystem>;

// A system with what is known at the start, and the metric in which x moves least (empty:
// Euclidean).
struct Problem {
  SystemPointer system;
  InitialGuess guess;
  MatrixXd metric = MatrixXd();

  ConstraintLadder ladder() const {
    return certificate(system, guess, {.metric = metric.sparseView()}, Decider::both);
  }
};

// Equations and unknowns in a random order (x on Rⁿ only).
Problem permuted(const Problem& problem, std::mt19937& generator);
// Equation i times 10^±6, unknowns x_j = s_j x'_j and z_j = s_j z'_j with s = 10^±6 (x on Rⁿ only).
// The metric goes along.
Problem scaled(const Problem& problem, std::mt19937& generator);
// On Rⁿ: x and z by a random change of coordinates, nonlinear in x, that is a diffeomorphism. The metric at the guess
// goes along. On other manifolds z and the equations are replaced by random linear combinations.
Problem transformed(const Problem& problem, std::mt19937& generator);

// Expr entries as a vector.
ExprVector equations(std::initializer_list<Expr> entries);

}  // namespace courant::examples
