#include "courant/structures/time_transformation.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/port_hamiltonian_system.hpp"

using namespace courant;

// Mistakes that these cases have to notice:
//  * the momentum of time has the sign of the energy
//  * the energy is that of the parameters that are given, also where they are none of the point
//  * p_t is left out: the flow is another one off E = 0
//  * velocities are those of the transformed time
//  * time goes on at its own rate
//  * what is dissipated is told in a unit of t
//  * the energy of the extended system does not know that it depends on time
//  * what is carried is computed anew
BOOST_AUTO_TEST_SUITE(time_transformation)

namespace {

using BundlePointer = std::shared_ptr<const CotangentBundle>;

// H = p²/2 (1 + q²/3) - cos(q) - q sin(2t) on T*R, and g = 1 + q²/2 + p²/5 + t/7.
const BundlePointer plane = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(1));
Expr hamiltonian(const ExprVector& x, const Expr& t) {
  return 0.5 * square(x[1]) * (1.0 + square(x[0]) / 3.0) - cos(x[0]) - x[0] * sin(2.0 * t);
}
Expr rate(const ExprVector& x, const Expr& t) {
  return 1.0 + 0.5 * square(x[0]) + square(x[1]) / 5.0 + t / 7.0;
}
std::shared_ptr<const DiracSystem> driven() {
  return std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(plane),
                                       std::make_shared<Hamiltonian>(plane, hamiltonian),
                                       ImplicitSystem::Names{.coordinates = {"q", "p"}});
}

constexpr double q = 0.4, p = -0.7, t = 0.3;
const double g = 1.0 + 0.5 * q * q + p * p / 5.0 + t / 7.0;
const double H = 0.5 * p * p * (1.0 + q * q / 3.0) - std::cos(q) - q * std::sin(2.0 * t);
const double H_q = p * p * q / 3.0 + std::sin(q) - std::sin(2.0 * t);
const double H_p = p * (1.0 + q * q / 3.0);
const double H_t = -2.0 * q * std::cos(2.0 * t);

const State state = {.t = t, .x = Eigen::Vector2d(q, p), .v = Eigen::Vector2d(H_p, -H_q)};

// The largest of the residual of an extended system at (x, v), at any τ.
double residual(const ImplicitSystem& system, const VectorXd& x, const VectorXd& v,
                const VectorXd& z = VectorXd()) {
  return system.residual(x, v, z, 0.9).lpNorm<Eigen::Infinity>();
}

}  // namespace

// By hand: (q, t, p, p_t)' = g (H_p, 1, -H_q, -H_t) where p_t = -H.
BOOST_AUTO_TEST_CASE(hamiltons_equations_in_another_time) {
  const auto time = TimeTransformation::symplectic(driven(), rate);
  BOOST_TEST(time.is_symplectic());
  BOOST_TEST(time.extended()->is_lagrangian().value());
  const State extended = time.to_extended(state);
  BOOST_TEST((extended.x - Eigen::Vector4d(q, t, p, -H)).norm() < 1e-15);
  const Eigen::Vector4d v = g * Eigen::Vector4d(H_p, 1.0, -H_q, -H_t);
  BOOST_TEST(residual(*time.extended(), extended.x, v) < 1e-14);
  // Off H + p_t = 0 it is another field: p' has -(H + p_t) ∂g/∂q besides.
  VectorXd off = extended.x;
  off[3] += 0.25;
  BOOST_TEST(residual(*time.extended(), off, v) > 0.05);
  const Eigen::Vector4d w = v + 0.25 * Eigen::Vector4d(2.0 * p / 5.0, 0.0, -q, -1.0 / 7.0);
  BOOST_TEST(residual(*time.extended(), off, w) < 1e-14);
}

BOOST_AUTO_TEST_CASE(any_system_in_another_time) {
  const auto time = TimeTransformation::plain(driven(), rate);
  BOOST_TEST(!time.is_symplectic());
  BOOST_TEST(!time.extended()->is_lagrangian().has_value());
  const State extended = time.to_extended(state);
  BOOST_TEST((extended.x - Eigen::Vector3d(q, p, t)).norm() < 1e-15);
  BOOST_TEST(residual(*time.extended(), extended.x, g * Eigen::Vector3d(H_p, -H_q, 1.0)) < 1e-14);
  BOOST_TEST(residual(*time.extended(), extended.x, g * Eigen::Vector3d(H_p, -H_q, 1.1)) > 0.1);
  BOOST_TEST(residual(*time.extended(), extended.x, Eigen::Vector3d(H_p, -H_q, g)) > 0.05);
}

// L = ẋ²(1 + x²)/2 - x on T*R: w is a velocity in t, and p_t is -E also where w isn't given.
BOOST_AUTO_TEST_CASE(lagrangians_in_another_time) {
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(plane),
      std::make_shared<Lagrangian>(
          plane, [](const ExprVector& x, const ExprVector& w, const Expr&) -> Expr {
            return 0.5 * square(w[0]) * (1.0 + square(x[0])) - x[0];
          }));
  const auto time = TimeTransformation::symplectic(system, rate);
  const double w = p / (1.0 + q * q), E = 0.5 * p * w + q, force = w * w * q - 1.0;
  for (const double known : {w, 0.0}) {
    const State extended =
        time.to_extended({.t = t, .x = Eigen::Vector2d(q, p), .z = VectorXd::Constant(1, known)});
    BOOST_TEST(std::abs(extended.x[3] + E) < 1e-14);
  }
  const State extended = time.to_extended({.t = t, .x = Eigen::Vector2d(q, p)});
  BOOST_TEST(std::abs(extended.x[3] + E) < 1e-14);
  BOOST_TEST(residual(*time.extended(), extended.x, g * Eigen::Vector4d(w, 1.0, force, 0.0),
                      VectorXd::Constant(1, w)) < 1e-14);
}

// On a sphere the numbers of a point and of its tangent vectors lie elsewhere.
BOOST_AUTO_TEST_CASE(states_go_there_and_back) {
  const auto sphere = std::make_shared<CotangentBundle>(std::make_shared<Sphere>(2));
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(sphere),
      std::make_shared<Hamiltonian>(sphere, [](const ExprVector& x, const Expr& s) {
        return 0.5 * square(x[4]) + square(x[5]) + x[2] * (1.0 + s);
      }));
  const auto faster = [](const ExprVector& x, const Expr& s) { return 2.0 + x[2] + x[4] * s; };
  State at{.t = 0.4, .x = VectorXd(6), .v = VectorXd(6)};
  at.x << 0.6, 0.0, 0.8, 0.4, 0.5, -0.3;
  at.v << 0.8, 0.1, -0.6, 0.3, -0.2, 0.7;
  const auto plain = TimeTransformation::plain(system, faster);
  const auto symplectic = TimeTransformation::symplectic(system, faster);
  BOOST_TEST(std::abs(plain.rate(at) - 3.0) < 1e-15);
  for (const auto* time : {&plain, &symplectic}) {
    const State extended = time->to_extended(at);
    BOOST_TEST(extended.v[time->places().time_of_tangent] == 3.0);
    State back = time->from_extended(extended);
    BOOST_TEST(back.carried.size() == (time == &symplectic ? 1 : 0));
    BOOST_TEST((back.v - at.v).norm() < 1e-15);
    back.v = at.v;
    back.carried = VectorXd();
    BOOST_TEST(back.t == at.t);
    BOOST_TEST((back.x == at.x));
    // What is carried is not computed anew.
    back.carried = VectorXd::Constant(1, 0.125);
    const State again = time->to_extended(back);
    BOOST_TEST((again.x[again.x.size() - 1] == (time == &symplectic ? 0.125 : at.t)));
  }
  BOOST_TEST(plain.covector(VectorXd::LinSpaced(7, 0.0, 6.0)).size() == 6);
}

// ⟨α, v⟩ = what goes through ports in a unit of τ, and what time supplies.
BOOST_AUTO_TEST_CASE(powers_in_another_time) {
  const auto space = std::make_shared<Euclidean>(2);
  const auto energy = std::make_shared<Hamiltonian>(space, hamiltonian);
  const ExprMatrix J = constants((MatrixXd(2, 2) << 0, 1, -1, 0).finished());
  const ExprMatrix R = constants((MatrixXd(2, 2) << 0, 0, 0, 0.6).finished());
  const PortHamiltonianSystem::Matrices matrices{
      .J = [J](const ExprVector&) { return J; },
      .R = [R](const ExprVector&) { return R; },
      .B = [](const ExprVector&) -> ExprMatrix {
        return constants(MatrixXd(Eigen::Vector2d(0.0, 1.0)));
      },
      .m = 1};
  const auto system = std::make_shared<PortHamiltonianSystem>(
      matrices, energy, [](const Expr& s, const ExprVector&) -> ExprVector {
        return ExprVector::Constant(1, cos(s));
      });
  const auto time = TimeTransformation::plain(system, rate);
  BOOST_TEST(time.has_time_in_energy());
  const auto& extended = dynamic_cast<const EnergySystem&>(*time.extended());
  const double u = std::cos(t), force = -H_q - 0.6 * H_p + u;
  const Eigen::Vector3d v = g * Eigen::Vector3d(H_p, force, 1.0);
  BOOST_TEST(residual(extended, Eigen::Vector3d(q, p, t), v, VectorXd::Constant(1, u)) < 1e-14);

  const ExprVector x = constants(VectorXd(Eigen::Vector3d(q, p, t)));
  const ExprVector z = constants(VectorXd::Constant(1, u));
  const ExprVector alpha = extended.effort(x, z, 0.0);
  BOOST_TEST((values(alpha) - Eigen::Vector3d(H_q, H_p, H_t)).norm() < 1e-14);
  const EnergySystem::Powers powers = extended.powers(x, constants(VectorXd(v)), alpha, z, 0.0);
  double sum = 0.0;
  for (const PortPower& port : powers.supplied) sum += port.power.value();
  for (const PortPower& port : powers.dissipated) sum -= port.power.value();
  BOOST_TEST(std::abs(sum - values(alpha).dot(v)) < 1e-14);
  BOOST_TEST(powers.supplied.back().port == "time");
  BOOST_TEST(std::abs(powers.dissipated.back().power.value() - g * 0.6 * H_p * H_p) < 1e-14);
}

BOOST_AUTO_TEST_CASE(what_has_no_symplectic_transformation) {
  const auto damped = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(plane),
      std::make_shared<Hamiltonian>(plane, hamiltonian),
      DiracSystem::Exterior{
          .source = [](const ExprVector&, const ExprVector& v, const ExprVector&, const Expr&) {
            return ExprVector((ExprVector(4) << 0.0, 0.0, 0.0, -0.1 * v[0]).finished());
          }});
  BOOST_TEST(!TimeTransformation::is_possible(*damped));
  BOOST_CHECK_THROW(TimeTransformation::symplectic(damped, rate), std::invalid_argument);
  BOOST_CHECK_THROW(TimeTransformation::plain(damped, nullptr), std::invalid_argument);
  BOOST_CHECK_THROW(
      TransformedFamily(std::make_shared<Hamiltonian>(std::make_shared<Euclidean>(2), hamiltonian),
                        rate),
      std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
