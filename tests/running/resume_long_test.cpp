// Every experiment that is kept goes on with the same bytes.
#include <boost/test/unit_test.hpp>

#include "../core/files/experiment_files.hpp"
#include "courant/reading/table.hpp"
#include "resumed_run.hpp"

BOOST_AUTO_TEST_SUITE(resume_long)

BOOST_AUTO_TEST_CASE(every_experiment) {
  using namespace courant;
  const test::Campaign campaign = test::Campaign::of_environment();
  long count = 0;
  for (const std::filesystem::path& file : test::experiment_files(campaign)) {
    Json document = Json::parse(read_text(file));
    load_tables(document, "experiments");
    const Experiment experiment = read_experiment(document.dump());
    if (!experiment.time || experiment.time->steps > 10'000)
      continue;                         // the long ones are of others
    if (experiment.ensemble) continue;  // which ensemble_run_test resumes
    const long steps = experiment.time->steps;
    document["output"]["epoch"] = steps / 7 + 1;
    document["output"]["format"] = ++count % 2 == 0 ? "npy" : "csv";
    check_resumption(document, {steps / 20, 6 * steps / 10}, file.stem());
  }
  BOOST_TEST(count > campaign.of(100));
}

BOOST_AUTO_TEST_SUITE_END()
