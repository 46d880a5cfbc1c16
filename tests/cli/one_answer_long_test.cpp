// What `run` says of a system beside what `constraints` says, of all experiments.
#include <algorithm>
#include <atomic>
#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "../core/files/experiment_files.hpp"
#include "../core/files/temporary_folder.hpp"
#include "answer.hpp"
#include "courant/reading/json_document.hpp"
#include "courant/reading/table.hpp"

// Mistakes that these cases have to notice:
//  * runs decide by digits alone (running/start_moves.cpp)
BOOST_AUTO_TEST_SUITE(one_answer_long_test)

using namespace courant;

// A run that is interrupted at its first state has the summary of its start. One with conditions at both ends begins at
// its solution, and not at the given values; an ensemble has a ladder for each member. Brackets and branches are made
// where they are shown, by `constraints` alone.
BOOST_AUTO_TEST_CASE(a_run_begins_with_the_ladder_that_constraints_shows) {
  const TemporaryFolder folder;
  const std::atomic<bool> stop = true;
  const test::Campaign campaign = test::Campaign::of_environment();
  long experiments = 0;
  for (const std::filesystem::path& file : test::experiment_files(campaign)) {
    const std::string name = file.stem().string();
    const Json document = Json::parse(read_text(file), nullptr, true, true);
    if (document.contains("boundary") || document.contains("ensemble")) continue;
    const auto shown = test::courant_command({"constraints", file.string(), "--json"});
    BOOST_TEST_REQUIRE(shown.status == 0, name << ": " << shown.err);
    Json ladder = Json::parse(shown.out);
    ladder.erase("brackets");
    ladder.erase("branches");

    const std::filesystem::path there = folder / name;
    const auto run = test::courant_command(
        {"run", file.string(), "-o", there.string(), "--quiet", "--backend", "interpreter"}, "",
        &stop);
    const Json summary = Json::parse(read_text(there / "summary.json"));
    BOOST_TEST(summary.at("ladder") == ladder, name << ": " << run.err
                                                    << summary.at("ladder").dump() << "\n"
                                                    << ladder.dump());
    ++experiments;
  }
  // A part may have more than its share of those that are left out.
  BOOST_TEST(experiments >= (campaign.is_whole() ? 160 : campaign.of(160) - 6));
}

BOOST_AUTO_TEST_SUITE_END()
