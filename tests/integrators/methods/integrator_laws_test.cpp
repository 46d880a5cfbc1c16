#include "courant/integrators/methods/integrator_laws.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <functional>
#include <limits>
#include <stdexcept>

#include "../../manifolds/catalogue.hpp"
#include "../step/integrator_catalogue.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/structures/canonical_symplectic.hpp"

// Mistakes that these cases have to notice:
//  * Method 1 is called symplectic on any system (integrators/methods/discretize_first.hpp)
//  * tangent blocks are differentiated as the ladder's basis happened to lie
//    (integrators/certificate/local_formulation.cpp)
//  * multipliers have to be right before the velocity is known
//    (integrators/step/step_continuation.cpp)
BOOST_AUTO_TEST_SUITE(integrator_laws)

using namespace courant;

namespace {

// An integrator of which claims and steps can be replaced.
class Liar final : public Integrator {
 public:
  struct Parts {
    int order;
    bool symmetric;
    std::optional<bool> symplectic;
    // From the state before, the state after (which may be changed), the step size and the number
    // of the step.
    std::function<void(const State&, State&, double, long)> spoil = {};
    // Whether a step that fails leaves its mark on the next one.
    bool moves_on_failure = false;
    // Whether it fails with an exception of another kind.
    bool fails_otherwise = false;
    // The step size that is used for h.
    std::function<double(double)> taken = [](double h) { return h; };
    // What is made of the initial state.
    std::function<State(State)> started = [](State state) { return state; };
    bool exact = false;
    // Instead of that of the steps.
    std::shared_ptr<const StepDifferential> differential = nullptr;
  };
  Liar(std::shared_ptr<const Integrator> truth, Parts parts)
      : Integrator(truth->system()), truth_(std::move(truth)), parts_(std::move(parts)) {}

  std::string name() const override { return "Liar"; }
  int order() const override { return parts_.order; }
  bool is_symmetric() const override { return parts_.symmetric; }
  std::optional<bool> is_symplectic() const override { return parts_.symplectic; }
  bool has_exact_energy() const override { return parts_.exact; }
  bool is_native() const override { return truth_->is_native(); }

 private:
  class Trajectory final : public Stepper {
   public:
    Trajectory(const Parts& parts, std::shared_ptr<const Integrator> truth)
        : Stepper("Liar", truth->system()),
          parts_(parts),
          truth_(std::move(truth)),
          stepper_(truth_->stepper()) {}

   private:
    void do_prepare(State& state, double) override { state = parts_.started(state); }
    void do_step(const State& before, double h, State& after) override {
      const double end = after.t;
      after = before;
      if (is_marked_) after.x *= 1.0 + 1e-6;
      try {
        stepper_->step(after, parts_.taken(h), end);
      } catch (const SolveError&) {
        is_marked_ = parts_.moves_on_failure;
        if (parts_.fails_otherwise) throw std::runtime_error("It failed.");
        throw;
      }
      if (parts_.spoil) parts_.spoil(before, after, h, stepper_->statistics().steps);
    }
    void do_keep(const State&, const State&) override {}
    void do_stage(Step& step) const override {
      step.stage = stepper_->last().stage;
      step.effort = stepper_->last().effort;
    }
    void do_forget() override { stepper_->forget(); }
    std::unique_ptr<Stepper> do_fresh() const override {
      return std::make_unique<Trajectory>(parts_, truth_);
    }
    Parts parts_;
    std::shared_ptr<const Integrator> truth_;
    std::unique_ptr<Stepper> stepper_;
    bool is_marked_ = false;
  };

  std::unique_ptr<Stepper> do_stepper() const override {
    return std::make_unique<Trajectory>(parts_, truth_);
  }

  std::shared_ptr<const StepDifferential> do_differential() const override {
    return parts_.differential;
  }

  std::shared_ptr<const Integrator> truth_;
  Parts parts_;
};

// As if the step were a little longer or shorter than it is.
class StretchedDifferential final : public StepDifferential {
 public:
  StretchedDifferential(std::shared_ptr<const StepDifferential> truth, double factor)
      : truth_(std::move(truth)), factor_(factor) {}

 private:
  MatrixXd do_images(const Step& step, const MatrixXd& V) const override {
    return factor_ * (*truth_)(step, V);
  }
  MatrixXd do_pull_back(const Step& step, const MatrixXd& Lambda) const override {
    return factor_ * truth_->pull_back(step, Lambda);
  }
  std::shared_ptr<const StepDifferential> truth_;
  double factor_;
};

const std::vector<test::IntegratorEntry>& catalogue() {
  static const auto table = test::integrator_catalogue();
  return table;
}

const test::IntegratorEntry& entry(const std::string& name) {
  const auto found =
      std::ranges::find_if(catalogue(), [&](const auto& e) { return e.name == name; });
  BOOST_REQUIRE(found != catalogue().end());
  return *found;
}

Liar::Parts truth_of(const test::IntegratorEntry& entry) {
  return {.order = entry.integrator->order(),
          .symmetric = entry.integrator->is_symmetric(),
          .symplectic = entry.integrator->is_symplectic()};
}

// The laws that fail, by number.
std::vector<std::string> failed(const test::IntegratorEntry& entry, const Liar::Parts& parts) {
  std::vector<std::string> numbers;
  for (const LawResult& result :
       check_integrator(Liar(entry.integrator, parts), entry.setting, {.both_ways = true}).laws)
    if (!result.passed()) numbers.push_back(result.law.substr(0, result.law.find(' ')));
  return numbers;
}
bool fails(const test::IntegratorEntry& entry, const Liar::Parts& parts, const std::string& law) {
  const auto numbers = failed(entry, parts);
  return std::ranges::find(numbers, law) != numbers.end();
}

const test::IntegratorEntry& midpoint() {
  return entry("discretize-first, midpoint: driven pendulum");
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_integrator_keeps_every_law) {
  for (const auto& [name, integrator, setting, both_ways] : catalogue())
    for (const LawResult& result :
         check_integrator(*integrator, setting, {.both_ways = both_ways}).laws)
      BOOST_TEST(result.passed(), name << ": " << result);
}

BOOST_AUTO_TEST_CASE(every_class_is_in_the_catalogue) {
  const auto classes = test::final_classes("integrators", "Integrator|IntegratorAdaptor");
  BOOST_TEST(classes.size() >= 3U);
  for (const std::string& name : classes)
    BOOST_TEST(std::ranges::any_of(
                   catalogue(),
                   [&](const auto& entry) { return test::is_of_class(*entry.integrator, name); }),
               name << " is missing from the catalogue of integrators");
}

BOOST_AUTO_TEST_CASE(the_integrator_that_nothing_is_planted_in_passes) {
  BOOST_TEST(failed(midpoint(), truth_of(midpoint())).empty());
}

// What is claimed of a method is claimed of it on a system.
BOOST_AUTO_TEST_CASE(claims_are_about_method_and_system) {
  BOOST_TEST(midpoint().integrator->is_symplectic().value_or(false));
  BOOST_TEST(!entry("discretize-first, midpoint of T*R, no lift: driven pendulum")
                  .integrator->is_symplectic()
                  .has_value());
  const auto& damped = entry("discretize-first, midpoint: damped pendulum");
  BOOST_TEST(!damped.integrator->is_symplectic().has_value());
}

BOOST_AUTO_TEST_CASE(p1_an_order_that_is_too_high_or_too_low) {
  auto parts = truth_of(midpoint());
  parts.order = 3;
  BOOST_TEST(fails(midpoint(), parts, "P1"));
  parts.order = 1;
  BOOST_TEST(fails(midpoint(), parts, "P1"));
}

// Round-off of 1e-9, as ill-conditioned constraints leave of a step, hides the errors of short steps and those of
// the setting: the order shows with longer ones, and a wrong claim with none.
BOOST_AUTO_TEST_CASE(p1_an_order_below_round_off) {
  auto short_steps = midpoint();
  short_steps.setting.step *= 0.02;
  auto parts = truth_of(midpoint());
  parts.spoil = [](const State&, State& after, double, long) {
    after.x = after.x.unaryExpr([](double x) { return std::round(x * 1e9) * 1e-9; });
  };
  BOOST_TEST(!fails(short_steps, parts, "P1"));
  BOOST_TEST(!fails(short_steps, parts, "P6"));
  for (const int order : {1, 3}) {
    parts.order = order;
    BOOST_TEST(fails(short_steps, parts, "P1"));
  }
}

BOOST_AUTO_TEST_CASE(p2_a_symmetry_that_is_wrongly_claimed_or_denied) {
  const auto& euler = entry("discretize-first, theta = 0: driven pendulum");
  auto parts = truth_of(euler);
  parts.symmetric = true;
  BOOST_TEST(fails(euler, parts, "P2"));
  parts = truth_of(midpoint());
  parts.symmetric = false;
  BOOST_TEST(fails(midpoint(), parts, "P2"));
}

// With damping, and with a map that is no lift.
BOOST_AUTO_TEST_CASE(p3_p4_symplecticity_that_is_wrongly_claimed) {
  auto damped = entry("discretize-first, midpoint: damped pendulum");
  damped.setting.structure = midpoint().setting.structure;
  auto parts = truth_of(damped);
  parts.symplectic = true;
  BOOST_TEST(fails(damped, parts, "P3"));
  const auto& euler = entry("rk2: driven pendulum");
  parts = truth_of(euler);
  parts.symplectic = true;
  BOOST_TEST(fails(euler, parts, "P3"));
  BOOST_TEST(fails(euler, parts, "P4"));
}

// Method 1 balances dH(x̄) instead of H, and a step that is moved a little does not balance H.
BOOST_AUTO_TEST_CASE(p10_a_balance_that_is_wrongly_claimed) {
  const auto& exact = entry("discrete-gradient, gonzalez, midpoint: open port");
  BOOST_TEST(exact.integrator->has_exact_energy());
  auto parts = truth_of(exact);
  parts.exact = true;
  BOOST_TEST(!fails(exact, parts, "P10"));
  parts.spoil = [](const State&, State& after, double, long) { after.x *= 1.0 + 1e-10; };
  BOOST_TEST(fails(exact, parts, "P10"));
  const auto& method_1 = entry("discretize-first, midpoint: driven pendulum");
  BOOST_TEST(!method_1.integrator->has_exact_energy());
  parts = truth_of(method_1);
  parts.exact = true;
  BOOST_TEST(fails(method_1, parts, "P10"));
}

BOOST_AUTO_TEST_CASE(p5_a_step_that_remembers) {
  auto parts = truth_of(midpoint());
  parts.spoil = [](const State&, State& after, double, long k) {
    after.x *= 1.0 + 1e-8 * static_cast<double>(k);
  };
  BOOST_TEST(fails(midpoint(), parts, "P5"));
}

BOOST_AUTO_TEST_CASE(p6_a_step_that_does_not_go_back) {
  auto parts = truth_of(midpoint());
  parts.taken = [](double h) { return std::abs(h); };
  BOOST_TEST(fails(midpoint(), parts, "P6"));
}

BOOST_AUTO_TEST_CASE(p7_a_failure_that_leaves_a_mark) {
  const auto& rod = entry("constrain-first, midpoint: Cartesian pendulum");
  BOOST_TEST(!fails(rod, truth_of(rod), "P7"));
  auto parts = truth_of(rod);
  parts.moves_on_failure = true;
  BOOST_TEST(fails(rod, parts, "P7"));
  parts = truth_of(rod);
  parts.fails_otherwise = true;
  BOOST_TEST(fails(rod, parts, "P7"));
}

// The base class refuses them.
BOOST_AUTO_TEST_CASE(p7_numbers_that_are_not_finite_do_not_get_out) {
  auto parts = truth_of(midpoint());
  parts.spoil = [](const State&, State& after, double h, long) {
    if (std::abs(h) > 1.0) after.x[0] = std::numeric_limits<double>::quiet_NaN();
  };
  BOOST_TEST(!fails(midpoint(), parts, "P7"));
  State state = midpoint().setting.initial;
  BOOST_CHECK_THROW(Liar(midpoint().integrator, parts).advance(state, 2.0), SolveError);
}

BOOST_AUTO_TEST_CASE(p8_a_step_that_needs_the_velocity) {
  auto parts = truth_of(midpoint());
  parts.started = [](State state) {
    if (state.v.isZero()) state.x *= 1.0 + 1e-6;
    return state;
  };
  BOOST_TEST(fails(midpoint(), parts, "P8"));
}

BOOST_AUTO_TEST_CASE(p9_a_clock_that_is_wrong) {
  auto parts = truth_of(midpoint());
  parts.spoil = [](const State&, State& after, double h, long) { after.t += 1e-9 * h; };
  BOOST_TEST(fails(midpoint(), parts, "P9"));
}

BOOST_AUTO_TEST_CASE(p11_a_differential_that_is_not_that_of_the_steps) {
  const auto truth = midpoint().integrator->differential();
  auto parts = truth_of(midpoint());
  parts.differential = truth;
  BOOST_TEST(!fails(midpoint(), parts, "P11"));
  parts.differential = std::make_shared<StretchedDifferential>(truth, 1.0 + 1e-5);
  BOOST_TEST(fails(midpoint(), parts, "P11"));
}

BOOST_AUTO_TEST_SUITE_END()
