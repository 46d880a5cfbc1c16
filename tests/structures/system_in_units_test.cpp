#include "courant/structures/system_in_units.hpp"

#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/manifolds/torus.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/generating_family.hpp"

// Mistakes that these cases have to notice:
//  * residuals are of unknowns in other units
//  * units that round numbers are taken
//  * components of a vector may have any units
//  * numbers without a unit may have one
//  * in other units equations are no vectors
BOOST_AUTO_TEST_SUITE(system_in_units)

using namespace courant;

namespace {

// x' = 3 z, x z = t.
class Flow final : public ImplicitSystem {
 public:
  Flow()
      : ImplicitSystem(std::make_shared<Euclidean>(1), 1, 2,
                       {.coordinates = {"charge"}, .auxiliary = {}, .equations = {}}) {}

 private:
  ExprVector do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                         const Expr& t) const override {
    ExprVector result(2);
    result << v[0] - 3.0 * z[0], x[0] * z[0] - t;
    return result;
  }
  std::optional<Expr> do_energy(const ExprVector& x, const ExprVector& z,
                                const Expr& t) const override {
    return x[0] + 10.0 * z[0] + t;
  }
  VectorXd do_auxiliary_guess(const VectorXd& x, const VectorXd&) const override { return 5.0 * x; }
};

VectorXd numbers(std::initializer_list<double> values) {
  return Eigen::Map<const VectorXd>(values.begin(), static_cast<Index>(values.size()));
}

const Units kUnits = {numbers({4.0}), numbers({4.0}), numbers({0.5}), numbers({8.0, 2.0}), 0.5};

SystemInUnits measured() { return {std::make_shared<Flow>(), kUnits}; }

}  // namespace

// (4·3/0.5 - 3·0.5·7)/8 and (4·2·0.5·7 - 0.5·6)/2.
BOOST_AUTO_TEST_CASE(numbers_are_measured) {
  const SystemInUnits system = measured();
  const VectorXd r = system.residual(numbers({2.0}), numbers({3.0}), numbers({7.0}), 6.0);
  BOOST_TEST(r[0] == 1.6875);
  BOOST_TEST(r[1] == 12.5);
  BOOST_TEST(system.auxiliary_guess(numbers({2.0}), numbers({0.0}))[0] == 80.0);
  const ExprVector x = ExprVector::Constant(1, Expr(2.0)), z = ExprVector::Constant(1, Expr(7.0));
  BOOST_TEST(system.energy(x, z, 1.0)->value() == 43.5);
  BOOST_TEST(system.names().coordinates[0] == "charge");
}

BOOST_AUTO_TEST_CASE(states_are_restored_to_the_last_bit) {
  const State state{.t = 0.1, .x = numbers({0.3}), .v = numbers({-1.7}), .z = numbers({1e-9})};
  const State there = kUnits.measure(state);
  BOOST_TEST(there.t == 0.2);
  BOOST_TEST(there.x[0] == 0.075);
  BOOST_TEST(there.v[0] == -0.2125);
  BOOST_TEST(there.z[0] == 2e-9);
  BOOST_TEST((kUnits.restore(there) == state));
  BOOST_TEST(kUnits.measure({.t = 0.1, .x = numbers({0.3})}).v.size() == 0);
  BOOST_CHECK_THROW(kUnits.measure({.x = numbers({1.0, 2.0})}), std::invalid_argument);
}

namespace {

// Rest at the point.
class Rest final : public ImplicitSystem {
 public:
  explicit Rest(std::shared_ptr<const Manifold> M)
      : ImplicitSystem(M, 0, M->tangent_dimension(), Names{}) {}

 private:
  ExprVector do_residual(const ExprVector&, const ExprVector& v, const ExprVector&,
                         const Expr&) const override {
    return v;
  }
};

bool are_taken(const std::shared_ptr<const Manifold>& M, const VectorXd& coordinates,
               const VectorXd& tangent) {
  try {
    const SystemInUnits system(
        std::make_shared<Rest>(M),
        {coordinates, tangent, VectorXd(0), VectorXd::Ones(M->tangent_dimension()), 1.0});
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

}  // namespace

// Positions in the plane have a unit each, points of a sphere and angles none; momenta of a sphere share one, those
// of angles do not.
BOOST_AUTO_TEST_CASE(units_are_those_of_scaling_symmetries) {
  const auto plane = std::make_shared<Euclidean>(2);
  BOOST_TEST(are_taken(plane, numbers({2.0, 4.0}), numbers({2.0, 4.0})));
  BOOST_TEST(!are_taken(plane, numbers({2.0, 4.0}), numbers({2.0, 2.0})));
  const auto sphere = std::make_shared<Sphere>(2);
  BOOST_TEST(!are_taken(sphere, numbers({2.0, 2.0, 2.0}), numbers({2.0, 2.0, 2.0})));
  BOOST_TEST(are_taken(sphere, numbers({1.0, 1.0, 1.0}), numbers({1.0, 1.0, 1.0})));
  const auto momenta = std::make_shared<CotangentBundle>(sphere);
  const VectorXd shared = numbers({1.0, 1.0, 1.0, 8.0, 8.0, 8.0});
  BOOST_TEST(are_taken(momenta, shared, shared));
  const VectorXd different = numbers({1.0, 1.0, 1.0, 8.0, 8.0, 4.0});
  BOOST_TEST(!are_taken(momenta, different, different));
  const auto angles = std::make_shared<CotangentBundle>(std::make_shared<Torus>(2));
  const VectorXd each = numbers({1.0, 1.0, 8.0, 4.0});
  BOOST_TEST(are_taken(angles, each, each));
  const VectorXd turned = numbers({2.0, 1.0, 8.0, 4.0});
  BOOST_TEST(!are_taken(angles, turned, turned));
}

// The six equations of a system on T*S² are two vectors, of three components each.
BOOST_AUTO_TEST_CASE(components_of_a_vector_share_a_unit) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Sphere>(2));
  const auto top = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(M),
      std::make_shared<Hamiltonian>(M, [](const ExprVector& x, const Expr&) {
        return 0.5 * x.tail(3).squaredNorm() + x[2];
      }));
  BOOST_TEST(top->tangent_blocks() > 0);
  const auto with = [&](const VectorXd& equations) {
    return SystemInUnits(top, {VectorXd::Ones(6), VectorXd::Ones(6), VectorXd(0), equations, 1.0});
  };
  BOOST_TEST(with(numbers({2.0, 2.0, 2.0, 8.0, 8.0, 8.0})).tangent_blocks() ==
             top->tangent_blocks());
  BOOST_CHECK_THROW(with(numbers({2.0, 2.0, 4.0, 8.0, 8.0, 8.0})), std::invalid_argument);
}

// Coordinates of the chart have the units of what they are along: on T*S² two of positions and two of momenta.
BOOST_AUTO_TEST_CASE(units_of_a_chart) {
  const CotangentBundle M(std::make_shared<Sphere>(2));
  const VectorXd units = numbers({1.0, 1.0, 1.0, 8.0, 8.0, 8.0});
  const VectorXd chart = chart_units({units, units, VectorXd(0), VectorXd(0), 1.0}, M,
                                     numbers({0.6, 0.0, 0.8, 0.4, 0.5, -0.3}));
  BOOST_TEST_REQUIRE(chart.size() == 4);
  BOOST_TEST((chart.array() == 1.0).count() == 2);
  BOOST_TEST((chart.array() == 8.0).count() == 2);
}

BOOST_AUTO_TEST_CASE(units_that_would_round_are_refused) {
  Units other = kUnits;
  other.coordinates[0] = 3.0;
  BOOST_CHECK_THROW(SystemInUnits(std::make_shared<Flow>(), other), std::invalid_argument);
  other = kUnits;
  other.auxiliary[0] = 0.0;
  BOOST_CHECK_THROW(SystemInUnits(std::make_shared<Flow>(), other), std::invalid_argument);
  other = kUnits;
  other.time = 0.3;
  BOOST_CHECK_THROW(SystemInUnits(std::make_shared<Flow>(), other), std::invalid_argument);
  other = kUnits;
  other.equations = numbers({1.0});
  BOOST_CHECK_THROW(SystemInUnits(std::make_shared<Flow>(), other), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
