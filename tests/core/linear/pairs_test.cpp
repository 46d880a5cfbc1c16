#include "courant/core/linear/pairs.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

namespace courant {

// Mistakes that these cases have to notice:
//  * the last of an odd number is left out
//  * every other number is no maximum
//  * numbers are added from left to right, not as programs in C do
//  * the first two numbers are looked at again and again
//  * of eight numbers at once the last ones are not looked at
BOOST_AUTO_TEST_SUITE(pairs)

BOOST_AUTO_TEST_CASE(each_number_is_visited_once) {
  for (const Index begin : {0, 1, 3})
    for (Index end = begin; end < begin + 6; ++end) {
      std::vector<int> visits(10);
      int alone = 0;
      for_each_pair(begin, end, [&]<class Numbers>(Index i, Numbers) {
        ++visits[static_cast<std::size_t>(i)];
        if constexpr (std::same_as<Numbers, Pair>)
          ++visits[static_cast<std::size_t>(i) + 1];
        else
          ++alone;
      });
      BOOST_TEST(alone == (end - begin) % 2);
      for (Index i = 0; i < 10; ++i)
        BOOST_TEST(visits[static_cast<std::size_t>(i)] == (begin <= i && i < end ? 1 : 0));
    }
}

BOOST_AUTO_TEST_CASE(sums_and_maxima_are_those_of_all_numbers) {
  const double numbers[] = {1.0, -8.0, 2.0, 4.0, 0.25};
  for (Index count = 0; count <= 5; ++count) {
    PairSum sum;
    PairMaximum maximum;
    for_each_pair(0, count, [&]<class Numbers>(Index i, Numbers) {
      sum.add(read<Numbers>(numbers + i));
      maximum.add(Numbers(magnitude(read<Numbers>(numbers + i))));
    });
    double expected_sum = 0.0, expected_maximum = 0.0;
    for (Index i = 0; i < count; ++i) {
      expected_sum += numbers[i];
      expected_maximum = std::fmax(expected_maximum, std::fabs(numbers[i]));
    }
    BOOST_TEST(sum.value() == expected_sum);
    BOOST_TEST(maximum.value() == expected_maximum);
  }
}

// As programs in C add them: 1 + 1e-16 + 1e-16 is 1 from left to right.
BOOST_AUTO_TEST_CASE(even_and_odd_places_are_added_apart) {
  const double numbers[] = {1.0, 1e-16, 0.0, 1e-16};
  PairSum sum;
  for_each_pair(0, 4,
                [&]<class Numbers>(Index i, Numbers) { sum.add(read<Numbers>(numbers + i)); });
  BOOST_TEST(sum.value() == 1.0 + 2e-16);
  BOOST_TEST(sum.value() != 1.0);
}

BOOST_AUTO_TEST_CASE(comparisons_hold_of_both) {
  const Pair a(1.0, 5.0), b(2.0, 4.0);
  BOOST_TEST(larger(a, b)[0] == 2.0);
  BOOST_TEST(larger(a, b)[1] == 5.0);
  BOOST_TEST(smaller(a, b)[0] == 1.0);
  BOOST_TEST(smaller(a, b)[1] == 4.0);
  BOOST_TEST(larger(a, 3.0)[0] == 3.0);
  BOOST_TEST(!is_at_most(a, b));
  BOOST_TEST(!is_at_most(b, a));
  BOOST_TEST(is_at_most(a, larger(a, b)));
  BOOST_TEST(!is_at_most(Pair(std::nan(""), 0.0), b));
}

BOOST_AUTO_TEST_CASE(numbers_that_are_not_finite_are_found_at_each_place) {
  for (const double special : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    for (Index count = 1; count <= 20; ++count)
      for (Index place = 0; place <= count; ++place) {
        std::vector<double> numbers(21, 1e300);
        numbers[static_cast<std::size_t>(place)] = special;
        BOOST_TEST(are_finite(numbers.data(), count) == (place == count));
      }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
