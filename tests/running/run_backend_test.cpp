#include "courant/running/run_backend.hpp"

#include <boost/test/unit_test.hpp>

namespace courant {
// Mistakes that these cases have to notice:
//  * short runs wait for a compiler that takes longer than they do
BOOST_AUTO_TEST_SUITE(run_backend_test)

namespace {

Experiment chain(int masses, long steps) {
  const Json experiment = {{"system",
                            {{"type", "mechanical"},
                             {"parameters", {{"n", masses}}},
                             {"coordinates", {"q[n]"}},
                             {"potential", "dot(q, q)/2"}}},
                           {"initial", {{"q", std::vector<double>(std::size_t(masses), 0.0)}}},
                           {"method", {{"type", "discretize-first"}}},
                           {"time", {{"step", 1}, {"end", steps}}}};
  return read_experiment(experiment.dump());
}

}  // namespace

// Compiling pays where the run is long, and is done where it is asked for.
BOOST_AUTO_TEST_CASE(short_runs_are_interpreted) {
  BOOST_TEST((worthwhile(Backend::automatic, chain(150, 100)) == Backend::interpreter));
  BOOST_TEST((worthwhile(Backend::automatic, chain(150, 30'000)) == Backend::automatic));
  BOOST_TEST((worthwhile(Backend::automatic, chain(5, 19'000)) == Backend::interpreter));
  BOOST_TEST((worthwhile(Backend::automatic, chain(5, 20'000)) == Backend::automatic));
  BOOST_TEST((worthwhile(Backend::native, chain(150, 100)) == Backend::native));
  // The code of ten runs is compiled once.
  BOOST_TEST((worthwhile(Backend::automatic, chain(5, 2'000), 9) == Backend::interpreter));
  BOOST_TEST((worthwhile(Backend::automatic, chain(5, 2'000), 10) == Backend::automatic));
  BOOST_TEST((worthwhile(Backend::automatic, chain(5, 100), 10'000) == Backend::interpreter));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
