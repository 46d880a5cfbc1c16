#include "courant/structures/representation.hpp"

#include <boost/test/unit_test.hpp>
#include <stdexcept>

// Mistakes that these cases have to notice:
//  * matrices are turned on one side only
BOOST_AUTO_TEST_SUITE(representation)

using namespace courant;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

const LieAlgebra kRotations = LieAlgebra::so3();

MatrixXd combined(const Representation& rho, const VectorXd& xi) {
  MatrixXd sum = MatrixXd::Zero(rho[0].rows(), rho[0].cols());
  for (Index i = 0; i < xi.size(); ++i) sum += xi[i] * rho[static_cast<std::size_t>(i)];
  return sum;
}

}  // namespace

// semidirect() throws if [ρ(a), ρ(b)] is not ρ([a, b]) to 1e-12.
BOOST_AUTO_TEST_CASE(what_is_made_of_a_representation_is_one) {
  for (const LieAlgebra& g : {kRotations, LieAlgebra::se3(), LieAlgebra::so(4)}) {
    const Representation ad = adjoint_representation(g);
    for (const Representation& rho :
         {ad, dual(ad), symmetric_square(ad), exterior_square(dual(ad))}) {
      BOOST_CHECK_NO_THROW(LieAlgebra::semidirect(g, rho));
      auto wrong = rho;
      wrong[0] *= 1.5;
      BOOST_CHECK_THROW(LieAlgebra::semidirect(g, wrong), std::domain_error);
    }
  }
}

// ad(ξ) = ξ ×. On symmetric matrices it is the commutator with it, on skew ones, by their axial vector, ξ ×
// again.
BOOST_AUTO_TEST_CASE(rotations_of_matrices_by_hand) {
  const VectorXd xi{{0.3, -0.7, 0.4}};
  MatrixXd hat(3, 3), S(3, 3);
  hat << 0.0, -0.4, -0.7, 0.4, 0.0, -0.3, 0.7, 0.3, 0.0;
  S << 1.0, 0.2, -0.5, 0.2, 2.0, 0.8, -0.5, 0.8, -0.6;
  const Representation ad = adjoint_representation(kRotations);
  BOOST_TEST((combined(ad, xi) - hat).norm() < 1e-15);
  const VectorXd entries{{1.0, 0.2, -0.5, 2.0, 0.8, -0.6}};
  const MatrixXd moved = hat * S - S * hat;
  const VectorXd expected{
      {moved(0, 0), moved(0, 1), moved(0, 2), moved(1, 1), moved(1, 2), moved(2, 2)}};
  BOOST_TEST((combined(symmetric_square(ad), xi) * entries - expected).norm() < 1e-15);
  // W_01 = -w_2, W_02 = w_1, W_12 = -w_0.
  const VectorXd w{{0.9, -0.2, 0.5}}, turned = hat * w;
  const VectorXd W{{-w[2], w[1], -w[0]}}, rate{{-turned[2], turned[1], -turned[0]}};
  BOOST_TEST((combined(exterior_square(ad), xi) * W - rate).norm() < 1e-15);
}

BOOST_AUTO_TEST_SUITE_END()
