// TimeTransformation: a system in a time of its own.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/energy_system.hpp"
#include "courant/structures/state.hpp"

namespace courant {

// dt/dτ = g(x, t) > 0 at a point x (N) and a time t.
using TimeRate = std::function<Expr(const ExprVector& x, const Expr& t)>;

// Where the numbers of a system are among those of the same system with time as a coordinate: of
// points (N), of tangent vectors and covectors (Ñ), and of time.
struct TimePlaces {
  std::vector<Index> point, tangent;
  Index time_of_point = 0, time_of_tangent = 0;
  std::shared_ptr<const Manifold> manifold;  // the extended one

  // M × R: (x, t).
  static TimePlaces on_product(std::shared_ptr<const Manifold> manifold);
  // dx/dt by an extended velocity; empty if that is, or where it does not go forward in time.
  VectorXd velocity(const VectorXd& extended) const;

  // T*(Q × R): (q, t, p, p_t). The momentum p_t of time is the last number of a point and of a tangent
  // vector.
  static TimePlaces on_cotangent_bundle(const CotangentBundle& phase_space);
};

// Poincaré's transformation of a generating family E(x, λ, t) on T*Q:
//
//   E^g(q, t, p, p_t, λ) = g(x, t) (E(x, λ, t) + p_t)      on T*(Q × R),   x = (q, p)
//
// (E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, VIII.2.1). Where E^g = 0, that is
// p_t = -E, its flow is that of E in the time τ with dt/dτ = g; off it the flow is another one.
// What is a Morse family stays one, as g > 0.
class TransformedFamily final : public GeneratingFamily {
 public:
  // `family` on a cotangent bundle; throws std::invalid_argument otherwise, or if the rate is empty.
  TransformedFamily(std::shared_ptr<const GeneratingFamily> family, TimeRate rate);
  std::optional<bool> is_morse() const override { return family_->is_morse(); }

 private:
  Expr do_value(const ExprVector& x, const ExprVector& lambda, const Expr& tau) const override;
  VectorXd do_parameter_guess(const VectorXd& x, const VectorXd& v) const override;

  std::shared_ptr<const GeneratingFamily> family_;
  TimeRate rate_;
  TimePlaces places_;
};

// A system S = {F(x, v, z, t) = 0} on M in another time τ, on an extended manifold where t is a
// coordinate. There are two of them:
//
//   plain        on M × R         F(x, v/g, z, t) = 0,  t' = g
//   symplectic   on T*(Q × R)     the canonical structure with the family E^g, see TransformedFamily
//
// where ' is d/dτ. The first has the constraints of S, and G(x, v/g, α, …) where S is an EnergySystem.
// The second is Lagrangian as S is: a symplectic method with a constant step in τ is symplectic on
// T*(Q × R), and its steps in t follow g. Neither depends on τ.
//
// States are taken to the extended manifold and back. The velocity of a state is dx/dt, that of an
// extended one d/dτ. State::carried is p_t for the second, empty for the first.
// Immutable.
class TimeTransformation {
 public:
  // The first of the two systems above, for any S.
  static TimeTransformation plain(std::shared_ptr<const ImplicitSystem> system, TimeRate rate);
  // The second. Throws std::invalid_argument unless is_possible.
  static TimeTransformation symplectic(const std::shared_ptr<const ImplicitSystem>& system,
                                       TimeRate rate);
  // Whether the system is Lagrangian by its family on T*Q, with the canonical structure.
  static bool is_possible(const ImplicitSystem& system);

  const std::shared_ptr<const ImplicitSystem>& system() const { return system_; }
  const std::shared_ptr<const ImplicitSystem>& extended() const { return extended_; }
  const TimePlaces& places() const { return places_; }
  bool is_symplectic() const { return family_ != nullptr; }
  // Whether an energy of the system depends on t.
  bool has_time_in_energy() const { return has_time_in_energy_; }

  // g at a state.
  double rate(const State& state) const;
  // At τ = 0. Without `carried` p_t is -E(x, λ, t) with the λ of ∂_λE = 0 nearest to the state's.
  State to_extended(const State& state) const;
  State from_extended(const State& extended) const;
  // The part of a covector of the extended manifold that is one of M.
  VectorXd covector(const VectorXd& extended) const;

 private:
  TimeTransformation(std::shared_ptr<const ImplicitSystem> system, TimeRate rate, TimePlaces places,
                     std::shared_ptr<const GeneratingFamily> family);
  VectorXd stationary(const State& state, const VectorXd& near) const;

  std::shared_ptr<const ImplicitSystem> system_, extended_;
  TimePlaces places_;
  std::shared_ptr<const GeneratingFamily> family_;  // of the second kind
  Function rate_;                                   // x, t ↦ g
  Function energy_;                                 // x, λ, t ↦ E
  Function stationarity_;                           // x, λ, t ↦ ∂_λE
  bool has_time_in_energy_ = false;
};

}  // namespace courant
