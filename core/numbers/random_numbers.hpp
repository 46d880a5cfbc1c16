// Random numbers that are the same on every machine.
#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace courant {

// The numbers u₀, u₁, … of one stream, which its seed, its name and its number determine to the last bit: they are
// made of the words of std::mt19937_64, which the C++ standard fixes, by comparisons and by operations of IEEE 754 that
// round exactly. (std::normal_distribution differs between libraries, log and cos between machines.)
class RandomNumbers {
 public:
  RandomNumbers(std::uint64_t seed, std::string_view name, std::uint64_t number);

  // Uniform on [0, 1): a multiple of 2⁻⁵³.
  double uniform() { return static_cast<double>(words_() >> 11) * 0x1p-53; }
  // Of the standard normal distribution: |g| is an exponential variable E, by von Neumann's comparisons, that is kept
  // with probability exp(-(E - 1)²/2). J. von Neumann, "Various techniques used in connection with random digits",
  // NBS Applied Mathematics Series 12 (1951), 36–38.
  double normal();

 private:
  double exponential();
  bool happens(double a);         // with probability exp(-a), a ≥ 0
  bool happens_within(double a);  // the same for a ≤ 1

  std::mt19937_64 words_;
};

}  // namespace courant
