#include "courant/manifolds/laws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/words/message.hpp"
#include "courant/manifolds/measurement.hpp"

namespace courant {
namespace {

class ManifoldLaws {
 public:
  ManifoldLaws(const Manifold& M, const LawOptions& options)
      : M_(M),
        generator_(options.seed),
        samples_(draw_samples(M, options.points, 2.0, generator_)) {}

  std::vector<LawResult> run() {
    return {retracts_zero(),
            rigid_to_first_order(),
            remainder_is_quadratic(),
            stays_on(),
            radius(),
            left_inverse(),
            right_inverse(),
            frames(),
            frame_spans_tangents(),
            derivatives_of_retraction(),
            derivatives_of_inverse(),
            geodesics(),
            left_invariance(),
            velocities_along(),
            scaling_symmetries(),
            sources(),
            points_and_vectors()};
  }

 private:
  LawMeasurement law(const std::string& text, double bound) const {
    return LawMeasurement(M_.name(), text, bound);
  }

  LawResult retracts_zero() const {
    auto measured = law("M1 R(x, 0) = x", 1e-13);
    for (const LawSample& s : samples_)
      measured.add(
          [&] {
            const VectorXd zero = VectorXd::Zero(M_.tangent_dimension());
            return M_.separation(M_.retract(s.x, zero), s.x) / (1.0 + s.x.norm());
          },
          describe("x", s.x));
    return measured.result();
  }

  LawResult rigid_to_first_order() const {
    auto measured = law("M2 d/ds R(x, s v) = E(x) v at s = 0", 1e-12);
    for (const LawSample& s : samples_)
      measured.add(
          [&] {
            Graph graph;
            const ExprVector length = graph.variables("s", 1);
            const ExprVector curve =
                M_.retract(constants(s.x), ExprVector(length[0] * constants(s.w)));
            const ExprVector velocity = tangent(curve, length, ExprVector::Ones(1));
            const VectorXd expected = M_.frame(s.x) * s.w;
            return relative(values(substitute(velocity, length, ExprVector::Zero(1))) - expected,
                            expected);
          },
          describe(s, s.w));
    return measured.result();
  }

  LawResult remainder_is_quadratic() const {
    auto measured = law("M2 slope of R(x, s v) - x - s E(x) v is 2 (shortfall)", 0.15);
    for (const LawSample& s : samples_)
      measured.add(
          [&] {
            // Steps so small that a derivative wrong by 1e-3 outweighs the curvature.
            const VectorXd velocity = M_.frame(s.x) * s.w;
            std::vector<double> steps, errors;
            for (double step = 4e-4 * std::min(1.0, s.radius); steps.size() < 5; step /= 2) {
              const VectorXd v = step * s.w;
              steps.push_back(step);
              errors.push_back((M_.retract(s.x, v) - s.x - step * velocity).norm());
            }
            const double floor = 1e-13 * (1.0 + s.x.norm());
            return std::max(0.0, 2.0 - log_log_slope(steps, errors, floor));
          },
          describe(s, s.w));
    return measured.result();
  }

  LawResult stays_on() const {
    auto measured = law("M3 R(x, v) lies on M", 1e-12);
    for_vectors(samples_, [&](const LawSample& s, const VectorXd& v) {
      measured.add(
          [&] {
            const VectorXd y = M_.retract(s.x, v);
            return M_.point_defect(y) / (1.0 + y.squaredNorm());
          },
          describe(s, v));
    });
    return measured.result();
  }

  // Where nothing is said to bound the vectors, those that go round a sphere or a circle are tried.
  LawResult radius() {
    auto measured = law("M4 r(x) > 0; where r(x) = ∞, R⁻¹(x, R(x, v)) = v for long v", 1e-6);
    for (const LawSample& s : samples_)
      measured.add(
          [&] {
            const double radius = M_.injectivity_radius(s.x);
            if (!(radius > 0.0)) return std::numeric_limits<double>::infinity();
            double worst = 0.0;
            if (std::isinf(radius) && M_.dimension() > 0)
              for (const double length : {4.0, 8.0}) {
                const VectorXd v = M_.random_tangent(s.x, length, generator_);
                worst =
                    std::max(worst, relative(M_.inverse_retract(s.x, M_.retract(s.x, v)) - v, v));
              }
            return worst;
          },
          describe("x", s.x));
    return measured.result();
  }

  LawResult left_inverse() const {
    auto measured = law("M4 R⁻¹(x, R(x, v)) = v", 1e-10);
    for_vectors(samples_, [&](const LawSample& s, const VectorXd& v) {
      measured.add([&] { return relative(M_.inverse_retract(s.x, M_.retract(s.x, v)) - v, v); },
                   describe(s, v));
    });
    return measured.result();
  }

  // At points y that were not made by the retraction.
  LawResult right_inverse() {
    auto measured = law("M4 R(x, R⁻¹(x, y)) = y, R⁻¹(x, y) tangent at x", 1e-10);
    for (const LawSample& s : samples_)
      for (const double distance : {1e-8, 1e-4, 0.1 * std::min(1.0, s.radius)}) {
        measured.add(
            [&] {
              const VectorXd y = point_near(M_, s.x, distance, generator_);
              const VectorXd v = M_.inverse_retract(s.x, y);
              return M_.separation(M_.retract(s.x, v), y) / (1.0 + y.norm()) +
                     M_.tangent_defect(s.x, v);
            },
            describe("x", s.x) + ", y at distance " + number_text(distance));
      }
    return measured.result();
  }

  LawResult frames() const {
    auto measured = law("M5 C E C = C, E C E = E", 1e-12);
    for (const LawSample& s : samples_)
      measured.add(
          [&] {
            const MatrixXd E = M_.frame(s.x);
            const MatrixXd C = M_.coframe(s.x);
            return (C * E * C - C).norm() / (1.0 + C.norm()) +
                   (E * C * E - E).norm() / (1.0 + E.norm()) +
                   (C * E - M_.tangent_projector(s.x).matrix()).norm();
          },
          describe("x", s.x));
    return measured.result();
  }

  LawResult frame_spans_tangents() const {
    auto measured = law("M5 E(x) has range ker dc(x) of dimension n", 1e-11);
    for (const LawSample& s : samples_)
      measured.add(
          [&] {
            Graph graph;
            const ExprVector x = graph.variables("x", M_.ambient_dimension());
            const ExprVector c = M_.constraint(x);
            const Function constraint("constraint", {{"x", x}}, c, {.differentiate = {"x"}});
            const MatrixXd d_constraint = constraint.jacobian({s.x});
            const MatrixXd E = M_.frame(s.x);
            if (rank(E) != M_.dimension() ||
                rank(d_constraint) != M_.ambient_dimension() - M_.dimension())
              return std::numeric_limits<double>::infinity();
            return (d_constraint * E).norm() / (1.0 + d_constraint.norm() * E.norm());
          },
          describe("x", s.x));
    return measured.result();
  }

  static Index rank(const MatrixXd& A) {
    if (A.size() == 0) return 0;
    // Frames and constraints are well conditioned at random points: 1e-8 is far from both sides.
    return CompleteOrthogonalDecomposition(A, 2e-11).rank();
  }

  // x(t) = R_x(t w), v(t) = Π(x(t)) (v + t u)
  struct Motion {
    ExprVector x, v;
  };
  Motion motion(const Expr& t, const ExprVector& x, const ExprVector& w, const ExprVector& v,
                const ExprVector& u) const {
    const ExprVector moved = M_.retract(x, ExprVector(t * w));
    return {moved, M_.tangent_projector(moved) * (v + t * u)};
  }

  LawResult derivatives(const std::string& text, const SampleCurve& curve) const {
    return measure_derivatives(law(text, 1e-8), M_, samples_, curve);
  }

  LawResult derivatives_of_retraction() const {
    return derivatives("M6 derivatives of R, E, C, c are finite and right",
                       [&](const Expr& t, const ExprVector& x, const ExprVector& w,
                           const ExprVector& v, const ExprVector& u) {
                         const Motion moved = motion(t, x, w, v, u);
                         const ExprVector y = M_.retract(moved.x, moved.v);
                         const ExprMatrix E = M_.frame(moved.x);
                         const ExprMatrix C = M_.coframe(moved.x);
                         const ExprVector c = M_.constraint(moved.x);
                         ExprVector result(y.size() + E.size() + C.size() + c.size());
                         result << y, E.reshaped(), C.reshaped(), c;
                         return result;
                       });
  }

  // x and y = R(x, v) move independently, across each other where v is small.
  LawResult derivatives_of_inverse() const {
    const std::string text = "M6 derivatives of R⁻¹ are finite and right";
    if (!M_.has_inverse()) {
      auto measured = law(text + " (no closed formula: nothing to differentiate)", 0.0);
      measured.add(0.0, "");
      return measured.result();
    }
    return derivatives(text, [&](const Expr& t, const ExprVector& x, const ExprVector& w,
                                 const ExprVector& v, const ExprVector& u) {
      const ExprVector moved_x = M_.retract(x, ExprVector(t * w));
      const ExprVector y = M_.retract(x, v);
      const ExprVector velocity = M_.tangent_projector(y) * u;
      return M_.inverse_retract(moved_x, M_.retract(y, ExprVector(t * velocity)));
    });
  }

  LawResult geodesics() const {
    if (!M_.is_geodesic()) {
      auto measured = law("M7 is_geodesic() is not claimed", 0.0);
      measured.add(0.0, "");
      return measured.result();
    }
    auto measured =
        law("M7 is_geodesic(): seen from R(x, s v), x and R(x, v) lie along one vector", 1e-10);
    for_vectors(samples_, [&](const LawSample& s, const VectorXd& v) {
      for (const double along : {0.25, 0.5, 0.8})
        measured.add(
            [&] {
              const VectorXd m = M_.retract(s.x, VectorXd(along * v));
              const VectorXd back = M_.inverse_retract(m, s.x);
              const VectorXd ahead = M_.inverse_retract(m, M_.retract(s.x, v));
              return relative((1.0 - along) * back + along * ahead, ahead);
            },
            describe(s, v));
    });
    return measured.result();
  }

  LawResult left_invariance() const {
    const auto unit = M_.unit();
    if (!unit) {
      auto measured = law("M9 unit() is not claimed", 0.0);
      measured.add(0.0, "");
      return measured.result();
    }
    auto measured = law("M9 R⁻¹(R(x, v), R(x, w)) is the same at x and at unit()", 1e-10);
    for (const LawSample& s : samples_)
      for (const double length : {1e-4, 0.3 * std::min(1.0, s.radius)})
        measured.add(
            [&] {
              const VectorXd v = length * s.w, w = 0.5 * length * s.u;
              const auto seen = [&](const VectorXd& x) {
                return M_.inverse_retract(M_.retract(x, v), M_.retract(x, w));
              };
              return M_.point_defect(*unit) + relative(seen(s.x) - seen(*unit), seen(s.x));
            },
            describe("x", s.x));
    return measured.result();
  }

  // With factors that differ for all of them.
  LawResult scaling_symmetries() const {
    const Manifold::ScalingSymmetries units = M_.scaling_symmetries();
    if (Manifold::ScalingSymmetries::after(units.point) == 0) {
      auto measured = law("M11 scaling_symmetries() are not claimed", 0.0);
      measured.add(0.0, "");
      return measured.result();
    }
    const auto factors = [](const std::vector<Index>& of) {
      VectorXd result(std::ssize(of));
      for (std::size_t i = 0; i < of.size(); ++i)
        result[static_cast<Index>(i)] = of[i] == Manifold::ScalingSymmetries::none
                                            ? 1.0
                                            : 2.0 + 0.3 * static_cast<double>(of[i]);
      return result;
    };
    const VectorXd d = factors(units.point), d_v = factors(units.tangent);
    auto measured = law("M11 R(D x, D v) = D R(x, v) for scaling symmetries D", 1e-12);
    for_vectors(samples_, [&](const LawSample& s, const VectorXd& v) {
      measured.add(
          [&] {
            const VectorXd x = d.cwiseProduct(s.x), w = d_v.cwiseProduct(v);
            const VectorXd expected = d.cwiseProduct(M_.retract(s.x, v));
            return M_.point_defect(x) +
                   M_.separation(M_.retract(x, w), expected) / (1.0 + expected.norm());
          },
          describe(s, v));
    });
    return measured.result();
  }

  LawResult sources() const {
    if (!M_.has_source()) {
      auto measured = law("M12 has_source() is not claimed", 0.0);
      measured.add(0.0, "");
      return measured.result();
    }
    auto measured = law("M12 R(source(y, v), v) = y", 1e-12);
    for_vectors(samples_, [&](const LawSample& s, const VectorXd& v) {
      measured.add(
          [&] {
            const VectorXd x = M_.source(s.x, v);
            return M_.point_defect(x) / (1.0 + x.squaredNorm()) +
                   M_.separation(M_.retract(x, v), s.x) / (1.0 + x.norm() + s.x.norm());
          },
          describe(s, v));
    });
    return measured.result();
  }

  LawResult velocities_along() const {
    auto measured = law("M10 velocity_along(x, v, s) = C(y) dy/ds of y = R(x, s v)", 1e-11);
    for_vectors(samples_, [&](const LawSample& s, const VectorXd& v) {
      for (const double along : {0.0, 0.4, 1.0})
        measured.add(
            [&] {
              Graph graph;
              const ExprVector length = graph.variables("s", 1);
              const ExprVector x = constants(s.x), w = constants(v);
              const ExprVector curve = M_.retract(x, ExprVector(length[0] * w));
              const ExprVector velocity =
                  M_.coframe(curve) * tangent(curve, length, ExprVector::Ones(1));
              const auto here = [&](const ExprVector& formula) {
                return values(substitute(formula, length, ExprVector::Constant(1, along)));
              };
              const VectorXd expected = here(velocity);
              return relative(here(M_.velocity_along(x, w, length[0])) - expected, expected);
            },
            describe(s, v));
    });
    return measured.result();
  }

  LawResult points_and_vectors() const {
    auto measured = law("M8 random points are on M, project keeps them, bases are tangent", 1e-12);
    for (const LawSample& s : samples_)
      measured.add(
          [&] {
            const MatrixXd B = M_.tangent_basis(s.x);
            const MatrixXd one = MatrixXd::Identity(M_.dimension(), M_.dimension());
            return M_.point_defect(s.x) / (1.0 + s.x.squaredNorm()) +
                   (M_.project(s.x) - s.x).norm() / (1.0 + s.x.norm()) +
                   (B.transpose() * B - one).norm() + (M_.tangent_projector(s.x) * B - B).norm() +
                   M_.separation(s.x, s.x) + M_.tangent_defect(s.x, s.w);
          },
          describe("x", s.x));
    return measured.result();
  }

  const Manifold& M_;
  std::mt19937 generator_;
  std::vector<LawSample> samples_;
};

}  // namespace

std::vector<LawResult> check_manifold(const Manifold& manifold, const LawOptions& options) {
  try {
    return ManifoldLaws(manifold, options).run();
  } catch (const std::exception& error) {
    LawMeasurement measured(manifold.name(), "random points and vectors exist", 0.0);
    measured.add(std::numeric_limits<double>::infinity(), without_place(error.what()));
    return {measured.result()};
  }
}

}  // namespace courant
