// The branches of an implicit system.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "courant/structures/implicit_system.hpp"

namespace courant {

// Where the equations of a system, or what follows from them at a level of the constraint algorithm, are products, S is
// a union. A branch is the part on which these factors are 0.
struct Branch {
  Index level = 0;                     // at which its last product is seen
  std::vector<std::string> equations;  // f, each = 0, in the names of the system
  std::shared_ptr<const ImplicitSystem>
      system;  // S with these equations: the algorithm is restarted with it
};

// The branches of S, those of simple factors first, then in the order of coordinates, velocities and unknowns: numbers do
// not depend on a point. None where nothing is a product.
//
// Equations are solved for velocities and unknowns that have numbers for coefficients, and constraints are
// differentiated, as by hand (EquationReduction). At the first level at which there are products (factors of
// NormalForm), each smallest set of factors that has one of each product is a branch:
//
//   p y u = 0,  p y w = 0:   y = 0;   p = 0;   u = w = 0
//
// and what follows from each is looked at in the same way, so that branches may branch again. A sum of squares is no
// product, and a factor with time alone is none. Products of more than 100 terms when they are multiplied out, and those
// behind a division by what may vanish, are not seen. For up to 100 velocities and unknowns, 16 branches, four levels.
std::vector<Branch> branches(const std::shared_ptr<const ImplicitSystem>& system);

}  // namespace courant
