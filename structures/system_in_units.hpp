// SystemInUnits: a system in other units of its coordinates.
#pragma once

#include <memory>

#include "courant/structures/implicit_system.hpp"
#include "courant/structures/state.hpp"

namespace courant {

// Sizes that count as 1, all of them powers of two, so that no number is rounded when units change.
struct Units {
  VectorXd coordinates;  // N
  VectorXd tangent;      // Ñ, of tangent vectors: of velocities times the unit of time
  VectorXd auxiliary;    // m
  VectorXd equations;    // r
  double time = 1.0;

  // A state in these units, and back, with all its v and z or none. Throw std::invalid_argument on wrong sizes.
  State measure(const State& state) const;
  State restore(const State& measured) const;
  // The same into memory that is there; what is `carried` there stays.
  void measure(const State& state, State& measured) const;
  void restore(const State& measured, State& state) const;
};

// What is 1 of the n coordinates ξ of the chart R_x(B ξ) at a point x of M, for its tangent_basis B: each is along
// tangent vectors that share a unit.
VectorXd chart_units(const Units& units, const Manifold& M, const VectorXd& x);

// The system with numbers (x̂, v̂, ẑ, t̂) where the other one has x = u x̂, v = u v̂ / T, z = w ẑ, t = T t̂:
//
//   F̂(x̂, v̂, ẑ, t̂) = F(u x̂, u v̂ / T, w ẑ, T t̂) / r
//
// for u, w, r, T as Units has them; u of tangent vectors where v is one. An electron's position in metres and its
// momentum are 10²⁰ apart, and an iteration that measures changes of a vector by its largest entry does not see the
// smaller one.
//
// Names stay. is_lagrangian() is that of the other system, with the form that its own coordinates have; there is no
// structure() here. Units are those of scaling symmetries of M, so that M is the same: see
// Manifold::scaling_symmetries().
class SystemInUnits final : public ImplicitSystem {
 public:
  // Throws std::invalid_argument unless all units are powers of two, as many as there are coordinates, unknowns and
  // equations, those of the coordinates are of scaling symmetries of M, and the equations that are components of one
  // vector or covector share theirs.
  SystemInUnits(std::shared_ptr<const ImplicitSystem> system, Units units);

  const std::shared_ptr<const ImplicitSystem>& system() const { return system_; }
  const Units& units() const { return units_; }

  std::optional<bool> is_lagrangian() const override { return system_->is_lagrangian(); }
  Index tangent_blocks() const override { return system_->tangent_blocks(); }

 private:
  ExprVector do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                         const Expr& t) const override;
  std::optional<Expr> do_energy(const ExprVector& x, const ExprVector& z,
                                const Expr& t) const override;
  VectorXd do_auxiliary_guess(const VectorXd& x, const VectorXd& v) const override;

  std::shared_ptr<const ImplicitSystem> system_;
  Units units_;
};

}  // namespace courant
