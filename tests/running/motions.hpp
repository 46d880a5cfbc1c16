// Motions in a potential on the nonlinear spaces, each with the symmetric maps that its space has.
#pragma once

#include <string>
#include <vector>

#include "courant/reading/json_reader.hpp"

namespace courant::test {

struct Motion {
  std::string space;
  Json experiment;
  std::vector<const char*> maps;
};

// Hamiltonian systems on cotangent bundles, and an equation on a tangent bundle.
const std::vector<Motion>& motions();

}  // namespace courant::test
