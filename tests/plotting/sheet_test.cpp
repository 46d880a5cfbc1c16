#include "courant/plotting/sheet.hpp"

#include <boost/test/unit_test.hpp>

#include "parsed_markup.hpp"

BOOST_AUTO_TEST_SUITE(sheet)

using namespace courant::plot;
using namespace courant::test;

namespace {

Panel panel(double width, double height = 200) {
  Panel one;
  one.width = width;
  one.height = height;
  one.series = {{"a", {0, 1}, {0, 1}, 0}};
  return one;
}

// The transform of each panel.
std::vector<std::string> places(const Sheet& sheet) {
  std::vector<std::string> found;
  for (const Tree& group : find(parsed(draw(sheet).str()), "g"))
    if (group.count("svg") > 0) found.push_back(attribute(group, "transform"));
  return found;
}

}  // namespace

BOOST_AUTO_TEST_CASE(wide_panels_stand_one_under_the_other) {
  const Sheet two{"title", "", {}, {panel(720), panel(720)}};
  BOOST_CHECK(places(two) == (std::vector<std::string>{"translate(10 10)", "translate(10 224)"}));
  const Tree drawing = parsed(draw(two).str()).get_child("svg");
  BOOST_TEST(attribute(drawing, "width") == "740");
  BOOST_TEST(attribute(drawing, "height") == "434");
  BOOST_TEST(drawing.get<std::string>("title") == "title");
}

BOOST_AUTO_TEST_CASE(narrow_panels_stand_two_abreast) {
  const Sheet three{"", "", {}, {panel(350), panel(350, 240), panel(350)}};
  BOOST_CHECK(places(three) == (std::vector<std::string>{"translate(10 10)", "translate(374 10)",
                                                         "translate(10 264)"}));
}

BOOST_AUTO_TEST_CASE(the_legend_is_in_the_picture_and_its_lines_do_not_leave_it) {
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < 12; ++i)
    entries.push_back({"a method with a long name, " + std::to_string(i), i});
  const Sheet sheet{"", "", entries, {panel(720)}};
  const Tree drawing = parsed(draw(sheet).str());
  std::size_t found = 0;
  for (const Tree& text : find(drawing, "text"))
    if (text.data().starts_with("a method")) {
      ++found;
      BOOST_TEST(std::stod(attribute(text, "x")) < 720 - 6 * 20);
    }
  BOOST_TEST(found == entries.size());
  BOOST_TEST(places(sheet)[0] != "translate(10 10)");
}

BOOST_AUTO_TEST_SUITE_END()
