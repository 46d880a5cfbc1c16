#include "courant/integrators/methods/discretize_first.hpp"

namespace courant {

DiscretizeFirst::DiscretizeFirst(std::shared_ptr<const ImplicitSystem> system,
                                 std::shared_ptr<const DiscretizationMap> map,
                                 const Options& options)
    : Integrator(std::move(system)),
      step_(
          name(), this->system(), std::move(map),
          [S = this->system()](const StageStep::Stage& at) {
            return StageStep::Equations{S->residual(at.x, at.v, at.z, at.t)};
          },
          options.backend) {}

}  // namespace courant
