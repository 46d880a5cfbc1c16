#include "courant/integrators/step/transported_frame.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/hyperbolic.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/manifolds/stiefel.hpp"

// Mistakes that these cases have to notice:
//  * after a long step the basis is made afresh
BOOST_AUTO_TEST_SUITE(transported_frame)

using namespace courant;

namespace {

TransportedFrame basis_at(const Manifold& M, const VectorXd& x) {
  TransportedFrame basis(M, TransportedFrame::projection(M, Backend::interpreter));
  basis.move_to(x);
  return basis;
}

// How far B is from an orthonormal basis of T_xM.
double defect(const Manifold& M, const VectorXd& x, const MatrixXd& B) {
  const MatrixXd one = MatrixXd::Identity(M.dimension(), M.dimension());
  return (B.transpose() * B - one).norm() + (M.tangent_projector(x) * B - B).norm();
}

}  // namespace

// Along a curve it stays an orthonormal basis, and turns by no more than the tangent space does.
BOOST_AUTO_TEST_CASE(follows_a_curve) {
  std::mt19937 generator(4);
  const std::vector<std::shared_ptr<const Manifold>> manifolds = {
      std::make_shared<Sphere>(2), std::make_shared<CotangentBundle>(std::make_shared<Sphere>(2)),
      std::make_shared<CotangentBundle>(std::make_shared<Hyperbolic>(2)),
      std::make_shared<Sphere>(7), std::make_shared<Stiefel>(5, 3)};  // 9 columns
  for (const auto& M : manifolds) {
    VectorXd x = M->random_point(generator);
    TransportedFrame basis = basis_at(*M, x);
    const double length = 0.02 * std::min(1.0, M->injectivity_radius(x));
    for (int k = 0; k < 20; ++k) {
      const MatrixXd before = basis.map();
      x = M->retract(x, M->random_tangent(x, length, generator));
      BOOST_TEST(basis.move_to(x), M->name());
      BOOST_TEST(defect(*M, x, basis.map()) < 1e-12, M->name());
      BOOST_TEST((basis.map().matrix() - before).norm() < 0.5, M->name());
    }
  }
}

// Where it is the identity nothing is stored, however large the space is.
BOOST_AUTO_TEST_CASE(is_no_matrix_on_large_flat_spaces) {
  const Euclidean flat(300'000);  // a matrix would take 720 GB
  TransportedFrame basis(flat, TransportedFrame::projection(flat, Backend::interpreter));
  BOOST_TEST(basis.move_to(VectorXd::Zero(flat.dimension())));
  BOOST_TEST(basis.map().is_identity());
}

// Far away the nearest basis too, but not at a right angle, where it is a fresh one.
BOOST_AUTO_TEST_CASE(jumps) {
  const Sphere sphere(2);
  const Eigen::Vector3d far(std::sin(1.2), 0.0, std::cos(1.2));
  TransportedFrame basis = basis_at(sphere, Eigen::Vector3d::UnitZ());
  const MatrixXd before = basis.map();
  BOOST_TEST(basis.move_to(far));
  BOOST_TEST(defect(sphere, far, basis.map()) < 1e-14);
  // The rotation by 1.2 about the second axis, which is the parallel transport.
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.2, Eigen::Vector3d::UnitY()).toRotationMatrix();
  BOOST_TEST((basis.map().matrix() - turn * before).norm() < 1e-14);
  TransportedFrame other = basis_at(sphere, Eigen::Vector3d::UnitZ());
  BOOST_TEST(!other.move_to(Eigen::Vector3d::UnitX()));
  BOOST_TEST(defect(sphere, Eigen::Vector3d::UnitX(), other.map()) < 1e-14);
}

BOOST_AUTO_TEST_CASE(is_the_identity_on_a_group) {
  const SpecialOrthogonal3 rotations;
  std::mt19937 generator(1);
  TransportedFrame basis = basis_at(rotations, rotations.random_point(generator));
  basis.move_to(rotations.random_point(generator));
  BOOST_TEST(basis.map().is_identity());
}

BOOST_AUTO_TEST_SUITE_END()
