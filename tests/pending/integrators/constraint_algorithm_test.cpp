#include "courant/integrators/constraint_algorithm.hpp"

#include <boost/test/unit_test.hpp>
#include <numbers>

#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"
#include "example_systems.hpp"

using namespace courant;
using examples::equations;
using examples::FormulaSystem;
using examples::SystemPointer;

namespace {

using Dimensions = std::vector<std::pair<Index, Index>>;

std::shared_ptr<const Euclidean> space(Index n) { return std::make_shared<Euclidean>(n); }

std::shared_ptr<const DiracSystem> lagrangian_system(Index n, Lagrangian::Formula L,
                                                     ImplicitSystem::Names names = {}) {
  const auto phase_space = std::make_shared<CotangentBundle>(space(n));
  return std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(phase_space),
                                       std::make_shared<Lagrangian>(phase_space, std::move(L)),
                                       std::move(names));
}

// L = ⟨α(q), q̇⟩ - H(q), strengths Γ (Section 6 of the paper).
SystemPointer vortices() {
  const Eigen::Vector4d strength(1, 1, -1, -1);
  return lagrangian_system(8, [strength](const ExprVector& q, const ExprVector& w, const Expr&) {
    Expr kinetic = 0.0, H = 0.0;
    for (Index j = 0; j < 4; ++j) {
      kinetic += 0.5 * strength[j] * (q[j] * w[4 + j] - q[4 + j] * w[j]);
      for (Index k = 0; k < j; ++k)
        H -= strength[j] * strength[k] / (4 * std::numbers::pi) *
             log(square(q[j] - q[k]) + square(q[4 + j] - q[4 + k]));
    }
    return kinetic - H;
  });
}

InitialGuess vortex_guess() {
  InitialGuess guess;
  guess.x = (VectorXd(16) << -1, 1, -1, 1, 2, 2, -2, -2, VectorXd::Zero(8)).finished();
  return guess;
}

SystemPointer cartesian_pendulum() {
  return std::make_shared<FormulaSystem>(
      space(4), 1, 5,
      [](const ExprVector& x, const ExprVector& v, const ExprVector& z, const Expr&) {
        return equations({v[0] - x[2], v[1] - x[3], v[2] + z[0] * x[0], v[3] + z[0] * x[1] + 9.81,
                          square(x[0]) + square(x[1]) - 1});
      },
      ImplicitSystem::Names{{"x", "y", "p_x", "p_y"},
                            {"lambda"},
                            {"x' = p_x", "y' = p_y", "p_x'", "p_y'", "length"}});
}

// ẋ = p, ṗ = -∇V + λ (-y, 0, 1), ż = y ẋ
SystemPointer nonholonomic_particle() {
  return std::make_shared<FormulaSystem>(
      space(6), 1, 7,
      [](const ExprVector& x, const ExprVector& v, const ExprVector& z, const Expr&) {
        return equations({v[0] - x[3], v[1] - x[4], v[2] - x[5], v[3] + x[0] + z[0] * x[1],
                          v[4] + x[1], v[5] - z[0], x[5] - x[1] * x[3]});
      });
}

// Charges of two capacitors in parallel, flux of an inductor.
SystemPointer parallel_capacitors() {
  return std::make_shared<FormulaSystem>(
      space(3), 2, 5,
      [](const ExprVector& x, const ExprVector& v, const ExprVector& z, const Expr&) {
        // currents i_1 = q_1', i_2 = q_2', i_L = φ/L; voltages q/C and φ'; z: currents of the
        // capacitors
        return equations({v[0] - z[0], v[1] - z[1], z[0] + z[1] + x[2] / 3.0, x[0] / 2.0 - x[1],
                          v[2] - x[0] / 2.0});
      });
}

// L = ½ (q̇_1 - q_3 q_2…): Christ–Lee, L = ½ (ṙ² + r² (θ̇ - a)²) - V(r).
SystemPointer christ_lee() {
  return lagrangian_system(3, [](const ExprVector& q, const ExprVector& w, const Expr&) {
    return 0.5 * (square(w[0]) + square(q[0]) * square(w[1] - q[2])) - 0.5 * square(q[0]);
  });
}

SystemPointer contradictory() {
  return lagrangian_system(
      1, [](const ExprVector& q, const ExprVector& w, const Expr&) { return w[0] + q[0]; });
}

InitialGuess at(std::initializer_list<double> x) {
  InitialGuess guess;
  guess.x = Eigen::Map<const VectorXd>(x.begin(), static_cast<Index>(x.size()));
  return guess;
}

struct Example {
  std::string name;
  examples::Problem problem;
  Dimensions dimensions;
  Verdict verdict;
  Index index;
};

std::vector<Example> errata() {
  return {
      {"four vortices",
       {vortices(), vortex_guess()},
       {{16, 8}, {8, 8}, {8, 8}},
       Verdict::regular,
       1},
      {"Cartesian pendulum",
       {cartesian_pendulum(), at({0.6, -0.9, 0.1, 0.3})},
       {{4, 3}, {3, 2}, {2, 2}, {2, 2}},
       Verdict::regular,
       2},
      {"nonholonomic particle",
       {nonholonomic_particle(), at({0.3, 0.7, 0.2, 1.0, 0.4, 0.5})},
       {{6, 5}, {5, 5}, {5, 5}},
       Verdict::regular,
       1},
      {"parallel capacitors",
       {parallel_capacitors(), at({1.0, 0.3, 0.2})},
       {{3, 2}, {2, 2}, {2, 2}},
       Verdict::regular,
       1},
      {"Christ-Lee",
       {christ_lee(), at({1.2, 0.4, 0.3, 0.2, 0.5, 0.1})},
       {{6, 5}, {5, 4}, {5, 4}},
       Verdict::gauge,
       1},
  };
}

void check_ladder(const std::string& name, const ConstraintLadder& ladder,
                  const Example& expected) {
  BOOST_TEST_CONTEXT(name) {
    BOOST_TEST(to_string(ladder.verdict) == to_string(expected.verdict),
               to_string(ladder.verdict) << ": " << ladder.reason);
    BOOST_TEST(ladder.index == expected.index);
    BOOST_TEST(ladder.levels.size() == expected.dimensions.size());
    for (std::size_t k = 0; k < std::min(ladder.levels.size(), expected.dimensions.size()); ++k) {
      BOOST_TEST_CONTEXT("level " << k << ": " << ladder.levels[k].all << "; "
                                  << ladder.levels[k].without_tangent << "; "
                                  << ladder.levels[k].without_point) {
        BOOST_TEST(ladder.levels[k].dim_S == expected.dimensions[k].first);
        BOOST_TEST(ladder.levels[k].dim_M == expected.dimensions[k].second);
        BOOST_TEST(!ladder.levels[k].is_ambiguous());
      }
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(constraint_algorithm_test)

BOOST_AUTO_TEST_CASE(the_tables_of_the_errata) {
  std::mt19937 generator(7);
  for (const Example& example : errata()) {
    check_ladder(example.name, example.problem.ladder(), example);
    for (int trial = 0; trial < 5; ++trial) {
      check_ladder(example.name + ", permuted", permuted(example.problem, generator).ladder(),
                   example);
      check_ladder(example.name + ", scaled", scaled(example.problem, generator).ladder(), example);
      check_ladder(example.name + ", transformed", transformed(example.problem, generator).ladder(),
                   example);
    }
  }
}

BOOST_AUTO_TEST_CASE(contradiction_is_found_and_named) {
  const ConstraintLadder ladder = ConstraintAlgorithm().run(contradictory(), at({0.3, 0.2}));
  BOOST_TEST(to_string(ladder.verdict) == "inconsistent");
  BOOST_REQUIRE_EQUAL(ladder.levels.size(), 2U);
  BOOST_TEST(ladder.levels[0].dim_S == 2);
  BOOST_TEST(ladder.levels[1].is_empty);
  BOOST_TEST(ladder.levels[1].residual > 0.1);
  BOOST_TEST_MESSAGE(ladder.reason);
}

BOOST_AUTO_TEST_CASE(vortices_differentiate_eight_equations_once) {
  const ConstraintLadder ladder = ConstraintAlgorithm().run(vortices(), vortex_guess());
  std::vector<int> expected(24, 0);
  std::fill(expected.begin() + 16, expected.end(), 1);
  BOOST_TEST(ladder.differentiations == expected, boost::test_tools::per_element());
  BOOST_TEST(ladder.constraints.size() == 8U);
  BOOST_TEST(ladder.moved > 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
