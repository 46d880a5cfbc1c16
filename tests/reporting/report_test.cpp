#include "courant/reporting/report.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <fstream>
#include <iterator>

#include "../plotting/parsed_markup.hpp"
#include "courant/core/files/output_file.hpp"
#include "courant/reporting/report_script.hpp"
#include "some_runs.hpp"

// Mistakes that these cases have to notice:
//  * pages of long runs have few rows
//  * the rest of the page is not counted
//  * the table of one run names it in each row (reporting/report_tables.cpp)
BOOST_AUTO_TEST_SUITE(report)

using namespace courant;
using namespace courant::test;

namespace {

// The three methods of Section 6.3 in a folder.
std::vector<std::filesystem::path> write_methods(const TemporaryFolder& folder, int steps) {
  std::vector<std::filesystem::path> runs = {folder / "rk2", folder / "method-1",
                                             folder / "method-2"};
  write_run(runs[0], rk2_path(steps), "rk2");
  write_run(runs[1], two_step_path(steps), "discretize-first");
  write_run(runs[2], one_step_path(steps), "constrain-first");
  return runs;
}

std::vector<Run> read(const std::vector<std::filesystem::path>& folders) {
  std::vector<Run> runs;
  for (const auto& folder : folders) runs.push_back(read_run(folder));
  return runs;
}

// The page as XML, which it is after its document type.
Tree parsed_page(const std::string& page) { return parsed(page.substr(page.find('\n'))); }

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

BOOST_AUTO_TEST_CASE(page_of_the_three_methods_has_its_figures_and_tables) {
  const TemporaryFolder folder;
  const Tree page = parsed_page(report_html(read(write_methods(folder, 300))));
  BOOST_TEST(page.get<std::string>("html.head.title") == "Point vortices: two leapfrogging pairs");
  // Trajectories of four vortices by three methods, H - H(0) by three, the spread by three.
  BOOST_TEST(find(page, "g", "series").size() == 12 + 3 + 3);
  BOOST_TEST(find(page, "g", "ladder").size() == 1);
  std::vector<std::string> captions;
  for (const Tree& table : find(page, "table"))
    captions.push_back(table.get<std::string>("caption"));
  BOOST_CHECK(captions ==
              (std::vector<std::string>{"Levels", "What failed", "Expectations that passed",
                                        "Observables", "Runs and solver statistics"}));
  std::vector<std::string> results;
  for (const std::string style : {"good", "bad"}) {
    for (const Tree& cell : find(page, "td", style)) results.push_back(cell.data());
  }
  BOOST_CHECK(results == (std::vector<std::string>{"✓ passed", "✓ passed", "completed", "completed",
                                                   "completed", "✗ failed"}));
  // The experiments, and the expectations that passed.
  BOOST_TEST(find(page, "details").size() == 4);
  const std::string text = report_html(read(write_methods(folder, 300)));
  BOOST_TEST(text.find("<span class=\"bad\">2 of 3</span> expectations passed.") !=
             std::string::npos);
  for (const Tree& drawing : find(page, "svg")) {
    const bool said = !drawing.get<std::string>("title", "").empty() &&
                      !drawing.get<std::string>("desc", "").empty();
    BOOST_TEST((said || attribute(drawing, "aria-hidden") == "true"));
  }
}

// The column that says which run a row is of is there where there are several.
BOOST_AUTO_TEST_CASE(tables_of_one_run_do_not_name_it) {
  const TemporaryFolder folder;
  const std::vector<Run> runs = read(write_methods(folder, 300));
  const auto heads_of = [](std::span<const Run> some) {
    std::vector<std::string> heads;
    for (const Tree& table : find(parsed_page(report_html(some)), "table"))
      if (table.get<std::string>("caption") == "Observables")
        for (const Tree& head : find(table, "th"))
          if (attribute(head, "scope") == "col") heads.push_back(head.data());
    return heads;
  };
  BOOST_TEST(heads_of(std::span(runs).first(1)) ==
                 (std::vector<std::string>{"Observable", "Initial", "Final", "Least", "Greatest",
                                           "Greatest drift"}),
             boost::test_tools::per_element());
  BOOST_REQUIRE_EQUAL(heads_of(runs).size(), 7U);
  BOOST_TEST(heads_of(runs)[1] == "Run");
}

BOOST_AUTO_TEST_CASE(page_of_long_runs_is_small) {
  const TemporaryFolder folder;
  const std::string page = report_html(read(write_methods(folder, 30'000)));
  BOOST_TEST(page.size() < 1'000'000);
  // The energy again without RK2: its beginning, and the whole.
  BOOST_TEST(find(parsed_page(page), "g", "series").size() == 12 + 3 + 2 + 2 + 3);
}

BOOST_AUTO_TEST_CASE(pages_of_many_curves_stay_below_a_megabyte) {
  Texts names = {"t"};
  for (int i = 0; i < 60; ++i) names.push_back("a" + std::to_string(i));
  const Run run = table(names, 100'000, [](std::size_t c, double t) {
    return std::sin(t * static_cast<double>(c + 1)) + 1e-3 * std::fmod(1e5 * t, 1.0);
  });
  const std::string page = report_html(std::vector<Run>{run, run, run, run, run, run, run, run});
  BOOST_TEST(page.size() < 1'000'000);
  BOOST_TEST(find(parsed_page(page), "g", "series").size() == 12 * 8);
}

BOOST_AUTO_TEST_CASE(pages_of_long_runs_are_full_of_rows) {
  const Run run = table({"t", "q", "p", "H"}, 200'000, [](std::size_t c, double t) {
    return c == 1 ? std::sin(t) : c == 2 ? std::cos(t) : 1 + 1e-3 * std::sin(3 * t);
  });
  const std::string page = report_html(std::vector<Run>{run});
  BOOST_TEST(page.size() < 1'000'000);
  BOOST_TEST(page.size() > 900'000);
  std::size_t thinned = 0;
  for (const Tree& series : find(parsed_page(page), "g", "series")) {
    if (attribute(series, "data-stretches") == "0") continue;
    ++thinned;
    // 640 pixels have twenty pieces each, at least.
    BOOST_TEST(std::stoi(attribute(series, "data-stretches")) > 20 * 640);
    BOOST_TEST(attribute(series, "data-rows") == "200000");
  }
  BOOST_TEST(thinned == 4);
}

BOOST_AUTO_TEST_CASE(pages_of_rough_paths_stay_below_a_megabyte) {
  const Run run = table({"t", "q", "p", "H"}, 100'000, [](std::size_t c, double t) {
    return c == 1 ? std::sin(1e-3 * t) + 0.1 * std::sin(50 * t) : std::cos(2e-3 * t);
  });
  BOOST_TEST(report_html(std::vector<Run>{run}).size() < 1'000'000);
}

BOOST_AUTO_TEST_CASE(numbers_of_all_rows_go_along_where_they_are_few) {
  const TemporaryFolder folder;
  const Tree page = parsed_page(report_html(read(write_methods(folder, 300))));
  for (const Tree& series : find(page, "g", "series")) {
    BOOST_TEST(attribute(series, "data-rows") == "301");
    BOOST_TEST(attribute(series, "data-y").size() == (4 * 301 + 2) / 3 * 4);
  }
}

BOOST_AUTO_TEST_CASE(page_needs_nothing_else) {
  const TemporaryFolder folder;
  std::string page = report_html(read(write_methods(folder, 20)));
  // The script is the program's own, and names nothing outside either.
  const std::string script = plot::script(report_script()).str();
  const std::size_t begin = page.find(script);
  BOOST_TEST_REQUIRE(begin != std::string::npos);
  page.replace(begin, script.size(), report_script());
  for (const std::string name : {"http://www.w3.org/2000/svg", "http://www.w3.org/1999/xhtml"}) {
    for (std::size_t at; (at = page.find(name)) != std::string::npos;) page.erase(at, name.size());
  }
  for (const char* outside : {"http", "src=", "href", "url(", "@import", "<script", "<link"}) {
    BOOST_TEST(page.find(outside) == std::string::npos, outside);
  }
}

BOOST_AUTO_TEST_CASE(nothing_in_the_files_becomes_markup) {
  const std::string evil =
      "</text></svg><script>alert(1)</script><img src='x' onerror=\"alert(2)\"/>&";
  const TemporaryFolder folder;
  const auto run = folder / "<script>alert(0)<";
  const Path path = rk2_path(20);
  nlohmann::ordered_json told = summary(path, evil);
  for (const char* key : {"message", "system", "backend"}) told[key] = evil;
  told["observables"][evil] = told["observables"]["H"];
  told["expectations"][0]["description"] = evil;
  told["expectations"][0]["value"] = evil;
  std::string columns = csv(path);
  columns.replace(columns.find("spread"), 6, evil);
  write_text(run / "trajectory.csv", columns);
  write_text(run / "summary.json", told.dump());
  write_text(run / "experiment.json", nlohmann::ordered_json{{"title", evil}, {evil, evil}}.dump());
  const std::string text = report_html(std::vector<Run>{read_run(run)});
  const Tree page = parsed_page(text);
  BOOST_TEST(find(page, "script").size() == 1);
  BOOST_TEST(find(page, "img").empty());
  // The only one is the program's own.
  BOOST_TEST(text.find("<script") == text.find(plot::script(report_script()).str()));
  BOOST_TEST(text.find("<script") == text.rfind("<script"));
  BOOST_TEST(text.find("<img") == std::string::npos);
  BOOST_TEST(page.get<std::string>("html.head.title") == evil);
  BOOST_TEST(page.get<std::string>("html.body.main.h1") == evil);
}

BOOST_AUTO_TEST_CASE(expectations_may_be_of_numbers_words_and_lists) {
  const TemporaryFolder folder;
  const Path path = rk2_path(5);
  write_run(folder / "run", path, "rk2");
  nlohmann::ordered_json told = summary(path, "rk2");
  told["expectations"] = {
      {{"description", "verdict"}, {"passed", true}, {"value", "regular"}, {"bound", "regular"}},
      {{"description", "dim S"}, {"passed", true}, {"value", {16, 8}}, {"bound", nullptr}}};
  write_text(folder / "run/summary.json", told.dump());
  const Tree page = parsed_page(report_html(std::vector<Run>{read_run(folder / "run")}));
  std::vector<std::string> cells;
  for (const Tree& table : find(page, "table")) {
    if (table.get<std::string>("caption") != "Expectations that passed") continue;
    for (const Tree& cell : find(table, "td", "number")) cells.push_back(cell.data());
  }
  BOOST_CHECK(cells == (std::vector<std::string>{"regular", "regular", "[16,8]", "–"}));
}

BOOST_AUTO_TEST_CASE(failed_run_is_shown_with_its_message) {
  const TemporaryFolder folder;
  const Path path = rk2_path(5);
  write_run(folder / "run", path, "rk2");
  nlohmann::ordered_json failed = summary(path, "rk2");
  failed["status"] = "failed";
  failed["message"] = "step 6: the vortices 0 and 1 coincide";
  for (const char* key : {"ladder", "expectations", "solver", "observables", "time"})
    failed.erase(key);
  write_text(folder / "run/summary.json", failed.dump());
  write_text(folder / "run/trajectory.csv", "t,x[0],y[0],H\n0,1,2,nan\n");
  const Tree page = parsed_page(report_html(std::vector<Run>{read_run(folder / "run")}));
  const auto messages = find(page, "p", "message");
  BOOST_TEST_REQUIRE(messages.size() == 1);
  BOOST_TEST(messages[0].data().find("the vortices 0 and 1 coincide") != std::string::npos);
  write_text(folder / "run/trajectory.csv", "t,x[0],y[0],H\n");
  BOOST_CHECK_NO_THROW(report_html(std::vector<Run>{read_run(folder / "run")}));
  BOOST_CHECK_THROW(report_html({}), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(report_is_written_whole_or_not_at_all) {
  const TemporaryFolder folder;
  const std::vector<Run> runs = read(write_methods(folder, 10));
  write_report(runs, folder / "report.html");
  BOOST_TEST(text_of(folder / "report.html").starts_with(report_html(runs)));
  write_report(runs, folder / "report.html");
  const auto message = [&](const std::filesystem::path& output) -> std::string {
    try {
      write_report(runs, output);
    } catch (const OutputError& error) {
      return error.what();
    }
    return "written";
  };
  const std::string none = (folder / "none/report.html").string();
  BOOST_TEST(message(none) == none + ": cannot be written: No such file or directory");
  std::filesystem::create_directories(folder / "folder/inside");
  BOOST_TEST(message(folder / "folder").find("folder: cannot be written: ") != std::string::npos);
  write_text(folder / "mine.html", "<p>mine</p>");
  BOOST_TEST(message(folder / "mine.html").find("is not as courant wrote it") != std::string::npos);
  BOOST_TEST(text_of(folder / "mine.html") == "<p>mine</p>");
  write_report(runs, folder / "mine.html", true);
  BOOST_TEST(message(folder / "mine.html") == "written");
}

BOOST_AUTO_TEST_SUITE_END()
