#include "courant/structures/interconnection.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"

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

BOOST_AUTO_TEST_SUITE(interconnection_test)

// Each system has its own equations in its own block, on the product of their manifolds, and the joint comes
// in the place of the equations of its ports.
BOOST_AUTO_TEST_CASE(equations_of_the_parts) {
  const auto first = part(std::make_shared<Euclidean>(2), 0.1, 0.2);
  const auto second = part(std::make_shared<Sphere>(2), 0.0, 0.0);
  const auto third = part(std::make_shared<Euclidean>(1), 0.3, 0.4);
  const double k = 0.7;
  const auto whole =
      interconnected({first, second, third},
                     {Joint::gyrator({2, 0}, (MatrixXd(2, 2) << 0.0, -k, k, 0.0).finished())});
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
  // Then what the ports obey: the closed one of the second as it was, u₂ = -k y₀ and u₀ = k y₂.
  BOOST_TEST(std::abs(residual[6] - of_second[3]) < 1e-14);
  BOOST_TEST(std::abs(residual[7] - (u[2] + k * of_first[2])) < 1e-14);
  BOOST_TEST(std::abs(residual[8] - (u[0] - k * of_third[1])) < 1e-14);
  const auto energy = [&](const PortHamiltonianSystem& system, Index at, Index size) {
    return system.generator(ExprVector(X.segment(at, size)), ExprVector(0), t).value();
  };
  BOOST_TEST(std::abs(whole->generator(X, U, t).value() - energy(*first, 0, 2) -
                      energy(*second, 2, 3) - energy(*third, 5, 1)) < 1e-14);
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
  BOOST_CHECK_NO_THROW(interconnected({closed, closed}, {joint}));
  BOOST_CHECK_NO_THROW(interconnected({closed, driven}, {}));
  BOOST_CHECK_THROW(interconnected({closed, driven}, {joint}), std::invalid_argument);
  BOOST_CHECK_THROW(interconnected({closed, closed}, {joint, joint}), std::invalid_argument);
  BOOST_CHECK_THROW(interconnected({closed}, {joint}), std::invalid_argument);
  BOOST_CHECK_THROW(interconnected({closed, nullptr}, {joint}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
