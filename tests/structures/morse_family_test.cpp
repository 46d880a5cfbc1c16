#include "courant/structures/morse_family.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/constrained_family.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/laws.hpp"

// Mistakes that these cases have to notice:
//  * abnormal extremals know the cost
//  * derivatives of a family are measured over one distance (structures/laws.cpp)
BOOST_AUTO_TEST_SUITE(morse_family)

using namespace courant;

namespace {

// E = λ x + λ³/3 - c λ on R, whose Hessian (1, 2λ) has rank 1; c x² λ²/2 with (2 c x λ, c x²).
MorseFamily fold() {
  return MorseFamily(std::make_shared<Euclidean>(1), 1,
                     [](const ExprVector& x, const ExprVector& l, const Expr& t) -> Expr {
                       return l[0] * x[0] + l[0] * l[0] * l[0] / 3.0 - t * l[0];
                     });
}
MorseFamily degenerate() {
  return MorseFamily(std::make_shared<Euclidean>(1), 1,
                     [](const ExprVector& x, const ExprVector& l, const Expr&) -> Expr {
                       return 0.5 * x[0] * x[0] * l[0] * l[0];
                     });
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_fold) {
  const MorseFamily family = fold();
  const ExprVector x{{2.0}}, l{{3.0}};
  BOOST_TEST(values(family.differential(x, l, 0.5))[0] == 3.0);
  BOOST_TEST(values(family.stationarity(x, l, 0.5))[0] == 2.0 + 9.0 - 0.5);
  BOOST_TEST(family.energy(x, l, 0.5).value() == 6.0 + 9.0 - 1.5);
  BOOST_CHECK_THROW(MorseFamily(std::make_shared<Euclidean>(1), 1, {}), std::invalid_argument);
}

// Goddard's rocket in an atmosphere whose density falls by half in 10⁻³: differences of E over 0.03 tell nothing.
BOOST_AUTO_TEST_CASE(derivatives_of_steep_families_are_measured_too) {
  const MorseFamily steep(std::make_shared<Euclidean>(1), 1,
                          [](const ExprVector& x, const ExprVector& l, const Expr&) -> Expr {
                            return l[0] * x[0] + 6.2 * exp(-500.0 * (x[0] - 1.0));
                          });
  const FamilyPoint at{VectorXd::Constant(1, 1.0027), VectorXd::Constant(1, 4.0), 0.0};
  for (const LawResult& law : check_generating_family(steep, std::span(&at, 1)))
    BOOST_TEST(law.passed(), law.law << " " << law.defect);
}

// The claim is measured: by how much the rank is less than k at (x, λ).
BOOST_AUTO_TEST_CASE(rank_condition) {
  const auto missing = [](const GeneratingFamily& family, double x, double lambda) {
    const FamilyPoint at{VectorXd::Constant(1, x), VectorXd::Constant(1, lambda), 0.0};
    for (const LawResult& law : check_generating_family(family, std::span(&at, 1)))
      if (law.law.starts_with("G2")) return law.defect;
    return -1.0;
  };
  BOOST_TEST(missing(fold(), 1.0, 0.0) == 0.0);
  BOOST_TEST(missing(degenerate(), 1.0, 1.0) == 0.0);
  BOOST_TEST(missing(degenerate(), 0.0, 1.0) == 1.0);
  // What is not claimed is not measured: conditions may repeat each other.
  const ConstrainedFamily twice(
      std::make_shared<Hamiltonian>(
          std::make_shared<Euclidean>(1),
          [](const ExprVector& x, const Expr&) -> Expr { return x[0] * x[0]; }),
      [](const ExprVector& x, const ExprVector&, const Expr&) {
        return ExprVector{{x[0], 2.0 * x[0]}};
      },
      2);
  BOOST_TEST(!twice.is_morse().has_value());
}

// A symplectic map makes symplectic steps of a family on T*Q alone, not with forces.
BOOST_AUTO_TEST_CASE(forces_are_not_lagrangian) {
  const auto T = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(1));
  const auto D = std::make_shared<CanonicalSymplectic>(T);
  const auto family = std::make_shared<MorseFamily>(
      T, 1, [](const ExprVector& x, const ExprVector& l, const Expr&) -> Expr {
        return l[0] * x[1] + x[0];
      });
  const DiracSystem::Law law = [](const ExprVector&, const ExprVector& v, const ExprVector& alpha,
                                  const Expr&) {
    ExprVector both(4);
    both << v, alpha;
    return both;
  };
  BOOST_TEST(DiracSystem(D, family).is_lagrangian().value_or(false));
  BOOST_TEST(!DiracSystem(D, family, {.source = law}).is_lagrangian().has_value());
  BOOST_TEST(!DiracSystem(D, family, {.constraint = law, .constraint_count = 4})
                  .is_lagrangian()
                  .has_value());
}

// E = ⟨p, f⟩ - c ℓ: ẋ = f, ṗ = -∂E/∂x, 0 = ∂E/∂u.
BOOST_AUTO_TEST_CASE(pontryagin) {
  const auto T = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  ControlProblem problem{
      .cost = [](const ExprVector& q, const ExprVector& u, const Expr& t) -> Expr {
        return 0.5 * u[0] * u[0] + t * q[0] * q[0];
      },
      .dynamics =
          [](const ExprVector& q, const ExprVector& u, const Expr&) {
            return ExprVector{{q[1], u[0] - sin(q[0])}};
          },
      .controls = 1};
  const VectorXd x{{0.3, -0.2, 0.7, 1.1}}, u{{1.4}};
  const double t = 0.9;
  for (const double c : {1.0, 0.0}) {
    problem.cost_multiplier = c;
    const DiracSystem system(std::make_shared<CanonicalSymplectic>(T),
                             pontryagin_family(T, problem));
    const VectorXd v{
        {x[1], u[0] - std::sin(x[0]), x[3] * std::cos(x[0]) + c * 2.0 * t * x[0], -x[2]}};
    const VectorXd residual = system.residual(x, v, u, t);
    BOOST_TEST(residual.head(4).norm() < 1e-15);
    BOOST_TEST(std::abs(residual[4] - (x[3] - c * u[0])) < 1e-15);
  }
  problem.dynamics = [](const ExprVector& q, const ExprVector&, const Expr&) {
    return ExprVector(q.head(1));
  };
  BOOST_CHECK_THROW(pontryagin_family(T, problem)->value(constants(x), constants(u), 0.0),
                    std::invalid_argument);
  problem.dynamics = {};
  BOOST_CHECK_THROW(pontryagin_family(T, problem), std::invalid_argument);
}

// The rank condition is claimed where the constant entries of ∂f/∂u and ∂²E/∂u² show it: x' = x u
// with no cost of u has none at x = 0.
BOOST_AUTO_TEST_CASE(what_pontryagin_claims) {
  const auto T = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  const auto claim = [&](double cost_of_u, double direct) {
    return pontryagin_family(
               T, {.cost = [=](const ExprVector& q, const ExprVector& u, const Expr&) -> Expr {
                     return q[1] + cost_of_u * u[0] * u[0];
                   },
                   .dynamics =
                       [=](const ExprVector& q, const ExprVector& u, const Expr&) {
                         return ExprVector{{q[0] * u[0], q[0] + direct * u[0]}};
                       },
                   .controls = 1})
        ->is_morse();
  };
  BOOST_TEST(!claim(0.0, 0.0).has_value());
  BOOST_TEST(claim(0.5, 0.0).value_or(false));
  BOOST_TEST(claim(0.0, 2.0).value_or(false));
}

BOOST_AUTO_TEST_SUITE_END()
