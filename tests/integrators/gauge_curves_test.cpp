// Where a system has gauge freedom, S_f is no graph: through each of its points goes a curve that
// stays in it, whatever is chosen for the velocities that nothing determines.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/integrators/methods/explicit_runge_kutta.hpp"
#include "courant/tests/integrators/certificate/ladder_catalogue.hpp"

BOOST_AUTO_TEST_SUITE(gauge_curves)

using namespace courant;
using namespace courant::examples;

namespace {

// The system with the equations ⟨g_i, v⟩ = c_i + sin(t - t₀) more, for the gauge directions g_i.
SystemPointer fixed(const SystemPointer& system, const MatrixXd& directions, const VectorXd& c,
                    double t0) {
  return std::make_shared<FormulaSystem>(
      system->manifold(), system->auxiliary_size(), system->equation_count() + directions.cols(),
      [=](const ExprVector& x, const ExprVector& v, const ExprVector& z, const Expr& t) {
        ExprVector F(system->equation_count() + directions.cols());
        const ExprVector speeds = constants(MatrixXd(directions.transpose())) * v;
        F << system->residual(x, v, z, t), speeds - constants(c);
        for (Index i = F.size() - c.size(); i < F.size(); ++i) F[i] -= sin(t - t0);
        return F;
      });
}

// How far v is from the velocities of S_f over the point of the ladder, which differ from its own
// by gauge directions.
double distance(const ConstraintLadder& ladder, const VectorXd& v) {
  const VectorXd difference = v - ladder.point.v;
  const MatrixXd& G = ladder.gauge_directions;
  return (difference - G * CompleteOrthogonalDecomposition(G).solve(difference)).norm();
}

std::vector<KnownLadder> gauge_systems() {
  std::vector<KnownLadder> found;
  for (const KnownLadder& entry : catalogue()) {
    const Manifold& M = *entry.problem.system->manifold();
    if (entry.verdict == Verdict::gauge && M.dimension() == M.ambient_dimension())
      found.push_back(entry);
  }
  return found;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_curve_through_any_point_of_s_f_stays_in_it) {
  std::mt19937 generator(4);
  std::normal_distribution<double> normal;
  int tried = 0;
  for (const KnownLadder& entry : gauge_systems()) BOOST_TEST_CONTEXT(entry.name) {
      const SystemPointer& system = entry.problem.system;
      const ConstraintLadder ladder = entry.problem.ladder();
      BOOST_REQUIRE((ladder.verdict == Verdict::gauge));
      const MatrixXd& G = ladder.gauge_directions;
      BOOST_REQUIRE_EQUAL(G.cols(), ladder.gauge_dimension);
      // A point (x, v) of S_f over the point that was found.
      const VectorXd chosen = VectorXd::NullaryExpr(G.cols(), [&] { return normal(generator); });
      const VectorXd v = ladder.point.v + G * chosen;
      const double t0 = ladder.point.t;
      const SystemPointer regular = fixed(system, G, G.transpose() * v, t0);
      const ConstraintLadder start = ConstraintAlgorithm().run(
          regular, {.t = t0, .x = ladder.point.x, .v = v, .z = ladder.point.z});
      BOOST_TEST((start.verdict == Verdict::regular), start.reason);
      BOOST_TEST(start.degrees_of_freedom == ladder.degrees_of_freedom);
      BOOST_TEST((start.point.x - ladder.point.x).norm() < 1e-9);
      BOOST_TEST((start.point.v - v).norm() < 1e-8 * (1.0 + v.norm()));
      if (start.verdict != Verdict::regular) continue;

      const auto field = std::make_shared<VectorField>(regular, start, Backend::interpreter);
      const State end = ExplicitRungeKutta(field, ExplicitRungeKutta::Kind::classical)
                            .advance(start.point, 0.005, 20);
      BOOST_TEST((end.x - ladder.point.x).norm() > 1e-4);
      VectorField::Evaluation evaluate(*field);
      VectorXd rate;
      evaluate(end.x, rate, end.t);
      // Of the system itself: (x, v) is still a point of S_f, with the same ladder.
      const ConstraintLadder there = ConstraintAlgorithm().run(
          system, {.t = end.t, .x = end.x, .v = evaluate.v(), .z = evaluate.z()});
      BOOST_TEST((there.verdict == Verdict::gauge), there.reason);
      BOOST_TEST((dimensions(there) == dimensions(ladder)));
      BOOST_TEST(there.moved < 1e-8 * (1.0 + end.x.norm()));
      BOOST_TEST(distance(there, evaluate.v()) < 1e-6 * (1.0 + evaluate.v().norm()));
      // The control: other velocities are none of S_f.
      const VectorXd other = VectorXd::LinSpaced(end.x.size(), 1.0, -0.7);
      if (G.cols() < end.x.size()) BOOST_TEST(distance(there, evaluate.v() + other) > 1e-2);
      ++tried;
    }
  BOOST_TEST(tried >= 5);
}

// In coordinates with units of 1000 and 1/1000 the directions are those of these coordinates.
BOOST_AUTO_TEST_CASE(directions_have_the_units_of_their_coordinates) {
  // x' = a, y' = b, a + 10⁶ b = 1 on (x, y): free along (10⁶, -1).
  const SystemPointer system =
      flat(2, 0, 1, [](const ExprVector&, const ExprVector& v, const ExprVector&, const Expr&) {
        return equations({v[0] + 1e6 * v[1] - 1.0});
      });
  const ConstraintLadder ladder = ConstraintAlgorithm().run(system, at({0.3, 0.7}));
  BOOST_REQUIRE((ladder.verdict == Verdict::gauge));
  BOOST_REQUIRE_EQUAL(ladder.gauge_directions.cols(), 1);
  const VectorXd g = ladder.gauge_directions.col(0);
  BOOST_TEST(g[0] / g[1] == -1e6, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_SUITE_END()
