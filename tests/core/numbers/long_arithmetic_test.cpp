#include "courant/core/numbers/long_arithmetic.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>
#include <random>

// Mistakes that these cases have to notice:
//  * ties are rounded up
//  * what is below half a unit of the last bit of a power of two is not subtracted from it
//  * a carry out of the highest bit is lost, in a sum or where 1…1 is rounded
//  * a bit that a carry pushes out does not count for the rounding
BOOST_AUTO_TEST_SUITE(long_arithmetic_test)

using namespace courant;

namespace {

// Numbers whose sums and products cancel, carry and tie: few bits are set, or few are not, or the bits are random.
template <unsigned bits>
LongNumber<bits> random_number(std::mt19937_64& generator) {
  const auto up_to = [&](int most) { return static_cast<int>(generator() % (most + 1)); };
  LongNumber<bits> number(0);
  switch (up_to(3)) {
    case 0:  // a few powers of two
      for (int i = up_to(3); i >= 0; --i) number += ldexp(LongNumber<bits>(1), -up_to(bits + 4));
      break;
    case 1:  // 1…1, less a little
      number = LongNumber<bits>(1) - ldexp(LongNumber<bits>(1), -up_to(bits));
      number += ldexp(LongNumber<bits>(up_to(2)), -static_cast<int>(bits));
      break;
    default:
      for (unsigned i = 0; i < bits / 64; ++i)
        number = ldexp(number, 64) + LongNumber<bits>(generator());
      number = ldexp(number, -static_cast<int>(bits));
  }
  const int exponent = up_to(2) == 0 ? up_to(2 * bits + 8) - static_cast<int>(bits) - 4 : up_to(3);
  return ldexp(up_to(1) == 0 ? number : LongNumber<bits>(-number), exponent);
}

template <unsigned bits>
bool are_equal(const LongNumber<bits>& a, const LongNumber<bits>& b) {
  return (isnan(a) && isnan(b)) || (a == b && a.backend().sign() == b.backend().sign() &&
                                    a.backend().exponent() == b.backend().exponent());
}

// Numbers whose bits lie less than 1,000 places apart have exact sums and products in so many.
using Exact = LongNumber<1024>;

// Whether no other number of so many bits is nearer, and where one is as near, the last bit is 0.
template <unsigned bits>
bool is_rounded(const LongNumber<bits>& number, const Exact& exact) {
  const Exact found(number), wrong = abs(exact - found);
  if (wrong == 0) return true;
  const int exponent = number.backend().exponent();
  const Exact unit = ldexp(Exact(1), exponent - static_cast<int>(bits) + 1);
  const bool is_power_of_two = abs(found) == ldexp(Exact(1), exponent);
  // Below a power of two the next number is half as far.
  const Exact to_next = is_power_of_two && abs(exact) < abs(found) ? Exact(unit / 2) : unit;
  const bool is_even = fmod(abs(found) / unit, Exact(2)) == 0;
  return 2 * wrong < to_next || (2 * wrong == to_next && is_even);
}

template <unsigned bits>
void compare_with_exact_numbers() {
  std::mt19937_64 generator(bits);
  int wrong = 0, rounded = 0, ties = 0;
  for (int trial = 0; trial < 40'000; ++trial) {
    const auto a = random_number<bits>(generator), b = random_number<bits>(generator);
    // Next to a nearly all bits cancel.
    const LongNumber<bits> close = a + ldexp(b, -static_cast<int>(bits) + 2);
    const Exact x(a), y(b), z(close);
    const LongNumber<bits> total = sum<bits>(a, b);
    if (!is_rounded<bits>(total, x + y)) ++wrong;
    if (!is_rounded<bits>(difference<bits>(a, b), x - y)) ++wrong;
    if (!is_rounded<bits>(product<bits>(a, b), x * y)) ++wrong;
    if (!is_rounded<bits>(difference<bits>(a, close), x - z)) ++wrong;
    const Exact lost = abs(x + y - Exact(total));
    if (lost != 0) ++rounded;
    if (2 * lost == ldexp(Exact(1), total.backend().exponent() - static_cast<int>(bits) + 1))
      ++ties;
  }
  BOOST_TEST(wrong == 0);
  BOOST_TEST(rounded > 10'000);
  BOOST_TEST(ties > 100);
}

template <unsigned bits>
void compare_at_the_ends() {
  using Limits = std::numeric_limits<LongNumber<bits>>;
  const LongNumber<bits> numbers[] = {LongNumber<bits>(0),
                                      LongNumber<bits>(1),
                                      LongNumber<bits>(-3),
                                      Limits::infinity(),
                                      -Limits::infinity(),
                                      Limits::quiet_NaN(),
                                      (Limits::max)(),
                                      Limits::lowest(),
                                      (Limits::min)(),
                                      ldexp(LongNumber<bits>(5), 1 << 28),
                                      ldexp(LongNumber<bits>(5), (1 << 28) - 3),
                                      ldexp(LongNumber<bits>(1), (1 << 30) - 1),
                                      ldexp(LongNumber<bits>(1), 1 - (1 << 30)),
                                      ldexp(LongNumber<bits>(7), -(1 << 28) + 1)};
  for (const auto& a : numbers)
    for (const auto& b : numbers) {
      BOOST_TEST(are_equal<bits>(sum<bits>(a, b), a + b), a << " + " << b);
      BOOST_TEST(are_equal<bits>(difference<bits>(a, b), a - b), a << " - " << b);
      BOOST_TEST(are_equal<bits>(product<bits>(a, b), a * b), a << " * " << b);
    }
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_last_bit_is_right) {
  compare_with_exact_numbers<128>();
  compare_with_exact_numbers<256>();
}

BOOST_AUTO_TEST_CASE(zeros_infinities_and_extremes_are_those_of_boost) {
  compare_at_the_ends<128>();
  compare_at_the_ends<256>();
}

// Cases that can be worked out by hand.
BOOST_AUTO_TEST_CASE(halves_are_rounded_to_even) {
  const LongNumber<128> one(1), half_unit = ldexp(one, -128), odd = one + ldexp(one, -127);
  BOOST_TEST((sum<128>(one, half_unit) == one));
  BOOST_TEST((sum<128>(odd, half_unit) == one + ldexp(one, -126)));
  BOOST_TEST((difference<128>(one, ldexp(one, -129)) == one));
  BOOST_TEST((difference<128>(one, half_unit) < one));
  BOOST_TEST((difference<128>(one, half_unit - ldexp(one, -250)) < one));
  BOOST_TEST((difference<128>(one, one) == 0));
  const LongNumber<128> largest = one - half_unit;  // 0.1…1
  BOOST_TEST((sum<128>(largest, ldexp(one, -129)) == one));
  BOOST_TEST((product<128>(largest, largest) == one - ldexp(one, -127)));
}

BOOST_AUTO_TEST_SUITE_END()
