#include "courant/reading/table.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <fstream>
#include <memory>
#include <sstream>

#include "experiment_problems.hpp"

BOOST_AUTO_TEST_SUITE(table_test)

using namespace courant;

namespace {

// x' = -x + wind at a port, and wind in an observable.
Json blown(const Json& tables) {
  return {{"system",
           {{"type", "port-hamiltonian"},
            {"tables", tables},
            {"coordinates", {"x"}},
            {"J", Json::array({{0}})},
            {"R", Json::array({{1}})},
            {"B", Json::array({1})},
            {"hamiltonian", "x^2/2"},
            {"ports", "open"},
            {"inputs", {"2*wind"}}}},
          {"initial", {{"x", 1}}},
          {"method", "discretize-first"},
          {"time", {{"step", 0.1}, {"end", 1}}},
          {"observe", {{"gust", "wind^2"}}}};
}

const Json kWind = {{"wind", {{"times", {0, 1, 3}}, {"values", {2, 5, 4}}}}};

class File {
 public:
  explicit File(const std::string& text) { std::ofstream(path()) << text; }
  ~File() { std::filesystem::remove(path()); }
  static std::filesystem::path folder() { return std::filesystem::temp_directory_path(); }
  static std::filesystem::path path() { return folder() / "courant_table_test.csv"; }
};

// What load_tables says of a table.
std::string refusal(const std::string& text, Json table = Json::object()) {
  const File file(text);
  table["file"] = File::path().filename().string();
  Json document = {{"system", {{"tables", {{"wind", table}}}}}};
  try {
    load_tables(document, File::folder());
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

// At t = 0.5 the wind is 3.5 between 2 and 5: x' = -x + 7.
BOOST_AUTO_TEST_CASE(words_of_inputs_and_observables) {
  const Experiment experiment = read_experiment(blown(kWind).dump());
  const ImplicitSystem& system = *experiment.model.system;
  const VectorXd x = VectorXd{{1.5}}, u = VectorXd{{7.0}}, v = VectorXd{{5.5}};
  BOOST_TEST(system.residual(x, v, u, 0.5).norm() < 1e-14);
  BOOST_TEST(system.residual(x, v, u, 0.6).norm() > 0.1);
  Json steps = kWind;
  steps["wind"]["interpolation"] = "steps";
  const Experiment held = read_experiment(blown(steps).dump());
  BOOST_TEST(held.model.system->residual(x, VectorXd{{2.5}}, VectorXd{{4.0}}, 0.9).norm() < 1e-14);
}

BOOST_AUTO_TEST_CASE(wrong_tables) {
  const auto problem = [](const Json& change) {
    Json tables = kWind;
    tables["wind"].merge_patch(change);
    return problems(blown(tables));
  };
  BOOST_TEST(problem(Json::object()) == "");
  const auto begins = [](const std::string& text, const std::string& with) {
    BOOST_TEST(text.find(with) == 0u, text);
  };
  begins(problem({{"times", {0, 1}}}),
         "/system/tables/wind/values: has 3 numbers for 2 times; expected as many");
  begins(problem({{"times", {0, 1, 1}}}),
         "/system/tables/wind/times: has no greater number after that at 1; expected increasing");
  begins(problem({{"times", {0, "x", 1}}}), "/system/tables/wind/times/1: ");
  begins(problem({{"interpolation", "quintic"}}), "/system/tables/wind/interpolation: ");
  begins(problem({{"file", "wind.csv"}}), "/system/tables/wind: is in a file");
  begins(problem({{"value", 3}}), "/system/tables/wind/value: ");
  Json taken = blown(kWind);
  taken["system"]["parameters"] = {{"wind", 3}};
  begins(problems(taken), "/system/tables/wind: key, ");
}

BOOST_AUTO_TEST_CASE(files) {
  const File file("t, speed ,other\r\n0,2,7\n1, 5,8\n\n3,4,9\n");
  Json document = blown({{"wind", {{"file", File::path().filename().string()}}},
                         {"other",
                          {{"file", File::path().filename().string()},
                           {"column", "other"},
                           {"time", "speed"},
                           {"interpolation", "cubic"}}}});
  load_tables(document, File::folder());
  BOOST_TEST((document["system"]["tables"]["wind"].dump() ==
              R"({"times":[0.0,1.0,3.0],"values":[2.0,5.0,4.0]})"));
  BOOST_TEST(document["system"]["tables"]["other"].dump() ==
             R"({"times":[2.0,5.0,4.0],"values":[7.0,8.0,9.0],"interpolation":"cubic"})");
}

BOOST_AUTO_TEST_CASE(wrong_files) {
  const auto says = [](const std::string& text, const std::string& expected) {
    BOOST_TEST(text.find("/system/tables/wind: ") == 0u, text);
    BOOST_TEST(text.find(expected) != std::string::npos, text);
  };
  says(refusal("t,speed\n0,2\n1\n"), "courant_table_test.csv:3 has 1 cells; expected 2");
  says(refusal("t,speed\n0,fast\n"), "courant_table_test.csv:2 has \"fast\"; expected a number");
  says(refusal("t,speed\n0,2\n", {{"column", "sped"}}),
       "has no column \"sped\" (did you mean \"speed\"?)");
  says(refusal("t\n0\n"), "has one column");
  says(refusal(""), "is empty");
  Json missing = {{"system", {{"tables", {{"wind", {{"file", "no_such_file.csv"}}}}}}}};
  BOOST_CHECK_EXCEPTION(
      load_tables(missing, File::folder()), ExperimentError, [](const ExperimentError& error) {
        return std::string(error.what()).find("cannot be read") != std::string::npos;
      });
}

// Files need not be on a disk. Where there is none of a name, that is said at the key that names it.
BOOST_AUTO_TEST_CASE(files_that_are_handed_over) {
  const OpenTable open = [](const std::string& pointer, const std::string& file) {
    if (file == "away.csv") throw ExperimentError(pointer, "is away");
    TableFile found{"the file " + file, nullptr};
    if (file != "none.csv")
      found.bytes = std::make_unique<std::istringstream>("t,speed\n0,2\n1,5\n");
    return found;
  };
  Json document = blown({{"wind", {{"file", "wind.csv"}}}});
  document["ensemble"] = {{"table", "starts.csv"}};
  load_tables(document, open);
  BOOST_TEST(document["system"]["tables"]["wind"].dump() ==
             R"({"times":[0.0,1.0],"values":[2.0,5.0]})");
  BOOST_TEST(document["ensemble"].dump() == R"({"values":{"t":[0.0,1.0],"speed":[2.0,5.0]}})");
  const auto refused = [&](const char* file) {
    Json one = blown({{"wind", {{"file", file}}}});
    try {
      load_tables(one, open);
    } catch (const ExperimentError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  BOOST_TEST(refused("none.csv").starts_with("/system/tables/wind: the file none.csv cannot be"));
  BOOST_TEST(refused("away.csv") == "/system/tables/wind/file: is away");
}

BOOST_AUTO_TEST_SUITE_END()
