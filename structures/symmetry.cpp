#include "courant/structures/symmetry.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/solve/gauss_newton.hpp"
#include "courant/core/words/message.hpp"
#include "courant/manifolds/measurement.hpp"
#include "courant/structures/canonical_symplectic.hpp"

namespace courant {

Symmetry::Symmetry(std::shared_ptr<const CotangentBundle> phase_space, Field field)
    : phase_space_(std::move(phase_space)), field_(std::move(field)) {
  if (!phase_space_ || !field_)
    throw std::invalid_argument(
        "Symmetry::Symmetry: the phase space or the field is missing; expected both.");
}

ExprVector Symmetry::field(const ExprVector& q) const {
  ExprVector xi = field_(q);
  if (xi.size() != q.size())
    throw std::invalid_argument(
        "Symmetry: the field has " + std::to_string(xi.size()) +
        " entries; expected ambient_dimension() = " + std::to_string(q.size()) + ".");
  return xi;
}

Expr Symmetry::momentum(const ExprVector& x) const {
  const ExprVector q = phase_space_->position(x);
  const ExprVector p = phase_space_->momentum(x);
  return p.dot(phase_space_->base()->coframe(q) * field(q));
}

ExprVector Symmetry::differential(const ExprVector& x) const {
  return Hamiltonian(phase_space_, [this](const ExprVector& y, const Expr&) { return momentum(y); })
      .differential(x, ExprVector(0), Expr(0.0));
}

// By the equations of the graph of ω_Q at (0, dJ), which are affine in X with the matrix
// ((1, 0), (⟨p, T(·, ·)⟩, 1)).
ExprVector Symmetry::lift(const ExprVector& x) const {
  const CanonicalSymplectic graph(phase_space_);
  const Index n = phase_space_->base()->tangent_dimension();
  const ExprVector dJ = differential(x);
  ExprVector X = ExprVector::Zero(2 * n);
  X.head(n) = dJ.tail(n);
  X.tail(n) = -graph.membership(x, X, dJ, ExprVector(0)).tail(n);
  return X;
}

namespace {

// A sum, and the sum of the sizes of its terms.
struct Sum {
  Expr value = 0.0, size = 0.0;
  void add(const ExprVector& a, const ExprVector& b) {
    for (Index i = 0; i < a.size(); ++i) {
      const Expr term = a[i] * b[i];
      value += term;
      size += abs(term);
    }
  }
};

// Relative sizes of what is no invariance: rounding of sums of some hundred terms is 1e-14.
constexpr double kBound = 1e-9;
// A sum that is nothing but round-off of the energy is no change of it.
constexpr double kEnergyRoundOff = 1e-14;

// The measured functions of (x, λ, t), and the points where they are measured.
class Measurement {
 public:
  Measurement(const DiracSystem& system, const Symmetry& symmetry, const State& start)
      : system_(system), manifold_(*system.manifold()), k_(system.family()->parameter_size()) {
    const CotangentBundle& T = *symmetry.phase_space();
    const Manifold& Q = *T.base();
    Graph graph;
    const ExprVector x = graph.variables("x", manifold_.ambient_dimension());
    const ExprVector lambda = graph.variables("lambda", k_), t = graph.variables("t", 1);
    const ExprVector alpha = system.family()->differential(x, lambda, t[0]);
    const ExprVector stationarity = system.family()->stationarity(x, lambda, t[0]);
    const ExprVector X = symmetry.lift(x), dJ = symmetry.differential(x);
    std::vector<Expr> outputs;
    const auto add = [&](const Sum& sum) {
      outputs.push_back(sum.value);
      outputs.push_back(sum.size);
    };

    const ExprVector q = T.position(x), xi = symmetry.field(q);
    const ExprVector normal = xi - Q.frame(q) * (Q.coframe(q) * xi).eval();
    Expr off = 0.0, length = 0.0;
    for (Index i = 0; i < xi.size(); ++i) {
      off = max(off, abs(normal[i]));
      length = max(length, abs(xi[i]));
    }
    add({off, length});

    Sum energy;
    energy.add(alpha, X);
    energy.size += kEnergyRoundOff / kBound * abs(system.family()->value(x, lambda, t[0]));
    add(energy);

    const auto equations = static_cast<std::size_t>(system.structure()->equation_count());
    const ExprVector motion = manifold_.frame(x) * X;
    for (Index b = 0; b < k_; ++b) {
      const ExprVector phi = stationarity.segment(b, 1);
      if (depends(phi, lambda)) continue;
      constraints_.push_back(system.names().equations[equations + static_cast<std::size_t>(b)]);
      Sum change;
      change.add(gradient(phi[0], x), motion);
      add(change);
    }
    add_exterior(outputs, x, alpha, t[0], X, dJ);

    const std::vector<Function::Input> inputs = {{"x", x}, {"lambda", lambda}, {"t", t}};
    values_ =
        Function("symmetry", inputs, Eigen::Map<ExprVector>(outputs.data(), std::ssize(outputs)));
    find_point(start);
  }

  // The start as a point of 𝓛, then others.
  void visit(int count,
             const std::function<void(const VectorXd& values, const std::string&)>& add) {
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> later(0.0, 3.0);
    for (int i = 0; i <= count; ++i) {
      const bool is_start = i == 0;
      const double t = is_start ? start_.t : start_.t + later(generator);
      const auto at = is_start ? point(VectorXd::Zero(chart_.cols()), start_.z, t)
                               : point(displacement(generator), parameters(generator), t);
      if (!at) continue;
      const VectorXd found = values_({at->first, at->second, VectorXd::Constant(1, t)});
      if (is_start || found.allFinite())
        add(found, describe("x", at->first) + ", t = " + number_text(t, 3));
    }
  }

  const std::vector<std::string>& constraints() const { return constraints_; }
  const std::vector<std::string>& exterior() const { return exterior_; }

 private:
  // ⟪e, (X, dJ)⟫ for the sources and for each reaction, with v = ♯ α in them.
  void add_exterior(std::vector<Expr>& outputs, const ExprVector& x, const ExprVector& alpha,
                    const Expr& t, const ExprVector& X, const ExprVector& dJ) {
    const DiracSystem::Exterior& outside = system_.exterior();
    const Index n = alpha.size(), N = x.size();
    if (!outside.has_sources() && !outside.constraint) return;
    const auto canonical =
        std::dynamic_pointer_cast<const CanonicalSymplectic>(system_.structure());
    const ExprVector v = canonical->bivector(x) * alpha;
    const auto add = [&](const ExprVector& vector, const ExprVector& covector, std::string name) {
      Sum power;
      power.add(covector, X);
      power.add(vector, dJ);
      outputs.push_back(power.value);
      outputs.push_back(power.size);
      exterior_.push_back(std::move(name));
    };
    if (outside.has_sources()) {
      const ExprVector e = system_.sources(x, v, alpha, t);
      add(e.head(n), e.tail(n), "the forces");
    }
    if (!outside.constraint) return;
    Graph graph;
    ExprVector from(N + 2 * n + 1), to(N + 2 * n + 1);
    from << graph.variables("x", N), graph.variables("pair", 2 * n), graph.variable("t");
    to << x, v, alpha, t;
    const ExprVector pair = from.segment(N, 2 * n);
    const ExprVector g =
        outside.constraint(from.head(N), pair.head(n), pair.tail(n), from[N + 2 * n]);
    const auto& names = system_.names().equations;
    for (Index a = 0; a < g.size(); ++a) {
      const ExprVector slope = substitute(gradient(g[a], pair), from, to);
      add(slope.tail(n), slope.head(n),
          "the reaction of \"" + names[names.size() - static_cast<std::size_t>(g.size() - a)] +
              '"');
    }
  }

  // The chart at the start, and ∂_λE in it.
  void find_point(const State& start) {
    start_ = start;
    chart_ = manifold_.tangent_basis(start.x);
    start_.z =
        system_.auxiliary_guess(start.x, start.v.allFinite() ? start.v : VectorXd()).head(k_);
    if (start.z.size() >= k_ && start.z.head(k_).allFinite()) start_.z = start.z.head(k_);
    Graph graph;
    const ExprVector xi = graph.variables("xi", chart_.cols());
    const ExprVector lambda = graph.variables("lambda", k_), t = graph.variables("t", 1);
    const ExprVector x = manifold_.chart(constants(start.x), constants(chart_), xi);
    place_ = Function("place", {{"xi", xi}}, x);
    const ExprVector y = joined(xi, lambda);
    stationarity_ =
        Function("stationarity", {{"y", y}, {"t", t}},
                 system_.family()->stationarity(x, lambda, t[0]), {.differentiate = {"y"}});
  }

  // A tangent vector at the start as coordinates in its chart: a tenth of the size of the position
  // along positions, of the momentum along momenta, where these are not zero.
  VectorXd displacement(std::mt19937& generator) const {
    const Index n = manifold_.tangent_dimension() / 2;
    VectorXd v = manifold_.random_tangent(start_.x, 1.0, generator);
    const auto size = [](const VectorXd& part) { return part.norm() > 0.0 ? part.norm() : 1.0; };
    const Index N = start_.x.size() - n;
    v.head(n) *= 0.1 * size(start_.x.head(N));
    v.tail(n) *= 0.1 * size(start_.x.tail(n));
    const double extent = manifold_.extent_at(start_.x)(v);
    if (extent > 0.5) v *= 0.5 / extent;
    return chart_.transpose() * v;
  }
  VectorXd parameters(std::mt19937& generator) const {
    std::normal_distribution<double> normal;
    const double greatest = k_ == 0 ? 0.0 : start_.z.cwiseAbs().maxCoeff();
    const double size = greatest > 0.0 ? 0.1 * greatest : 1.0;
    VectorXd lambda = start_.z;
    for (double& entry : lambda) entry += size * normal(generator);
    return lambda;
  }

  // The point of 𝓛 next to these; nothing if there is none.
  std::optional<std::pair<VectorXd, VectorXd>> point(const VectorXd& xi, const VectorXd& lambda,
                                                     double t) const {
    VectorXd y(xi.size() + k_);
    y << xi, lambda;
    if (k_ > 0) {
      const VectorXd time = VectorXd::Constant(1, t);
      // As of momenta, which may be large.
      const double size = 1.0 + start_.x.cwiseAbs().maxCoeff();
      const auto found = gauss_newton(
          [&](const VectorXd& at) {
            return stationarity_({at, time});
          },
          [&](const VectorXd& at) {
            return stationarity_.jacobian({at, time});
          },
          y, {.accepted = 1e-11 * size});
      if (!found.converged) return std::nullopt;
      y = found.y;
    }
    return std::pair(place_({y.head(xi.size())}), VectorXd(y.tail(k_)));
  }

  const DiracSystem& system_;
  const Manifold& manifold_;
  Index k_;
  Function values_, place_, stationarity_;
  State start_;
  MatrixXd chart_;
  std::vector<std::string> constraints_, exterior_;
};

double quotient(const VectorXd& values, Index i) {
  const double defect = std::fabs(values[2 * i]), size = values[2 * i + 1];
  return defect == 0.0 ? 0.0 : defect / size;
}

}  // namespace

SymmetryReport check_symmetry(const DiracSystem& system, const Symmetry& symmetry,
                              const State& start, const std::string& name, int count) {
  if (!system.structure()->is_canonical() || *system.manifold() != *symmetry.phase_space())
    throw std::invalid_argument("check_symmetry: the structure is " + system.structure()->name() +
                                " on " + system.manifold()->name() +
                                "; expected the canonical one of " +
                                symmetry.phase_space()->name() + ".");
  Measurement measured(system, symmetry, start);
  LawMeasurement tangent(
      name, "Y1 the generator is tangent to " + symmetry.phase_space()->base()->name(), kBound);
  std::vector<LawMeasurement> constraints;
  for (const std::string& constraint : measured.constraints())
    constraints.emplace_back(name, "Y2 \"" + constraint + "\" is invariant", kBound);
  LawMeasurement energy(name, "Y3 the energy is invariant", kBound);
  const auto first_exterior = static_cast<Index>(2 + constraints.size());
  std::vector<bool> acts(measured.exterior().size(), false);
  measured.visit(count, [&](const VectorXd& values, const std::string& where) {
    tangent.add(quotient(values, 0), where);
    energy.add(quotient(values, 1), where);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      constraints[i].add(quotient(values, 2 + static_cast<Index>(i)), where);
    for (std::size_t i = 0; i < acts.size(); ++i)
      if (quotient(values, first_exterior + static_cast<Index>(i)) > kBound) acts[i] = true;
  });
  SymmetryReport report;
  report.laws.push_back(tangent.result());
  for (const LawMeasurement& constraint : constraints) report.laws.push_back(constraint.result());
  report.laws.push_back(energy.result());
  for (std::size_t i = 0; i < acts.size(); ++i)
    if (acts[i]) report.acting.push_back(measured.exterior()[i]);
  return report;
}

}  // namespace courant
