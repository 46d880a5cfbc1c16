#include "courant/integrators/step/parameter_projector.hpp"

#include <algorithm>
#include <stdexcept>

#include "courant/integrators/certificate/constraint_algorithm.hpp"

namespace courant {

ParameterProjector::ParameterProjector(std::shared_ptr<const Projector> projector,
                                       const ParameterExtension& extension)
    : Projector(projector ? projector->name()
                          : throw std::invalid_argument(
                                "ParameterProjector::ParameterProjector: the projector is null.")),
      projector_(std::move(projector)),
      manifold_(extension.system()->manifold()),
      count_(extension.count()),
      at_(extension.parameters()) {}

// Of T_(x,θ)(M × Rᵖ) the part of T_xM, and of covectors there what they say at these parameters.
ExprMatrix ParameterProjector::do_directions(const ExprVector& x, const Expr& t,
                                             const LinearMap<Expr>& tangents,
                                             const ExprMatrix& conormals) const {
  const Index N = manifold_->ambient_dimension(), n = manifold_->tangent_dimension(),
              d = conormals.cols();
  ExprVector basis(0);
  if (!tangents.is_identity()) basis = tangents.entries().topLeftCorner(n, n).reshaped();
  const ExprVector C = conormals.topRows(n).reshaped();
  const ExprVector entries =
      at_({x.head(N), ExprVector::Constant(1, t), basis, C}, x.tail(count_),
          [&](const std::vector<ExprVector>& y) -> ExprVector {
            const LinearMap<Expr> of_point = y[2].size() == 0
                                                 ? LinearMap<Expr>::identity(n)
                                                 : LinearMap<Expr>(ExprMatrix(y[2].reshaped(n, n)));
            return projector_->span(y[0], y[1][0], of_point, ExprMatrix(y[3].reshaped(n, d)))
                .reshaped();
          });
  ExprMatrix moves = ExprMatrix::Zero(conormals.rows(), d);
  moves.topRows(n) = entries.reshaped(n, d);
  return moves;
}

ConstraintLadder extended_ladder(const ParameterExtension& extension, const State& point) {
  const State start = extension.to_extended(point);
  ConstraintLadder ladder = ConstraintAlgorithm().run(
      extension.extended(), {.t = start.t, .x = start.x, .v = start.v, .z = start.z});
  auto& counts = ladder.differentiations;
  const auto first = counts.begin() + std::min<Index>(extension.first_rate(), std::ssize(counts));
  if (!counts.empty())
    std::fill_n(first, extension.count(), *std::max_element(counts.begin(), counts.end()));
  return ladder;
}

}  // namespace courant
