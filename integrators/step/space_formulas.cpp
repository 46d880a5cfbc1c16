#include "courant/integrators/step/space_formulas.hpp"

#include "courant/integrators/step/round_off_projection.hpp"
#include "courant/integrators/step/transported_frame.hpp"

namespace courant {

SpaceFormulas::SpaceFormulas(const Manifold& M)
    : basis(TransportedFrame::formulas(M)), constraint(RoundOffProjection::formulas(M)) {}

}  // namespace courant
