#include "courant/core/expressions/host.hpp"

#include <cstdlib>

namespace courant {

std::string environment_variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

}  // namespace courant
