#include "courant/structures/interconnection.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/network.hpp"
#include "courant/structures/port_hamiltonian_system.hpp"

// Mistakes that these cases have to notice:
//  * a joint may make power
//  * joined ports keep the equations of their systems
//  * power comes out where a port takes it in (structures/network.cpp)
BOOST_AUTO_TEST_SUITE(interconnection_test)

using namespace courant;

namespace {

using V = const ExprVector&;

// H = Σ x⁴/4 with ports on the first coordinate, and a feedthrough.
std::shared_ptr<const PortHamiltonianSystem> part(
    const std::shared_ptr<const Manifold>& M, double resistance, double feedthrough,
    std::optional<PortHamiltonianSystem::Input> input = {}) {
  const Index n = M->tangent_dimension();
  return std::make_shared<PortHamiltonianSystem>(
      PortHamiltonianSystem::Matrices{
          [n](V x) {
            ExprMatrix J = ExprMatrix::Zero(n, n);
            for (Index i = 0; i + 1 < n; ++i) {
              J(i, i + 1) = 1.0 + square(x[0]);
              J(i + 1, i) = -J(i, i + 1);
            }
            return J;
          },
          [n, resistance](V) { return ExprMatrix(Expr(resistance) * ExprMatrix::Identity(n, n)); },
          [n](V x) {
            ExprMatrix B = ExprMatrix::Zero(n, 1);
            B(0, 0) = 1.0 + x[n - 1];
            return B;
          },
          1, [feedthrough](V) { return ExprMatrix(ExprMatrix::Constant(1, 1, feedthrough)); }},
      std::make_shared<Hamiltonian>(
          M, [](V x, const Expr&) { return 0.25 * square(ExprVector(x.cwiseProduct(x)).sum()); }),
      std::move(input));
}

VectorXd random(Index size, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return VectorXd::NullaryExpr(size, [&] { return normal(generator); });
}

}  // namespace

// Each system has its own equations in its own block, on the product of their manifolds, and the joint comes
// in the place of the equations of its ports.
BOOST_AUTO_TEST_CASE(equations_of_the_parts) {
  const auto first = part(std::make_shared<Euclidean>(2), 0.1, 0.2);
  const auto second = part(std::make_shared<Sphere>(2), 0.0, 0.0);
  const auto third = part(std::make_shared<Euclidean>(1), 0.3, 0.4);
  const double k = 0.7;
  const auto whole = std::make_shared<Interconnection>(
      std::vector<Interconnection::Part>{{"a", first}, {"b", second}, {"c", third}},
      std::vector{Joint::gyrator({2, 0}, (MatrixXd(2, 2) << 0.0, -k, k, 0.0).finished())});
  BOOST_TEST(!whole->is_free(0));
  BOOST_TEST(whole->is_free(1));
  BOOST_TEST(whole->names().coordinates[2] == "b_x[0]");
  BOOST_REQUIRE(whole->auxiliary_size() == 3);
  BOOST_TEST(whole->manifold()->dimension() == 5);
  std::mt19937 generator(4);
  const VectorXd x = random(6, generator), v = random(6, generator), u = random(3, generator);
  const Expr t = 0.3;
  const ExprVector X = constants(x), U = constants(u);
  const VectorXd residual = values(whole->residual(X, constants(v), U, t));
  const auto own = [&](const PortHamiltonianSystem& system, Index at, Index size, Index port) {
    return values(system.residual(constants(VectorXd(x.segment(at, size))),
                                  constants(VectorXd(v.segment(at, size))),
                                  constants(VectorXd(u.segment(port, 1))), t));
  };
  const VectorXd of_first = own(*first, 0, 2, 0), of_second = own(*second, 2, 3, 1),
                 of_third = own(*third, 5, 1, 2);
  BOOST_TEST((residual.head(2) - of_first.head(2)).norm() < 1e-14);
  BOOST_TEST((residual.segment(2, 3) - of_second.head(3)).norm() < 1e-14);
  BOOST_TEST(std::abs(residual[5] - of_third[0]) < 1e-14);
  // Then what the ports obey: the closed one of the second as it was, and u₂ = -k y₀ and u₀ = k y₂.
  BOOST_TEST(std::abs(residual[7] - of_second[3]) < 1e-14);
  BOOST_TEST(std::abs(residual[8] - (u[2] + k * of_first[2])) < 1e-14);
  BOOST_TEST(std::abs(residual[6] - (u[0] - k * of_third[1])) < 1e-14);
  const auto energy = [&](const PortHamiltonianSystem& system, Index at, Index size) {
    return system.generator(ExprVector(X.segment(at, size)), ExprVector(0), t).value();
  };
  BOOST_TEST(std::abs(whole->generator(X, U, t).value() - energy(*first, 0, 2) -
                      energy(*second, 2, 3) - energy(*third, 5, 1)) < 1e-14);
}

// The inputs of a network come after the unknowns of its branches; what enters by its ports is y u.
BOOST_AUTO_TEST_CASE(ports_of_networks) {
  using Kind = NetworkBranch::Kind;
  using Role = NetworkBranch::Role;
  const auto network = std::make_shared<Network>(
      3,
      std::vector<NetworkBranch>{
          {.name = "C", .from = 1, .to = 0, .kind = Kind::charge, .role = Role::storage},
          {.name = "P", .from = 1, .to = 0, .kind = Kind::voltage, .role = Role::port},
          {.name = "R",
           .from = 1,
           .to = 2,
           .law = [](const NetworkVariables& variables) { return 3.0 * variables.current(2); }},
          {.name = "Q", .from = 2, .to = 0, .role = Role::port}},
      [](V x, const Expr&) { return 0.25 * square(x[0]); });
  BOOST_REQUIRE(network->port_count() == 2);
  BOOST_TEST(network->inputs() == (std::vector<Index>{3, 4}), boost::test_tools::per_element());
  BOOST_TEST(network->names().auxiliary[4] == "u_Q");
  // v_P = q/2 = 1; R leads 0.2 A from there to Q, which holds 0.4 V; C takes what P sends less that.
  const double sent = 0.5;
  const ExprVector x = constants(VectorXd{{2.0}}), v = constants(VectorXd{{sent - 0.2}}),
                   z = constants(VectorXd{{1.0, 0.2, 0.2, sent, 0.4}});
  const Expr t = 0.0;
  const ExprVector alpha = network->effort(x, z, t);
  BOOST_TEST(values(network->inner_equations(x, v, alpha, z, t)).norm() < 1e-15);
  const VectorXd y = values(network->output(x, alpha, z));
  BOOST_TEST((y - VectorXd{{1.0, -0.2}}).norm() < 1e-15);
  // Nothing is said of the ports: 0 = y.
  BOOST_TEST((values(network->residual(x, v, z, t)).tail(2) - y).norm() < 1e-15);
  const EnergySystem::Powers powers = network->powers(x, v, alpha, z, t);
  BOOST_REQUIRE(powers.supplied.size() == 2u);
  BOOST_TEST(powers.supplied[0].port == "P");
  const double supplied = powers.supplied[0].power.value() + powers.supplied[1].power.value(),
               stored = alpha[0].value() * v[0].value();
  BOOST_TEST(std::abs(supplied - powers.dissipated[0].power.value() - stored) < 1e-15);
  const auto ports = network->ports(x, v, alpha, z, t);
  BOOST_TEST(std::abs(network->supplied_power(ports).value() - supplied) < 1e-15);
}

// Joints neither make nor take power.
BOOST_AUTO_TEST_CASE(joints_keep_power) {
  const auto zero = [](const Joint& joint, const VectorXd& u, const VectorXd& y) {
    return values(joint.equations(Expr(0.0), constants(u), constants(y))).norm();
  };
  const VectorXd same = VectorXd::Constant(3, 0.4), cancelling = VectorXd{{0.5, 1.5, -2.0}};
  BOOST_TEST(zero(Joint::shared_input({0, 1, 2}), same, cancelling) < 1e-15);
  BOOST_TEST(zero(Joint::shared_input({0, 1, 2}), cancelling, same) > 0.1);
  BOOST_TEST(zero(Joint::shared_output({0, 1, 2}), cancelling, same) < 1e-15);
  BOOST_TEST(zero(Joint::shared_output({0, 1, 2}), same, cancelling) > 0.1);
  // A transformer: u₁ = n u₀, y₀ = -n y₁.
  const double n = 3.0;
  const MatrixXd F{{n, -1.0}, {0.0, 0.0}}, E{{0.0, 0.0}, {1.0, n}};
  BOOST_TEST(zero(Joint({0, 1}, F, E), VectorXd{{1.0, n}}, VectorXd{{-n, 1.0}}) < 1e-15);
  const Joint source =
      Joint::source(1, [](const Expr& t, const ExprVector& y) { return cos(t) + 2.0 * y[0]; });
  BOOST_TEST(zero(source, VectorXd{{0.0, 7.0}}, VectorXd{{3.0, 0.0}}) < 1e-15);
}

BOOST_AUTO_TEST_CASE(what_is_no_interconnection_is_refused) {
  const MatrixXd I = MatrixXd::Identity(2, 2), O = MatrixXd::Zero(2, 2);
  BOOST_CHECK_THROW(Joint({0, 1}, I, I), std::invalid_argument);  // resistors
  BOOST_CHECK_THROW(Joint({0, 1}, MatrixXd{{1.0, 1.0}, {2.0, 2.0}}, O), std::invalid_argument);
  BOOST_CHECK_THROW(Joint({0, 0}, I, O), std::invalid_argument);
  BOOST_CHECK_THROW(Joint({0}, I, O), std::invalid_argument);
  const auto line = std::make_shared<Euclidean>(1);
  const auto closed = part(line, 0.0, 0.0);
  const auto driven =
      part(line, 0.0, 0.0, [](const Expr& t, V) { return ExprVector(ExprVector::Constant(1, t)); });
  const Joint joint = Joint::shared_input({0, 1});
  const auto joined = [](const std::vector<std::shared_ptr<const PortSystem>>& systems,
                         const std::vector<Joint>& joints) {
    std::vector<Interconnection::Part> parts;
    for (const auto& system : systems) parts.push_back({"part", system});
    return std::make_shared<Interconnection>(parts, joints);
  };
  BOOST_CHECK_NO_THROW(joined({closed, closed}, {joint}));
  BOOST_CHECK_NO_THROW(joined({closed, driven}, {}));
  BOOST_CHECK_THROW(joined({closed, driven}, {joint}), std::invalid_argument);
  BOOST_CHECK_THROW(joined({closed, closed}, {joint, joint}), std::invalid_argument);
  BOOST_CHECK_THROW(joined({closed}, {joint}), std::invalid_argument);
  BOOST_CHECK_THROW(joined({closed, nullptr}, {joint}), std::invalid_argument);
  // What is joined already is not free in the whole.
  BOOST_CHECK_THROW(joined({joined({closed, closed}, {joint}), closed}, {joint}),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
