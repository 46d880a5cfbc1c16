// The energy of Method 2 on nonholonomic systems, (39) to (43), over many steps: where it does not drift,
// and where it does. docs/nonholonomic-energy.md has 10⁶ steps of seven systems.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "problems.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(nonholonomic_energy)

namespace {

// Σ p²/(2m) + Σ k q²/2 at (q, p).
struct Energy {
  VectorXd masses, stiffnesses;
  double operator()(const VectorXd& x) const {
    const Index n = masses.size();
    return 0.5 * (x.tail(n).cwiseAbs2().cwiseQuotient(masses).sum() +
                  x.head(n).cwiseAbs2().dot(stiffnesses));
  }
};

// The greatest |H - H(0)| in each tenth of a run in steps of 0.1.
std::vector<double> tenths(const test::Problem& motion, const Energy& energy, int order,
                           int steps) {
  const PreparedMethod prepared = motion.prepare(
      {{"type", "constrain-first"}, {"projector", "momentum"}, {"order", order}}, 0.1);
  const auto stepper = prepared.integrator->stepper();
  State state = prepared.initial;
  const double first = energy(state.x);
  std::vector<double> result(10, 0.0);
  for (int k = 0; k < steps; ++k) {
    stepper->step(state, 0.1);
    double& greatest = result[static_cast<std::size_t>(10 * k / steps)];
    greatest = std::max(greatest, std::abs(energy(state.x) - first));
  }
  return result;
}

}  // namespace

// Contact oscillators: an oscillation of H that stays the same, smaller at order 4.
BOOST_AUTO_TEST_CASE(bounded_on_oscillators) {
  const Json file = test::experiment_file("contact_oscillators");
  const test::Problem motion =
      test::problem({{"system", file.at("system")}, {"initial", file.at("initial")}});
  const Energy energy{VectorXd::Constant(5, 1.6), VectorXd::Constant(5, 2.5)};
  double before = 1.0;
  for (const int order : {2, 4}) {
    const std::vector<double> H = tenths(motion, energy, order, 6000);
    BOOST_TEST(H.back() < 1.1 * H.front());
    BOOST_TEST(H.front() < 1.1 * H.back());
    BOOST_TEST(H.front() < 0.2 * before);
    BOOST_TEST(H.front() > 1e-12);
    before = H.front();
  }
}

// Chaplygin's sleigh on a spring, which has no invariant measure: H goes on moving away. The motion is chaotic, and rounding
// decides which one it is: of five that begin 10⁻¹² apart the energies are added up.
BOOST_AUTO_TEST_CASE(drifts_on_the_sleigh) {
  const Energy energy{Eigen::Vector3d(3.0, 3.0, 0.5), Eigen::Vector3d(4.0, 5.2, 0.0)};
  double early = 0.0, late = 0.0;
  for (int start = 0; start < 5; ++start) {
    const test::Problem motion =
        test::problem({{"system",
                        {{"type", "mechanical"},
                         {"coordinates", {"x", "y", "theta"}},
                         {"metric", {3.0, 3.0, 0.5}},
                         {"potential", "2*x^2 + 2.6*y^2"},
                         {"nonholonomic", "sin(theta)*x' - cos(theta)*y' + 0.2*theta'"}}},
                       {"initial",
                        {{"x", 0.5 + 1e-12 * start},
                         {"y", -0.3},
                         {"theta", 0.4},
                         {"x'", "0.6*cos(0.4) - 0.14*sin(0.4)"},
                         {"y'", "0.6*sin(0.4) + 0.14*cos(0.4)"},
                         {"theta'", 0.7}}}});
    const std::vector<double> H = tenths(motion, energy, 2, 20000);
    early += H.front();
    late += H.back();
  }
  BOOST_TEST(late > 4.0 * early);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
