#include "courant/integrators/step/step_program.hpp"

#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/composition.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/integrators/methods/explicit_runge_kutta.hpp"
#include "courant/integrators/methods/substepping_integrator.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/tests/integrators/example_systems.hpp"

// Mistakes that these cases have to notice:
//  * a program makes one step of a composition (integrators/methods/composition.cpp)
BOOST_AUTO_TEST_SUITE(step_program)

using namespace courant;

namespace {

const auto kLine = std::make_shared<Euclidean>(1);

// x' = -x
std::shared_ptr<const ImplicitSystem> decay() {
  return std::make_shared<examples::FormulaSystem>(
      kLine, 0, 1, [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
        return ExprVector(v + x);
      });
}

std::shared_ptr<const DiscretizeFirst> midpoint() {
  return std::make_shared<DiscretizeFirst>(decay(), std::make_shared<Theta>(kLine));
}

}  // namespace

// The equations of the program are solved by the step that the method makes, and by no other.
BOOST_AUTO_TEST_CASE(the_equations_of_a_step) {
  const StepProgram program = courant::step_program(*midpoint());
  BOOST_TEST(program.method == "discretize-first");
  BOOST_TEST_REQUIRE(program.solve.has_value());
  BOOST_TEST(!program.explicit_steps.has_value());
  BOOST_TEST(!program.units.has_value());
  BOOST_TEST(program.solve->displacements == 1);
  BOOST_TEST(program.solve->auxiliaries == 0);
  BOOST_TEST(program.solve->is_affine);
  BOOST_TEST(program.substeps.size() == 1u);

  const double x0 = 3.0, h = 0.5, t = 0.0;
  const double x1 = x0 * (1.0 - 0.5 * h) / (1.0 + 0.5 * h);
  const StepFormulas& step = program.solve->formulas;
  const Function residual("F", step.inputs, step.equations),
      advanced("G", step.inputs, program.solve->advanced);
  // The unknown is h v̄ or v̄ itself: one of them solves the equation, and leads to x₁.
  bool leads_there = false;
  for (const double y : {x1 - x0, (x1 - x0) / h}) {
    const double* in[] = {&y, &x0, &t, &h, &t};
    VectorXd F(1), G(advanced.output_size());
    residual.value(in, F.data());
    advanced.value(in, G.data());
    leads_there = leads_there || (std::abs(F[0]) < 1e-14 && std::abs(G[0] - x1) < 1e-14);
  }
  BOOST_TEST(leads_there);
}

BOOST_AUTO_TEST_CASE(the_tableau_of_an_explicit_method) {
  const auto system = decay();
  const auto field = std::make_shared<VectorField>(
      system, ConstraintAlgorithm().run(system, {.x = VectorXd::Constant(1, 1.0)}),
      Backend::interpreter);
  const ExplicitRungeKutta rk4(field, ExplicitRungeKutta::Kind::classical);
  const StepProgram program = courant::step_program(rk4);
  BOOST_TEST_REQUIRE(program.explicit_steps.has_value());
  BOOST_TEST(program.explicit_steps->times == std::vector<double>({0.0, 0.5, 0.5, 1.0}),
             boost::test_tools::per_element());
  BOOST_TEST(program.explicit_steps->rows.size() == 4u);
  double weights = 0.0;
  for (const auto& b : program.explicit_steps->rows.back()) weights += b.value_or(0.0);
  BOOST_TEST(std::abs(weights - 1.0) < 1e-15);
}

BOOST_AUTO_TEST_CASE(a_composition_has_substeps) {
  const StepProgram program = courant::step_program(Composition(midpoint(), 4));
  double sum = 0.0, cubes = 0.0;
  for (const double part : program.substeps) {
    sum += part;
    cubes += part * part * part;
  }
  BOOST_TEST(program.substeps.size() >= 3u);
  BOOST_TEST(std::abs(sum - 1.0) < 1e-14);
  BOOST_TEST(std::abs(cubes) < 1e-14);  // order 4
}

BOOST_AUTO_TEST_CASE(methods_without_a_program_are_named) {
  const SubsteppingIntegrator divided(midpoint(), {.halvings = 2});
  BOOST_CHECK_EXCEPTION(
      courant::step_program(divided), std::invalid_argument,
      [](const std::invalid_argument& error) {
        return std::string(error.what())
            .starts_with("the steps of discretize-first are not known as formulas alone");
      });
}

// Explicit steps leave a sphere, which no formulas of theirs bring them back to.
BOOST_AUTO_TEST_CASE(explicit_steps_on_curved_spaces_have_no_program) {
  const auto sphere = std::make_shared<Sphere>(2);
  const auto system = std::make_shared<examples::FormulaSystem>(
      sphere, 0, 3, [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
        ExprVector rotation(3);
        rotation << -x[1], x[0], Expr(0.0);
        return ExprVector(v - rotation);
      });
  const auto field = std::make_shared<VectorField>(
      system, ConstraintAlgorithm().run(system, {.x = Eigen::Vector3d(0.6, 0.0, 0.8)}),
      Backend::interpreter);
  BOOST_CHECK_THROW(
      courant::step_program(ExplicitRungeKutta(field, ExplicitRungeKutta::Kind::classical)),
      std::invalid_argument);
  const DiscretizeFirst midpoint(system, std::make_shared<Theta>(sphere));
  const StepProgram program = courant::step_program(midpoint);
  BOOST_TEST(program.solve->displacements == 2);
  BOOST_TEST(program.solve->space.has_basis());
  BOOST_TEST(program.solve->space.has_equations());
}

BOOST_AUTO_TEST_SUITE_END()
