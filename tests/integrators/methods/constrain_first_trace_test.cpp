// The formulas of Method 2, at steps that are known in closed form.
#include "courant/integrators/methods/constrain_first_trace.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/step/projector.hpp"
#include "courant/tests/integrators/certificate/ladder_catalogue.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * W leads away from the point that is projected
BOOST_AUTO_TEST_SUITE(constrain_first_trace_test)

namespace {

constexpr double kTheta = 0.3, kStep = 0.2, kTime = 1.7;

// x' = cos t on the line y = 2x.
struct OnLine {
  examples::SystemPointer system = examples::flat(
      2, 0, 2, [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr& t) {
        return examples::equations({v[0] - cos(t), x[1] - 2.0 * x[0]});
      });
  VectorXd start{{0.5, 1.0}}, direction{{1.0, 2.0}};
  ConstrainFirst method{system,
                        ConstraintAlgorithm().run(system, {.t = kTime, .x = start}),
                        std::make_shared<Theta>(system->manifold(), kTheta),
                        std::make_shared<OrthogonalProjector>(),
                        {.backend = Backend::interpreter}};
  StepFormulas step = method.formulas().at(0), projection = method.formulas().at(1);

  // (ξ, ξ', μ)
  static VectorXd unknowns(const VectorXd& xi, const VectorXd& rate, double mu) {
    VectorXd y(5);
    y << xi, rate, mu;
    return y;
  }
};

BOOST_AUTO_TEST_CASE(a_step_goes_through_its_stage_from_a_start_that_is_shifted_along_w) {
  const OnLine line;
  const Function F = line.step.whole();
  const VectorXd h{{kStep}}, t{{kTime}}, W{{2.0, -1.0}}, none(0);
  const VectorXd rate = std::cos(kTime + kTheta * kStep) * line.direction;
  const VectorXd xi = kTheta * kStep * rate;
  BOOST_TEST_REQUIRE(F.input_size(0) == 5);
  BOOST_TEST(F({line.unknowns(xi, rate, 0.0), line.start, none, W, h, t}).norm() < 1e-15);

  // The start of the step is x₀ + W μ.
  VectorXd shifted = VectorXd::Zero(F.output_size());
  shifted.head(2) = -0.25 * W;
  BOOST_TEST((F({line.unknowns(xi, rate, 0.25), line.start, none, W, h, t}) - shifted).norm() <
             1e-15);
  // The time is that of the stage.
  BOOST_TEST(
      F({line.unknowns(xi, rate, 0.0), line.start, none, W, h, VectorXd{{kTime + 0.1}}}).norm() >
      1e-2);
}

BOOST_AUTO_TEST_CASE(a_projection_ends_on_the_constraints_where_w_leads_back) {
  const OnLine line;
  const Function F = line.projection.whole();
  const VectorXd t{{kTime}}, W{{2.0, -1.0}}, none(0), xi = 0.1 * line.direction;
  const VectorXd rate = std::cos(kTime) * line.direction, x = line.start + xi;
  const VectorXd near = x + 0.25 * W;
  BOOST_TEST(F({line.unknowns(xi, rate, 0.25), line.start, none, W, near, t}).norm() < 1e-15);
  BOOST_TEST(F({line.unknowns(xi, rate, 0.0), line.start, none, W, near, t}).norm() > 0.5);
}

}  // namespace

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
