#include <boost/test/unit_test.hpp>
#include <filesystem>

#include "../core/files/experiment_files.hpp"
#include "c_runs.hpp"
#include "courant/reading/table.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(c_programs_long)

// Of all experiments: what has a program runs as the run does, to the last byte; what has none is refused.
BOOST_AUTO_TEST_CASE(every_experiment_runs_in_c_or_is_refused) {
  const test::Campaign campaign = test::Campaign::of_environment();
  long programs = 0;
  for (const std::filesystem::path& file : test::experiment_files(campaign)) {
    const std::string name = file.stem().string();
    const TemporaryFolder folder;
    std::string source;
    Json experiment = Json::parse(read_text(file), nullptr, true, true);
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
  // A part may have more than its share of those that are refused.
  BOOST_TEST(programs >= (campaign.is_whole() ? 129 : campaign.of(129) - 6));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
