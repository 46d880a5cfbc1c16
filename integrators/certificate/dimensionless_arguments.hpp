// What sines and exponentials are of.
#pragma once

#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// The arguments w of the functions of numbers in the equations of a system, sines, exponentials and the like, as
// functions of (x, v, z, t): numbers without a unit, of the size of 1.
class DimensionlessArguments {
 public:
  explicit DimensionlessArguments(const ImplicitSystem& system);

  // |∂w/∂y_j| at y = (x, v, z, t), for each w and j where it is neither 0 nor infinite.
  struct Slope {
    Index argument;
    Index unknown;  // j
    double size;
  };
  std::vector<Slope> slopes(const VectorXd& y) const;

 private:
  Function values_;
  bool are_there_ = false;
};

}  // namespace courant
