#include "courant/running/quantity_statistics.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

namespace courant {

// Mistakes that these cases have to notice:
//  * drifts downwards are not seen
//  * a NaN is forgotten
//  * a value that is not a number is forgotten
//  * after a stop, a value that was not a number is forgotten
//  * deviations are from the mean before
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

// Of three quantities, two are looked at together.
BOOST_AUTO_TEST_CASE(what_is_not_a_number_stays) {
  for (const Index quantity : {0, 1, 2})
    for (const int position : {0, 1, 2, 4}) {
      QuantityStatistics statistics;
      for (int k = 0; k < 6; ++k) {
        VectorXd values = VectorXd::Constant(3, k == 3 ? -1.0 : k);
        if (k == position) values[quantity] = std::nan("");
        statistics.add(k, values);
      }
      for (Index i = 0; i < 3; ++i) {
        const QuantityRecord record = statistics.record(i);
        if (i == quantity) {
          BOOST_TEST(std::isnan(record.max));
          BOOST_TEST(std::isnan(record.min));
          BOOST_TEST(std::isnan(record.max_drift));
        } else {
          BOOST_TEST(record.min == -1.0);
          BOOST_TEST(record.max == 5.0);
        }
      }
    }
}

BOOST_AUTO_TEST_CASE(goes_on_from_its_memory_as_if_it_had_not_stopped) {
  for (const double special : {0.5, std::nan(""), HUGE_VAL}) {
    QuantityStatistics whole, first;
    const auto values = [&](int k) {
      return (VectorXd(3) << 1.0 / k, k == 2 ? special : std::sin(k), k * k).finished();
    };
    for (int k = 1; k <= 5; ++k) {
      whole.add(k, values(k));
      first.add(k, values(k));
    }
    QuantityStatistics second;
    second.recall(first.memory());
    for (int k = 6; k <= 9; ++k) {
      whole.add(k, values(k));
      second.add(k, values(k));
    }
    BOOST_TEST(whole.is_finite() == std::isfinite(special));
    BOOST_TEST(second.is_finite() == whole.is_finite());
    const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    for (Index i = 0; i < 3; ++i) {
      const QuantityRecord one = whole.record(i), other = second.record(i);
      BOOST_TEST(same(one.min, other.min));
      BOOST_TEST(same(one.max, other.max));
      BOOST_TEST(same(one.slope, other.slope));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
