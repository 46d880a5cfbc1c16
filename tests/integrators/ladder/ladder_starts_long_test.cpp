// Every system of the catalogue from ten starts, in other orders, units and coordinates, with terms
// added that are zero but for rounding. The aim is that no verdict is wrong without saying that it is
// ambiguous; the bounds hold what is measured.
#include <boost/test/unit_test.hpp>
#include <iostream>

#include "ladder_starts.hpp"

BOOST_AUTO_TEST_SUITE(ladder_starts_long_test)

using namespace courant;
using namespace courant::examples;

namespace {

struct Count {
  int ladders = 0, wrong_in_silence = 0, wrong = 0, ambiguous = 0;
};

Problem variant_of(const Problem& problem, int variant, std::mt19937& generator) {
  const Problem other = variant % 4 == 1   ? with_planted_round_off(problem, generator)
                        : variant % 4 == 3 ? with_cancelled_products(problem, generator)
                                           : problem;
  return variant == 0       ? problem
         : variant % 3 == 0 ? permuted(other, generator)
         : variant % 3 == 1 ? scaled(other, generator)
                            : transformed(other, generator);
}

void count(const KnownLadder& known, const KnownStart& start, std::mt19937& generator,
           Count& counted) {
  constexpr int variants = 8;
  for (int variant = 0; variant < variants; ++variant) {
    const ConstraintLadder ladder = variant_of(start.problem, variant, generator).ladder();
    const bool right = ladder.verdict == start.verdict &&
                       (start.dimensions.empty() || dimensions(ladder) == start.dimensions);
    ++counted.ladders;
    if (right && ladder.is_ambiguous()) ++counted.ambiguous;
    if (right) continue;
    ++counted.wrong;
    if (!ladder.is_ambiguous()) ++counted.wrong_in_silence;
    BOOST_TEST_MESSAGE(known.name << ", " << start.kind << ", variant " << variant << ": "
                                  << to_string(ladder.verdict)
                                  << (ladder.is_ambiguous() ? " (ambiguous), " : ", ")
                                  << ladder.reason);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(ten_starts_of_every_system_in_eight_variants) {
  Count counted;
  unsigned seed = 11;
  for (const KnownLadder& known : catalogue()) {
    std::mt19937 generator(++seed);
    for (const KnownStart& start : ten_starts(known)) count(known, start, generator, counted);
  }
  std::cout << counted.ladders << " ladders, " << counted.wrong << " wrong, of these "
            << counted.wrong_in_silence << " in silence; " << counted.ambiguous
            << " right ones ambiguous\n";
  BOOST_TEST(counted.ladders == 4320);
  BOOST_TEST(counted.wrong <= 117);
  BOOST_TEST(counted.wrong_in_silence == 0);
  BOOST_TEST(counted.ambiguous <= 84);
}

BOOST_AUTO_TEST_SUITE_END()
