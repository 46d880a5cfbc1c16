#include <Eigen/LU>
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "problems.hpp"

// The key `order` of methods.
BOOST_AUTO_TEST_SUITE(method_order)

using namespace courant;

namespace {

const Json kPendulum = {
    {"system",
     {{"type", "hamiltonian"}, {"coordinates", {"q"}}, {"hamiltonian", "p_q^2/2 - cos(q)"}}},
    {"initial", {{"q", 0.7}, {"p_q", 0.4}}}};

// x' = p, y' = q, z' = y x' by a multiplier: see experiments/nonholonomic_order_8.json.
Json nonholonomic() {
  Json experiment = test::experiment_file("nonholonomic_order_8");
  for (const char* key : {"method", "time", "observe", "expect", "output"}) experiment.erase(key);
  return experiment;
}

std::string refusal(const Json& experiment, const Json& method) {
  try {
    test::problem(experiment).prepare(method, 0.1);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_CASE(orders_from_json) {
  const test::Problem free = test::problem(kPendulum), held = test::problem(nonholonomic());
  for (const int order : {2, 4, 6, 8}) {
    const auto method_1 = free.prepare({{"type", "discretize-first"}, {"order", order}}, 0.1);
    BOOST_TEST(method_1.integrator->order() == order);
    BOOST_TEST((method_1.integrator->is_symplectic() == true));
    const auto method_2 = held.prepare({{"type", "constrain-first"}, {"order", order}}, 0.1);
    BOOST_TEST(method_2.integrator->order() == order);
  }
  BOOST_TEST(free.prepare({{"type", "discretize-first"}}, 0.1).integrator->order() == 2);
}

BOOST_AUTO_TEST_CASE(orders_that_cannot_be_had_are_refused) {
  const Json skewed = {{"type", "theta"}, {"theta", 0.3}};
  const auto begins = [](const std::string& text, const std::string& start) {
    BOOST_TEST(text.find(start) == 0u, text);
  };
  begins(refusal(kPendulum, {{"type", "discretize-first"}, {"order", 3}}),
         "/method/order: is 3; expected 2, 4, 6 or 8");
  for (const char* type : {"discretize-first", "constrain-first"})
    for (const int order : {2, 4})
      begins(refusal(kPendulum, {{"type", type}, {"discretization", skewed}, {"order", order}}),
             "/method/order: is " + std::to_string(order) +
                 ", but the method is not symmetric, and of order 1");
  begins(refusal(nonholonomic(), {{"type", "discretize-first"}, {"order", 4}}),
         "/method/order: is 4, but on a system with constraints");
  begins(refusal(kPendulum, {{"type", "discretize-first"}, {"order", 4}, {"start", "rk2"}}),
         "/method/start: is \"rk2\"");
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(method_order_long)

using namespace courant;

// A body in a field that may not turn about an axis fixed in it, on T*SO(3): nonlinear, curved, with a
// nonholonomic constraint. Method 2 of each order; the bench constrained_orders.py makes 10⁶ steps.
BOOST_AUTO_TEST_CASE(orders_and_constraints_on_rotations) {
  const test::Problem body = test::problem(
      {{"system",
        {{"type", "mechanical"},
         {"manifold", "so3"},
         {"coordinates", {"R[3][3]"}},
         {"metric", {{1.4, 0, 0.3}, {0, 2.1, 0.4}, {0.3, 0.4, 1.7}}},
         {"potential", "0.7*R[2][2] + 0.5*R[0][1] + 0.3*R[1][0]"},
         {"nonholonomic", "v_R[2] - 0.25*v_R[0]"}}},
       {"initial", {{"R", {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}}, {"v_R", {0.6, -0.5, 0.15}}}}});
  const VectorXd exact = body.end({{"type", "rkf78"}}, 1.0, 100);
  const Eigen::Matrix3d I{{1.4, 0.0, 0.3}, {0.0, 2.1, 0.4}, {0.3, 0.4, 1.7}};
  const std::vector<std::vector<long>> counts = {
      {32, 64, 128, 256}, {8, 16, 32, 64}, {6, 9, 12, 18}, {4, 5, 6, 8}};
  for (const int order : {2, 4, 6, 8}) {
    const Json method = {
        {"type", "constrain-first"}, {"discretization", "cayley"}, {"order", order}};
    const double shown =
        body.order(method, 1.0, exact, 0, counts[static_cast<std::size_t>(order / 2 - 1)]);
    BOOST_TEST(std::abs(shown - order) < 0.15, "order " << order << " shows " << shown);

    // The energy, which no constraint holds, is off by no lower order.
    const auto energy = [&](const VectorXd& x) {
      const Eigen::Vector3d p = x.tail(3);
      return 0.5 * p.dot(I.inverse() * p) + 0.7 * x[8] + 0.5 * x[1] + 0.3 * x[3];
    };
    std::vector<double> steps, errors;
    for (const long count : counts[static_cast<std::size_t>(order / 2 - 1)]) {
      const double h = 1.0 / static_cast<double>(count);
      const PreparedMethod of_energy = body.prepare(method, h);
      const auto along = of_energy.integrator->stepper();
      State at = of_energy.initial;
      const double initially = energy(at.x);
      double most = 0.0;
      for (long k = 0; k < count; ++k) {
        along->step(at, h);
        most = std::max(most, std::abs(energy(at.x) - initially));
      }
      steps.push_back(h);
      errors.push_back(most);
    }
    const double of_energy = log_log_slope(steps, errors, 1e-12);
    BOOST_TEST(of_energy > order - 0.3, "order " << order << " shows " << of_energy << " in H");
    BOOST_TEST(errors.front() > 1e-11);  // something was measured, ten times where slopes end

    const PreparedMethod prepared = body.prepare(method, 0.1);
    const auto stepper = prepared.integrator->stepper();
    State state = prepared.initial;
    double worst = 0.0, off = 0.0;
    for (int k = 0; k < 4000; ++k) {
      if (k % 500 == 499) stepper->forget();  // as a run does at its epochs
      stepper->step(state, 0.1);
      const Eigen::Vector3d omega = I.inverse() * state.x.tail(3);
      worst = std::max(worst, std::abs(omega[2] - 0.25 * omega[0]));
      off = std::max(off, std::abs(state.x.head(3).squaredNorm() - 1.0));
    }
    BOOST_TEST(worst < 1e-14, "order " << order << " leaves its constraint by " << worst);
    BOOST_TEST(off < 1e-13, "order " << order << " leaves SO(3) by " << off);
  }
}

BOOST_AUTO_TEST_SUITE_END()
