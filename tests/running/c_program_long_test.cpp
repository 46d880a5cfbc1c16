#include <boost/test/unit_test.hpp>
#include <filesystem>

#include "c_runs.hpp"
#include "courant/reading/table.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(c_programs_long)

// Of all experiments: what has a program runs as the run does, to the last byte; what has none is refused.
BOOST_AUTO_TEST_CASE(every_experiment_runs_in_c_or_is_refused) {
  int programs = 0;
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
    BOOST_TEST(program.status == 0, name << ": " << program.err);
    BOOST_TEST(program.err == "", name);
    BOOST_TEST((program.out == test::rows_of_run(folder, experiment)), name << ": other bytes");
    ++programs;
  }
  BOOST_TEST(programs >= 129);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
