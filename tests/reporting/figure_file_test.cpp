#include "courant/reporting/figure_file.hpp"

#include <boost/test/unit_test.hpp>
#include <cstdlib>

#include "../core/files/temporary_folder.hpp"
#include "../plotting/parsed_markup.hpp"
#include "courant/core/files/output_file.hpp"
#include "courant/core/files/own_file.hpp"

// Mistakes that these cases have to notice:
//  * the numbers of somebody are replaced
BOOST_AUTO_TEST_SUITE(figure_file)

using namespace courant;
using namespace courant::test;

namespace {

Figure two_curves() {
  Figure figure;
  plot::Panel panel;
  panel.title = "Two curves";
  panel.x.label = "t";
  panel.y.label = "H";
  panel.series = {{"one", {0, 1, 2}, {0, 0.1, 0.2}, 0}, {"two, long", {0, 1, 2}, {3, 4, 5}, 1}};
  figure.panels = {panel};
  figure.legend = {{"one", 0}, {"two, long", 1}};
  figure.caption = "Caption.";
  return figure;
}

bool has_converter() { return std::system("rsvg-convert --version > /dev/null 2>&1") == 0; }

}  // namespace

BOOST_AUTO_TEST_CASE(numbers_stand_by_columns) {
  BOOST_TEST(figure_csv(two_curves()) == "t,one: H,\"two, long: H\"\n0,0,3\n1,0.1,4\n2,0.2,5\n");
  // Curves over places of their own have columns of both, as long as they are.
  Figure figure = two_curves();
  figure.panels[0].series[1] = {"two", {7}, {8}, 1};
  BOOST_TEST(figure_csv(figure) == "one: t,one: H,two: t,two: H\n0,0,7,8\n1,0.1,,\n2,0.2,,\n");
  figure.panels = {two_curves().panels[0], two_curves().panels[0]};
  figure.panels[1].heading = "below";
  BOOST_TEST(
      figure_csv(figure).find("1: t,1: one: H,\"1: two, long: H\",below: t,below: one: H,") == 0u);
}

BOOST_AUTO_TEST_CASE(a_picture_has_its_legend_and_stands_alone) {
  const std::string svg = figure_svg(two_curves());
  const Tree drawing = parsed(svg);
  std::vector<std::string> texts;
  for (const Tree& text : find(drawing, "text")) texts.push_back(text.data());
  for (const char* label : {"one", "two, long"})
    BOOST_TEST(std::count(texts.begin(), texts.end(), label) == 1);
  BOOST_TEST(find(drawing, "path", "line").size() == 2u);
  BOOST_TEST(svg.find("var(") == std::string::npos);
  BOOST_TEST(drawing.get<std::string>("svg.desc") == "Caption.");
}

BOOST_AUTO_TEST_CASE(files_are_of_the_kind_that_their_names_say) {
  const TemporaryFolder folder;
  write_figure(two_curves(), folder / "a.svg");
  BOOST_TEST(read_text(folder / "a.svg").starts_with(figure_svg(two_curves())));
  BOOST_TEST(read_text(folder / "a.csv") == figure_csv(two_curves()));
  BOOST_CHECK_THROW(write_figure(two_curves(), folder / "a.jpg"), std::invalid_argument);
  BOOST_CHECK_THROW(write_figure(two_curves(), folder / "none" / "a.svg"), OutputError);
  if (!has_converter()) {
    BOOST_TEST_MESSAGE("rsvg-convert is not there");
    return;
  }
  write_figure(two_curves(), folder / "b.pdf");
  write_figure(two_curves(), folder / "c.png");
  BOOST_TEST(read_text(folder / "b.pdf").starts_with("%PDF-"));
  const std::string png = read_text(folder / "c.png");
  BOOST_TEST_REQUIRE(png.starts_with("\x89PNG"));
  // 740 pixels at 300 dots an inch.
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(png[i]); };
  BOOST_TEST(256 * byte(18) + byte(19) == 2313);
  BOOST_CHECK_THROW(write_figure(two_curves(), folder / "none" / "a.pdf"), OutputError);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path()))
    ++files;
  BOOST_TEST(files == 6u);  // nothing is left of what was on the way
}

// Also where they are of the same name: the trajectory of a run, what was measured in a laboratory.
BOOST_AUTO_TEST_CASE(files_of_others_are_not_replaced) {
  const TemporaryFolder folder;
  const auto refused = [](const RefusedOutput&) { return true; };
  for (const char* name : {"trajectory.csv", "trajectory.svg"}) {
    write_text(folder / name, "mine");
    BOOST_CHECK_EXCEPTION(write_figure(two_curves(), folder / "trajectory.svg"), RefusedOutput,
                          refused);
    BOOST_TEST(read_text(folder / name) == "mine");
    std::filesystem::remove(folder / name);
    BOOST_TEST(std::filesystem::is_empty(folder.path()));
  }
  // The picture by its name, the numbers never.
  write_text(folder / "a.svg", "mine");
  write_figure(two_curves(), folder / "a.svg", true);
  write_text(folder / "a.csv", "edited");
  BOOST_CHECK_EXCEPTION(write_figure(two_curves(), folder / "a.svg", true), RefusedOutput, refused);
  BOOST_TEST(read_text(folder / "a.csv") == "edited");
}

BOOST_AUTO_TEST_CASE(its_own_files_are_replaced) {
  const TemporaryFolder folder;
  Figure other = two_curves();
  other.panels[0].series[0].y[0] = 17;
  std::vector<const char*> names = {"a.svg"};
  if (has_converter()) names.insert(names.end(), {"a.pdf", "a.png"});
  for (const char* name : names)
    for (const Figure& figure : {two_curves(), other}) {
      write_figure(figure, folder / name);
      BOOST_TEST(read_text(folder / "a.csv") == figure_csv(figure));
      BOOST_TEST(mark_of(folder / name).has_value());
    }
}

BOOST_AUTO_TEST_CASE(a_missing_converter_is_said) {
  const TemporaryFolder folder;
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder.path().c_str(), 1);
  BOOST_CHECK_EXCEPTION(
      write_figure(two_curves(), folder / "a.pdf"), OutputError, [](const OutputError& error) {
        return std::string(error.what()).find("librsvg2-bin") != std::string::npos;
      });
  setenv("PATH", path.c_str(), 1);
}

BOOST_AUTO_TEST_SUITE_END()
