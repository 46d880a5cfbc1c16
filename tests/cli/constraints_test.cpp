#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <sstream>

#include "answer.hpp"
#include "courant/cli/command.hpp"
#include "courant/reading/findings.hpp"
#include "courant/tests/core/files/temporary_folder.hpp"
#include "courant/tests/core/says.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a right-hand side that is longer than a line stands on one (cli/text.cpp)
//  * the ladder of pairs is taken for that of Method 2
//  * runs begin with bounds of errors alone (running/consistent_start.hpp)
//  * a run does not tell of the choices of its start (running/other_values.cpp)
//  * branches are told on the screen and not on the page, or where there are none
BOOST_AUTO_TEST_SUITE(constraints_test)

namespace {

using test::Answer;
using test::courant_command;

Answer constraints(std::vector<std::string> arguments, const std::string& input = "") {
  arguments.insert(arguments.begin(), "constraints");
  return courant_command(arguments, input);
}

const std::string pendulum = "experiments/pendulum_cartesian.json";

}  // namespace

BOOST_AUTO_TEST_CASE(stops_at_a_level) {
  const Answer answer = constraints({pendulum, "--level", "1"});
  BOOST_TEST(answer.status == 0, answer.err);
  BOOST_TEST(says(answer.out, "Stopped at level 1, as asked."), answer.out);
  BOOST_TEST(says(answer.out, "x*v + y*w = 0"));
  BOOST_TEST(!says(answer.out, "tension = "));
  const Json json = Json::parse(constraints({pendulum, "--level", "0", "--json"}).out);
  BOOST_TEST(json.at("levels").size() == 1u);
  BOOST_TEST(constraints({pendulum, "--level", "-1"}).status == 2);
}

BOOST_AUTO_TEST_CASE(branches_are_listed_and_chosen) {
  const std::string martinet = "experiments/martinet_abnormal.json",
                    line = "experiments/martinet_singular_line.json";
  const Answer answer = constraints({martinet});
  BOOST_TEST(says(answer.out, "Branches: S is a union of 3"), answer.out);
  BOOST_TEST(says(answer.out, "1: y = 0 (gauge, (5,3), (4,3), 3 degrees of freedom"), answer.out);
  BOOST_TEST(says(answer.out, "2: p_z = 0 (gauge, (5,3), 3 degrees of freedom, 1 away)"),
             answer.out);
  BOOST_TEST(says(constraints({martinet, "--markdown"}).out, "## Branches"));
  BOOST_TEST(says(constraints({line}).out, "This is branch 1 of 3."));
  const Json json = Json::parse(constraints({line, "--json"}).out);
  BOOST_TEST_REQUIRE(json.at("branches").size() == 3u);
  BOOST_TEST(json.at("branches").at(0).at("chosen") == true);
  BOOST_TEST(json.at("branches").at(1).at("chosen") == false);
  const Answer refused = constraints({line, "--set", "/branch=7"});
  BOOST_TEST(refused.status == 2);
  BOOST_TEST(
      says(refused.err, "/branch: is 7, and there are 3 branches; expected a number from 1 to 3"),
      refused.err);
  BOOST_TEST(!says(constraints({pendulum}).out, "ranch"));
  BOOST_TEST(!Json::parse(constraints({pendulum, "--json"}).out).contains("branches"));
}

BOOST_AUTO_TEST_CASE(a_proof_is_told_in_words_and_json) {
  const Json json = Json::parse(constraints({pendulum, "--prove", "--json"}).out);
  const bool has_balls = json.at("proof").at("point").get<bool>();
  BOOST_TEST(json.at("proof").at("proved") == has_balls);
  const Answer answer = constraints({pendulum, "--prove"});
  BOOST_TEST(answer.status == 0, answer.err);
  BOOST_TEST(
      says(answer.out, has_balls ? "index and verdict are proved" : "Not proved. This build"),
      answer.out);
  BOOST_TEST(!Json::parse(constraints({pendulum, "--json"}).out).contains("proof"));
  if (!has_balls) return;
  BOOST_TEST(json.at("proof").at("not_zero") == 20);
  const Answer contradiction = constraints({"experiments/inconsistent_lagrangian.json", "--prove"});
  BOOST_TEST(says(contradiction.out, "Only ladders that are regular or gauge are proved"),
             contradiction.out);
}

// Remark 6.1: by the midpoint rule the ends of a step are free.
BOOST_AUTO_TEST_CASE(the_discrete_ladder) {
  const std::string experiment = R"json({
  "system": { "type": "implicit", "coordinates": ["x", "y", "v", "w"], "unknowns": ["T"],
    "equations": ["x' - v", "y' - w", "v' + T*x", "w' + T*y + 1", "x^2 + y^2 - 1"] },
  "initial": { "x": 0.6, "y": -0.8, "v": 0.8, "w": 0.6 },
  "method": { "type": "discretize-first", "discretization": "midpoint" },
  "time": { "step": 0.1, "end": 1 }
})json";
  const Answer answer = constraints({"-", "--discrete"}, experiment);
  BOOST_TEST(answer.status == 0, answer.err);
  BOOST_TEST(says(answer.out, "(dim S, dim M): (4, 4)"), answer.out);
  BOOST_TEST(says(answer.out, "without discretization: (4, 3) ⊇ (3, 2) ⊇ (2, 2)"));
  const Json json = Json::parse(constraints({"-", "--discrete", "--json"}, experiment).out);
  BOOST_TEST(json.at("degrees_of_freedom") == 4);

  // The pairs are those of the system, not the steps of Method 2, which keep the constraints.
  BOOST_TEST(!says(answer.out, "constrain-first"));
  const Answer second = constraints({"experiments/point_vortices.json", "--discrete"});
  BOOST_TEST(says(second.out, "(dim S, dim M): (16, 16)"), second.out);
  BOOST_TEST(says(second.out, "as those of discretize-first do"), second.out);

  const Answer without = constraints({"experiments/inconsistent_lagrangian.json", "--discrete"});
  BOOST_TEST(without.status == 2);
  BOOST_TEST(says(without.err, "/method: is missing"), without.err);
}

BOOST_AUTO_TEST_CASE(lines_fit_a_hundred_columns) {
  for (const char* name :
       {"point_vortices", "heavy_top_constrained", "heavy_top_so3", "inconsistent_lagrangian",
        "christ_lee", "spherical_vortices", "structure_pushforward",
        "structure_restricted_two_form",
        // Formulas whose factors are longer than a line, and a long manifold.
        "double_pendulum", "furuta_pendulum", "vertical_rolling_disk", "rolling_ball_turntable"}) {
    const Answer answer = constraints({std::string("experiments/") + name + ".json"});
    BOOST_TEST(answer.status == 0, answer.err);
    std::istringstream lines(answer.out);
    for (std::string line; std::getline(lines, line);) {
      const auto width =
          std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
      BOOST_TEST(width <= 100, name << ": " << line);
      BOOST_TEST(!says(line, "equation["), name << ": " << line);
      BOOST_TEST(!says(line, "z[0]"), name << ": " << line);
    }
  }
}

// One content in three notations, with formulas set and none of the signs of source text.
BOOST_AUTO_TEST_CASE(prints_documents) {
  const Answer latex = constraints({pendulum, "--latex"});
  BOOST_TEST(latex.status == 0, latex.err);
  BOOST_TEST(says(latex.out, "\\[ \\fitted{x\\,v + y\\,w = 0} \\]"), latex.out);
  BOOST_TEST(says(latex.out, "S_{0} & \\supseteq & S_{1}"), latex.out);
  BOOST_TEST(!says(latex.out, "x*v"));
  const Answer markdown = constraints({pendulum, "--markdown"});
  BOOST_TEST(says(markdown.out, "$$x\\,v + y\\,w = 0$$"), markdown.out);
  BOOST_TEST(constraints({pendulum, "--latex", "--json"}).status == 2);
}

BOOST_AUTO_TEST_CASE(writes_a_page) {
  const TemporaryFolder folder;
  const std::string page = (folder.path() / "page.html").string();
  const Answer answer = constraints({pendulum, "-o", page});
  BOOST_TEST(answer.status == 0, answer.err);
  const std::string html = read_text(page);
  BOOST_TEST(says(html, "<math displaystyle=\"true\">"), html);
  BOOST_TEST(says(html, "<mover accent=\"true\">"));
  BOOST_TEST(!says(html, "<script"));
  const Answer wrong = constraints({pendulum, "-o", (folder.path() / "page.pdf").string()});
  BOOST_TEST(wrong.status == 2);
  BOOST_TEST(says(wrong.err, "expected a name that ends in .html, .tex or .md"), wrong.err);
}

// Without a run: gauge and inconsistent systems, and what has brackets, have pages too.
BOOST_AUTO_TEST_CASE(pages_of_all_verdicts) {
  for (const std::string name : {"christ_lee", "inconsistent_lagrangian", "point_vortices"}) {
    const Answer answer = constraints({"experiments/" + name + ".json", "--latex"});
    BOOST_TEST(answer.status == 0, name << answer.err);
    BOOST_TEST(says(answer.out, "\\end{document}"), name);
  }
  BOOST_TEST(says(constraints({"experiments/point_vortices.json", "--latex"}).out, "pmatrix"));
}

// Where bounds of errors alone would say something else: equations that agree at an instant only, a set without points, and
// switches at their edge; and an unknown that has another value as well.
BOOST_AUTO_TEST_CASE(a_run_says_the_same) {
  const auto implicit = [](const Json& coordinates, const Json& equations, const Json& initial) {
    return Json{
        {"system", {{"type", "implicit"}, {"coordinates", coordinates}, {"equations", equations}}},
        {"initial", initial}};
  };
  Json on_circle = implicit({"x"}, {"x' - 1", "x^2 + y^2 - 1"}, {{"x", 0.6}});
  on_circle["system"]["unknowns"] = {"y"};
  const std::vector<std::pair<Json, std::string>> systems = {
      {implicit({"x", "y"}, {"x' - y", "y' + x", "x - t"}, {{"x", 0}, {"y", 1}}), "inconsistent"},
      {{{"system",
         {{"type", "mechanical"},
          {"coordinates", {"x", "y", "z"}},
          {"metric", 1},
          {"potential", "z"},
          {"holonomic", {"x^2 + y^2 + z^2 + 1"}}}},
        {"initial", {{"x", 0}, {"y", 0}, {"z", 0}, {"p_x", 0}, {"p_y", 0}, {"p_z", 0}}}},
       "inconsistent"},
      {implicit({"x", "v"}, {"x' - v", "v' + sign(v) - 0.5"}, {{"x", 0}, {"v", 0}}), "doubted"},
      {implicit({"x", "y"}, {"x' - 1", "y - max(x, 0)"}, {{"x", 0}}), "doubted"},
      {on_circle, "regular"}};
  for (const auto& [document, expected] : systems) {
    const TemporaryFolder folder;
    Json shown = Json::parse(constraints({"-", "--json"}, document.dump()).out);
    shown.erase("brackets");
    const Answer run =
        courant_command({"run", "-", "-o", (folder / "run").string(), "--quiet"}, document.dump());
    const Json told = Json::parse(read_text(folder / "run/summary.json")).at("ladder");
    BOOST_TEST(told == shown, told.dump() << "\n" << shown.dump() << "\n" << run.err);
    BOOST_TEST((told.at("ambiguous") == true ? "doubted" : told.at("verdict")) == expected,
               told.dump());
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
