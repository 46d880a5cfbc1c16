#include "courant/running/ensemble_run.hpp"

#include <algorithm>
#include <bit>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "../core/files/temporary_folder.hpp"
#include "courant/reading/setting.hpp"
#include "courant/running/ensemble_folder.hpp"
#include "courant/running/run_in_memory.hpp"
#include "courant/tests/core/says.hpp"
#include "problems.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * members get each other's values (reading/ensemble.cpp)
//  * members are written in the order in which they end (running/ensemble_run.cpp)
//  * a member goes on from what another one's steps left
//  * what was done before an interrupt is not among the statistics (running/ensemble_folder.cpp)
//  * a member that was damaged on the disk is kept (running/ensemble_folder.cpp)
//  * members that failed are among the statistics (running/ensemble_statistics.cpp)
//  * an expectation passes though one member does not keep it (running/ensemble_run.cpp)
BOOST_AUTO_TEST_SUITE(ensemble_run_test)

namespace {

using test::experiment_file;

const Json oscillator = Json::parse(R"json({
  "system": { "type": "hamiltonian", "coordinates": ["q"], "parameters": { "k": 1 },
              "hamiltonian": "(p_q^2 + k*q^2)/2" },
  "initial": { "q": 1, "p_q": 0 },
  "method": { "type": "discretize-first" },
  "time": { "step": 0.1, "end": 1 }
})json");

// The square root is not defined for q < 0: starts below 0 are none.
const Json root = Json::parse(R"json({
  "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "p_q^2/2 + sqrt(q)" },
  "initial": { "q": 1, "p_q": 0 },
  "method": { "type": "discretize-first" },
  "time": { "step": 0.1, "end": 1 }
})json");

Json with(Json document, const Json& ensemble) {
  document["ensemble"] = ensemble;
  return document;
}

EnsembleInMemory ensemble_of(const Json& document, unsigned threads = 2) {
  return run_ensemble_in_memory(read_experiment_document(document),
                                {.backend = Backend::interpreter, .threads = threads});
}

// A file of the catalogue, with so many steps.
Json brief(const std::string& name, double end, bool is_npy = true) {
  Json document = experiment_file(name);
  document.erase("expect");
  document.erase("output");
  if (document["time"]["step"].is_string()) document["time"]["step"] = 0.05;
  document["time"]["end"] = end;
  if (is_npy) document["output"] = {{"every", 2}};
  return document;
}

// Values of a member by the names of an ensemble, and where a user would set them.
struct Varied {
  std::string name, pointer;
  std::vector<double> values;
};

// Members are, to the bit, the runs of the document with their values set; those of any number of threads.
void check_law(const std::string& title, const Json& document, const std::vector<Varied>& varied) {
  BOOST_TEST_CONTEXT(title) {
    Json values = Json::object();
    for (const Varied& one : varied) values[one.name] = one.values;
    const EnsembleInMemory all = ensemble_of(with(document, {{"values", values}}));
    const auto size = static_cast<std::size_t>(all.opening.numbers_of_member());
    const std::size_t members = varied.front().values.size();
    BOOST_REQUIRE(all.values.size() == members * size);
    BOOST_TEST((all.outcome.status == RunStatus::completed), all.outcome.message);
    for (std::size_t i = 0; i < members; ++i) {
      Json alone = document;
      for (const Varied& one : varied) apply_setting({one.pointer, one.values[i]}, alone);
      RunInMemoryOptions options;
      options.run.backend = Backend::interpreter;
      const RunInMemory run = run_in_memory(read_experiment_document(alone), options);
      BOOST_TEST(run.rows.names == all.opening.columns);
      BOOST_REQUIRE(run.rows.values.size() == size);
      std::size_t different = 0;
      for (std::size_t k = 0; k < size; ++k)
        different += std::bit_cast<std::uint64_t>(run.rows.values[k]) !=
                     std::bit_cast<std::uint64_t>(all.values[i * size + k]);
      BOOST_TEST(different == 0u, "member " << i);
    }
    // Members differ: the comparison is of something.
    BOOST_TEST(!std::equal(all.values.begin(), all.values.begin() + static_cast<long>(size),
                           all.values.begin() + static_cast<long>(size)));
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_member_has_the_bits_of_its_own_run) {
  const std::vector<double> three = {-1.0, -1.05, -0.9};
  check_law("vortices, Method 2", brief("point_vortices", 30),
            {{"x[0]", "/initial/x/0", three}, {"y[3]", "/initial/y/3", {-2, -2.125, -1.9}}});
  check_law("vortices, Method 1 started by rk2", brief("point_vortices_method1", 30),
            {{"x[0]", "/initial/x/0", three}});
  check_law("vortices, rk2", brief("point_vortices_rk2", 30), {{"x[0]", "/initial/x/0", three}});
  check_law("Cartesian pendulum, Method 2", brief("pendulum_cartesian", 0.50098517561),
            {{"x", "/initial/x", {std::sin(1.0), std::sin(0.5)}},
             {"y", "/initial/y", {-std::cos(1.0), -std::cos(0.5)}}});
  check_law("sphere", brief("spherical_pendulum", 0.116049607),
            {{"p_x[2]", "/initial/p_x/2", {0.0, 0.1}}});
  check_law(
      "RATTLE of order 8, with parameters", brief("pendulum_rattle", 1),
      {{"g", "/system/parameters/g", {9.81, 1.62}}, {"l", "/system/parameters/l", {1.5, 0.7}}});
  check_law("nonholonomic, order 8", brief("nonholonomic_order_8", 2),
            {{"p_x", "/initial/p_x", {1, 1.25, 0.5}}});
  check_law("Verlet of order 8", brief("kepler_verlet_order_8", 2),
            {{"y", "/initial/y", {0.0, 0.01}}, {"m", "/system/parameters/m", {1.7, 1.5}}});
  check_law("composition, with parameters", brief("duffing", 5),
            {{"a", "/system/parameters/a", {0.9, 1.1}}, {"q", "/initial/q", {1.4, 1.3}}});
  check_law("an element of a parameter", brief("heavy_top_so3", 0.05),
            {{"w[2]", "/system/parameters/w/2", {1.0, 0.8}}});
}

BOOST_AUTO_TEST_CASE(members_do_not_depend_on_threads_nor_on_how_many_they_are) {
  const auto members = [&](int count) {
    return with(oscillator, {{"members", count},
                             {"seed", 3},
                             {"random", {{"g", "normal"}, {"u", "uniform"}}},
                             {"values", {{"q", "1 + 0.1*g"}, {"k", "1 + u + i/10"}}}});
  };
  const EnsembleInMemory one = ensemble_of(members(40), 1), two = ensemble_of(members(40), 3);
  BOOST_TEST(one.values == two.values);
  BOOST_TEST(one.outcome.summary["statistics"] == two.outcome.summary["statistics"]);
  const EnsembleInMemory few = ensemble_of(members(7));
  BOOST_TEST(std::equal(few.values.begin(), few.values.end(), one.values.begin()));
}

// By the midpoint rule q turns by 2 atan(w h/2) a step; of three members all numbers are known.
BOOST_AUTO_TEST_CASE(statistics_are_those_of_closed_forms) {
  Json document = with(oscillator, {{"values", {{"k", {1, 4, 9}}}}});
  document["expect"] = {
      {{"mean", {{"H", "14/6"}}}, {"tolerance", 1e-13}},
      {{"standard_deviation", {{"H", "sqrt(49/12)"}}}, {"at", 0.5}, {"tolerance", 1e-13}},
      {{"mean", {{"q", 1}}}, {"at", 0}, {"tolerance", 1e-15}},
      {{"observable", "H"}, {"max_drift", 1e-13}}};
  const EnsembleInMemory all = ensemble_of(document);
  double sum = 0.0, least = 2.0;
  for (const double w : {1.0, 2.0, 3.0}) {
    const double q = std::cos(20.0 * std::atan(0.05 * w));
    sum += q;
    least = std::min(least, q);
  }
  const Json& q = all.outcome.summary["statistics"]["q"];
  BOOST_TEST(std::abs(q["mean"].get<double>() - sum / 3.0) < 1e-13);
  BOOST_TEST(std::abs(q["min"].get<double>() - least) < 1e-13);
  const Json& quantiles = all.outcome.summary["statistics"]["H"]["quantiles"];
  BOOST_TEST(std::abs(quantiles["0.5"].get<double>() - 2.0) < 1e-13);
  BOOST_TEST(std::abs(quantiles["0.25"].get<double>() - 1.25) < 1e-13);
  BOOST_TEST(all.outcome.expectations.size() == 4u);
  for (const ExpectationResult& one : all.outcome.expectations)
    BOOST_TEST(one.passed, one.description << " " << one.finding);
  BOOST_TEST(all.outcome.summary["members"] == 3);
}

BOOST_AUTO_TEST_CASE(what_is_expected_must_be_true_of_every_member_and_of_the_mean) {
  Json document = with(oscillator, {{"values", {{"q", {1, 2, 3}}}}});
  document["expect"] = {{{"observable", "q"}, {"max", 2.5}},
                        {{"mean", {{"q", 2.5}}}, {"at", 0}, {"tolerance", 0.1}},
                        {{"mean", {{"q", 2}}}, {"at", 0.55}, {"tolerance", 10}}};
  const auto results = [&](Json wanted) {
    wanted["expect"].erase(2);
    return ensemble_of(wanted).outcome.expectations;
  }(document);
  BOOST_REQUIRE(results.size() == 2u);
  BOOST_TEST(!results[0].passed);
  BOOST_TEST(says(results[0].finding, "member 2 is 3"), results[0].finding);
  BOOST_TEST(!results[1].passed);
  BOOST_TEST(says(results[1].finding, "is 2, off by 0.5"), results[1].finding);
  // There is no row at such a time.
  BOOST_TEST(!ensemble_of(document).outcome.expectations[2].passed);
}

BOOST_AUTO_TEST_CASE(members_that_cannot_be_run_are_named_and_stop_no_other_one) {
  const EnsembleInMemory all = ensemble_of(with(root, {{"values", {{"q", {1, -1, 2, -3}}}}}));
  BOOST_TEST((all.outcome.status == RunStatus::failed));
  BOOST_TEST(all.outcome.message == "2 of 4 members did not complete.");
  BOOST_REQUIRE(all.outcome.problems.size() == 2u);
  BOOST_TEST(says(all.outcome.problems[0], "member 1: "), all.outcome.problems[0]);
  BOOST_TEST(says(all.outcome.problems[1], "member 3: "), all.outcome.problems[1]);
  const auto size = static_cast<std::size_t>(all.opening.numbers_of_member());
  BOOST_TEST(all.values.size() == 4 * size);
  BOOST_TEST(std::isnan(all.values[size]));
  BOOST_TEST(!std::isnan(all.values[2 * size]));
  BOOST_TEST(all.outcome.summary["completed"] == 2);
  BOOST_TEST(std::isfinite(all.outcome.summary["statistics"]["q"]["mean"].get<double>()));
  BOOST_CHECK_EXCEPTION(
      ensemble_of(with(root, {{"values", {{"q", {-1, -2}}}}})), ExperimentError,
      [](const ExperimentError& error) { return says(error.what(), "member 0: "); });
}

// The rod of length 0 has another ladder than rods that have one.
BOOST_AUTO_TEST_CASE(a_start_with_another_ladder_is_named) {
  const Json product = Json::parse(R"json({
    "system": { "type": "implicit", "coordinates": ["x", "y"], "parameters": { "c": 1 },
                "equations": ["x' + x", "c*(y - x)"] },
    "initial": { "x": 1, "y": 1 }, "method": "constrain-first", "time": { "step": 0.1, "end": 1 }
  })json");
  const EnsembleInMemory all = ensemble_of(with(product, {{"values", {{"c", {1, 2, 0}}}}}));
  BOOST_REQUIRE(all.outcome.problems.size() == 1u);
  BOOST_TEST(says(all.outcome.problems[0], "member 2: "), all.outcome.problems[0]);
}

namespace {

constexpr Index kAll = 1'000'000;

// Stops after so many members. On one thread then: while one of two waits for the first member, the other may make all.
EnsembleOutcome run_in_folder(const TemporaryFolder& folder, const Json& document,
                              ExistingRun existing, Index most = kAll) {
  std::atomic<bool> stop = false;
  EnsembleFolder keeper(folder / "ensemble", existing);
  EnsembleOptions options{
      .backend = Backend::interpreter, .threads = most < kAll ? 1U : 2U, .stop = &stop};
  options.on_progress = [&](Index done, Index) { stop = done >= most; };
  return run_ensemble(read_experiment_document(document), keeper, options);
}

Json without_times(const std::filesystem::path& file) {
  Json summary = Json::parse(read_text(file));
  for (const char* key : {"id", "wall_seconds", "cpu_seconds", "member_steps_per_cpu_second"})
    summary.erase(key);
  return summary;
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_was_interrupted_goes_on_with_the_same_bytes) {
  Json document =
      with(oscillator,
           {{"members", 30}, {"seed", 1}, {"random", {{"g", "normal"}}}, {"values", {{"q", "g"}}}});
  document["expect"] = {{{"observable", "H"}, {"max_drift", 1e-12}},
                        {{"mean", {{"q", 0}}}, {"at", 0}, {"tolerance", 1}}};
  document["events"] = {{"down", {{"zero", "q"}, {"direction", "falling"}}}};
  const TemporaryFolder whole, parts;
  BOOST_TEST((run_in_folder(whole, document, ExistingRun::refuse).status == RunStatus::completed));
  const EnsembleOutcome first = run_in_folder(parts, document, ExistingRun::refuse, 4);
  BOOST_TEST((first.status == RunStatus::interrupted), first.message);
  const Json between = Json::parse(read_text(parts / "ensemble/summary.json"));
  const int done = between["done"].get<int>();
  BOOST_TEST(done >= 4);
  BOOST_TEST(done < 30);
  BOOST_TEST(says(read_text(parts / "ensemble/ensemble.npy"),
                  "'shape': (" + std::to_string(done) + ", 11, 4)"));
  run_in_folder(parts, document, ExistingRun::resume, 17);
  BOOST_TEST((run_in_folder(parts, document, ExistingRun::resume).status == RunStatus::completed));
  for (const char* file :
       {"ensemble.npy", "columns.json", "members.jsonl", "events.csv", "statistics.csv"})
    BOOST_TEST(read_text(whole / (std::string("ensemble/") + file)) ==
                   read_text(parts / (std::string("ensemble/") + file)),
               file);
  BOOST_TEST(without_times(whole / "ensemble/summary.json") ==
             without_times(parts / "ensemble/summary.json"));
  BOOST_CHECK_EXCEPTION(
      run_in_folder(parts, document, ExistingRun::resume), UnusableFolder,
      [](const UnusableFolder& error) { return says(error.what(), "the run is complete"); });
  BOOST_CHECK_THROW(run_in_folder(parts, document, ExistingRun::refuse), UnusableFolder);
  run_in_folder(parts, document, ExistingRun::replace);
}

BOOST_AUTO_TEST_CASE(what_a_kill_left_goes_on_and_damage_is_refused) {
  const Json document = with(oscillator, {{"members", 12}, {"values", {{"q", "1 + i"}}}});
  const TemporaryFolder whole, parts;
  run_in_folder(whole, document, ExistingRun::refuse);
  const auto expected = read_text(whole / "ensemble/ensemble.npy");
  run_in_folder(parts, document, ExistingRun::refuse, 5);
  // A line that is cut off, and numbers without a line.
  const auto lines = parts / "ensemble/members.jsonl", numbers = parts / "ensemble/ensemble.npy";
  std::string text = read_text(lines);
  text.resize(text.size() - 7);
  std::ofstream(lines) << text;
  std::ofstream(numbers, std::ios::app) << "12345";
  run_in_folder(parts, document, ExistingRun::resume);
  BOOST_TEST((read_text(numbers) == expected));

  const TemporaryFolder damaged;
  run_in_folder(damaged, document, ExistingRun::refuse, 5);
  std::string bytes = read_text(damaged / "ensemble/ensemble.npy");
  bytes[128 + 11 * 4 * 8 + 100] ^= 1;  // of member 1
  std::ofstream(damaged / "ensemble/ensemble.npy") << bytes;
  BOOST_CHECK_EXCEPTION(
      run_in_folder(damaged, document, ExistingRun::resume), UnusableFolder,
      [](const UnusableFolder& error) { return says(error.what(), "member 1 is not as"); });
}

BOOST_AUTO_TEST_CASE(what_would_take_too_much_room_is_refused_before_anything_is_written) {
  Json document = with(oscillator, {{"members", 100'000}, {"values", {{"q", "1 + i"}}}});
  document["time"]["end"] = 1000;
  const TemporaryFolder folder;
  BOOST_CHECK_EXCEPTION(run_in_folder(folder, document, ExistingRun::refuse), ExperimentError,
                        [](const ExperimentError& error) {
                          return says(error.what(),
                                      "/ensemble: has 100000 members × 10001 rows × 4 columns = "
                                      "4e+09 numbers; expected at most 2e+09");
                        });
  BOOST_TEST(!std::filesystem::exists(folder / "ensemble"));
}

BOOST_AUTO_TEST_CASE(one_run_is_no_ensemble) {
  BOOST_CHECK_THROW(run_in_memory(read_experiment_document(
                        with(oscillator, {{"members", 2}, {"values", Json::object()}}))),
                    ExperimentError);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
