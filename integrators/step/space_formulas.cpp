#include "courant/integrators/step/space_formulas.hpp"

#include "courant/integrators/step/moving_basis.hpp"
#include "courant/integrators/step/round_off_projection.hpp"

namespace courant {

SpaceFormulas::SpaceFormulas(const Manifold& M)
    : basis(MovingBasis::formulas(M)), constraint(RoundOffProjection::formulas(M)) {}

}  // namespace courant
