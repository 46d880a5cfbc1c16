#include "courant/core/words/spelling.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <random>

// Mistakes that these cases have to notice:
//  * letters that are exchanged count two
BOOST_AUTO_TEST_SUITE(spelling_test)

using namespace courant;

BOOST_AUTO_TEST_CASE(distances_known_by_hand) {
  BOOST_TEST(edit_distance("", "") == 0);
  BOOST_TEST(edit_distance("", "abc") == 3);
  BOOST_TEST(edit_distance("kitten", "sitting") == 3);
  BOOST_TEST(edit_distance("gravtiy", "gravity") == 1);  // a swap is one edit
  BOOST_TEST(edit_distance("ca", "abc") == 3);           // restricted: unrestricted it would be 2
}

BOOST_AUTO_TEST_CASE(edits_bound_the_distance_and_it_is_symmetric) {
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  const auto letter = [&] { return static_cast<char>('a' + below(4)); };
  for (int trial = 0; trial < 500; ++trial) {
    std::string word(5 + below(8), ' ');
    for (char& c : word) c = letter();
    std::string edited = word;
    const std::size_t edits = below(4);
    for (std::size_t edit = 0; edit < edits; ++edit) {
      const std::size_t at = below(edited.size() - 1);
      switch (below(4)) {
        case 0:
          edited.insert(at, 1, letter());
          break;
        case 1:
          edited.erase(at, 1);
          break;
        case 2:
          edited[at] = letter();
          break;
        default:
          edits == 1 ? std::swap(edited[at], edited[at + 1]) : void(edited[at] = letter());
      }
    }
    BOOST_TEST(edit_distance(word, edited) <= edits);
    BOOST_TEST(edit_distance(word, edited) == edit_distance(edited, word));
    BOOST_TEST((edit_distance(word, edited) == 0) == (word == edited));
  }
}

BOOST_AUTO_TEST_CASE(suggests_what_is_close_and_nothing_else) {
  const std::vector<std::string> names{"q", "omega", "gravity", "pi"};
  BOOST_TEST(did_you_mean("qq", names) == " (did you mean \"q\"?)");
  BOOST_TEST(did_you_mean("omgea", names) == " (did you mean \"omega\"?)");
  BOOST_TEST(did_you_mean("Gravty", names) == " (did you mean \"gravity\"?)");
  BOOST_TEST(did_you_mean("PI", names) == " (did you mean \"pi\"?)");
  BOOST_TEST(did_you_mean("x", names) == "");  // another letter is another name
  BOOST_TEST(did_you_mean("length", names) == "");
  BOOST_TEST(did_you_mean("x", {}) == "");
}

BOOST_AUTO_TEST_SUITE_END()
