#include "courant/core/solve/equation_engine.hpp"

namespace courant {

std::shared_ptr<const EquationEngine> engine_of(const Backend& backend) {
  return std::dynamic_pointer_cast<const EquationEngine>(backend.compiler());
}

}  // namespace courant
