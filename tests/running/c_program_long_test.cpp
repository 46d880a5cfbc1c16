#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <set>

#include "c_runs.hpp"
#include "courant/reading/table.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(c_programs_long)

// Of all experiments: what has a program runs as the run does, to the last byte, or ends where a step needs
// more; what has none is refused.
BOOST_AUTO_TEST_CASE(every_experiment_runs_in_c_or_is_refused) {
  // Diodes that begin to block or to conduct within a step.
  const std::set<std::string> end_before = {"network_rectifier", "network_transistor_amplifier"};
  int same = 0;
  for (const auto& file : std::filesystem::directory_iterator("experiments")) {
    const std::string name = file.path().stem().string();
    if (file.path().extension() != ".json" || name == "schema") continue;
    const TemporaryFolder folder;
    std::string source;
    Json experiment = Json::parse(read_text(file.path()), nullptr, true, true);
    load_tables(experiment, "experiments");
    try {
      if (experiment.contains("output")) experiment["output"]["format"] = "csv";
      source = c_program(read_experiment(experiment.dump()));
    } catch (const ExperimentError&) {
      continue;
    }
    const test::CRun program = test::run_c(folder, source);
    BOOST_TEST(program.compiler == "", name);
    BOOST_TEST(program.status == (end_before.contains(name) ? 3 : 0), name << ": " << program.err);
    const std::string rows = test::rows_of_run(folder, experiment);
    BOOST_TEST(program.err.empty() == !end_before.contains(name), name << ": " << program.err);
    BOOST_TEST((program.status == 3 ? rows.find(program.out) == 0u : rows == program.out), name);
    same += program.status == 0 ? 1 : 0;
  }
  BOOST_TEST(same >= 78);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
