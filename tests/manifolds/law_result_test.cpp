#include "courant/manifolds/law_result.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

// Mistakes that these cases have to notice:
//  * a defect that is NaN is no defect
//  * the last defect instead of the worst
//  * a law that was not measured passes
BOOST_AUTO_TEST_SUITE(law_result)

using namespace courant;

BOOST_AUTO_TEST_CASE(keeps_the_worst_defect_and_where_it_was) {
  LawMeasurement measured("Sphere(2)", "M1", 1e-3);
  measured.add(1e-5, "here");
  measured.add(1e-4, "there");
  measured.add(0.0, "nowhere");
  BOOST_TEST(measured.result().defect == 1e-4);
  BOOST_TEST(measured.result().where == "there");
  BOOST_TEST(measured.result().passed());
}

BOOST_AUTO_TEST_CASE(nothing_measured_fails) {
  BOOST_TEST(!LawMeasurement("Sphere(2)", "M1", 1e300).result().passed());
}

BOOST_AUTO_TEST_CASE(not_a_number_fails_and_stays) {
  LawMeasurement measured("Sphere(2)", "M1", 1e300);
  measured.add(std::nan(""), "here");
  measured.add(1.0, "there");
  BOOST_TEST(!measured.result().passed());
  BOOST_TEST(measured.result().where == "here");
}

BOOST_AUTO_TEST_CASE(an_exception_fails_and_says_what_it_was) {
  LawMeasurement measured("Sphere(2)", "M1", 1.0);
  measured.add([]() -> double { throw std::domain_error("too far"); }, "here");
  BOOST_TEST(!measured.result().passed());
  BOOST_TEST(measured.result().where == "here: too far");
}

BOOST_AUTO_TEST_CASE(prints_one_line) {
  LawMeasurement measured("Sphere(2)", "M1", 0.5);
  measured.add(0.25, "here");
  std::ostringstream passed;
  passed << measured.result();
  BOOST_TEST(passed.str() == "passed  Sphere(2): M1: defect 0.25, bound 0.5");
  measured.add(1.0, "there");
  std::ostringstream failed;
  failed << measured.result();
  BOOST_TEST(failed.str() == "FAILED  Sphere(2): M1: defect 1, bound 0.5, there");
  BOOST_TEST(!all_passed({measured.result()}));
}

BOOST_AUTO_TEST_SUITE_END()
