#include "courant/integrators/methods/constrain_first_functions.hpp"

#include <stdexcept>

#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/integrators/methods/constrain_first_trace.hpp"
#include "courant/integrators/step/round_off_projection.hpp"
#include "courant/integrators/step/transported_frame.hpp"

namespace courant {

ConstrainFirstFunctions::ConstrainFirstFunctions(ConstrainFirstScheme of, const Backend& chosen)
    : scheme(std::move(of)) {
  const Manifold& M = scheme.manifold();
  const ConstrainFirstTrace trace(scheme);
  omitted = trace.omitted;
  held_z = trace.held_z;
  const Backend backend = chosen.together();
  const Function::Options compiled = {.backend = backend};
  blocks = trace.blocks;
  auxiliaries = trace.auxiliaries;
  equations = trace.step.compile(backend);
  whole = trace.step.followed(equations);
  advance = Function("advance", trace.step.inputs, trace.advanced, compiled);
  projection = trace.projection.compile(backend);
  projected = Function("projected", trace.projection.inputs, trace.projected, compiled);
  if (engine_of(backend) && trace.redundant.size() > 0)
    throw std::invalid_argument(
        "ConstrainFirst::ConstrainFirst: the system has equations that follow from others, which "
        "steps may have to be solved with by least squares; the engine solves as many equations as "
        "unknowns.");
  redundant = Function("redundant equations", trace.projection.inputs, trace.redundant,
                       {.differentiate = {"y"}, .backend = backend});
  shift = Function("shift", {{"near", trace.near}, {"s", trace.s}}, trace.shifted, compiled);
  corrected_shift = Function(
      "corrected shift", {{"near", trace.near}, {"s", trace.s}, {"x0", trace.x0}, {"x", trace.x}},
      trace.corrected, compiled);
  conormals = {trace.conormals(), scheme.has_fixed_directions() ? Backend::interpreter : backend};
  if (!scheme.has_fixed_directions()) {
    MatrixXd normals = scheme.ladder->conormals().transpose();
    if (const VectorXd sizes = scheme.projector->conormal_sizes(); sizes.size() > 0)
      normals = (sizes.cwiseInverse().asDiagonal() * normals).eval();
    references = TransportedConormals::references(orthonormalized(normals));
    span =
        Function("directions", scheme.projector->span_formulas(M, scheme.codimension()), compiled);
  }
  basis = TransportedFrame::projection(M, backend);
  constraint = RoundOffProjection::constraint(M, backend);
  backend.compile();
}

}  // namespace courant
