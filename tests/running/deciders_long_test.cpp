// Ranks that two precisions decide and ranks that bounds of errors decide, of all experiments.
#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <set>
#include <string>

#include "../core/files/temporary_folder.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/reading/table.hpp"
#include "courant/running/consistent_start.hpp"

// Mistakes that these cases have to notice:
//  * the ranks of a manifold in space are counted as those in a chart
//    (integrators/certificate/elimination_reading.cpp)
//  * given values that doubles round are held to the last digit
//    (integrators/certificate/nearest_jet.cpp)
//  * velocities that are held on a manifold move (integrators/certificate/nearest_jet.cpp)
BOOST_AUTO_TEST_SUITE(deciders_long_test)

using namespace courant;

namespace {

std::string in_words(const ConstraintLadder& ladder) {
  std::string text = to_string(ladder.verdict) + " " + std::to_string(ladder.index);
  for (const LadderLevel& level : ladder.levels) {
    text += " (" + std::to_string(level.dim_S) + "," + std::to_string(level.dim_M) + ")";
    if (level.is_empty) continue;
    for (const RankDecision* rank : {&level.all, &level.without_tangent, &level.without_point})
      text += " " + std::to_string(rank->rank);
  }
  for (const int count : ladder.differentiations) text += " " + std::to_string(count);
  for (const Doubt& doubt : ladder.doubts) text += " [" + doubt.text + "]";
  return text;
}

// Where the two are known to differ, for causes that were not looked into. Once they agree, they go from this list.
const std::set<std::string> kDiffer = {"charge_pump", "christ_lee_quartic",
                                       "inconsistent_lagrangian", "redundant_loops"};

}  // namespace

// Dimensions, the ranks behind them, index, how often each equation is differentiated, and where the start is.
BOOST_AUTO_TEST_CASE(both_say_the_same_of_every_experiment) {
  int experiments = 0;
  for (const auto& file : std::filesystem::directory_iterator("experiments")) {
    const std::string name = file.path().stem().string();
    if (file.path().extension() != ".json" || name == "schema") continue;
    Json document = Json::parse(read_text(file.path()), nullptr, true, true);
    load_tables(document, "experiments");
    const Experiment experiment = read_experiment_document(document);
    const ConsistentStart digits = consistent_start(experiment, Decider::both),
                          bounds = consistent_start(experiment, Decider::bounds);
    const bool agree =
        in_words(digits) == in_words(bounds) &&
        (digits.point.x - bounds.point.x).norm() <= 1e-9 * (1.0 + bounds.point.x.norm()) &&
        (digits.point.v - bounds.point.v).norm() <= 1e-9 * (1.0 + bounds.point.v.norm());
    BOOST_TEST(agree != kDiffer.contains(name),
               name << ": by digits " << in_words(digits) << ", by bounds " << in_words(bounds));
    ++experiments;
  }
  BOOST_TEST(experiments >= 160);
}

BOOST_AUTO_TEST_SUITE_END()
