// Starts as people type them beside the nearest consistent ones that SciPy finds (start_references.py).
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <fstream>

#include "../core/campaign.hpp"
#include "courant/running/consistent_start.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(starts_long_test)

namespace {

struct Distances {
  double position = 0.0, motion = 0.0;
  bool holds = true, is_start = false;
};

// Of the start that is found from the one that SciPy found.
Distances distances(const Json& table, const Json& typed) {
  const auto names = table.at("names").get<std::vector<std::string>>();
  const std::string motion = table.at("motion");
  const auto of_motion = [&](std::size_t i) {
    return motion == "velocity" ? names[i] + "'" : "p_" + names[i];
  };
  Json initial = Json::object(), hold = Json::array();
  for (std::size_t i = 0; i < names.size(); ++i) initial[names[i]] = typed.at("q")[i];
  if (motion != "none")
    for (std::size_t i = 0; i < names.size(); ++i) initial[of_motion(i)] = typed.at("w")[i];
  for (const Json& i : typed.at("hold_q")) hold.push_back(names[i.get<std::size_t>()]);
  if (motion != "none")
    for (const Json& i : typed.at("hold_w")) hold.push_back(of_motion(i.get<std::size_t>()));
  Json experiment = {{"system", table.at("system")}, {"initial", initial}, {"start", "nearest"}};
  if (!hold.empty()) experiment["hold"] = hold;
  const Experiment read = read_experiment(experiment.dump());
  const ConstraintLadder ladder = consistent_start(read);

  Distances found;
  found.is_start = ladder.verdict == Verdict::regular;
  if (!found.is_start) return found;
  const auto n = static_cast<Index>(names.size());
  const auto numbers = [&](const char* key) {
    const auto list = typed.at(key).get<std::vector<double>>();
    return VectorXd(Eigen::Map<const VectorXd>(list.data(), n));
  };
  const VectorXd q = ladder.point.x.head(n);
  const VectorXd rates = read.model.system->manifold()->frame(ladder.point.x) * ladder.point.v;
  found.position = (q - numbers("nearest_q")).norm();
  const VectorXd w =
      motion == "momentum" ? VectorXd(ladder.point.x.tail(n)) : VectorXd(rates.head(n));
  if (motion != "none") found.motion = (w - numbers("nearest_w")).norm();
  for (const Json& i : typed.at("hold_q"))
    found.holds = found.holds && q[i.get<Index>()] == numbers("q")[i.get<Index>()];
  if (motion != "none")
    for (const Json& i : typed.at("hold_w"))
      found.holds = found.holds && w[i.get<Index>()] == numbers("w")[i.get<Index>()];
  return found;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_start_is_the_nearest_one) {
  std::ifstream file("tests/running/starts.json");
  const test::Campaign campaign = test::Campaign::of_environment();
  long number = 0;
  for (const Json& table : Json::parse(file))
    for (const Json& typed : table.at("starts")) {
      if (!campaign.has(number++)) continue;
      const Distances found = distances(table, typed);
      BOOST_TEST_CONTEXT(table.at("name") << ", " << typed) {
        BOOST_TEST(found.is_start);
        BOOST_TEST(found.position < 1e-7);
        BOOST_TEST(found.motion < 1e-6);
        BOOST_TEST(found.holds);
      }
    }
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
