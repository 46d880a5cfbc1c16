#include "courant/structures/laws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/manifolds/measurement.hpp"
#include "courant/structures/rank_profile.hpp"

namespace courant {
namespace {

class StructureLaws {
 public:
  StructureLaws(const DiracStructure& structure, std::span<const VectorXd> points,
                const LawOptions& options)
      : D_(structure), points_(points), generator_(options.seed) {}

  std::vector<LawResult> run() {
    std::vector<LawResult> results{dimension()};
    if (D_.is_dirac()) results.push_back(isotropy());
    results.push_back(coisotropy());
    results.push_back(linearity());
    results.push_back(vanishes_on_D());
    results.push_back(nowhere_else());
    results.push_back(constant_ranks());
    results.push_back(tangent_equations());
    return results;
  }

 private:
  LawMeasurement law(const std::string& text, double bound) const {
    return LawMeasurement(D_.name(), text, bound);
  }
  template <class Measure>
  LawResult at_points(LawMeasurement measured, const Measure& measure) const {
    for (const VectorXd& x : points_) measured.add([&] { return measure(x); }, describe("x", x));
    return measured.result();
  }

  VectorXd random(Index size) {
    std::normal_distribution<double> normal;
    return VectorXd::NullaryExpr(size, [&] { return normal(generator_); });
  }
  VectorXd residual(const VectorXd& x, const VectorXd& v, const VectorXd& alpha,
                    const VectorXd& u) const {
    return values(D_.membership(constants(x), constants(v), constants(alpha), constants(u)));
  }
  // The covector with a = Bᵀα.
  VectorXd covector(const VectorXd& x, const VectorXd& a) const {
    const Manifold& M = *D_.manifold();
    return M.tangent_projector(x).transpose() * (M.tangent_basis(x) * a);
  }
  // The least of |membership(x, v, α, u)| over u, for (v, α) given by (w, a) in the basis, next to
  // the size of its matrices.
  double least_residual(const VectorXd& x, const VectorXd& w, const VectorXd& a) const {
    const auto [F, E, P] = D_.matrices(x);
    const VectorXd v = D_.manifold()->tangent_basis(x) * w, alpha = covector(x, a);
    const VectorXd u =
        -FundamentalSubspaces(P, DiracStructure::rounding).pseudo_solve(F * w + E * a);
    const double size = F.norm() + E.norm() + P.norm();
    return residual(x, v, alpha, u).norm() / std::max(size, 1e-300);
  }

  LawResult dimension() {
    const bool dirac = D_.is_dirac();
    return at_points(law(dirac ? "S1 dim D = n" : "S1 dim D ≥ n", 0.0), [&](const VectorXd& x) {
      const Index excess = D_.fibre(x).dimension() - D_.manifold()->dimension();
      return static_cast<double>(dirac ? std::abs(excess) : std::max<Index>(-excess, 0));
    });
  }

  LawResult isotropy() {
    return at_points(law("S2 ⟨α₁, v₂⟩ + ⟨α₂, v₁⟩ = 0 on D", 1e-9),
                     [&](const VectorXd& x) { return D_.fibre(x).isotropy_defect(); });
  }

  LawResult coisotropy() {
    return at_points(law("S3 D^⊥ ⊂ D", 1e-9),
                     [&](const VectorXd& x) { return D_.fibre(x).coisotropy_defect(); });
  }

  LawResult linearity() {
    const Index n = D_.manifold()->tangent_dimension(), m = D_.port_size();
    return at_points(law("S4 membership is linear", 1e-12), [&](const VectorXd& x) {
      const VectorXd v = random(n), w = random(n), alpha = random(n), beta = random(n),
                     u = random(m), s = random(m);
      const double c = 3.0;
      const VectorXd sum = residual(x, c * v + w, c * alpha + beta, c * u + s);
      const VectorXd parts = c * residual(x, v, alpha, u) + residual(x, w, beta, s);
      return relative(sum - parts, sum);
    });
  }

  LawResult vanishes_on_D() {
    return at_points(law("S5 membership = 0 on D", 1e-9), [&](const VectorXd& x) {
      const PairedSubspace fibre = D_.fibre(x);
      const VectorXd c = random(fibre.dimension()).normalized();
      return least_residual(x, fibre.vectors() * c, fibre.covectors() * c);
    });
  }

  LawResult nowhere_else() {
    return at_points(law("S5 membership ≠ 0 off D (1 where it vanishes)", 0.0),
                     [&](const VectorXd& x) {
                       const PairedSubspace fibre = D_.fibre(x);
                       const MatrixXd normals = fibre.complement();
                       if (normals.cols() == 0) return 0.0;
                       const VectorXd normal = normals * random(normals.cols()).normalized();
                       const Index n = fibre.space_dimension();
                       return least_residual(x, normal.head(n), normal.tail(n)) > 1e-9 ? 0.0 : 1.0;
                     });
  }

  LawResult constant_ranks() {
    auto measured = law("S6 constant ranks (number of points where they jump)", 0.0);
    std::string where = "all points";
    measured.add(
        [&] {
          const RankProfile profile = rank_profile(D_, points_);
          if (!profile.is_smooth()) where = describe("x", points_[profile.jumps.front()]);
          return static_cast<double>(profile.jumps.size());
        },
        where);
    return measured.result();
  }

  LawResult tangent_equations() {
    const Manifold& M = *D_.manifold();
    const Index n = M.dimension(), size = M.tangent_dimension();
    return at_points(law("S7 the first tangent_blocks() equations are tangent", 1e-12),
                     [&](const VectorXd& x) {
                       const VectorXd r = residual(x, M.tangent_basis(x) * random(n),
                                                   covector(x, random(n)), random(D_.port_size()));
                       if (D_.tangent_blocks() * size > r.size())
                         throw std::domain_error("tangent_blocks() are more than there are");
                       const MatrixXd projector = M.tangent_projector(x);
                       double defect = 0.0;
                       for (Index k = 0; k < D_.tangent_blocks(); ++k) {
                         const VectorXd block = r.segment(k * size, size);
                         const VectorXd tangent = projector * block;
                         const VectorXd cotangent = projector.transpose() * block;
                         defect = std::max(defect, std::min(relative(block - tangent, block),
                                                            relative(block - cotangent, block)));
                       }
                       return defect;
                     });
  }

  const DiracStructure& D_;
  std::span<const VectorXd> points_;
  std::mt19937 generator_;
};

}  // namespace

std::vector<LawResult> check_structure(const DiracStructure& structure,
                                       std::span<const VectorXd> points,
                                       const LawOptions& options) {
  return StructureLaws(structure, points, options).run();
}

std::vector<LawResult> check_structure(const DiracStructure& structure, const LawOptions& options) {
  std::mt19937 generator(options.seed);
  std::vector<VectorXd> points;
  for (int i = 0; i < options.points; ++i)
    points.push_back(structure.manifold()->random_point(generator));
  return check_structure(structure, points, options);
}

std::vector<LawResult> check_generating_family(const GeneratingFamily& family,
                                               std::span<const FamilyPoint> points) {
  const Manifold& M = *family.manifold();
  const Index n = M.dimension(), k = family.parameter_size();
  Graph graph;
  const ExprVector x = graph.variables("x", M.ambient_dimension());
  const ExprVector lambda = graph.variables("lambda", k), t = graph.variables("t", 1);
  const std::vector<Function::Input> inputs = {{"x", x}, {"lambda", lambda}, {"t", t}};
  const Function value("value", inputs, ExprVector::Constant(1, family.value(x, lambda, t[0])));
  const ExprVector d_x = family.differential(x, lambda, t[0]);
  const ExprVector d_lambda = family.stationarity(x, lambda, t[0]);
  ExprVector both(d_x.size() + d_lambda.size());
  both << d_x, d_lambda;
  const Function derivatives("derivatives", inputs, both);
  const std::string subject = "GeneratingFamily on " + M.name();

  LawMeasurement first(subject, "G1 differential and stationarity are the derivatives of value",
                       1e-7);
  LawMeasurement morse(subject, "G2 the rank of ∂_λ(∂_x E, ∂_λ E) is k, as said (less by)", 0.0);
  for (const FamilyPoint& at : points) {
    const std::string where = describe("x", at.x) + ", " + describe("λ", at.lambda);
    const VectorXd time = VectorXd::Constant(1, at.t);
    const MatrixXd basis = M.tangent_basis(at.x);
    first.add(
        [&] {
          const VectorXd exact = derivatives({at.x, at.lambda, time});
          VectorXd expected(n + k), measured(n + k);
          expected << basis.transpose() * exact.head(d_x.size()), exact.tail(k);
          // A density that falls by half in 10⁻³ needs short steps. They are believed where they are as much better
          // as they are of a function without kinks: by 10⁶ each.
          constexpr double kSmooth = 1e-3;
          // An energy of 10³³ J changes by less than its rounding on short steps. Of these 10⁻¹⁶ of it have to be less than
          // 10⁻¹⁰ of the derivative.
          constexpr double kRounded = 1e-6;
          const double least =
              kRounded * std::fabs(value({at.x, at.lambda, time})[0]) / (1.0 + expected.norm());
          double defect = std::numeric_limits<double>::infinity();
          for (const double usual : {1e-2, 1e-3, 1e-4}) {
            const double step = std::max(usual, least);
            for (Index j = 0; j < n + k; ++j) {
              const auto moved = [&](double s) {
                VectorXd y = at.x, mu = at.lambda;
                if (j < n)
                  y = M.retract(at.x, VectorXd(s * basis.col(j)));
                else
                  mu[j - n] += s;
                return value({y, mu, time})[0];
              };
              const auto slope = [&](double s) { return moved(s * step) - moved(-s * step); };
              measured[j] = (45.0 * slope(1) - 9.0 * slope(2) + slope(3)) / (60.0 * step);
            }
            const double next = relative(measured - expected, expected);
            if (!(next < kSmooth * defect)) break;
            defect = next;
          }
          return defect;
        },
        where);
    if (family.is_morse().value_or(false))
      morse.add(
          [&] { return k == 0 ? 0.0 : static_cast<double>(k - family_rank(family, at).rank); },
          where);
  }
  std::vector<LawResult> results{first.result()};
  if (family.is_morse().value_or(false)) results.push_back(morse.result());
  return results;
}

}  // namespace courant
