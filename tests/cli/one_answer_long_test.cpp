// What `run` says of a system beside what `constraints` says, of all experiments.
#include <algorithm>
#include <atomic>
#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "../core/files/temporary_folder.hpp"
#include "answer.hpp"
#include "courant/reading/json_document.hpp"
#include "courant/reading/table.hpp"

// Mistakes that these cases have to notice:
//  * runs decide by digits alone (running/start_moves.cpp)
BOOST_AUTO_TEST_SUITE(one_answer_long_test)

using namespace courant;

// A run that is interrupted at its first state has the summary of its start. One with conditions at both ends begins at
// its solution, and not at the given values; an ensemble has a ladder for each member.
BOOST_AUTO_TEST_CASE(a_run_begins_with_the_ladder_that_constraints_shows) {
  const TemporaryFolder folder;
  const std::atomic<bool> stop = true;
  int experiments = 0;
  for (const auto& file : std::filesystem::directory_iterator("experiments")) {
    const std::string name = file.path().stem().string();
    if (file.path().extension() != ".json" || name == "schema") continue;
    const Json document = Json::parse(read_text(file.path()), nullptr, true, true);
    if (document.contains("boundary") || document.contains("ensemble")) continue;
    const auto shown = test::courant_command({"constraints", file.path().string(), "--json"});
    BOOST_TEST_REQUIRE(shown.status == 0, name << ": " << shown.err);
    Json ladder = Json::parse(shown.out);
    ladder.erase("brackets");

    const std::filesystem::path there = folder / name;
    const auto run = test::courant_command(
        {"run", file.path().string(), "-o", there.string(), "--quiet", "--backend", "interpreter"},
        "", &stop);
    const Json summary = Json::parse(read_text(there / "summary.json"));
    BOOST_TEST(summary.at("ladder") == ladder, name << ": " << run.err
                                                    << summary.at("ladder").dump() << "\n"
                                                    << ladder.dump());
    ++experiments;
  }
  BOOST_TEST(experiments >= 160);
}

BOOST_AUTO_TEST_SUITE_END()
