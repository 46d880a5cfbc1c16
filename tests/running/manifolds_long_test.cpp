// A million steps on S², T*SO(3) and T*S²: the points stay on their manifolds, Casimirs and moment
// maps stay what they are, the energy of symplectic methods has no drift, and that of others has.
// On the other spaces fewer.
#include <boost/test/unit_test.hpp>

#include "motions.hpp"
#include "problems.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(manifolds_long)

namespace {

using test::method_1, test::method_2;

constexpr long kMillion = 1000000;

// What a run shows of one number, of which every hundredth value is looked at.
struct Record {
  double drift = 0.0;  // greatest distance from the first value
  double slope = 0.0;  // of the least-squares line through it, over the whole run
  // Of a bounded oscillation the line shows a few thousandths, of a drift all.
  bool drifts() const { return std::abs(slope) > 0.01 * drift; }
};

using Quantity = std::function<double(const VectorXd& x)>;

std::vector<Record> run(const test::Problem& problem, const Json& method, double h,
                        const std::vector<Quantity>& quantities, long steps = kMillion) {
  const PreparedMethod prepared = problem.prepare(method, h, Backend::automatic);
  const auto stepper = prepared.integrator->stepper();
  State state = prepared.initial;
  stepper->prepare(state, h);
  std::vector<Record> records(quantities.size());
  std::vector<double> first, moment(quantities.size());
  for (const Quantity& quantity : quantities) first.push_back(quantity(state.x));
  double square = 0.0;

  for (long k = 1; k <= steps; ++k) {
    stepper->step(state, h);
    if (k % 100 != 0) continue;

    const double centred = static_cast<double>(k) - 0.5 * (static_cast<double>(steps) + 100.0);
    square += centred * centred;
    for (std::size_t i = 0; i < quantities.size(); ++i) {
      const double change = quantities[i](state.x) - first[i];
      records[i].drift = std::max(records[i].drift, std::abs(change));
      moment[i] += centred * change;
    }
  }
  for (std::size_t i = 0; i < quantities.size(); ++i)
    records[i].slope = static_cast<double>(steps) * moment[i] / square;
  return records;
}

double turned(const VectorXd& x, const Eigen::Vector3d& inertia) {
  return 0.5 * x.tail(3).cwiseAbs2().cwiseQuotient(inertia).sum();
}

double orthonormality(const VectorXd& x) {
  const Eigen::Matrix3d R = x.head(9).reshaped<Eigen::RowMajor>(3, 3);
  return (R.transpose() * R - Eigen::Matrix3d::Identity()).lpNorm<Eigen::Infinity>();
}

double momentum_in_space(const VectorXd& x, Index i) { return x.segment(3 * i, 3).dot(x.tail(3)); }

const Eigen::Vector3d kInertia(1.0, 2.0, 3.0);

}  // namespace

BOOST_AUTO_TEST_CASE(reduced_rigid_body) {
  const auto body = test::problem(test::experiment_file("rigid_body"));
  const std::vector<Quantity> quantities = {
      [](const VectorXd& xi) { return xi.norm(); },
      [](const VectorXd& xi) { return turned(xi, kInertia); }};
  for (const char* map : {"chordal", "exponential", "spherical-midpoint"}) {
    const auto [length, energy] = [&] {
      const auto records = run(body, method_1(map), 0.1, quantities);
      return std::pair(records[0], records[1]);
    }();
    BOOST_TEST_MESSAGE(map << ": length " << length.drift << ", energy " << energy.drift
                           << ", slope " << energy.slope);
    BOOST_TEST(length.drift < 1e-12, map);
    BOOST_TEST(energy.drift < 1e-12, map);  // round-off alone
  }
  // Of orders 2, 4 and 5: off the sphere and off the energy, further with every step.
  for (const auto& [method, least] : {std::pair("rk2", 1e-2), {"rk4", 1e-6}, {"dopri5", 5e-8}}) {
    const auto records = run(body, method, 0.1, quantities);
    BOOST_TEST_MESSAGE(method << ": length " << records[0].drift << ", energy " << records[1].drift
                              << ", slope " << records[1].slope);
    BOOST_TEST(records[0].drift > least, method);
    BOOST_TEST(std::abs(records[0].slope) > 0.5 * records[0].drift, method);
    BOOST_TEST(std::abs(records[1].slope) > 0.5 * records[1].drift, method);
  }
}

BOOST_AUTO_TEST_CASE(rigid_body_on_the_group) {
  const auto body = test::problem(test::experiment_file("rigid_body_so3"));
  const std::vector<Quantity> quantities = {
      orthonormality, [](const VectorXd& x) { return turned(x, kInertia); },
      [](const VectorXd& x) { return momentum_in_space(x, 0); },
      [](const VectorXd& x) { return momentum_in_space(x, 2); }};
  for (const char* map : {"exponential", "cayley"}) {
    const auto records = run(body, method_1(map), 0.1, quantities);
    BOOST_TEST_MESSAGE(map << ": R^T R " << records[0].drift << ", energy " << records[1].drift
                           << ", slope " << records[1].slope << ", momentum " << records[2].drift
                           << ", " << records[3].drift);
    BOOST_TEST(records[0].drift < 1e-12, map);
    BOOST_TEST(records[1].drift < 1e-4, map);
    BOOST_TEST(!records[1].drifts(), map);
    BOOST_TEST(std::max(records[2].drift, records[3].drift) < 1e-10, map);
  }
  const auto records = run(body, "rk4", 0.1, quantities);
  BOOST_TEST_MESSAGE("rk4: R^T R " << records[0].drift << ", energy " << records[1].drift
                                   << ", slope " << records[1].slope);
  BOOST_TEST(records[0].drift > 1e-5);
  BOOST_TEST(records[1].drifts());
}

// What is off M by round-off may not grow, as it would by a factor e in 1800 steps on H².
BOOST_AUTO_TEST_CASE(every_space) {
  for (const test::Motion& motion : test::motions()) {
    const auto problem = test::problem(motion.experiment);
    const ImplicitSystem& system = *problem.experiment.model.system;
    const VectorXd none = VectorXd::Zero(system.auxiliary_size());
    const std::vector<Quantity> quantities = {
        [&](const VectorXd& x) { return system.manifold()->point_defect(x); },
        [&](const VectorXd& x) {
          return system.energy(constants(x), constants(none), 0.0)->value();
        }};
    for (const Json& method : {method_1(motion.maps[0]), method_2(motion.maps[0])}) {
      const auto records = run(problem, method, 0.05, quantities, 20000);
      const std::string name = motion.space + ", " + method.dump();
      BOOST_TEST_MESSAGE(name << ": defect " << records[0].drift << ", energy " << records[1].drift
                              << ", slope " << records[1].slope);
      BOOST_TEST(records[0].drift < 1e-12, name);
      BOOST_TEST(records[1].drift > 1e-6, name);
      BOOST_TEST(records[1].drift < 0.05, name);
    }
  }
}

BOOST_AUTO_TEST_CASE(spherical_pendulum) {
  const auto pendulum = test::problem(test::experiment_file("spherical_pendulum"));
  const std::vector<Quantity> quantities = {
      [](const VectorXd& x) { return x.head(3).norm(); },
      [](const VectorXd& x) { return x.head(3).dot(x.tail(3)); },
      [](const VectorXd& x) { return 0.5 * x.tail(3).squaredNorm() + 2.0 * x[2]; },
      [](const VectorXd& x) { return x[0] * x[4] - x[1] * x[3]; }};
  for (const char* map : {"exponential", "chordal", "spherical-midpoint"}) {
    const auto records = run(pendulum, method_1(map), 0.05, quantities);
    BOOST_TEST_MESSAGE(map << ": length " << records[0].drift << ", tangency " << records[1].drift
                           << ", energy " << records[2].drift << ", slope " << records[2].slope
                           << ", momentum " << records[3].drift);
    BOOST_TEST(records[0].drift < 1e-12, map);
    BOOST_TEST(records[1].drift < 1e-12, map);
    BOOST_TEST(records[2].drift < 1e-4, map);
    BOOST_TEST(!records[2].drifts(), map);
    BOOST_TEST(records[3].drift < 1e-10, map);
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
