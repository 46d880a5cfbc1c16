// Methods in a time of their own: the key `transformation` of `time`.
#pragma once

#include "courant/reading/method_choice.hpp"
#include "courant/reading/written_formula.hpp"

namespace courant {

// The same choice with steps in τ, dt/dτ = `rate`, a formula of coordinates and t: a
// TransformedIntegrator. The transformation is the symplectic one where the method keeps a symplectic
// form and the system has one, else the plain one. Preparing it throws ExperimentError unless the rate is
// positive at the initial point, std::invalid_argument where the method cannot be had so.
MethodChoice in_transformed_time(MethodChoice choice, WrittenFormula rate);

// What a method is made of, for a setting in its own time, in another one, or with parameters as coordinates: the
// discretization map on the manifold of its system; a projector that leaves time and parameters as they are; and sizes
// of the Ñ components of tangent vectors, those that are given, else 1, but of time, which has none; empty for 1.
std::shared_ptr<const DiscretizationMap> map_at(const DiscretizationChoice& choice,
                                                const MethodSetting& at);
ProjectorChoice::Made projector_at(const ProjectorChoice& choice, const MethodSetting& at);
VectorXd units_at(const MethodSetting& at);
// A map of the system itself, on its manifold with the parameters.
std::shared_ptr<const DiscretizationMap> beside_parameters(
    std::shared_ptr<const DiscretizationMap> map, const MethodSetting& at);

}  // namespace courant
