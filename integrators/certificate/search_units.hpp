// The units in which a search for a zero compares unknowns and equations.
#pragma once

#include "courant/integrators/certificate/mobility.hpp"
#include "courant/integrators/certificate/natural_scaling.hpp"

namespace courant {

// The units of a search at its points, as its mobility asks for them: those of the largest Jacobian met so
// far, so that an unknown that is small by accident does not look like a large unit; but where there are
// exponentials those of each point.
class SearchUnits {
 public:
  // At the point y where a search begins. `nominal`: sizes of the unknowns; `at`: the map at y. The mobility has to
  // outlive the units.
  SearchUnits(const LinearizableMap& map, const Mobility& mobility, const VectorXd& y,
              const VectorXd& nominal, const Linearization& at);

  // At the next point.
  NaturalScaling operator()(const Linearization& at, const VectorXd& nominal);

 private:
  void keep_exponentials_here(const Linearization& at);

  const Mobility& mobility_;
  SparseMatrixXd magnitude_;
};

// `units`, smaller where a step by one of them would change a derivative to more than 1000 times the largest one
// of its equation: an exponential leads out of the range of numbers, when a unit is what a diode blocks by.
NaturalScaling with_step_limits(NaturalScaling units, const LinearizableMap& map, const VectorXd& y,
                                const Linearization& at, const Mobility& mobility);

}  // namespace courant
