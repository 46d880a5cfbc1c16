#include "courant/integrators/step/transported_directions.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/manifolds/euclidean.hpp"

// Mistakes that these cases have to notice:
//  * directions that meet the tangent space on the way are not refused
//  * directions go along as they were, whatever the projector says now
//  * a step that is taken back leaves its directions behind
//  * directions are made afresh where units are far apart
//  * what combines the vectors of the projector stays as it was
BOOST_AUTO_TEST_SUITE(transported_directions)

using namespace courant;

namespace {

const LinearMap<double> kIdentity = LinearMap<double>::identity(4);

// A point of the pendulum of length 1, (q, v), and an orthonormal basis of the conormals there, (q, 0)
// and (v, q) made orthogonal.
struct Place {
  explicit Place(double angle, double rate = 0.7) : x(4), conormals(4, 2) {
    const Eigen::Vector2d q(std::sin(angle), -std::cos(angle));
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
    x << q, rate * along;
    const double length = std::hypot(rate, 1.0);
    conormals.col(0) << q, Eigen::Vector2d::Zero();
    conormals.col(1) << rate / length * along, q / length;
  }
  VectorXd x;
  MatrixXd conormals;
};

MatrixXd onto(const MatrixXd& W) { return W * W.transpose(); }

double orthonormality(const MatrixXd& W) {
  return (W.transpose() * W - MatrixXd::Identity(W.cols(), W.cols())).norm();
}

// Directions that stretch with the point.
class Stretched final : public Projector {
 public:
  Stretched() : Projector("stretched") {}

 private:
  ExprMatrix do_directions(const ExprVector& x, const Expr&, const LinearMap<Expr>&,
                           const ExprMatrix& conormals) const override {
    ExprVector factors(4);
    factors << 1.0, 2.0, 0.1, exp(x[0]);
    return factors.asDiagonal() * conormals;
  }
};

// In units that are far apart.
class Uneven final : public Projector {
 public:
  Uneven() : Projector("uneven") {}
  bool is_always_complement() const override { return true; }

 private:
  ExprMatrix do_directions(const ExprVector&, const Expr&, const LinearMap<Expr>&,
                           const ExprMatrix& conormals) const override {
    return constants(Eigen::Vector4d(1e-3, 1e-3, 1.0, 1.0)).asDiagonal() * conormals;
  }
};

// No complement where x_0 = 0: (0, 0, 1, 0) is tangent there.
class Vanishing final : public Projector {
 public:
  Vanishing() : Projector("vanishing") {}

 private:
  ExprMatrix do_directions(const ExprVector&, const Expr&, const LinearMap<Expr>&,
                           const ExprMatrix& conormals) const override {
    return constants(Eigen::Vector4d(0.0, 0.0, 1.0, 0.0)).replicate(1, conormals.cols());
  }
};

// Those of a projector on R⁴.
TransportedDirections moving(const Projector& projector, Index d) {
  return {projector, Function("span", projector.span_formulas(Euclidean(4), d), {}), 4, d};
}

}  // namespace

// What is carried along spans what the projector says at each point, in units of any size.
BOOST_AUTO_TEST_CASE(span_those_of_the_projector) {
  const OrthogonalProjector in_units(Eigen::Vector4d(1e-3, 1e-3, 40.0, 30.0));
  const OrthogonalProjector by_metric(Euclidean(4), [](const ExprVector& x) {
    ExprMatrix G = ExprMatrix::Identity(4, 4);
    G(0, 0) = 3.0 + x[1];
    G(2, 3) = G(3, 2) = 0.5 * x[0];
    return G;
  });
  const Stretched stretched;
  const OrthogonalProjector nearest;
  for (const Projector* projector :
       {static_cast<const Projector*>(&in_units), static_cast<const Projector*>(&by_metric),
        static_cast<const Projector*>(&stretched), static_cast<const Projector*>(&nearest)}) {
    TransportedDirections directions = moving(*projector, 2);
    for (int k = 0; k < 400; ++k) {
      const Place place(0.3 + 0.02 * k);
      directions.move_to(place.x, 0.0, kIdentity, place.conormals);
      const MatrixXd W = directions.matrix();
      BOOST_TEST(orthonormality(W) < 1e-13);
      const MatrixXd exact = projector->directions(place.x, kIdentity, place.conormals);
      BOOST_TEST((onto(W) - onto(exact)).norm() < 1e-12);
      if (directions.is_kept()) BOOST_TEST((W - directions.kept()).norm() < 0.1);
      directions.move_to(place.x, 0.0, kIdentity, place.conormals);
      BOOST_TEST((directions.matrix() - W).norm() < 1e-13);
      directions.keep();
    }
  }
}

// Where units are far apart a small turn of the conormals, in their own span too, changes what the projector gives by much. It is carried along all
// the same: nothing is looked at afresh.
BOOST_AUTO_TEST_CASE(are_carried_along_in_units_that_are_far_apart) {
  const Uneven uneven;
  TransportedDirections directions = moving(uneven, 2);
  for (int k = 0; k < 200; ++k) {
    const Place place(0.3 + 0.02 * k);
    const MatrixXd conormals = place.conormals * Eigen::Rotation2Dd(0.05 * k).toRotationMatrix();
    directions.move_to(place.x, 0.0, kIdentity, conormals);
    BOOST_TEST(directions.is_continued());
    const MatrixXd& W = directions.matrix();
    BOOST_TEST(orthonormality(W) < 1e-13);
    const MatrixXd exact = uneven.directions(place.x, kIdentity, place.conormals);
    BOOST_TEST((onto(W) - onto(exact)).norm() < 1e-9);
    directions.keep();
  }
}

// After a long step too W is as near as the span allows.
BOOST_AUTO_TEST_CASE(are_carried_along_a_long_step) {
  const Stretched stretched;
  TransportedDirections directions = moving(stretched, 2);
  const Place first(0.1), far(1.9);
  directions.move_to(first.x, 0.0, kIdentity, first.conormals);
  directions.keep();
  directions.move_to(far.x, 0.0, kIdentity, far.conormals);
  BOOST_TEST(orthonormality(directions.matrix()) < 1e-13);
  const MatrixXd exact = stretched.directions(far.x, kIdentity, far.conormals);
  BOOST_TEST((onto(directions.matrix()) - onto(exact)).norm() < 1e-12);
}

BOOST_AUTO_TEST_CASE(go_back_and_forget) {
  const Stretched stretched;
  TransportedDirections directions = moving(stretched, 2);
  const Place first(0.1), second(0.12);
  BOOST_TEST(!directions.is_kept());
  directions.move_to(first.x, 0.0, kIdentity, first.conormals);
  directions.keep();
  const MatrixXd kept = directions.matrix();
  directions.move_to(second.x, 0.0, kIdentity, second.conormals);
  BOOST_TEST((directions.matrix() != kept));
  directions.discard();
  BOOST_TEST((directions.matrix() == kept));
  directions.forget();
  BOOST_TEST(!directions.is_kept());
  TransportedDirections fresh = moving(stretched, 2);
  directions.move_to(second.x, 0.0, kIdentity, second.conormals);
  fresh.move_to(second.x, 0.0, kIdentity, second.conormals);
  BOOST_TEST((directions.matrix() == fresh.matrix()));
}

// Directions that were a complement and are none any more are refused on the way too.
BOOST_AUTO_TEST_CASE(are_refused_where_they_meet_the_tangent_space) {
  const Vanishing vanishing;
  TransportedDirections directions = moving(vanishing, 1);
  const VectorXd x = VectorXd::Zero(4);
  const auto normal = [](double angle) {
    return MatrixXd(Eigen::Vector4d(std::sin(angle), 0.0, std::cos(angle), 0.0));
  };
  for (const double angle : {0.0, 0.8, 1.5, 1.57}) {
    directions.move_to(x, 0.0, kIdentity, normal(angle));
    directions.keep();
  }
  BOOST_CHECK_THROW(directions.move_to(x, 0.0, kIdentity, normal(0.5 * M_PI)), std::domain_error);
}

BOOST_AUTO_TEST_SUITE_END()
