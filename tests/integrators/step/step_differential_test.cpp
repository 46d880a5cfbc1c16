#include "courant/integrators/step/step_differential.hpp"

#include <array>
#include <boost/test/unit_test.hpp>

#include "../example_systems.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/composition.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/step/projector.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "integrator_catalogue.hpp"

// Mistakes that these cases have to notice:
//  * the differential of Method 1 forgets the unknowns z
//    (integrators/step/stage_step_differential.cpp)
//  * where the map has no inverse the displacement is not h v
//    (integrators/step/stage_step_differential.cpp)
//  * W does not turn (integrators/methods/constrain_first_differential.cpp)
//  * steps of Method 2 end before they are projected
//    (integrators/methods/constrain_first_differential.cpp)
//  * the stages of an explicit method are not differentiated with those before
//    (integrators/methods/explicit_runge_kutta.cpp)
//  * the reduced map is differentiated away from its step (integrators/methods/reduced_map.cpp)
BOOST_AUTO_TEST_SUITE(step_differential)

using namespace courant;

namespace {

// A basis of T_xM_f as tangent vectors, orthonormal.
MatrixXd directions(const IntegratorSetting& setting) {
  const MatrixXd basis = setting.system->manifold()->tangent_basis(setting.initial.x);
  if (setting.conormals.rows() == 0) return basis;
  return basis * kernel(setting.conormals * basis, {.data_error = 1e-9});
}

MatrixXd exact(const test::IntegratorEntry& entry) {
  const IntegratorSetting& setting = entry.setting;
  const auto stepper = entry.integrator->stepper();
  stepper->tell_parts();
  State state = setting.initial;
  stepper->step(state, setting.step);
  const MatrixXd V = setting.system->manifold()->frame(setting.initial.x) * directions(setting);
  return (*entry.integrator->differential())(stepper->last(), V);
}

// Of steps from nearby points, by differences of order 8. They know thirteen digits, and nine of Gonzalez'
// differential, which divides by the length of the step. On M_f the
// points nearby are on curves that are tangent to it: Method 2 moves them onto it.
MatrixXd by_differences(const test::IntegratorEntry& entry) {
  constexpr std::array kWeights = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
  constexpr double kStep = 0.01;
  const IntegratorSetting& setting = entry.setting;
  const Manifold& M = *setting.system->manifold();
  const MatrixXd V = directions(setting);
  MatrixXd result = MatrixXd::Zero(M.ambient_dimension(), V.cols());
  for (Index k = 0; k < V.cols(); ++k)
    for (std::size_t i = 0; i < kWeights.size(); ++i)
      for (const double sign : {1.0, -1.0}) {
        State state = setting.initial;
        const double s = sign * static_cast<double>(i + 1) * kStep;
        state.x = M.retract(state.x, VectorXd(s * V.col(k)));
        result.col(k) +=
            sign * kWeights[i] / kStep * entry.integrator->advance(state, setting.step).x;
      }
  return result;
}

}  // namespace

// Every method of the catalogue that has one: both of them, discrete gradients, explicit ones, compositions, on
// vector spaces, T*S², T*SO(3), with constraints on T*S³, on duals of Lie algebras.
BOOST_AUTO_TEST_CASE(agrees_with_differences_for_every_method) {
  for (const auto& entry : test::integrator_catalogue()) {
    if (entry.setting.system->manifold()->dimension() == 0 || !entry.integrator->differential())
      continue;
    const MatrixXd measured = by_differences(entry), image = exact(entry);
    BOOST_TEST((image - measured).norm() < 1e-9 * measured.norm(),
               entry.name << ": " << (image - measured).norm() / measured.norm());
  }
}

// x' = -x² by the midpoint rule in closed form: (x₁ - x₀)/h = -((x₀ + x₁)/2)².
BOOST_AUTO_TEST_CASE(of_one_equation_it_is_the_quotient_of_the_partial_derivatives) {
  const auto line = std::make_shared<Euclidean>(1);
  const auto system = std::make_shared<examples::FormulaSystem>(
      line, 0, 1, [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
        return examples::equations({v[0] + square(x[0])});
      });
  const auto ladder = ConstraintAlgorithm().run(system, {.x = VectorXd::Constant(1, 0.8)});
  const ConstrainFirst method(system, ladder, std::make_shared<Theta>(line),
                              std::make_shared<OrthogonalProjector>());
  const auto stepper = method.stepper();
  State state = ladder.point;
  const double h = 0.3;
  stepper->step(state, h);
  const double middle = 0.5 * (0.8 + state.x[0]);
  const MatrixXd image = (*method.differential())(stepper->last(), MatrixXd::Ones(1, 1));
  BOOST_TEST(std::abs(image(0, 0) - (1.0 - h * middle) / (1.0 + h * middle)) < 1e-14);
}

BOOST_AUTO_TEST_CASE(a_composition_needs_the_parts_of_its_steps) {
  for (const auto& entry : test::integrator_catalogue()) {
    if (!dynamic_cast<const Composition*>(entry.integrator.get())) continue;
    const auto stepper = entry.integrator->stepper();
    State state = entry.setting.initial;
    stepper->step(state, entry.setting.step);
    const MatrixXd V = MatrixXd::Zero(state.x.size(), 1);
    const auto differential = entry.integrator->differential();
    BOOST_CHECK_THROW((*differential)(stepper->last(), V), std::invalid_argument);
    BOOST_CHECK_THROW((*differential)(stepper->last(), MatrixXd(1, 1)), std::invalid_argument);
    return;
  }
}

BOOST_AUTO_TEST_CASE(redundant_equations_do_not_matter_and_freedom_is_told) {
  MatrixXd A(3, 2), B(3, 1);
  A << 2.0, 0.0, 0.0, 1e-6, 4.0, 0.0;
  B << 6.0, 2e-6, 12.0;
  BOOST_TEST((implicit_derivative("test", A, B, 2) - Eigen::Vector2d(-3.0, -2.0)).norm() < 1e-12);
  B(2) = 11.0;
  BOOST_CHECK_THROW(implicit_derivative("test", A, B, 2), std::domain_error);
  MatrixXd free(2, 2), right(2, 1);
  free << 1.0, 1.0, 2.0, 2.0;
  right << 1.0, 2.0;
  BOOST_CHECK_THROW(implicit_derivative("test", free, right, 1), std::domain_error);
  BOOST_CHECK_NO_THROW(implicit_derivative("test", free, right, 0));
}

BOOST_AUTO_TEST_SUITE_END()
