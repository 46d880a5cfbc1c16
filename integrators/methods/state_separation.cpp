#include "courant/integrators/methods/state_separation.hpp"

#include "courant/structures/system_in_units.hpp"

namespace courant {

StateSeparation::StateSeparation(const Manifold& M, const Units* units, const VectorXd& x)
    : M_(M), units_(units), scale_(std::max(in_units(x).norm(), 1e-300)) {}

double StateSeparation::operator()(const State& a, const State& b) const {
  const double apart = units_ ? in_units(a.x - b.x).norm() : M_.separation(a.x, b.x);
  return apart / scale_;
}

VectorXd StateSeparation::in_units(const VectorXd& x) const {
  return units_ ? VectorXd(x.cwiseQuotient(units_->coordinates)) : x;
}

}  // namespace courant
