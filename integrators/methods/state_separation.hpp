// Distances of the states of an integrator.
#pragma once

#include <algorithm>

#include "courant/integrators/step/integrator.hpp"
#include "courant/manifolds/manifold.hpp"

namespace courant {

// The distance of two states on M next to the size of where they are, so that 1e-12 is round-off. Numbers
// of steps that are made in other units are compared in those.
class StateSeparation {
 public:
  // Two ways to the same state: they differ by what Newton's method leaves and by round-off.
  static constexpr double kSame = 1e-9;

  // Sizes next to that of x. The manifold and the units (null: there are none) have to outlive it.
  StateSeparation(const Manifold& M, const Units* units, const VectorXd& x);

  double operator()(const State& a, const State& b) const;

  // A system that starts at zero has the size of where it goes.
  void include(const VectorXd& x) { scale_ = std::max(scale_, in_units(x).norm()); }
  double scale() const { return scale_; }

 private:
  VectorXd in_units(const VectorXd& x) const;

  const Manifold& M_;
  const Units* units_;
  double scale_;
};

}  // namespace courant
