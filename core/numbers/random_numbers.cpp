#include "courant/core/numbers/random_numbers.hpp"

#include <vector>

namespace courant {
namespace {

std::mt19937_64 seeded(std::uint64_t seed, std::string_view name, std::uint64_t number) {
  std::vector<std::uint32_t> parts = {
      static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
      static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(number >> 32)};
  for (const char c : name) parts.push_back(static_cast<unsigned char>(c));
  std::seed_seq sequence(parts.begin(), parts.end());
  return std::mt19937_64(sequence);
}

}  // namespace

RandomNumbers::RandomNumbers(std::uint64_t seed, std::string_view name, std::uint64_t number)
    : words_(seeded(seed, name, number)) {}

// a > u₁ > u₂ > … > u_n ≤ u_{n+1} has n even with probability exp(-a).
bool RandomNumbers::happens_within(double a) {
  bool is_even = true;
  for (double last = a, u = uniform(); u < last; u = uniform()) {
    last = u;
    is_even = !is_even;
  }
  return is_even;
}

bool RandomNumbers::happens(double a) {
  for (; a > 1.0; a -= 1.0)
    if (!happens_within(1.0)) return false;
  return happens_within(a);
}

// The whole part counts how often a fraction u was not kept, each time with probability 1 - exp(-u).
double RandomNumbers::exponential() {
  for (double whole = 0.0;; whole += 1.0)
    if (const double u = uniform(); happens_within(u)) return whole + u;
}

double RandomNumbers::normal() {
  for (;;) {
    const double size = exponential();
    const double way = size - 1.0;
    const bool is_kept = happens(way * way * 0.5);
    const bool is_positive = (words_() >> 63) == 0;
    if (is_kept) return is_positive ? size : -size;
  }
}

}  // namespace courant
