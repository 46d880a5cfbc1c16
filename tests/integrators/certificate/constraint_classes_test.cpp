#include "courant/integrators/certificate/constraint_classes.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/poisson.hpp"
#include "courant/structures/presymplectic.hpp"
#include "courant/structures/pullback.hpp"
#include "ladder_catalogue.hpp"

// Mistakes that these cases have to notice:
//  * primary constraints are called first class by their fields rather than their brackets
//  * the border is not taken off the rank of a two-form on M_f
//  * a Casimir is counted as a gauge direction
//  * numbers that the structure says exactly are uncertain
BOOST_AUTO_TEST_SUITE(constraint_classes_test)

using namespace courant;
using namespace courant::examples;

namespace {

using V = const ExprVector&;
using T = const Expr&;

struct Textbook {
  std::string name;
  Problem problem;
  Index primary, secondary, first, second, primary_first;
  Index degrees_of_freedom, up_to_gauge;
};

void check(const Textbook& known) {
  BOOST_TEST_CONTEXT(known.name) {
    const ConstraintLadder ladder = known.problem.ladder();
    const auto found = constraint_classes(*known.problem.system, ladder);
    BOOST_REQUIRE(found);
    BOOST_REQUIRE(found->brackets);
    BOOST_TEST(found->primary == known.primary);
    BOOST_TEST(found->secondary == known.secondary);
    BOOST_TEST(found->brackets->first_class == known.first);
    BOOST_TEST(found->brackets->second_class == known.second);
    BOOST_TEST(found->brackets->primary_first_class == known.primary_first);
    BOOST_TEST(ladder.degrees_of_freedom == known.degrees_of_freedom);
    BOOST_TEST(found->degrees_of_freedom_up_to_gauge == known.up_to_gauge);
    BOOST_TEST(!found->is_ambiguous());
    // As many velocities are free as primary constraints are first class (Dirac).
    BOOST_TEST(ladder.gauge_dimension == found->brackets->primary_first_class);
  }
}

// H on Rⁿ with the graph of a constant matrix.
template <class Structure>
SystemPointer on_flat_space(const MatrixXd& matrix, Hamiltonian::Formula H) {
  const auto M = std::make_shared<Euclidean>(matrix.rows());
  return std::make_shared<DiracSystem>(
      std::make_shared<Structure>(M, [matrix](const ExprVector&) { return constants(matrix); }),
      std::make_shared<Hamiltonian>(M, std::move(H)));
}

// E = (q² + p²)/2 + λ c on (q, p, c).
class OscillatorWithMultiplier final : public GeneratingFamily {
 public:
  explicit OscillatorWithMultiplier(std::shared_ptr<const Manifold> manifold)
      : GeneratingFamily(std::move(manifold), 1) {}

 private:
  Expr do_value(V x, V lambda, T) const override {
    return 0.5 * (square(x[0]) + square(x[1])) + lambda[0] * x[2];
  }
};

// Masses between springs, of which the first two are held together: E = H + λ (q₁ - q₀).
class HeldTogether final : public GeneratingFamily {
 public:
  explicit HeldTogether(std::shared_ptr<const Manifold> manifold)
      : GeneratingFamily(std::move(manifold), 1) {}

 private:
  Expr do_value(V x, V lambda, T) const override {
    const Index n = x.size() / 2;
    Expr energy = lambda[0] * (x[1] - x[0]);
    for (Index i = 0; i < n; ++i) energy += 0.5 * square(x[n + i]);
    for (Index i = 0; i + 1 < n; ++i) energy += 0.5 * square(x[i + 1] - x[i]);
    return energy;
  }
};

std::vector<Textbook> textbook() {
  return {
      // Section 6 of the paper: p = α(q), {φ_a, φ_b} = dα, which is regular.
      {"four vortices", {vortices(), vortex_guess()}, 8, 0, 0, 8, 0, 8, 8},
      // p_λ = 0, φ = 0, (q, p) = 0, and the one that determines λ; the last makes p_λ second class.
      {"pendulum, multiplier as a coordinate",
       {lagrangian(3,
                   [](V q, V w, T) {
                     return 0.5 * (square(w[0]) + square(w[1])) - q[1] -
                            q[2] * (square(q[0]) + square(q[1]) - 1) / 2;
                   }),
        at({0.6, -0.8, 0.8, 0, 0, 0})},
       1,
       3,
       0,
       4,
       0,
       2,
       2},
      // p_z = 0, then the angular momentum (Christ, Lee 1980).
      {"Christ and Lee",
       {lagrangian(3,
                   [](V q, V w, T) {
                     return 0.5 * (square(w[0] + q[2] * q[1]) + square(w[1] - q[2] * q[0])) -
                            0.5 * (square(q[0]) + square(q[1]));
                   }),
        at({1, 0.5, 0.3, 1, 0.5, 0})},
       1,
       1,
       2,
       0,
       1,
       4,
       2},
      // L = x'²/2 - x²/2 on (x, z): z does not occur.
      {"a coordinate that does not occur",
       {lagrangian(2, [](V q, V w, T) { return 0.5 * (square(w[0]) - square(q[0])); }),
        at({0.7, 0.2, 0.1, 0})},
       1,
       0,
       1,
       0,
       1,
       3,
       2},
      // L = -√(t'² - x'²): the mass shell p_t² - p_x² = 1, at 3/5 of the speed of light.
      {"relativistic particle",
       {lagrangian(2, [](V, V w, T) { return -sqrt(square(w[0]) - square(w[1])); }),
        {.x = (VectorXd(4) << 0, 0, -1.25, 0.75).finished(),
         .v = (VectorXd(4) << 1.0, 0.6, 0, 0).finished()}},
       1,
       0,
       1,
       0,
       1,
       3,
       2},
      // Maxwell's equations on three sites: L = Σ (a_i' - φ_{i+1} + φ_i)²/2 (fields along the links,
      // no magnetic part). p_φ = 0 on 3 sites, then the Gauss law e_i = e_{i-1}, of which two are
      // independent. 3 + 2 first class, 3 of them primary: 12 - 5 = 7, and 2 up to gauge: the flux
      // round the ring and its conjugate.
      {"electrodynamics on a ring of three sites",
       {lagrangian(6,
                   [](V q, V w, T) {
                     Expr L = 0.0;
                     for (Index i = 0; i < 3; ++i)
                       L += 0.5 * square(w[i] - q[3 + (i + 1) % 3] + q[3 + i]);
                     return L;
                   }),
        at({0.3, -0.2, 0.5, 0.1, 0.7, -0.4, 0.2, 0.2, 0.2, 0, 0, 0})},
       3,
       2,
       5,
       0,
       3,
       7,
       2},
      // Proca on the same ring: + m² Σ (φ_i² - a_i²)/2. Each p_φ is now second class with its own
      // Gauss law.
      {"massive field on a ring of three sites",
       {lagrangian(6,
                   [](V q, V w, T) {
                     Expr L = 0.0;
                     for (Index i = 0; i < 3; ++i)
                       L += 0.5 * square(w[i] - q[3 + (i + 1) % 3] + q[3 + i]) +
                            0.5 * (square(q[3 + i]) - square(q[i]));
                     return L;
                   }),
        at({0.3, -0.2, 0.5, 0.1, 0.7, -0.4, 0.2, 0.3, -0.1, 0, 0, 0})},
       3,
       3,
       0,
       6,
       0,
       6,
       6},
      // First and second class together: a free particle x, a coordinate z that does not occur, and
      // L = y₁ y₂' of the first order: p_y₁ = 0 and p_y₂ = y₁.
      {"both classes",
       {lagrangian(4,
                   [](V q, V w, T) {
                     return 0.5 * square(w[0]) + q[2] * w[3] - 0.5 * (square(q[2]) + square(q[3]));
                   }),
        at({0.7, 0.2, 0.3, -0.4, 0.1, 0, 0, 0.3})},
       3,
       0,
       1,
       2,
       1,
       5,
       4},
  };
}

}  // namespace

BOOST_AUTO_TEST_CASE(systems_of_the_textbooks) {
  for (const Textbook& known : textbook()) check(known);
}

// Units, and the order of equations and unknowns, do not matter: neither do the coordinates.
BOOST_AUTO_TEST_CASE(brackets_do_not_depend_on_the_size_of_constraints) {
  for (Textbook known : textbook()) {
    ConstraintLadder ladder = known.problem.ladder();
    double factor = 1e-6;
    for (PointConstraint& constraint : ladder.constraints) {
      constraint.gradient *= factor;
      constraint.gradient_error *= factor;
      factor *= -1e3;
    }
    const auto found = constraint_classes(*known.problem.system, ladder);
    BOOST_REQUIRE(found);
    BOOST_TEST_CONTEXT(known.name) {
      BOOST_TEST(found->brackets->second_class == known.second);
      BOOST_TEST(found->degrees_of_freedom_up_to_gauge == known.up_to_gauge);
    }
  }
}

// A two-form with a kernel: there are no brackets, and what is left is the rank of the form on M_f.
// ω = dq ∧ dp on (q, p, s, r), H = p²/2 + q²/2 + s q: ∂_sH = q = 0, then p = 0, then s + q = 0
// (from p' = -q - s), r is free.
BOOST_AUTO_TEST_CASE(presymplectic_systems_have_a_rank_and_no_brackets) {
  MatrixXd omega = MatrixXd::Zero(4, 4);
  omega(0, 1) = 1.0;
  omega(1, 0) = -1.0;
  const auto count = [&](Hamiltonian::Formula H) {
    const Problem problem{on_flat_space<Presymplectic>(omega, std::move(H)), at({0, 0, 0, 0.3})};
    const ConstraintLadder ladder = problem.ladder();
    const auto found = constraint_classes(*problem.system, ladder);
    BOOST_REQUIRE(found);
    BOOST_TEST(!found->brackets);
    return std::pair(ladder.degrees_of_freedom, found->degrees_of_freedom_up_to_gauge);
  };
  using Pair = std::pair<Index, Index>;
  const bool constrained =
      count([](V x, T) { return 0.5 * (square(x[0]) + square(x[1])) + x[2] * x[0]; }) == Pair(1, 0);
  BOOST_TEST(constrained);
  const bool free = count([](V x, T) { return 0.5 * (square(x[0]) + square(x[1])); }) == Pair(4, 2);
  BOOST_TEST(free);
}

// Λ = ∂_q ∧ ∂_p on (q, p, c): c is a Casimir. L with a multiplier that holds c fixed: E = H + λ c.
// The constraint c = 0 is first class, moves nothing, and takes nothing off.
BOOST_AUTO_TEST_CASE(casimirs_move_nothing) {
  MatrixXd lambda = MatrixXd::Zero(3, 3);
  lambda(0, 1) = 1.0;
  lambda(1, 0) = -1.0;
  const auto M = std::make_shared<Euclidean>(3);
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<Poisson>(M, [lambda](const ExprVector&) { return constants(lambda); }),
      std::make_shared<OscillatorWithMultiplier>(M));
  const ConstraintLadder ladder = Problem{system, at({1, 0, 0})}.ladder();
  const auto found = constraint_classes(*system, ladder);
  BOOST_REQUIRE(found);
  BOOST_REQUIRE(found->brackets);
  BOOST_TEST(ladder.degrees_of_freedom == 2);
  BOOST_TEST(found->brackets->first_class == 1);
  BOOST_TEST(found->degrees_of_freedom_up_to_gauge == 2);
}

// What is given by equations alone has no brackets.
// So large that the structure is solved for by sparse factors.
BOOST_AUTO_TEST_CASE(a_long_chain) {
  constexpr Index n = 110;
  const auto phase_space = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(n));
  const auto system =
      std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(phase_space),
                                    std::make_shared<HeldTogether>(phase_space));
  VectorXd x = VectorXd::Zero(2 * n);
  for (Index i = 0; i < n; ++i) x[i] = std::sin(0.3 * static_cast<double>(std::max<Index>(i, 1)));
  const ConstraintLadder ladder = ConstraintAlgorithm().run(system, {.x = x});
  const auto found = constraint_classes(*system, ladder);
  BOOST_REQUIRE(found);
  BOOST_REQUIRE(found->brackets);
  BOOST_TEST(ladder.degrees_of_freedom == 2 * n - 2);
  BOOST_TEST(found->brackets->second_class == 2);
  BOOST_TEST(found->brackets->first_class == 0);
  BOOST_TEST(found->degrees_of_freedom_up_to_gauge == 2 * n - 2);
  BOOST_TEST(!found->is_ambiguous());
}

BOOST_AUTO_TEST_CASE(equations_alone_have_no_classes) {
  const SystemPointer system = cartesian_pendulum();
  const ConstraintLadder ladder = Problem{system, at({0.6, -0.8, 0.8, 0.6})}.ladder();
  BOOST_TEST(ladder.index == 2);
  BOOST_TEST(!constraint_classes(*system, ladder).has_value());
}

BOOST_AUTO_TEST_SUITE_END()
