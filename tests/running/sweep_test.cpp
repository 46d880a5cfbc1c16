#include "courant/running/sweep.hpp"

#include <boost/test/unit_test.hpp>
#include <set>

#include "../core/files/temporary_folder.hpp"
#include "courant/running/run_files.hpp"
#include "courant/running/run_folder.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a sweep that was interrupted passes for a whole one
//  * cases of different sizes wait for a compiler, since they count as one code (running/sweep.cpp)
BOOST_AUTO_TEST_SUITE(sweep_test)

namespace {

const Json oscillator = Json::parse(R"json({
  "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "(p_q^2 + k*q^2)/2", "parameters": { "k": 1 } },
  "initial": { "q": 1, "p_q": 0 },
  "method": { "type": "discretize-first", "discretization": { "type": "theta", "theta": 0.5 } },
  "time": { "step": 0.1, "end": 1 },
  "expect": [ { "observable": "H", "max_drift": 1e-12 } ]
})json");

const std::vector<ValueRange> thetas = {{"/method/discretization/theta", {0.5, 1, 2}}};

Json sweep_runs(const ResultFolder& folder, std::span<const ValueRange> ranges,
                const std::atomic<bool>* stop = nullptr, unsigned threads = 2,
                const Shard& shard = {}, const Json& earlier = {}) {
  return sweep(sweep_head(oscillator, ranges, shard), shard.take(sweep_cases(oscillator, ranges)),
               [&](const SweepCase& one) {
                 return run_of_case(one, folder.path(), Backend::interpreter, stop,
                                    !earlier.is_null());
               },
               {.threads = threads, .stop = stop, .folder = &folder, .earlier = earlier});
}

}  // namespace

BOOST_AUTO_TEST_CASE(cases_have_the_settings_and_names_of_folders) {
  const std::vector<ValueRange> ranges = {{"/system/parameters/k", {1, "2/3"}},
                                          {"/time/step", {0.1, 0.05}}};
  const auto cases = sweep_cases(oscillator, ranges);
  BOOST_TEST_REQUIRE(cases.size() == 4u);
  BOOST_TEST(cases[0].name == "1-k=1,step=0.1");
  BOOST_TEST(cases[3].name == "4-k=2_3,step=0.05");
  BOOST_TEST(cases[3].document["system"]["parameters"]["k"] == "2/3");
  BOOST_TEST(cases[3].document["time"]["step"] == 0.05);
  // In the order of names, however many there are; none longer than a folder's name may be.
  const std::vector<ValueRange> many = {{"/title", std::vector<Json>(10, std::string(300, 'a'))}};
  BOOST_TEST(sweep_cases(oscillator, many)[0].name.substr(0, 4) == "01-t");
  BOOST_TEST(sweep_cases(oscillator, many)[9].name.size() == 80u);
  BOOST_CHECK_THROW(sweep_cases(oscillator, std::vector<ValueRange>{{"/tim/step", {1}}}),
                    ExperimentError);
}

// A step is no number of the formulas, and a whole number may be a size.
BOOST_AUTO_TEST_CASE(cases_that_differ_in_numbers_have_one_code) {
  const std::vector<Json> numbers = {0.5, 1, 2}, whole = {1, 2, 3};
  const auto alike = [](std::vector<ValueRange> ranges) {
    return sweep_cases(oscillator, ranges).front().alike;
  };
  BOOST_TEST(alike({{"/system/parameters/k", numbers}}) == 3u);
  BOOST_TEST(alike({{"/system/parameters/k", whole}}) == 1u);
  BOOST_TEST(alike({{"/initial/q", numbers}, {"/time/step", numbers}}) == 3u);
  BOOST_TEST(alike({{"/initial/q", numbers}, {"/system/parameters/k", numbers}}) == 9u);
  BOOST_TEST(alike({{"/initial/q", numbers}, {"/time/step", numbers, true}}) == 1u);
  BOOST_TEST(alike({{"/initial/q", numbers}, {"/system/parameters/k", numbers, true}}) == 3u);
}

// A run that is as expected, one that is not, and one that cannot be read: all in the table.
BOOST_AUTO_TEST_CASE(a_table_says_what_became_of_each_run) {
  const TemporaryFolder temporary;
  const ResultFolder folder(temporary / "sweep", "sweep", false);
  const Json table = sweep_runs(folder, thetas);
  BOOST_TEST(table["status"] == "completed");
  const Json& runs = table["runs"];
  BOOST_TEST_REQUIRE(runs.size() == 3u);
  BOOST_TEST(runs[0]["status"] == "completed");
  BOOST_TEST(runs[0]["as_expected"] == true);
  BOOST_TEST(runs[0]["values"]["passed"] == 1);
  BOOST_TEST(runs[0]["values"]["H.max_drift"].get<double>() < 1e-12);
  BOOST_TEST(runs[1]["as_expected"] == false);
  BOOST_TEST(runs[1]["values"]["H.max_drift"].get<double>() > 1e-2);
  BOOST_TEST(runs[1]["message"].get<std::string>().find("/expect/0: ") == 0u);
  BOOST_TEST(runs[2]["status"] == "wrong");
  BOOST_TEST(runs[2]["folder"] == "");
  BOOST_TEST(runs[2]["message"].get<std::string>().find("/method/discretization/theta: is 2") ==
             0u);

  // The values are those of the runs in the folders, and the files those of the table.
  for (const std::size_t i : {0, 1}) {
    const Run run = read_run(folder.path() / runs[i]["folder"].get<std::string>());
    BOOST_TEST(runs[i]["values"]["H.max_drift"] == run.summary.observable("H")->max_drift);
    BOOST_TEST(run.trajectory.column("q").back() == runs[i]["values"]["q.final"].get<double>());
  }
  Json written = read_json(folder.file("json"));
  BOOST_TEST(written["kind"] == "sweep");
  Json told = runs;
  for (Json& run : told) run.erase("seconds");
  BOOST_TEST(written["runs"] == told);
  const std::string csv = read_text(folder.file("csv"));
  BOOST_TEST(csv == sweep_csv(table));
  BOOST_TEST(
      csv.find(
          "folder,/method/discretization/theta,status,verdict,ambiguous,steps,expectations,passed,"
          "H.initial,") == 0u);
  BOOST_TEST(csv.find("\n1-theta=0.5,0.5,completed,regular,false,10,1,1,0.5,") !=
             std::string::npos);
  BOOST_TEST(csv.find("\n,2,wrong,,") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(the_number_of_threads_changes_nothing) {
  const std::vector<ValueRange> ranges = {{"/system/parameters/k", {1, 2, 3, 4, 5, 6}}};
  std::set<std::string> tables;
  for (const unsigned threads : {1U, 4U}) {
    const TemporaryFolder temporary;
    Json table =
        sweep_runs(ResultFolder(temporary / "sweep", "sweep", false), ranges, nullptr, threads);
    for (Json& run : table["runs"]) run.erase("seconds");
    tables.insert(table.dump());
  }
  BOOST_TEST(tables.size() == 1u);
}

BOOST_AUTO_TEST_CASE(an_interrupt_leaves_a_table) {
  const TemporaryFolder temporary;
  const ResultFolder folder(temporary / "sweep", "sweep", false);
  const std::atomic<bool> stop{true};
  const Json table = sweep_runs(folder, thetas, &stop);
  BOOST_TEST(table["status"] == "interrupted");
  for (const Json& run : table["runs"]) {
    BOOST_TEST(run["status"] == "interrupted");
    BOOST_TEST(run["folder"] == "");
  }
  BOOST_TEST(read_json(folder.file("json"))["status"] == "interrupted");
}

// What gives up because of an interrupt says so by an exception; --resume makes such a case again.
BOOST_AUTO_TEST_CASE(a_case_that_an_interrupt_ends_before_its_first_step_is_no_failure) {
  const Json document = Json::parse(R"({"initial": {"q": 1}})");
  const std::vector<ValueRange> ranges = {{"/initial/q", {1, 2}}};
  std::atomic<bool> stop{false};
  const Json table =
      sweep(sweep_head(document, ranges), sweep_cases(document, ranges),
            [&](const SweepCase& one) -> Json {
              stop = one.name.starts_with("2");
              throw std::runtime_error(stop ? "interrupted" : "no solution was found");
            },
            {.threads = 1, .stop = &stop});
  BOOST_TEST(table["runs"][0]["status"] == "failed");
  BOOST_TEST(table["runs"][1]["status"] == "interrupted");
  BOOST_TEST(table["status"] == "interrupted");
}

BOOST_AUTO_TEST_CASE(ladders_are_swept_too) {
  const Json pendulum = Json::parse(R"json({
    "system": { "type": "mechanical", "coordinates": ["x", "y"], "potential": "y", "holonomic": "x^2 + y^2 - l^2", "parameters": { "l": 1 } },
    "initial": { "x": 0.6, "y": -0.8, "p_x": 0.8, "p_y": 0.6 } })json");
  const std::vector<ValueRange> ranges = {{"/system/parameters/l", {1, 2}}};
  const Json table = sweep(sweep_head(pendulum, ranges), sweep_cases(pendulum, ranges),
                           [](const SweepCase& one) { return ladder_of_case(one); }, {});
  for (const Json& run : table["runs"]) {
    BOOST_TEST(run["status"] == "completed", run["message"]);
    BOOST_TEST(run["values"]["verdict"] == "regular");
    BOOST_TEST(run["values"]["degrees_of_freedom"] == 2);
    BOOST_TEST(run["values"]["gap"].get<double>() > 1e3);
  }
  BOOST_TEST(table["runs"][0]["values"]["moved"].get<double>() < 1e-12);
  BOOST_TEST(table["runs"][1]["values"]["moved"].get<double>() > 0.1);
}

// A sweep that is stopped after some cases, and one whose table was lost after that: both go on to the bytes of one that was
// not.
BOOST_AUTO_TEST_CASE(an_interrupted_sweep_goes_on_to_the_same_bytes) {
  const std::vector<ValueRange> ranges = {{"/system/parameters/k", {1, 2, 3, 4, 5, 6}}};
  const TemporaryFolder temporary;
  const ResultFolder whole(temporary / "whole", "sweep", false);
  sweep_runs(whole, ranges);
  {
    const ResultFolder folder(temporary / "sweep", "sweep", false);
    std::atomic<bool> stop{false};
    const auto cases = sweep_cases(oscillator, ranges);
    sweep(sweep_head(oscillator, ranges), cases,
          [&](const SweepCase& one) {
            if (one.name == cases[3].name) stop = true;
            return run_of_case(one, folder.path(), Backend::interpreter, &stop);
          },
          {.threads = 1, .stop = &stop, .folder = &folder});
  }
  const Json earlier = ResultFolder::result_in(temporary / "sweep", "sweep");
  BOOST_TEST(earlier["status"] == "interrupted");
  BOOST_TEST(earlier["runs"][2]["status"] == "completed");
  BOOST_TEST(earlier["runs"][5]["status"] == "interrupted");
  const auto written = [&](const char* file) { return read_text(temporary / "sweep" / file); };
  Json without_rows = earlier;  // as after a kill before the table was written again
  for (Json& row : without_rows["runs"]) row["status"] = "interrupted";
  for (const Json& known : {earlier, without_rows}) {
    const ResultFolder folder(temporary / "sweep", "sweep", false, true);
    const Json table = sweep_runs(folder, ranges, nullptr, 2, {}, known);
    BOOST_TEST(table["status"] == "completed");
    for (const char* file : {"sweep.json", "sweep.csv"})
      BOOST_TEST(written(file) == read_text(temporary / "whole" / file), file);
  }
}

BOOST_AUTO_TEST_CASE(parts_of_a_sweep_make_the_whole) {
  const std::vector<ValueRange> ranges = {{"/system/parameters/k", {1, 2, 3, 4, 5, 6, 7}}};
  const TemporaryFolder temporary;
  const ResultFolder whole(temporary / "whole", "sweep", false);
  sweep_runs(whole, ranges);
  std::vector<Json> parts;
  for (const std::size_t k : {3u, 1u, 2u}) {
    const ResultFolder folder(temporary / std::to_string(k), "sweep", false);
    sweep_runs(folder, ranges, nullptr, 2, {k, 3});
    parts.push_back(ResultFolder::result_in(folder.path(), "sweep"));
  }
  BOOST_TEST(parts[1]["runs"].size() == 3u);
  const Json merged = merged_sweep(parts);
  Json expected = ResultFolder::result_in(whole.path(), "sweep");
  expected.erase("kind");
  BOOST_TEST(merged == expected);
  BOOST_TEST(sweep_csv(merged) == read_text(whole.file("csv")));
  const auto refused = [](std::vector<Json> of) {
    BOOST_CHECK_THROW(merged_sweep(of), std::invalid_argument);
  };
  refused({parts[0], parts[1]});
  refused({parts[0], parts[1], parts[1]});
  std::vector<Json> other = parts;
  other[0]["experiment"]["title"] = "another";
  refused(other);
  other = parts;
  other[2]["status"] = "interrupted";
  refused(other);
  BOOST_CHECK_THROW(Shard::read("5/4"), ExperimentError);
  BOOST_CHECK_THROW(Shard::read("0/4"), ExperimentError);
  BOOST_CHECK_THROW(Shard::read("2"), ExperimentError);
}

BOOST_AUTO_TEST_CASE(parameters_that_nothing_uses_are_not_swept) {
  BOOST_CHECK_THROW(
      sweep_cases(oscillator, std::vector<ValueRange>{{"/system/parameters/kk", {1, 2}}}),
      ExperimentError);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
