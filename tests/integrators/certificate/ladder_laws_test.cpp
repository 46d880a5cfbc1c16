#include "courant/integrators/certificate/ladder_laws.hpp"

#include <boost/test/unit_test.hpp>
#include <functional>

#include "ladder_catalogue.hpp"

BOOST_AUTO_TEST_SUITE(ladder_laws)

using namespace courant;

namespace {

const examples::KnownLadder& pendulum() {
  static const auto table = examples::errata();
  return table[1];  // (4,3), (3,2), (2,2), (2,2)
}

// Which laws fail for the pendulum's ladder with something planted in it.
std::string failed(const std::function<void(ConstraintLadder&)>& plant) {
  ConstraintLadder ladder = pendulum().problem.ladder();
  plant(ladder);
  std::string laws;
  for (const LawResult& result : check_ladder(ladder, 4))
    if (!result.passed()) laws += result.law.substr(0, 2) + " ";
  return laws;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_ladder_of_the_catalogue_keeps_every_law) {
  for (const examples::KnownLadder& known : examples::catalogue()) {
    const auto results =
        check_ladder(known.problem.ladder(), known.problem.system->manifold()->dimension());
    if (known.verdict == Verdict::regular || known.verdict == Verdict::gauge)
      BOOST_TEST(results.size() == 4U);
    for (const LawResult& result : results)
      BOOST_TEST(result.passed(), known.name << ": " << result);
  }
}

BOOST_AUTO_TEST_CASE(laws_reject_what_is_planted) {
  BOOST_TEST(failed([](ConstraintLadder&) {}) == "");
  BOOST_TEST(failed([](ConstraintLadder& l) { l.levels[1].dim_S = 5; }) == "N1 ");
  BOOST_TEST(failed([](ConstraintLadder& l) { l.levels[0].dim_S = 8; }) == "N2 ");
  BOOST_TEST(failed([](ConstraintLadder& l) { l.constraints.pop_back(); }) == "N3 ");
  BOOST_TEST(failed([](ConstraintLadder& l) { l.levels[1].dim_M = 3; }) == "N3 ");
  BOOST_TEST(failed([](ConstraintLadder& l) { l.levels.pop_back(); }) == "N4 ");
  BOOST_TEST(failed([](ConstraintLadder& l) { l.gauge_dimension = 1; }) == "N4 ");
}

BOOST_AUTO_TEST_SUITE_END()
