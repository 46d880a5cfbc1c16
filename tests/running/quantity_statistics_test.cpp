#include "courant/running/quantity_statistics.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

namespace courant {

BOOST_AUTO_TEST_SUITE(quantity_statistics)

BOOST_AUTO_TEST_CASE(of_a_line_and_an_oscillation) {
  QuantityStatistics statistics;
  BOOST_TEST(statistics.empty());
  for (int k = 0; k <= 1000; ++k) {
    const double t = 5.0 + 0.1 * k;
    statistics.add(t, (VectorXd(2) << 1e6 - 3.0 * t, std::sin(t)).finished());
  }
  const QuantityRecord line = statistics.record(0), wave = statistics.record(1);
  BOOST_TEST(line.initial == 1e6 - 15.0);
  BOOST_TEST(line.final == 1e6 - 315.0, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(line.max == line.initial);
  BOOST_TEST(line.min == line.final);
  BOOST_TEST(line.max_drift == 300.0, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(line.slope == -3.0, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(wave.max <= 1.0);
  BOOST_TEST(wave.max > 0.99);
  BOOST_TEST(wave.max_drift > 1.9);
  BOOST_TEST(std::abs(wave.slope) < 1e-2);
}

BOOST_AUTO_TEST_CASE(a_single_value_has_no_slope) {
  QuantityStatistics statistics;
  statistics.add(0.0, VectorXd::Constant(1, 7.0));
  const QuantityRecord record = statistics.record(0);
  BOOST_TEST(record.initial == 7.0);
  BOOST_TEST(record.final == 7.0);
  BOOST_TEST(record.max_drift == 0.0);
  BOOST_TEST(record.slope == 0.0);
}

BOOST_AUTO_TEST_CASE(what_is_not_a_number_stays) {
  for (const int position : {0, 1, 2}) {
    QuantityStatistics statistics;
    for (int k = 0; k < 3; ++k)
      statistics.add(k,
                     (VectorXd(2) << (k == position ? std::nan("") : 1.0 * k), 1.0 * k).finished());
    BOOST_TEST(std::isnan(statistics.record(0).max));
    BOOST_TEST(std::isnan(statistics.record(0).min));
    BOOST_TEST(std::isnan(statistics.record(0).max_drift));
    BOOST_TEST(statistics.record(1).max == 2.0);
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
