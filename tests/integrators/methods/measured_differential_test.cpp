#include "courant/integrators/methods/measured_differential.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <stdexcept>

#include "../step/integrator_catalogue.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(measured_differential_test)

namespace {

const test::IntegratorEntry& entry(const std::string& name) {
  static const auto table = test::integrator_catalogue();
  const auto found = std::ranges::find_if(table, [&](const auto& e) { return e.name == name; });
  BOOST_REQUIRE(found != table.end());
  return *found;
}

MeasuredDifferential measured(const test::IntegratorEntry& of) {
  return {*of.integrator, of.setting, of.setting.initial.x.norm()};
}

}  // namespace

// A symplectic map of the plane keeps areas: the determinant says so without any structure.
BOOST_AUTO_TEST_CASE(the_midpoint_rule_is_symplectic) {
  const auto& midpoint = entry("discretize-first, midpoint: driven pendulum");
  const MeasuredDifferential differential = measured(midpoint);
  BOOST_TEST(has_symplectic_form(midpoint.setting));
  BOOST_TEST(std::abs(differential.image().determinant() - 1.0) < 1e-9);
  BOOST_TEST(differential.symplecticity_defect() < 1e-8);
  BOOST_TEST(differential.preservation_defect() < 1e-8);
  BOOST_TEST(differential.defect(*midpoint.integrator->differential()) < 1e-7);
  const VectorXd& x = midpoint.setting.initial.x;
  BOOST_TEST((differential.y() -
              midpoint.integrator->advance(midpoint.setting.initial, midpoint.setting.step, 1).x)
                 .norm() == 0.0);
  BOOST_TEST((differential.y() - x).norm() > 0.0);
}

BOOST_AUTO_TEST_CASE(a_runge_kutta_method_is_not) {
  const MeasuredDifferential differential = measured(entry("rk2: driven pendulum"));
  const double growth = std::abs(differential.image().determinant() - 1.0);
  BOOST_TEST(growth > 1e-7);
  BOOST_TEST(std::abs(differential.symplecticity_defect() - growth) < 1e-3 * growth);
  BOOST_TEST(differential.preservation_defect() > 1e-8);
}

// A rod in the plane has four coordinates with velocities, of which two are free.
BOOST_AUTO_TEST_CASE(directions_are_tangent_to_the_constraint_set) {
  const auto& rod = entry("constrain-first, midpoint: Cartesian pendulum");
  const MeasuredDifferential differential = measured(rod);
  BOOST_TEST(differential.tangent().cols() == 2);
  BOOST_TEST((rod.setting.conormals * differential.tangent()).norm() < 1e-12);
}

BOOST_AUTO_TEST_CASE(without_a_structure_there_is_no_form) {
  IntegratorSetting setting = entry("rk2: driven pendulum").setting;
  setting.structure = nullptr;
  BOOST_TEST(!has_symplectic_form(setting));
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
