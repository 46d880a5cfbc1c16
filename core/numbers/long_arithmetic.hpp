// Sums and products of Boost's binary numbers, of 128 and of 256 bits, in a fraction of the time.
#pragma once

#include <array>
#include <bit>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace courant {

// A binary number of Boost.Multiprecision without memory of its own.
template <unsigned bits>
using LongNumber = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<bits, boost::multiprecision::digit_base_2, void,
                                         std::int32_t>,
    boost::multiprecision::et_off>;

// a + b, a - b and a * b, rounded to the nearest, ties to even. Boost, which is written for integers of any length,
// takes several times as long for the same bits (but where one number is 2^(bits + 1) times the other: there its
// difference may be that of the next bit). Zeros, infinities, what is no number and exponents at the ends of their
// range are left to Boost.
template <unsigned bits>
LongNumber<bits> sum(const LongNumber<bits>& a, const LongNumber<bits>& b);
template <unsigned bits>
LongNumber<bits> difference(const LongNumber<bits>& a, const LongNumber<bits>& b);
template <unsigned bits>
LongNumber<bits> product(const LongNumber<bits>& a, const LongNumber<bits>& b);

namespace long_arithmetic {

#ifdef __SIZEOF_INT128__
inline constexpr bool is_available = std::endian::native == std::endian::little;
__extension__ typedef unsigned __int128 DoubleWord;
#else
inline constexpr bool is_available = false;
using DoubleWord = std::uint64_t;
#endif

// Significands are words of 64 bits, the lowest first.
template <std::size_t count>
using Words = std::array<std::uint64_t, count>;

// ± significand · 2^(exponent - bits + 1), where the highest bit of the significand is 1.
template <unsigned bits>
struct Parts {
  static constexpr std::size_t count = bits / 64;
  Words<count> significand;
  std::int32_t exponent;
  bool is_negative;
};

// Whether the number has parts, and sums and products of such have them too, or are 0.
template <unsigned bits>
bool is_ordinary(const LongNumber<bits>& a) {
  constexpr std::int32_t largest = 1 << 28;
  const std::int32_t exponent = a.backend().exponent();
  return -largest < exponent && exponent < largest;
}

template <unsigned bits>
Parts<bits> parts(const LongNumber<bits>& a) {
  Parts<bits> result;
  std::memcpy(result.significand.data(), a.backend().bits().limbs(), sizeof(result.significand));
  result.exponent = a.backend().exponent();
  result.is_negative = a.backend().sign();
  return result;
}

template <unsigned bits>
LongNumber<bits> number(const Parts<bits>& parts) {
  LongNumber<bits> result;
  auto& significand = result.backend().bits();
  constexpr unsigned limbs = sizeof(parts.significand) / sizeof(*significand.limbs());
  significand.resize(limbs, limbs);
  std::memcpy(significand.limbs(), parts.significand.data(), sizeof(parts.significand));
  result.backend().exponent() = parts.exponent;
  result.backend().sign() = parts.is_negative;
  return result;
}

template <std::size_t count>
int leading_zeros(const Words<count>& a) {
  for (std::size_t i = count; i-- > 0;)
    if (a[i] != 0) return static_cast<int>(64 * (count - 1 - i)) + std::countl_zero(a[i]);
  return 64 * static_cast<int>(count);
}

template <std::size_t count>
void shift_left(Words<count>& a, int shift) {
  const auto words = static_cast<std::size_t>(shift / 64);
  const int rest = shift % 64;
  for (std::size_t i = count; i-- > 0;) {
    const std::uint64_t high = i >= words ? a[i - words] : 0;
    const std::uint64_t low = i >= words + 1 ? a[i - words - 1] : 0;
    a[i] = rest == 0 ? high : high << rest | low >> (64 - rest);
  }
}

// The number whose significand is the upper words of `significand`, whose highest bit is 1, rounded by the lower ones.
template <unsigned bits, std::size_t count>
LongNumber<bits> rounded(const Words<count>& significand, std::int32_t exponent, bool is_negative) {
  constexpr std::size_t kept = bits / 64, lower = count - kept;
  Parts<bits> result;
  for (std::size_t i = 0; i < kept; ++i) result.significand[i] = significand[lower + i];
  result.exponent = exponent;
  result.is_negative = is_negative;
  constexpr std::uint64_t half = std::uint64_t{1} << 63;
  if (significand[lower - 1] & half) {
    std::uint64_t below = significand[lower - 1] ^ half;
    for (std::size_t i = 0; i + 1 < lower; ++i) below |= significand[i];
    if (below != 0 || (result.significand[0] & 1)) {
      std::size_t i = 0;
      while (i < kept && ++result.significand[i] == 0) ++i;
      if (i == kept) {  // from 1…1 to 10…0
        result.significand[kept - 1] = half;
        ++result.exponent;
      }
    }
  }
  return number(result);
}

// a + b, or a - b where `subtracts`, of which both are ordinary.
template <unsigned bits>
LongNumber<bits> sum(const LongNumber<bits>& a, const LongNumber<bits>& b, bool subtracts) {
  constexpr std::size_t kept = bits / 64, count = kept + 1;
  Parts<bits> large = parts(a), small = parts(b);
  small.is_negative ^= subtracts;
  const auto is_less = [](const Parts<bits>& x, const Parts<bits>& y) {
    if (x.exponent != y.exponent) return x.exponent < y.exponent;
    for (std::size_t i = kept; i-- > 0;)
      if (x.significand[i] != y.significand[i]) return x.significand[i] < y.significand[i];
    return false;
  };
  if (is_less(large, small)) std::swap(large, small);
  const std::int32_t shift = large.exponent - small.exponent;
  if (shift > static_cast<std::int32_t>(bits) + 1) return number(large);

  // A word more than is kept. What the shift loses of the small number beyond that becomes its last bit: there are lost
  // bits only where the sum has its highest bit in the first two places, so they decide nothing but what is a tie.
  Words<count> result{}, shifted{};
  const auto words = static_cast<std::size_t>(shift / 64);
  const int rest = shift % 64;
  std::uint64_t lost = 0;
  for (std::size_t i = 0; i < kept; ++i) {
    const std::uint64_t high = small.significand[i] >> rest;
    const std::uint64_t low = rest == 0 ? 0 : small.significand[i] << (64 - rest);
    (i + 1 >= words ? shifted[i + 1 - words] : lost) |= high;
    (i >= words ? shifted[i - words] : lost) |= low;
    result[i + 1] = large.significand[i];
  }
  shifted[0] |= lost != 0 ? 1 : 0;
  if (large.is_negative == small.is_negative) {
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const DoubleWord digit = DoubleWord{result[i]} + shifted[i] + carry;
      result[i] = static_cast<std::uint64_t>(digit);
      carry = static_cast<std::uint64_t>(digit >> 64);
    }
    if (carry != 0) {
      const std::uint64_t last = result[0] & 1;
      for (std::size_t i = 0; i < count; ++i)
        result[i] = result[i] >> 1 | (i + 1 < count ? result[i + 1] : carry) << 63;
      result[0] |= last;
      ++large.exponent;
    }
    return rounded<bits>(result, large.exponent, large.is_negative);
  }
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const DoubleWord digit = DoubleWord{result[i]} - shifted[i] - borrow;
    result[i] = static_cast<std::uint64_t>(digit);
    borrow = static_cast<std::uint64_t>(digit >> 64) & 1;
  }
  const int zeros = leading_zeros(result);
  if (zeros == 64 * static_cast<int>(count)) return LongNumber<bits>(0);
  if (zeros > 0) shift_left(result, zeros);
  return rounded<bits>(result, large.exponent - zeros, large.is_negative);
}

// a · b, of which both are ordinary.
template <unsigned bits>
LongNumber<bits> product(const LongNumber<bits>& a, const LongNumber<bits>& b) {
  constexpr std::size_t kept = bits / 64;
  const Parts<bits> x = parts(a), y = parts(b);
  Words<2 * kept> result{};
  for (std::size_t i = 0; i < kept; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < kept; ++j) {
      const DoubleWord digit =
          DoubleWord{x.significand[i]} * y.significand[j] + result[i + j] + carry;
      result[i + j] = static_cast<std::uint64_t>(digit);
      carry = static_cast<std::uint64_t>(digit >> 64);
    }
    result[i + kept] = carry;
  }
  std::int32_t exponent = x.exponent + y.exponent + 1;
  if (result.back() >> 63 == 0) {
    for (std::size_t i = result.size(); i-- > 0;)
      result[i] = result[i] << 1 | (i > 0 ? result[i - 1] >> 63 : 0);
    --exponent;
  }
  return rounded<bits>(result, exponent, x.is_negative != y.is_negative);
}

}  // namespace long_arithmetic

template <unsigned bits>
LongNumber<bits> sum(const LongNumber<bits>& a, const LongNumber<bits>& b) {
  if constexpr (long_arithmetic::is_available)
    if (long_arithmetic::is_ordinary<bits>(a) && long_arithmetic::is_ordinary<bits>(b))
      return long_arithmetic::sum<bits>(a, b, false);
  return a + b;
}

template <unsigned bits>
LongNumber<bits> difference(const LongNumber<bits>& a, const LongNumber<bits>& b) {
  if constexpr (long_arithmetic::is_available)
    if (long_arithmetic::is_ordinary<bits>(a) && long_arithmetic::is_ordinary<bits>(b))
      return long_arithmetic::sum<bits>(a, b, true);
  return a - b;
}

template <unsigned bits>
LongNumber<bits> product(const LongNumber<bits>& a, const LongNumber<bits>& b) {
  if constexpr (long_arithmetic::is_available)
    if (long_arithmetic::is_ordinary<bits>(a) && long_arithmetic::is_ordinary<bits>(b))
      return long_arithmetic::product<bits>(a, b);
  return a * b;
}

}  // namespace courant
