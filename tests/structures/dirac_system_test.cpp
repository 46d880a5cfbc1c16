#include "courant/structures/dirac_system.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/poisson.hpp"

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

BOOST_AUTO_TEST_CASE(structure_and_family_share_a_manifold_object) {
  BOOST_CHECK_THROW(DiracSystem(std::make_shared<CanonicalSymplectic>(phase_space()),
                                std::make_shared<Hamiltonian>(phase_space(), pendulum)),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
