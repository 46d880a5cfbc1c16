#include "courant/integrators/maps/laws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"
#include "courant/core/words/message.hpp"
#include "courant/integrators/maps/inversion.hpp"
#include "courant/integrators/maps/one_step.hpp"
#include "courant/integrators/maps/symplecticity.hpp"
#include "courant/manifolds/measurement.hpp"

namespace courant {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

class DiscretizationMapLaws {
 public:
  DiscretizationMapLaws(const DiscretizationMap& map, const LawOptions& options)
      : map_(map),
        M_(*map.manifold()),
        generator_(options.seed),
        samples_(draw_samples(M_, options.points, 1.0, generator_, map.domain_radius())) {
    if (map.is_symplectic().has_value() &&
        std::dynamic_pointer_cast<const CotangentBundle>(map.manifold()))
      symplecticity_.emplace(map);
  }

  std::vector<LawResult> run() {
    std::vector<LawResult> results = {
        zero_section(),  difference_to_first_order(), stays_on(), left_inverse(),
        right_inverse(), derivatives_of_forward(),    order(),    symmetry(),
        stage_time()};
    if (map_.has_inverse()) results.push_back(derivatives_of_inverse());
    if (map_.has_start()) results.push_back(from_start());
    if (map_.is_symplectic().has_value()) results.push_back(symplectic());
    if (map_.is_left_invariant()) results.push_back(left_invariance());
    return results;
  }

  std::vector<LawResult> run_lift(const CotangentBundle& phase_space,
                                  const DiscretizationMap& base) {
    std::vector<LawResult> results = run();
    results.push_back(covers(phase_space, base));
    if (map_.has_inverse()) results.push_back(inverse_symplectic());
    return results;
  }

 private:
  LawMeasurement law(const std::string& text, double bound) const {
    return LawMeasurement(map_.name() + " on " + M_.name(), text, bound);
  }

  // map_.inverse, traced once where it is found by Newton's method.
  DiscretizationMap::TangentVector<double> inverse(const VectorXd& x0, const VectorXd& x1) {
    if (map_.has_inverse()) return map_.inverse(x0, x1);
    if (!inversion_) inversion_.emplace(map_);
    const auto [x, v] = (*inversion_)(x0, x1);
    return {x, v};
  }

  LawResult zero_section() const {
    auto measured = law("D1 R_d(x, 0) = (x, x)", 1e-12);
    for (const LawSample& s : samples_)
      measured.add(
          [&] {
            const auto [x0, x1] = map_.forward(s.x, VectorXd::Zero(M_.tangent_dimension()));
            return (M_.separation(x0, s.x) + M_.separation(x1, s.x)) / (1.0 + s.x.norm());
          },
          describe("x", s.x));
    return measured.result();
  }

  LawResult difference_to_first_order() const {
    auto measured = law("D2 d/ds (R⁺ - R⁻)(x, s v) = E(x) v at s = 0", 1e-11);
    for (const LawSample& s : samples_)
      measured.add(
          [&] {
            Graph graph;
            const ExprVector length = graph.variables("s", 1);
            const auto [x0, x1] =
                map_.forward(constants(s.x), ExprVector(length[0] * constants(s.w)));
            const ExprVector velocity = tangent(x1 - x0, length, ExprVector::Ones(1));
            const VectorXd expected = M_.frame(s.x) * s.w;
            return relative(values(substitute(velocity, length, ExprVector::Zero(1))) - expected,
                            expected);
          },
          describe(s, s.w));
    return measured.result();
  }

  LawResult stays_on() const {
    auto measured = law("D3 R⁻ and R⁺ lie on M", 1e-11);
    for_vectors(samples_, [&](const LawSample& s, const VectorXd& v) {
      measured.add(
          [&] {
            const auto [x0, x1] = map_.forward(s.x, v);
            return M_.point_defect(x0) / (1.0 + x0.squaredNorm()) +
                   M_.point_defect(x1) / (1.0 + x1.squaredNorm());
          },
          describe(s, v));
    });
    return measured.result();
  }

  LawResult left_inverse() {
    auto measured = law("D3 R_d⁻¹(R_d(x, v)) = (x, v)", 1e-9);
    for_vectors(samples_, [&](const LawSample& s, const VectorXd& v) {
      measured.add(
          [&] {
            const auto [x0, x1] = map_.forward(s.x, v);
            const auto [x, velocity] = inverse(x0, x1);
            return M_.separation(x, s.x) / (1.0 + s.x.norm()) + relative(velocity - v, v);
          },
          describe(s, v));
    });
    return measured.result();
  }

  // At pairs that were not made by the map.
  LawResult right_inverse() {
    auto measured = law("D3 R_d(R_d⁻¹(x₀, x₁)) = (x₀, x₁), R_d⁻¹(x₀, x₁) in TM", 1e-9);
    for (const LawSample& s : samples_)
      for (const double distance : {1e-8, 1e-4, 0.1 * std::min(1.0, s.radius)})
        measured.add(
            [&] {
              const VectorXd y = point_near(M_, s.x, distance, generator_);
              const auto [x, v] = inverse(s.x, y);
              const auto [x0, x1] = map_.forward(x, v);
              return (M_.separation(x0, s.x) + M_.separation(x1, y)) / (1.0 + s.x.norm()) +
                     M_.point_defect(x) / (1.0 + x.squaredNorm()) + M_.tangent_defect(x, v);
            },
            describe("x₀", s.x) + ", x₁ at distance " + number_text(distance));
    return measured.result();
  }

  // R_d(x̄, v) = (x₀, x₁), and v = w to first order: the slope of v - w (in the space around).
  LawResult from_start() const {
    auto measured = law("D5 R_d(from_start(x₀, w)) begins at x₀, ends where it says", 1e-10);
    for (const LawSample& s : samples_)
      for (const double length : {0.0, 1e-8, 1e-3, 0.3 * std::min(1.0, s.radius)})
        measured.add(
            [&] {
              const VectorXd w = length * s.w;
              const auto [x, v, end] = map_.from_start(constants(s.x), constants(w));
              const auto [x0, x1] = map_.forward(values(x), values(v));
              const double far = (values(v) - w).norm() / (length + 1e-12);
              return (M_.separation(x0, s.x) + M_.separation(x1, values(end))) /
                         (1.0 + s.x.norm()) +
                     (length < 1e-2 && far > 0.1 * (1.0 + s.x.norm()) ? kUnbounded : 0.0);
            },
            describe("x₀", s.x) + ", ‖w‖ = " + number_text(length));
    return measured.result();
  }

  LawResult derivatives(const std::string& text, const SampleCurve& curve) const {
    return measure_derivatives(law(text, 1e-7), M_, samples_, curve);
  }

  LawResult derivatives_of_forward() const {
    return derivatives("D3 derivatives of R_d are finite and right",
                       [&](const Expr& t, const ExprVector& x, const ExprVector& w,
                           const ExprVector& v, const ExprVector& u) {
                         const ExprVector moved = M_.retract(x, ExprVector(t * w));
                         const ExprVector velocity = M_.tangent_projector(moved) * (v + t * u);
                         const auto [x0, x1] = map_.forward(moved, velocity);
                         return joined(x0, x1);
                       });
  }

  LawResult derivatives_of_inverse() const {
    return derivatives("D3 derivatives of R_d⁻¹ are finite and right",
                       [&](const Expr& t, const ExprVector& x, const ExprVector& w,
                           const ExprVector& v, const ExprVector& u) {
                         const ExprVector x0 = M_.retract(x, ExprVector(t * w));
                         const ExprVector y = M_.retract(x, v);
                         const ExprVector velocity = M_.tangent_projector(y) * u;
                         const auto [z, dz] =
                             map_.inverse(x0, M_.retract(y, ExprVector(t * velocity)));
                         return joined(z, dz);
                       });
  }

  LawResult order() {
    auto measured = law("D4 measured order is order() = " + std::to_string(map_.order()), 0.15);
    for (const LawSample& s : samples_)
      measured.add(
          [&] {
            if (M_.dimension() == 0) return 0.0;
            // Several fields at once: the leading coefficient of one may happen to be small,
            // above all where n = 1.
            std::vector<OneStep> fields;
            for (int k = 0; k < 3; ++k) fields.emplace_back(map_, s.x, generator_);
            std::vector<double> steps, errors;
            for (double h = 0.02; steps.size() < 5; h /= 2) {
              steps.push_back(h);
              errors.push_back(0.0);
              for (const OneStep& field : fields)
                errors.back() = std::max(errors.back(), field.error(h));
            }
            const double floor = 1e-13 * (1.0 + s.x.norm());
            return std::abs(log_log_slope(steps, errors, floor) - 1.0 - map_.order());
          },
          describe("x", s.x));
    return measured.result();
  }

  // ‖R⁺(x, v) - R⁻(x, -v)‖
  double asymmetry(const VectorXd& x, const VectorXd& v) const {
    return M_.separation(map_.forward(x, v).second, map_.forward(x, -v).first);
  }

  LawResult symmetry() const {
    if (!map_.is_symmetric())
      return not_claimed("D4 not symmetric, as said", [&] {
        double largest = M_.dimension() == 0 ? kUnbounded : 0.0;
        for_vectors(samples_, [&](const LawSample& s, const VectorXd& v) {
          largest = std::max(largest, asymmetry(s.x, v));
        });
        return largest;
      });
    auto measured = law("D4 symmetric, as said: R⁺(x, v) = R⁻(x, -v)", 1e-11);
    for_vectors(samples_, [&](const LawSample& s, const VectorXd& v) {
      measured.add([&] { return asymmetry(s.x, v) / (1.0 + s.x.norm()); }, describe(s, v));
    });
    return measured.result();
  }

  // R⁻(x, s v) = x - s K v + O(s²): time, which is to go along as a coordinate of its own would,
  // has its stage where some coordinate has it, at an eigenvalue of K.
  LawResult stage_time() const {
    auto measured = law("D6 stage_time() is an eigenvalue of -d/ds R⁻(x, s v) at s = 0", 1e-11);
    for (const LawSample& s : samples_)
      measured.add(
          [&] {
            const Index n = M_.dimension();
            if (n == 0) return 0.0;
            const MatrixXd basis = M_.tangent_basis(s.x);
            Graph graph;
            const ExprVector xi = graph.variables("xi", n);
            const auto [x0, x1] = map_.forward(constants(s.x), ExprVector(constants(basis) * xi));
            const ExprVector entries = jacobian(x0, xi).dense().reshaped();
            const MatrixXd slope =
                values(substitute(entries, xi, ExprVector::Zero(n))).reshaped(x0.size(), n);
            const MatrixXd K = -(basis.transpose() * M_.coframe(s.x) * slope);
            const MatrixXd off = K - map_.stage_time() * MatrixXd::Identity(n, n);
            return singular_values(off)[n - 1];
          },
          describe("x", s.x));
    return measured.result();
  }

  // R_d(g x, v) = g R_d(x, v) without the multiplication of the group: the vectors from x to R⁻ and
  // from there to R⁺ are the same at every x (M9 of Manifold).
  LawResult left_invariance() const {
    auto measured = law("D7 left invariant, as said: R_d(g x, v) = g R_d(x, v)", 1e-10);
    const auto unit = M_.unit();
    if (!unit) {
      measured.add(kUnbounded, M_.name() + " is no group with left-trivialised vectors");
      return measured.result();
    }
    const auto seen_from = [&](const VectorXd& x, const VectorXd& v) {
      const auto [x0, x1] = map_.forward(x, v);
      VectorXd seen(2 * v.size());
      seen << M_.inverse_retract(x, x0), M_.inverse_retract(x0, x1);
      return seen;
    };
    for (const LawSample& s : samples_)
      for (const double length : {1e-4, 0.4 * std::min(1.0, s.radius)})
        measured.add(
            [&] {
              const VectorXd v = length * s.w, there = seen_from(*unit, v);
              return relative(seen_from(s.x, v) - there, there);
            },
            describe(s, length * s.w));
    return measured.result();
  }

  // A property that is denied must be seen to fail: the defect is how far it stays below 1e-6.
  LawResult not_claimed(const std::string& text, const std::function<double()>& violation) const {
    auto measured = law(text, 0.0);
    measured.add([&] { return std::max(0.0, 1e-6 - violation()); }, "all samples");
    return measured.result();
  }

  LawResult symplectic() {
    if (!symplecticity_) {
      auto measured = law("D4 is_symplectic() is claimed off a cotangent bundle", 0.0);
      measured.add(kUnbounded, M_.name());
      return measured.result();
    }
    if (!*map_.is_symplectic())
      return not_claimed("D4 not symplectic, as said", [&] {
        double largest = 0.0;
        for_vectors(samples_, [&](const LawSample& s, const VectorXd& v) {
          largest = std::max(largest, symplecticity_->defect(s.x, v, generator_));
        });
        return largest;
      });
    auto measured = law("D4 symplectic, as said: R_d pulls Ω₁₂ back to d_Tω_Q", 1e-11);
    for_vectors(samples_, [&](const LawSample& s, const VectorXd& v) {
      measured.add([&] { return symplecticity_->defect(s.x, v, generator_); }, describe(s, v));
    });
    return measured.result();
  }

  LawResult inverse_symplectic() {
    auto measured = law("L2 R_d⁻¹ pulls d_Tω_Q back to Ω₁₂", 1e-11);
    for_vectors(samples_, [&](const LawSample& s, const VectorXd& v) {
      measured.add(
          [&] {
            const auto [x0, x1] = map_.forward(s.x, v);
            return symplecticity_->inverse_defect(x0, x1, generator_);
          },
          describe(s, v));
    });
    return measured.result();
  }

  LawResult covers(const CotangentBundle& phase_space, const DiscretizationMap& base) const {
    auto measured = law("L1 covers the base map", 1e-13);
    for_vectors(samples_, [&](const LawSample& s, const VectorXd& v) {
      measured.add(
          [&] {
            const auto [x0, x1] = map_.forward(s.x, v);
            const auto [q0, q1] = base.forward(VectorXd(phase_space.position(s.x)),
                                               VectorXd(phase_space.horizontal(v)));
            return (phase_space.position(x0) - q0).norm() + (phase_space.position(x1) - q1).norm();
          },
          describe(s, v));
    });
    return measured.result();
  }

  const DiscretizationMap& map_;
  const Manifold& M_;
  mutable std::mt19937 generator_;
  std::vector<LawSample> samples_;
  std::optional<Symplecticity> symplecticity_;
  std::optional<Inversion> inversion_;
};

}  // namespace

std::vector<LawResult> check_discretization_map(const DiscretizationMap& map,
                                                const LawOptions& options) {
  return DiscretizationMapLaws(map, options).run();
}

std::vector<LawResult> check_cotangent_lift(const CotangentLift& lift, const LawOptions& options) {
  const auto& phase_space = dynamic_cast<const CotangentBundle&>(*lift.manifold());
  return DiscretizationMapLaws(lift, options).run_lift(phase_space, *lift.base());
}

}  // namespace courant
