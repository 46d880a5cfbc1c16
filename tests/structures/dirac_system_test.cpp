#include "courant/structures/dirac_system.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/morse_family.hpp"
#include "courant/structures/open_port_hamiltonian.hpp"
#include "courant/structures/poisson.hpp"

// Mistakes that these cases have to notice:
//  * parameters and ports are exchanged among the unknowns
//  * stationarity is that at time 0
BOOST_AUTO_TEST_SUITE(dirac_system)

using namespace courant;

namespace {

// H = p²/(2 m) - k cos q with non-unit parameters.
std::shared_ptr<const CotangentBundle> phase_space() {
  return std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(1));
}
Expr pendulum(const ExprVector& x, const Expr&) { return square(x[1]) / 2.6 - 0.7 * cos(x[0]); }

}  // namespace

BOOST_AUTO_TEST_CASE(equation_1) {
  // ẋ ⊕ dH(x) ∈ D_x says Hamilton's equations: zero at (q̇, ṗ) = (∂_pH, -∂_qH), and nowhere else.
  const auto M = phase_space();
  const DiracSystem system(std::make_shared<CanonicalSymplectic>(M),
                           std::make_shared<Hamiltonian>(M, pendulum));
  const VectorXd x = (VectorXd(2) << 0.4, 0.9).finished();
  const VectorXd v = (VectorXd(2) << 0.9 / 1.3, -0.7 * std::sin(0.4)).finished();
  BOOST_TEST(system.residual(x, v, VectorXd(0), 0.0).norm() < 1e-16);
  BOOST_TEST(system.residual(x, -v, VectorXd(0), 0.0).norm() > 0.1);
}

// (D, 𝓛), 𝓛 = {∂E/∂x : ∂E/∂λ = 0}, where neither is that of a Hamiltonian on a symplectic manifold: D is the graph of
// Λ = x₂ ∂₀ ∧ ∂₁ on R³, E = λ(x₀ + 2x₁ + x₂²/2) + λ³/3 - λ. So ẋ = (x₂ · 2λ, -x₂ · λ, 0), and
// x₀ + 2x₁ + x₂²/2 + λ² = 1.
BOOST_AUTO_TEST_CASE(a_morse_family_over_a_structure_that_is_not_symplectic) {
  const auto M = std::make_shared<Euclidean>(3);
  const auto D = std::make_shared<Poisson>(M, [](const ExprVector& x) {
    ExprMatrix matrix = ExprMatrix::Zero(3, 3);
    matrix(0, 1) = x[2];
    matrix(1, 0) = -x[2];
    return matrix;
  });
  const DiracSystem system(
      D, std::make_shared<MorseFamily>(
             M, 1, [](const ExprVector& x, const ExprVector& lambda, const Expr&) {
               return lambda[0] * (x[0] + 2.0 * x[1] + 0.5 * square(x[2])) +
                      lambda[0] * square(lambda[0]) / 3.0 - lambda[0];
             }));
  const VectorXd x{{0.3, -0.1, 0.8}};
  const double lambda = std::sqrt(1.0 - (0.3 - 0.2 + 0.32));
  const auto residual = [&](const VectorXd& v, double at) {
    return system.residual(x, v, VectorXd::Constant(1, at), 0.0).norm();
  };
  const auto velocity = [](double at) { return VectorXd{{0.8 * 2.0 * at, -0.8 * at, 0.0}}; };
  // Both of the covectors that 𝓛 has over x, and no others.
  for (const double at : {lambda, -lambda}) {
    BOOST_TEST(residual(velocity(at), at) < 1e-15);
    BOOST_TEST(residual(velocity(-at), at) > 0.1);
    BOOST_TEST(residual(velocity(1.1 * at), 1.1 * at) > 0.01);
  }
}

BOOST_AUTO_TEST_CASE(the_same_system_by_its_bivector) {
  const auto M = phase_space();
  const auto H = std::make_shared<Hamiltonian>(M, pendulum);
  const DiracSystem canonical(std::make_shared<CanonicalSymplectic>(M), H);
  const DiracSystem bivector(std::make_shared<Poisson>(M,
                                                       [](const ExprVector&) {
                                                         ExprMatrix matrix = ExprMatrix::Zero(2, 2);
                                                         matrix(0, 1) = 1.0;
                                                         matrix(1, 0) = -1.0;
                                                         return matrix;
                                                       }),
                             H);
  const VectorXd x = (VectorXd(2) << -1.1, 0.3).finished();
  const VectorXd v = (VectorXd(2) << 0.2, 0.5).finished();
  BOOST_TEST(
      (canonical.residual(x, v, VectorXd(0), 0.0) - bivector.residual(x, v, VectorXd(0), 0.0))
          .norm() < 1e-16);
}

BOOST_AUTO_TEST_CASE(structure_and_family_are_on_one_manifold) {
  const auto structure = std::make_shared<CanonicalSymplectic>(phase_space());
  BOOST_CHECK_NO_THROW(
      DiracSystem(structure, std::make_shared<Hamiltonian>(phase_space(), pendulum)));
  const auto elsewhere = std::make_shared<Euclidean>(2);
  BOOST_CHECK_THROW(DiracSystem(structure, std::make_shared<Hamiltonian>(elsewhere, pendulum)),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(what_is_missing_is_refused) {
  const auto M = phase_space();
  BOOST_CHECK_THROW(DiracSystem(nullptr, std::make_shared<Hamiltonian>(M, pendulum)),
                    std::invalid_argument);
  BOOST_CHECK_THROW(DiracSystem(std::make_shared<CanonicalSymplectic>(M), nullptr),
                    std::invalid_argument);
}

// z = (λ, u): the parameters of the family first, the ports of the structure after them; equations
// likewise. Here L = (1 + t) w²/2 - t q and the port is a force, v = (w, -t) + (0, 1) u.
BOOST_AUTO_TEST_CASE(unknowns_are_parameters_and_then_ports) {
  const auto M = phase_space();
  const auto L =
      std::make_shared<Lagrangian>(M, [](const ExprVector& q, const ExprVector& w, const Expr& t) {
        return (1.0 + t) * square(w[0]) / 2.0 - t * q[0];
      });
  const auto J = [](const ExprVector&) {
    ExprMatrix matrix = ExprMatrix::Zero(2, 2);
    matrix(0, 1) = 1.0;
    matrix(1, 0) = -1.0;
    return matrix;
  };
  const auto B = [](const ExprVector&) {
    ExprMatrix column = ExprMatrix::Zero(2, 1);
    column(1, 0) = 1.0;
    return column;
  };
  const DiracSystem system(std::make_shared<OpenPortHamiltonian>(M, J, 1, B), L);
  BOOST_TEST(system.auxiliary_size() == 2);
  const double q = 0.4, w = 0.9, t = 0.7, u = 0.25, p = (1.0 + t) * w;
  const VectorXd x = VectorXd{{q, p}}, z = VectorXd{{w, u}};
  BOOST_TEST(system.residual(x, VectorXd{{w, u - t}}, z, t).norm() < 1e-15);
  // The last equation is stationarity: p - (1 + t) w.
  const VectorXd r = system.residual(x, VectorXd{{w, u - t}}, VectorXd{{w + 0.5, u}}, t);
  BOOST_TEST(r[2] == -0.5 * (1.0 + t), boost::test_tools::tolerance(1e-14));
  // The energy ⟨∂L/∂w, w⟩ - L.
  const auto energy = system.energy(constants(x), constants(z), Expr(t));
  BOOST_TEST(energy->value() == p * w / 2 + t * q, boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_SUITE_END()
