#include "courant/integrators/methods/starting_procedure.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

#include "courant/core/expressions/derivative.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/lagrangian_system.hpp"

BOOST_AUTO_TEST_SUITE(starting_procedures)

using namespace courant;

namespace {

// A Lagrangian with a position-dependent mass: regular and not separable.
Expr lagrangian(const ExprVector& q, const ExprVector& v, const Expr&) {
  return (Expr(1.0) + square(q[0])) * square(v[0]) / Expr(2.0) + square(v[1]) / Expr(2.0) +
         q[1] * v[0] - cos(q[0]) * q[1];
}

struct Setting {
  std::shared_ptr<const CotangentBundle> bundle =
      std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  std::shared_ptr<const ImplicitSystem> system =
      lagrangian_system(bundle, lagrangian, {"q[0]", "q[1]", "p[0]", "p[1]"});
  std::shared_ptr<const DiscretizationMap> map =
      std::make_shared<CotangentLift>(bundle, std::make_shared<Theta>(bundle->base(), 0.5));
};

State at(const VectorXd& x) {
  return {.t = 0.0, .x = x, .v = VectorXd::Zero(4), .z = VectorXd::Zero(2)};
}

}  // namespace

// p₀ = -D₁L_d(q₀, q₁) with L_d = h L((q₀+q₁)/2, (q₁-q₀)/h), differentiated as it is written.
BOOST_AUTO_TEST_CASE(is_the_derivative_of_the_discrete_lagrangian) {
  const Setting setting;
  std::mt19937 generator(6);
  std::normal_distribution<double> normal;
  const double h = 0.1;
  for (int trial = 0; trial < 10; ++trial) {
    const VectorXd q0 = VectorXd::NullaryExpr(2, [&] { return normal(generator); });
    const VectorXd q1 = q0 + h * VectorXd::NullaryExpr(2, [&] { return normal(generator); }).eval();
    Graph graph;
    const ExprVector from = graph.variables("q0", 2);
    const ExprVector middle = (from + constants(q1)) / Expr(2.0),
                     rate = (constants(q1) - from) / Expr(h);
    const Expr discrete = Expr(h) * lagrangian(middle, rate, 0.0);
    const VectorXd p0 = -values(substitute(gradient(discrete, from), from, constants(q0)));
    VectorXd x(4);
    x << q0, VectorXd::Zero(2);
    const State state = starting_procedure(*setting.system, *setting.map, at(x), q1, h);
    BOOST_TEST((state.x.head(2) - q0).norm() == 0.0);
    BOOST_TEST((state.x.tail(2) - p0).norm() < 1e-12 * (1.0 + p0.norm()));
  }
}

BOOST_AUTO_TEST_CASE(the_first_step_leads_to_the_second_position) {
  const Setting setting;
  const DiscretizeFirst method(setting.system, setting.map, {.backend = Backend::interpreter});
  const VectorXd x = (VectorXd(4) << 0.3, -0.2, 1.0, 0.5).finished();
  const VectorXd q1 = (VectorXd(2) << 0.35, -0.1).finished();
  const State next =
      method.advance(starting_procedure(*setting.system, *setting.map, at(x), q1, 0.1), 0.1);
  BOOST_TEST((next.x.head(2) - q1).norm() < 1e-13);
}

BOOST_AUTO_TEST_CASE(is_for_cotangent_bundles) {
  class Rest final : public ImplicitSystem {
   public:
    Rest() : ImplicitSystem(std::make_shared<Euclidean>(2), 0, 2, {}) {}

   private:
    ExprVector do_residual(const ExprVector&, const ExprVector& v, const ExprVector&,
                           const Expr&) const override {
      return v;
    }
  };
  const Rest system;
  const Theta map(system.manifold(), 0.5);
  BOOST_CHECK_THROW(starting_procedure(system, map, at(VectorXd::Zero(2)), VectorXd::Zero(2), 0.1),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
