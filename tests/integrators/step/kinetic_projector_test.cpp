#include "courant/integrators/step/kinetic_projector.hpp"

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "../example_systems.hpp"
#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/methods/projector_laws.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/constrained_family.hpp"
#include "courant/structures/dirac_system.hpp"

// Mistakes that these cases have to notice:
//  * positions move as little as possible in the numbers
//  * momenta move as little as possible in the numbers
BOOST_AUTO_TEST_SUITE(kinetic_projector)

using namespace courant;

namespace {

// Two masses on rods, one at the other's end, in the plane; with `drive` the first rod has the length 1 + sin(t)/10.
struct Rods {
  double m = 2.0, M = 0.3, length = 1.0;
  bool is_driven = false;
  bool repeats = false;  // the first condition once more, squared lengths doubled

  std::shared_ptr<const DiracSystem> system() const {
    const auto space = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(4));
    const auto free =
        std::make_shared<Hamiltonian>(space, [*this](const ExprVector& x, const Expr&) {
          return (square(x[4]) + square(x[5])) / (2.0 * m) +
                 (square(x[6]) + square(x[7])) / (2.0 * M) + 9.81 * (m * x[1] + M * x[3]);
        });
    const auto family = std::make_shared<ConstrainedFamily>(
        free,
        [*this](const ExprVector& x, const ExprVector&, const Expr& t) {
          const Expr first =
              is_driven ? length * (1.0 + 0.1 * sin(t)) * (1.0 + 0.2 * x[0] * t) : Expr(length);
          const Expr one = square(x[0]) + square(x[1]) - square(first);
          std::vector<Expr> all = {
              one, square(x[2] - x[0]) + square(x[3] - x[1]) - square(0.7 * length)};
          if (repeats) all.push_back(2.0 * one);
          return ExprVector(Eigen::Map<ExprVector>(all.data(), std::ssize(all)));
        },
        repeats ? 3 : 2);
    return std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(space), family);
  }
  ConstraintLadder ladder(double t = 0.0) const {
    VectorXd x(8);
    x << 0.6 * length, -0.8 * length, 1.3 * length, -0.8 * length, 0.8 * m * length,
        0.6 * m * length, 0.0, 0.0;
    return ConstraintAlgorithm().run(system(), {.t = t, .x = x});
  }
  // (g⁻¹ Jᵀ, 0) and (0, Jᵀ): what momenta conditions J g⁻¹ p = … move along.
  MatrixXd expected(const VectorXd& x, double t) const {
    Eigen::Matrix<double, 2, 4> J;
    const double d = x[2] - x[0], e = x[3] - x[1];
    const double part = length * (1.0 + 0.1 * std::sin(t)), first = part * (1.0 + 0.2 * x[0] * t);
    J << 2.0 * x[0] - (is_driven ? 2.0 * first * part * 0.2 * t : 0.0), 2.0 * x[1], 0.0, 0.0,
        -2.0 * d, -2.0 * e, 2.0 * d, 2.0 * e;
    const Eigen::Vector4d masses(m, m, M, M);
    MatrixXd W = MatrixXd::Zero(8, 4);
    W.topLeftCorner(4, 2) = masses.cwiseInverse().asDiagonal() * J.transpose();
    W.bottomRightCorner(4, 2) = J.transpose();
    return W;
  }
};

// How much of the span of A is not in that of B, both n × d.
double missing(const MatrixXd& A, const MatrixXd& B) {
  const MatrixXd Q = orthonormalized(B.colwise().normalized());
  const MatrixXd P = orthonormalized(A.colwise().normalized());
  return (P - Q * (Q.transpose() * P)).norm();
}

MatrixXd directions(const Projector& projector, const ConstraintLadder& ladder,
                    const MatrixXd& mix) {
  const MatrixXd C = orthonormalized(ladder.conormals().transpose()) * mix;
  return projector.directions(ladder.point.x, LinearMap<double>::identity(8), C, ladder.point.t);
}

}  // namespace

// Positions along g⁻¹Jᵀ, momenta along Jᵀ, whatever basis of conormals is given.
BOOST_AUTO_TEST_CASE(q_in_g_then_p_in_its_inverse) {
  for (const Rods& rods :
       {Rods{}, Rods{.m = 1e-3, .M = 50.0}, Rods{.repeats = true}, Rods{.is_driven = true}}) {
    const double t = rods.is_driven ? 0.4 : 0.0;
    const ConstraintLadder ladder = rods.ladder(t);
    BOOST_REQUIRE(ladder.degrees_of_freedom == 4);
    const auto projector = KineticProjector::of(rods.system(), ladder);
    BOOST_REQUIRE(projector);
    const MatrixXd expected = rods.expected(ladder.point.x, t);
    std::mt19937 generator(3);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 5; ++i) {
      const MatrixXd mix =
          orthonormalized(MatrixXd::NullaryExpr(4, 4, [&] { return normal(generator); }));
      const double defect = missing(expected, directions(*projector, ladder, mix));
      // Where masses are far apart, so are the columns of V.
      BOOST_TEST(defect < (rods.M > 1.0 ? 1e-6 : 1e-11), "off by " << defect);
    }
  }
}

// Masses of molecules and of ships: the directions are those of masses of one, in units of these.
BOOST_AUTO_TEST_CASE(units_of_mass_do_not_matter) {
  for (const double unit : {1e-24, 1e-9, 1e9}) {
    const Rods rods{.m = 2.0 * unit, .M = 0.3 * unit};
    const ConstraintLadder ladder = rods.ladder();
    const auto projector = KineticProjector::of(rods.system(), ladder);
    BOOST_REQUIRE(projector);
    const MatrixXd W = directions(*projector, ladder, MatrixXd::Identity(4, 4));
    MatrixXd expected = rods.expected(ladder.point.x, 0.0);
    BOOST_TEST(missing(expected, W) < 1e-9, unit << ": " << missing(expected, W));
  }
}

BOOST_AUTO_TEST_CASE(laws_hold) {
  const Rods rods;
  const ConstraintLadder ladder = rods.ladder();
  const auto projector = KineticProjector::of(rods.system(), ladder);
  BOOST_REQUIRE(projector);
  const ConstrainedPoint at{ladder.point.x, ladder.conormals()};
  for (const LawResult& result :
       check_projector(*projector, *rods.system()->manifold(), std::span(&at, 1)))
    BOOST_TEST(result.passed(), result.law << ": " << result.defect);
}

// Nothing is projected to positions alone where conditions on momenta are all there is; Euclidean where the system has no
// kinetic energy; Euclidean, too, where a condition on positions follows that none of the equations says.
BOOST_AUTO_TEST_CASE(where_it_is_and_where_not) {
  const auto space = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  const auto usual = [&](const std::shared_ptr<const GeneratingFamily>& family, const VectorXd& x) {
    const auto system =
        std::make_shared<DiracSystem>(std::make_shared<CanonicalSymplectic>(space), family);
    const ConstraintLadder ladder = ConstraintAlgorithm().run(system, {.x = x});
    const auto projector = usual_projector(system, ladder);
    return dynamic_cast<const KineticProjector*>(projector.get()) != nullptr;
  };
  const auto pendulum = std::make_shared<ConstrainedFamily>(
      std::make_shared<Hamiltonian>(space,
                                    [](const ExprVector& x, const Expr&) {
                                      return 0.5 * (square(x[2]) + square(x[3])) + x[1];
                                    }),
      [](const ExprVector& x, const ExprVector&, const Expr&) {
        return ExprVector{{square(x[0]) + square(x[1]) - 1.0}};
      },
      1);
  BOOST_TEST(usual(pendulum, Eigen::Vector4d(0.6, -0.8, 0.4, 0.3)));
  const auto vortex = std::make_shared<Lagrangian>(
      space, [](const ExprVector& q, const ExprVector& w, const Expr&) {
        return 0.5 * (q[0] * w[1] - q[1] * w[0]) - 0.5 * q.squaredNorm();
      });
  BOOST_TEST(!usual(vortex, Eigen::Vector4d(1.0, 0.0, 0.0, 0.5)));
}

BOOST_AUTO_TEST_SUITE_END()
