#include "courant/integrators/ladder/prolongation.hpp"

#include <stdexcept>
#include <string>

namespace courant {

Index Prolongation::level_of(const VectorXd& y) const {
  const Index block = base_size_ + auxiliary_size_;
  const Index blocks = block == 0 ? 1 : (y.size() - base_size_) / block;
  if (blocks < 1 || y.size() != base_size_ + blocks * block)
    throw std::invalid_argument(
        "Prolongation::level_of: y has " + std::to_string(y.size()) +
        " entries; expected n + (k+1)(n+m) with n = " + std::to_string(base_size_) +
        ", m = " + std::to_string(auxiliary_size_) + ".");
  return blocks - 1;
}

}  // namespace courant
