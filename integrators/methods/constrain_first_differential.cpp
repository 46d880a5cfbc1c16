#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <tuple>

#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/numbers/central_difference.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/methods/constrain_first_functions.hpp"
#include "courant/integrators/step/conormal_turning.hpp"
#include "courant/integrators/step/vector_field_differential.hpp"

namespace courant {
namespace {

// On curved spaces W along a curve is differentiated by differences of order 8 with this part of the point's size, which
// leaves about 1e-12 of W. It is multiplied by the distance of a step from M_f, O(h²) or less.
constexpr double kDifferenceOfW = 1e-2;
// Next to the point, a distance from M_f that is round-off: W does not matter there.
constexpr double kOnConstraints = 1e-15;
// Directions along the constraints are so up to this part of their size.
constexpr double kAlongConstraints = 1e-6;

}  // namespace

// With the field X of S_f the step is x₀ ↤ x̄ ↦ x₁, maps between points of M_f:
//
//   x̄ ↦ R_d^±(x̄, h X(x̄)) = y^±,   x₀ = P(y⁻),   x₁ = P(y⁺)
//
// so TΦ_h = T(P R_d⁺ hX) (T(P R_d⁻ hX))⁻¹ on T_{x̄}M_f. P(y) is the x ∈ M_f with R_x(B W(x) μ) = y:
//
//   δy = ∂R/∂x δx + ∂R/∂s (B ∂(Wμ)/∂x δx + B W δμ),   δx ∈ T_xM_f
class ConstrainFirst::Differential final : public StepDifferential {
 public:
  explicit Differential(std::shared_ptr<const ConstrainFirstFunctions> functions)
      : functions_(std::move(functions)),
        scheme_(functions_->scheme),
        M_(scheme_.manifold()),
        field_(scheme_.system, *scheme_.ladder, Backend::interpreter),
        differential_(field_.formulas()) {
    Graph graph;
    const ExprVector x = graph.variables("x", M_.ambient_dimension());
    const ExprVector w = graph.variables("w", M_.tangent_dimension());
    const ExprVector tangent = M_.tangent_projector(x) * w;
    const auto ends = scheme_.map->forward(x, tangent);
    const Function::Options by_both = {.differentiate = {"x", "w"}};
    first_ = Function("R-", {{"x", x}, {"w", w}}, ends.first, by_both);
    second_ = Function("R+", {{"x", x}, {"w", w}}, ends.second, by_both);
    retraction_ = Function("R", {{"x", x}, {"w", w}}, M_.retract(x, tangent), by_both);
    if (scheme_.codimension() == 0 || scheme_.fixed_directions.size() > 0 ||
        field_.formulas().inputs[2].variables.size() > 0)
      return;
    conormal_turning_.emplace(field_.formulas());
    if (functions_->span.output_size() == 0) return;
    const auto span = scheme_.projector->span_formulas(M_, scheme_.codimension());
    span_ = Function("directions", span, {.differentiate = {"x", "C"}});
  }

 private:
  MatrixXd do_images(const Step& step, const MatrixXd& V) const override {
    const Ends at = ends(step);
    const MatrixXd along = at.coordinates * V;
    if ((at.velocities * along - V).norm() > kAlongConstraints * V.norm())
      throw std::domain_error(
          "ConstrainFirst: no step begins in a given direction; expected directions along the "
          "constraints.");
    return at.to_end *
           implicit_derivative("ConstrainFirst", at.to_start, -along, at.to_start.cols());
  }

  MatrixXd do_pull_back(const Step& step, const MatrixXd& Lambda) const override {
    const Ends at = ends(step);
    return -at.coordinates.transpose() * implicit_adjoint("ConstrainFirst", at.to_start,
                                                          at.to_end.transpose() * Lambda,
                                                          at.to_start.cols());
  }

  // What the directions of T_{x̄}M_f lead to: in a basis of T_{x₀}M_f, where coordinates that are constant, as at rest or on
  // an axis, are no equations; and as ambient velocities at x₁.
  struct Ends {
    MatrixXd to_start, to_end;
    MatrixXd velocities, coordinates;  // of that basis: as ambient velocities, and back
  };
  Ends ends(const Step& step) const {
    const State& stage = step.stage;
    const Site at = site(stage);
    const MatrixXd tangent = at.velocities;
    const MatrixXd displaced =
        step.h * differential_(place(stage.x, stage.t, at.evaluation), tangent).v;
    const auto moved = [&](const Function& end) {
      const MatrixXd J = end.jacobian({stage.x, VectorXd(step.h * stage.v)});
      return MatrixXd(J.leftCols(stage.x.size()) * tangent +
                      J.rightCols(displaced.rows()) * displaced);
    };
    const VectorXd w = step.h * stage.v;
    const Site start = site(step.before);
    Ends result;
    result.velocities = start.velocities;
    result.coordinates =
        start.directions.transpose() *
        (start.evaluation.basis().matrix().transpose() * M_.coframe(step.before.x).matrix());
    result.to_start =
        result.coordinates * projected(step.before, start, first_({stage.x, w}), moved(first_));
    result.to_end = projected(step.after, site(step.after), second_({stage.x, w}), moved(second_));
    return result;
  }

  // A point of M_f with its tangent and conormal directions.
  struct Site {
    VectorField::Evaluation evaluation;
    MatrixXd directions;  // T_xM_f in the basis of the evaluation
    MatrixXd conormals;   // its annihilator
    MatrixXd velocities;  // the same as ambient velocities
  };
  Site site(const State& state) const {
    Site at{VectorField::Evaluation(field_), {}, {}, {}};
    VectorXd rate(state.x.size());
    at.evaluation(state, rate);
    std::tie(at.directions, at.conormals) =
        differential_.split(place(state.x, state.t, at.evaluation), scheme_.codimension());
    at.velocities = (M_.frame(state.x) * at.evaluation.basis()).matrix() * at.directions;
    return at;
  }
  static VectorFieldDifferential::Place place(const VectorXd& x, double t,
                                              const VectorField::Evaluation& evaluation) {
    return {x, t, evaluation.unknowns(), evaluation.basis()};
  }

  // W at a point, as tangent vectors (Ñ × d).
  MatrixXd projection_directions(const VectorXd& x, double t, const Site& at) const {
    const LinearMap<double>& B = at.evaluation.basis();
    const MatrixXd basis = B.matrix();
    if (scheme_.fixed_directions.size() > 0) return basis * scheme_.fixed_directions;
    const MatrixXd& C = at.conormals;
    MatrixXd V = C;
    MatrixXd sized = C;
    if (const VectorXd sizes = scheme_.projector->conormal_sizes(); sizes.size() > 0)
      sized = sizes.cwiseInverse().asDiagonal() * C;
    if (functions_->span.output_size() > 0)
      V = functions_->span({x, B.entries().reshaped(), sized.reshaped(), VectorXd::Constant(1, t)})
              .reshaped(C.rows(), C.cols());
    return basis * scheme_.projector->orthonormal_directions(V, B, C);
  }

  // T P: images in T_xM_f, at the state, of ambient velocities at y, which P takes to its x.
  MatrixXd projected(const State& state, const Site& at, const VectorXd& y,
                     const MatrixXd& velocities) const {
    if (scheme_.codimension() == 0) return velocities;
    const VectorXd shift = M_.inverse_retract(state.x, y);
    const MatrixXd R = retraction_.jacobian({state.x, shift});
    const auto by_point = R.leftCols(state.x.size());
    const auto by_shift = R.rightCols(shift.size());
    const MatrixXd W = projection_directions(state.x, state.t, at);
    MatrixXd A(y.size(), at.velocities.cols() + W.cols());
    A << by_point * at.velocities + by_shift * turning(state, at, shift), by_shift * W;
    return at.velocities * implicit_derivative("ConstrainFirst", A, -velocities, A.cols())
                               .topRows(at.velocities.cols());
  }

  // How W(x) μ = shift changes along T_xM_f, up to what lies in W itself, which δμ makes up for: (Ñ × k).
  MatrixXd turning(const State& state, const Site& at, const VectorXd& shift) const {
    MatrixXd result = MatrixXd::Zero(shift.size(), at.directions.cols());
    const double size = state.x.lpNorm<Eigen::Infinity>();
    if (scheme_.fixed_directions.size() > 0 ||
        shift.lpNorm<Eigen::Infinity>() <= kOnConstraints * size)
      return result;
    if (conormal_turning_) return exact_turning(state, at, shift);
    const MatrixXd along = at.evaluation.basis().matrix() * at.directions;
    const auto in_W = [&](const VectorXd& direction) -> VectorXd {
      State moved = state;
      moved.x = M_.retract(state.x, direction);
      const MatrixXd W = projection_directions(moved.x, moved.t, site(moved));
      return W * (W.transpose() * shift);
    };
    for (Index k = 0; k < along.cols(); ++k) {
      const double step = kDifferenceOfW * (size > 0.0 ? size : 1.0);
      add_central_difference([&](double s) { return in_W(s * along.col(k)); }, step, result.col(k));
    }
    return result;
  }

  // The same where tangent vectors are dx/dt: of W μ = V(x, C) m, with V linear in the conormals C, along with α = C m.
  MatrixXd exact_turning(const State& state, const Site& at, const VectorXd& shift) const {
    const auto here = place(state.x, state.t, at.evaluation);
    if (functions_->span.output_size() == 0)
      return (*conormal_turning_)(here, shift, at.directions);
    const MatrixXd& C = at.conormals;
    const Index n = C.rows(), d = C.cols(), N = state.x.size();
    VectorXd sizes = scheme_.projector->conormal_sizes();
    if (sizes.size() == 0) sizes = VectorXd::Ones(n);
    const MatrixXd sized = sizes.cwiseInverse().asDiagonal() * C;
    const std::array<VectorXd, 4> in = {state.x, at.evaluation.basis().entries().reshaped(),
                                        sized.reshaped(), VectorXd::Constant(1, state.t)};
    const MatrixXd V = span_(in).reshaped(n, d);
    const MatrixXd J = span_.jacobian(in);
    const VectorXd m = CompleteOrthogonalDecomposition(V).solve(shift);
    const MatrixXd turned = (*conormal_turning_)(here, C * m, at.directions);
    MatrixXd result(n, at.directions.cols());
    for (Index k = 0; k < result.cols(); ++k) {
      const MatrixXd conormals =
          sizes.cwiseInverse().cwiseProduct(turned.col(k)) * m.transpose() / m.squaredNorm();
      const VectorXd change =
          J.leftCols(N) * at.directions.col(k) + J.rightCols(n * d) * conormals.reshaped();
      result.col(k) = change.reshaped(n, d) * m;
    }
    return result;
  }

  std::shared_ptr<const ConstrainFirstFunctions> functions_;
  const ConstrainFirstScheme& scheme_;
  const Manifold& M_;
  VectorField field_;
  VectorFieldDifferential differential_;
  Function first_, second_, retraction_;  // x, w ↦ R_d⁻, R_d⁺, R, with Jacobian by both
  std::optional<ConormalTurning> conormal_turning_;  // not on curved spaces
  Function span_;  // of the method, with Jacobian by the point and the conormals
};

std::shared_ptr<const StepDifferential> ConstrainFirst::do_differential() const {
  if (functions_->scheme.gauge_dimension() > 0)
    throw std::domain_error(
        "ConstrainFirst::differential: with gauge freedom a step depends on the steps before; "
        "expected a regular system.");
  return std::make_shared<Differential>(functions_);
}

}  // namespace courant
