#include "courant/core/algebra/elimination.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/core/linear/qr_decomposition.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a parameter that may vanish is divided by
//  * a small pivot is taken
//  * a coarse unknown gives a fine one
//  * a long chain is filled
//  * round-off of identities passes for equations
//  * what is left of contradictions passes for an identity
//  * what a bound of round-off does not see is zero
BOOST_AUTO_TEST_SUITE(elimination_test)

namespace {

Elimination eliminated(const ExprVector& F, const ExprVector& y,
                       const Elimination::Options& options = {}) {
  return Elimination(F, y, options);
}

ExprVector equations(std::initializer_list<Expr> list) {
  ExprVector result(static_cast<Index>(list.size()));
  std::copy(list.begin(), list.end(), result.begin());
  return result;
}

VectorXd random_vector(Index size, std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return VectorXd::NullaryExpr(size, [&] { return uniform(generator); });
}

// The largest |F_i(Y(u))| of the equations that were eliminated, and the largest |F_i(Y(u)) - G_i(u)| of
// the others, at random u and p.
double defect(const ExprVector& F, const ExprVector& y, const ExprVector& p, const Elimination& e) {
  std::mt19937 generator(3);
  const Function whole("F", {{"y", y}, {"p", p}}, F), left("G", {{"y", y}, {"p", p}}, e.equations),
      all("Y", {{"y", y}, {"p", p}}, e.unknowns);
  double worst = 0.0;
  for (int sample = 0; sample < 20; ++sample) {
    VectorXd u = VectorXd::Constant(y.size(), std::nan(""));  // only those that are kept matter
    for (const Index j : e.kept) u[j] = random_vector(1, generator)[0];
    const VectorXd parameters = random_vector(p.size(), generator).array() + 2.0;
    const VectorXd Y = all({u, parameters}), G = left({u, parameters});
    VectorXd residual = whole({Y, parameters});
    for (std::size_t i = 0; i < e.remaining.size(); ++i)
      residual[e.remaining[i]] -= G[static_cast<Index>(i)];
    for (const Index j : e.kept) worst = std::max(worst, std::fabs(Y[j] - u[j]));
    worst = std::max(worst, residual.lpNorm<Eigen::Infinity>());
  }
  return worst;
}

BOOST_AUTO_TEST_CASE(definitions_of_definitions_are_put_in) {
  Graph graph;
  const ExprVector y = graph.variables("y", 4), p = graph.variables("p", 1);
  const ExprVector F = equations({y[0] - sin(y[3]), 2.0 * y[1] - y[0] * y[0] + p[0],
                                  y[2] + y[1] - 3.0 * y[0], y[2] * exp(y[3]) + y[1] - 1.0});
  const Elimination e = eliminated(F, y);
  BOOST_TEST(e.kept == std::vector<Index>{3}, boost::test_tools::per_element());
  BOOST_TEST(e.remaining.size() == 1);
  BOOST_TEST(e.pivots.size() == 3);
  BOOST_TEST(defect(F, y, p, e) < 1e-13);
}

BOOST_AUTO_TEST_CASE(a_coefficient_that_can_vanish_is_no_pivot) {
  Graph graph;
  const ExprVector y = graph.variables("y", 2), p = graph.variables("p", 2);
  const ExprVector F =
      equations({p[0] * y[0] - cos(y[1]), square(p[0] * y[0]) + y[1] * y[1] - 2.0});
  BOOST_TEST(eliminated(F, y).pivots.size() == 0);
  // It is one if it cannot.
  const Elimination e = eliminated(F, y, {.never_zero = p.head(1)});
  BOOST_TEST(e.kept == std::vector<Index>{1}, boost::test_tools::per_element());
  BOOST_TEST(defect(F, y, p, e) < 1e-13);
  // A sum of such parameters may vanish.
  const ExprVector sum =
      equations({(p[0] - p[1]) * y[0] - cos(y[1]), y[0] * y[0] + y[1] * y[1] - 2.0});
  BOOST_TEST(eliminated(sum, y, {.never_zero = p}).pivots.size() == 0);
  // So may what is left of a coefficient after another elimination: here it is zero.
  const ExprVector cancels = equations(
      {y[0] - p[0] * y[1] + sin(y[1]), p[1] * y[0] - p[1] * p[0] * y[1] + sin(y[0] * y[1])});
  const Elimination c = eliminated(cancels, y, {.never_zero = p});
  BOOST_TEST(c.pivots.size() == 1);
  BOOST_TEST(defect(cancels, y, p, c) < 1e-13);
}

BOOST_AUTO_TEST_CASE(an_unknown_that_enters_nonlinearly_is_kept) {
  Graph graph;
  const ExprVector y = graph.variables("y", 2);
  const ExprVector F = equations({y[0] * y[0] + y[1] * y[1] - 1.0, y[0] * y[1] - 0.1});
  const Elimination e = eliminated(F, y);
  BOOST_TEST(e.pivots.size() == 0);
  BOOST_TEST(e.kept.size() == 2);
  BOOST_TEST(e.remaining.size() == 2);
}

// 1e-12 y₀ + y₁ = 1, y₀ + y₁ = 2 with y₀ from the first equation leaves four digits of y₀.
BOOST_AUTO_TEST_CASE(small_pivots_are_avoided) {
  Graph graph;
  const ExprVector y = graph.variables("y", 2);
  const ExprVector F = equations({1e-12 * y[0] + y[1] - 1.0, y[0] + y[1] - 2.0});
  const Elimination e = eliminated(F, y);
  const VectorXd solved = Function("Y", {{"y", y}}, e.unknowns)({VectorXd::Zero(2)});
  BOOST_TEST(e.kept.size() == 0);
  BOOST_TEST(std::fabs(solved[0] - 1.0 / (1.0 - 1e-12)) < 1e-15);
  BOOST_TEST(std::fabs(solved[1] - (1.0 - 1e-12 / (1.0 - 1e-12))) < 1e-15);

  // The small one is that of the unknown that would be taken first.
  const ExprVector swapped = equations({y[0] + 1e-12 * y[1] - 1.0, y[0] + y[1] - 2.0});
  const VectorXd others =
      Function("Y", {{"y", y}}, eliminated(swapped, y).unknowns)({VectorXd::Zero(2)});
  BOOST_TEST(std::fabs(others[0] - (1.0 - 1e-12 / (1.0 - 1e-12))) < 1e-15);
  BOOST_TEST(std::fabs(others[1] - 1.0 / (1.0 - 1e-12)) < 1e-15);
}

// Units do not matter: charges of 1e-12 and voltages.
BOOST_AUTO_TEST_CASE(units_do_not_matter) {
  Graph graph;
  const ExprVector y = graph.variables("y", 3), p = graph.variables("p", 1);
  const ExprVector F = equations({y[0] - 1e-12 * y[1], 1e-9 * y[2] - y[0] + 1e-12 * p[0],
                                  y[1] * y[1] * y[2] + sin(y[1]) - 1.0});
  const Elimination e = eliminated(F, y);
  BOOST_TEST(e.kept.size() == 1);
  BOOST_TEST(defect(F, y, p, e) < 1e-8);  // u of size 1 are charges of 1, voltages of 1e12
}

BOOST_AUTO_TEST_CASE(fine_unknowns_are_not_given_by_coarse_ones) {
  Graph graph;
  const ExprVector y = graph.variables("y", 2);
  const ExprVector F = equations({y[0] - y[1], sin(y[0]) + exp(y[1]) - 3.0});
  BOOST_TEST(eliminated(F, y, {.coarseness = {0, 1}}).kept == std::vector<Index>{0},
             boost::test_tools::per_element());
  BOOST_TEST(eliminated(F, y, {.coarseness = {1, 0}}).kept == std::vector<Index>{1},
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(redundant_equations_go_and_contradictions_stay) {
  Graph graph;
  const ExprVector y = graph.variables("y", 2);
  const ExprVector redundant = equations({y[0] - y[1], y[0] - y[1], y[1] * y[1] - 2.0});
  BOOST_TEST(eliminated(redundant, y).remaining.size() == 1);
  const ExprVector contradiction = equations({y[0] - y[1], y[0] - y[1] + 1.0, y[1] * y[1] - 2.0});
  BOOST_TEST(eliminated(contradiction, y).remaining.size() == 2);
}

// A circle in two ways: what one says, put into the other, is zero but for round-off, which is no
// equation. With another radius it is a contradiction.
BOOST_AUTO_TEST_CASE(equations_that_repeat_others_by_an_identity_go) {
  Graph graph;
  const ExprVector y = graph.variables("y", 3), p = graph.variables("p", 1);
  for (const double square : {1.0, 2.0}) {
    const ExprVector F =
        equations({y[0] - p[0] * cos(y[2]), y[1] - p[0] * sin(y[2]),
                   (y[0] * y[0] + y[1] * y[1]) / (p[0] * p[0]) - square, y[2] * exp(y[2]) - p[0]});
    const Elimination e = eliminated(F, y);
    BOOST_TEST(e.kept == std::vector<Index>{2}, boost::test_tools::per_element());
    const std::vector<Index> expected =
        square == 1.0 ? std::vector<Index>{3} : std::vector<Index>{2, 3};
    BOOST_TEST(e.remaining == expected, boost::test_tools::per_element());
    BOOST_TEST(e.equations.size() == std::ssize(expected));
  }
}

BOOST_AUTO_TEST_CASE(random_systems_have_the_same_solutions) {
  std::mt19937 generator(11);
  std::uniform_int_distribution<int> pick(0, 11);
  for (int trial = 0; trial < 50; ++trial) {
    Graph graph;
    const ExprVector y = graph.variables("y", 12), p = graph.variables("p", 2);
    ExprVector F(12);
    for (Index i = 0; i < 12; ++i) {
      const VectorXd c = random_vector(3, generator);
      F[i] = c[0] * y[pick(generator)] + c[1] * y[pick(generator)] + p[0] * y[i];
      if (i % 3 == 0) F[i] += c[2] * sin(y[pick(generator)]);
    }
    const Elimination e = eliminated(F, y, {.never_zero = p.head(1)});
    BOOST_TEST(e.kept.size() + e.pivots.size() == 12);
    BOOST_TEST(e.pivots.size() >= 6);
    BOOST_TEST(defect(F, y, p, e) < 1e-9);
  }
}

// A chain of 1,000 masses: momenta and forces go, and what is left stays sparse.
BOOST_AUTO_TEST_CASE(a_long_chain_is_not_filled) {
  constexpr Index n = 1000;
  Graph graph;
  const ExprVector q = graph.variables("q", n), v = graph.variables("v", n),
                   f = graph.variables("f", n + 1), h = graph.variables("h", 1);
  ExprVector y(3 * n + 1), F(3 * n + 1);
  y << q, v, f;
  for (Index i = 0; i < n; ++i) {
    F[i] = q[i] / h[0] - v[i];
    F[n + i] = 2.0 * v[i] / h[0] - f[i + 1] + f[i];
  }
  for (Index i = 0; i <= n; ++i) {
    const Expr stretch = (i < n ? q[i] : Expr(0.0)) - (i > 0 ? q[i - 1] : Expr(0.0));
    F[2 * n + i] = f[i] - stretch - pow(stretch, 3);
  }
  std::vector<int> coarseness(static_cast<std::size_t>(3 * n + 1), 1);
  std::fill_n(coarseness.begin(), n, 0);
  const Elimination e(F, y, {.never_zero = h, .coarseness = coarseness});
  BOOST_TEST(e.kept.size() == static_cast<std::size_t>(n));
  const Function G("G", {{"y", y}, {"h", h}}, e.equations, {.differentiate = {"y"}});
  BOOST_TEST(G.nonzeros() <= 3 * n);
}

// Slices that conduct heat behind one store, x, for one step of size h: the equation that is left last is no identity, however
// many slices there are, and x moves as the sum of a series of resistances says: f_0 = x n/(n + 1).
BOOST_AUTO_TEST_CASE(long_chains_are_solved) {
  for (const Index n : {10, 150, 250, 400, 1000}) {
    Graph graph;
    const ExprVector y = graph.variables("y", n + 1), h = graph.variables("h", 1);
    const ExprVector x0 = graph.variables("x0", 1);
    ExprVector F(n + 1);
    F[0] = (y[0] - x0[0]) / h[0] + 31250.0 * y[1];
    for (Index k = 1; k <= n; ++k) {
      const Expr before = k == 1 ? y[0] / 62500.0 : y[k - 1];
      F[k] = 62500.0 * ((k == n ? Expr(0.0) : y[k + 1]) - 2.0 * y[k] + before);
    }
    std::vector<int> coarseness(static_cast<std::size_t>(n + 1), 1);
    coarseness[0] = 0;
    const Elimination e(F, y, {.never_zero = h, .coarseness = coarseness});
    BOOST_TEST(e.remaining.size() == e.kept.size());
    BOOST_REQUIRE(!e.kept.empty());
    ExprVector u(std::ssize(e.kept));
    for (std::size_t k = 0; k < e.kept.size(); ++k) u[static_cast<Index>(k)] = y[e.kept[k]];
    const Function G("G", {{"u", u}, {"x0", x0}, {"h", h}}, e.equations, {.differentiate = {"u"}});
    const std::vector<VectorXd> at = {VectorXd::Zero(u.size()), VectorXd::Constant(1, 2.0),
                                      VectorXd::Constant(1, 0.5)};
    const VectorXd found = -QrDecomposition::in_order(G.jacobian(at)).solve(G(at));
    const Function Y("Y", {{"u", u}, {"x0", x0}, {"h", h}}, e.unknowns);
    const VectorXd all = Y({found, at[1], at[2]});
    const double size = static_cast<double>(n), part = size / (size + 1.0) / 62500.0;
    BOOST_TEST(all[0] == 2.0 / (1.0 + 0.5 * 31250.0 * part), boost::test_tools::tolerance(1e-9));
    BOOST_TEST(all[n] == all[0] / (size + 1.0) / 62500.0, boost::test_tools::tolerance(1e-6));
  }
}

BOOST_AUTO_TEST_CASE(arguments_are_checked) {
  Graph graph;
  const ExprVector y = graph.variables("y", 2);
  BOOST_CHECK_THROW(eliminated(y, y, {.coarseness = {1}}), std::invalid_argument);
  BOOST_CHECK_THROW(eliminated(y, equations({y[0], y[0] + y[1]})), std::invalid_argument);
}

// λ from 2λ² - a = 0 stays, and μ and ν, which one equation alone contains in the end, are divided by what depends on λ.
BOOST_AUTO_TEST_CASE(regular_equations_give_what_they_alone_contain) {
  Graph graph;
  const ExprVector y = graph.variables("y", 3), a = graph.variables("a", 1);  // λ, μ, ν
  const ExprVector F = equations({2.0 * square(y[0]) - a[0], (1.0 + square(y[0])) * y[1] - y[0],
                                  exp(y[0]) * y[2] + square(y[1]) * y[0] - 3.0});
  const Elimination careful(F, y, {});
  BOOST_TEST(careful.kept.size() == 3u);
  const Elimination regular(F, y, {.is_regular = true});
  const std::vector<Index> kept = {0}, remaining = {0};
  BOOST_TEST(regular.kept == kept, boost::test_tools::per_element());
  BOOST_TEST(regular.remaining == remaining, boost::test_tools::per_element());
  BOOST_TEST(regular.pivots.size() == 2u);
  const double lambda = 0.7, mu = lambda / (1.0 + lambda * lambda);
  const VectorXd found = values(
      substitute(regular.unknowns, joined(y, a),
                 constants(VectorXd(Eigen::Vector4d(lambda, 0.0, 0.0, 2.0 * lambda * lambda)))));
  BOOST_TEST(std::abs(found[1] - mu) < 1e-15);
  BOOST_TEST(std::abs(found[2] - (3.0 - mu * mu * lambda) / std::exp(lambda)) < 1e-15);
}

// A step of h for a line of inductors and capacitors that belong to a unit of time T: which unknowns are
// given by which equations does not depend on it.
BOOST_AUTO_TEST_CASE(pivots_do_not_depend_on_the_unit_of_time) {
  const auto pivots = [](double T) {
    constexpr Index sections = 4;
    Graph graph;
    const ExprVector h = graph.variables("h", 1), last = graph.variables("last", 2 * sections);
    const ExprVector y = graph.variables("y", 4 * sections);  // charge, flux, voltage, current
    std::vector<Expr> F;
    for (Index k = 0; k < sections; ++k) {
      const auto at = [&](Index section, Index what) { return y[4 * section + what]; };
      const Expr next = k + 1 < sections ? at(k + 1, 3) : 0.5 * at(k, 2);
      const Expr before = k > 0 ? at(k - 1, 2) : Expr(1.0);
      F.push_back((at(k, 0) - last[2 * k]) / h[0] - at(k, 3) + next);
      F.push_back((at(k, 1) - last[2 * k + 1]) / h[0] - before + at(k, 2) + 0.01 * at(k, 3));
      F.push_back(0.5 * (at(k, 0) + last[2 * k]) / T - at(k, 2));
      F.push_back(0.5 * (at(k, 1) + last[2 * k + 1]) / T - at(k, 3));
    }
    const Elimination e(Eigen::Map<const ExprVector>(F.data(), std::ssize(F)), y,
                        {.never_zero = h});
    std::vector<Index> found;
    for (const Elimination::Pivot& pivot : e.pivots) {
      found.push_back(pivot.equation);
      found.push_back(pivot.unknown);
    }
    return found;
  };
  const std::vector<Index> expected = pivots(1.0);
  BOOST_TEST(expected.size() > 8u);
  for (const double T : {1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9, 1e12})
    BOOST_TEST(pivots(T) == expected, boost::test_tools::per_element());
}

}  // namespace

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
