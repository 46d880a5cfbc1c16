#include "courant/integrators/step/displacement_stepper.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/manifolds/euclidean.hpp"
#include "courant/tests/integrators/example_systems.hpp"

// Mistakes that these cases have to notice:
//  * the size of a state is that of coordinates which the equations do not contain
//  * what is kept is that of a step that failed
BOOST_AUTO_TEST_SUITE(displacement_stepper)

using namespace courant;

namespace {

// x' = z, a' = 1 with z = -x³: a is in no equation but its own.
std::shared_ptr<const ImplicitSystem> decay() {
  return std::make_shared<examples::FormulaSystem>(
      std::make_shared<Euclidean>(2), 1, 3,
      [](const ExprVector& x, const ExprVector& v, const ExprVector& z, const Expr&) {
        return examples::equations({v[0] - z[0], v[1] - 1.0, z[0] + x[0] * x[0] * x[0]});
      });
}

// The midpoint rule for it: y = (Δx, Δa, z) with Δx = h z, Δa = h, z = -(x + Δx/2)³.
class Midpoint final : public DisplacementStepper {
 public:
  struct Formulas {
    Formulas() {
      Graph graph;
      const ExprVector y = graph.variables("y", 3), x = graph.variables("x", 2);
      const ExprVector h = graph.variables("h", 1);
      const std::vector<Function::Input> inputs = {{"y", y}, {"x", x}, {"h", h}};
      const Expr middle = x[0] + 0.5 * y[0];
      const ExprVector F =
          examples::equations({y[0] - h[0] * y[2], y[1] - h[0], y[2] + middle * middle * middle});
      equations = EquationSystem(Function("midpoint", inputs, F, {.differentiate = {"y"}}));
      whole = equations.left();
      // x₁, v, and the middle, which is kept.
      advance = Function(
          "advance", inputs,
          examples::equations({x[0] + y[0], x[1] + y[1], y[2], 1.0, middle, x[1] + 0.5 * y[1]}));
    }
    EquationSystem equations;
    Function whole, advance;
  };

  Midpoint(const Formulas& formulas, const std::shared_ptr<const ImplicitSystem>& system)
      : DisplacementStepper("midpoint", system,
                            {.equations = formulas.equations,
                             .whole = formulas.whole,
                             .advance = formulas.advance,
                             .constraint = RoundOffProjection::constraint(*system->manifold(),
                                                                          Backend::interpreter),
                             .displacements = 2,
                             .contained = {0},
                             .h = 2}),
        formulas_(formulas) {}

  double middle() const { return kept()[4]; }
  double middle_of_a() const { return kept()[5]; }
  int begun() const { return begun_; }
  using DisplacementStepper::forget_steps;

 private:
  void do_step(const State& before, double h, State& after) override {
    make_step(Inputs(unknown(), {before.x.data(), &h}), before, h, after);
  }
  void do_begin(const State&, double h, VectorXd& y) override {
    ++begun_;
    y.head(2) << 0.0, h;
  }
  void do_stage(Step& step) const override { step.stage = step.after; }
  std::unique_ptr<Stepper> do_fresh() const override {
    return std::make_unique<Midpoint>(formulas_, system_pointer());
  }
  static std::shared_ptr<const ImplicitSystem> system_pointer() { return decay(); }

  const Formulas& formulas_;
  int begun_ = 0;
};

// The root of Δ + h (x + Δ/2)³.
double displacement(double x, double h) {
  double d = 0.0;
  for (int i = 0; i < 50; ++i) {
    const double m = x + 0.5 * d;
    d -= (d + h * m * m * m) / (1.0 + 1.5 * h * m * m);
  }
  return d;
}

struct Run {
  Run() : stepper(formulas, decay()) {
    state.x = Eigen::Vector2d(1.5, 1e9);
    stepper.prepare(state, h);
  }
  void step() { stepper.step(state, h); }

  Midpoint::Formulas formulas;
  Midpoint stepper;
  State state;
  double h = 0.1;
};

}  // namespace

BOOST_AUTO_TEST_CASE(states_are_those_of_the_advance) {
  Run run;
  double x = 1.5;
  for (int k = 1; k <= 20; ++k) {
    run.step();
    const double d = displacement(x, run.h);
    BOOST_TEST(std::fabs(run.state.x[0] - (x + d)) < 1e-14);
    BOOST_TEST(run.state.x[1] == 1e9 + 0.1 * k, boost::test_tools::tolerance(1e-15));
    BOOST_TEST(std::fabs(run.state.v[0] - d / run.h) < 1e-13);
    BOOST_TEST(run.state.v[1] == 1.0);
    BOOST_TEST(std::fabs(run.state.z[0] - d / run.h) < 1e-13);  // the tail of y
    BOOST_TEST(std::fabs(run.stepper.middle() - (x + 0.5 * d)) < 1e-14);
    x = run.state.x[0];
  }
}

// What do_begin writes is asked for where no step is known, and the steps after it are extrapolated.
BOOST_AUTO_TEST_CASE(steps_begin_once_until_they_are_forgotten) {
  Run run;
  run.step();
  const int first = run.stepper.begun();
  BOOST_TEST(first >= 1);
  for (int k = 0; k < 30; ++k) run.step();
  const int known = run.stepper.begun();
  run.step();
  BOOST_TEST(run.stepper.begun() == known);
  run.stepper.forget_steps();
  run.step();
  BOOST_TEST(run.stepper.begun() > known);
  const int again = run.stepper.begun();
  run.stepper.forget();
  run.step();
  BOOST_TEST(run.stepper.begun() > again);
}

// A step that is solved, but leads to a number that is not finite, leaves what is kept.
BOOST_AUTO_TEST_CASE(a_failed_step_is_not_kept) {
  Run run;
  run.state.x = Eigen::Vector2d(0.0, 1e308);
  run.stepper.prepare(run.state, run.h);
  run.step();
  BOOST_TEST(run.stepper.middle_of_a() == 1e308);
  BOOST_CHECK_THROW(run.stepper.step(run.state, 1.5e308), std::exception);
  BOOST_TEST(run.stepper.middle_of_a() == 1e308);
  BOOST_TEST(run.state.x[1] == 1e308);
}

// Next to a = 10⁹, which the equations do not contain, x of 10⁻³ would be as good as zero: the step would be
// taken as it is predicted.
BOOST_AUTO_TEST_CASE(sizes_are_those_of_what_equations_contain) {
  Run run;
  run.state.x = Eigen::Vector2d(1e-3, 1e12);
  run.stepper.prepare(run.state, run.h);
  double x = 1e-3;
  for (int k = 0; k < 10; ++k) {
    run.step();
    x += displacement(x, run.h);
    BOOST_TEST(std::fabs(run.state.x[0] - x) < 1e-17);
  }
}

BOOST_AUTO_TEST_SUITE_END()
