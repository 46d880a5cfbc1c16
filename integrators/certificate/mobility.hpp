// What a search for a zero may move, and how much of it.
#pragma once

#include <functional>

#include "courant/core/linear/equilibration.hpp"

namespace courant {

// What to move by preference.
struct Mobility {
  VectorXd cost;  // of a step by one natural unit of each unknown: a step δ minimises ‖cost ∘ δ‖
                  // among those that do as well
  Index frozen = 0;               // so many leading unknowns do not move at all
  VectorXd typical = VectorXd();  // sizes |y_j| below which a change of y_j is round-off in the
                                  // map; may be 0
  VectorXd offset = VectorXd();   // sizes of what the map adds to leading unknowns
  double noise = 1e-11;           // natural units below which what is left of an unknown is noise
  // The generic magnitude of the derivatives around the start, where it is known; may be empty.
  SparseMatrixXd magnitude = SparseMatrixXd();
  // Whether derivatives grow as those of exp (v/25 mV) do: they are measured by what they are at each point, not
  // around it, and steps are as short as they have to be for derivatives to stay of their size. Heeded
  // for up to 200 unknowns.
  bool has_exponentials = false;
  // Whether y may be gone to, as the domain of a chart allows; empty: anything may.
  std::function<bool(const VectorXd& y)> admits = {};
};

}  // namespace courant
