#include "courant/plotting/svg.hpp"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <sstream>

BOOST_AUTO_TEST_SUITE(svg)

using namespace courant::plot;

namespace {

boost::property_tree::ptree parsed(const std::string& xml) {
  std::istringstream stream(xml);
  boost::property_tree::ptree tree;
  boost::property_tree::read_xml(stream, tree);
  return tree;
}

const std::string nasty = "a<b & \"c\" 'd' > e</text><script>alert(1)</script> ₀τ";

}  // namespace

BOOST_AUTO_TEST_CASE(escapes_what_could_be_markup) {
  BOOST_TEST(escape("a<b>&\"'") == "a&lt;b&gt;&amp;&quot;&#39;");
  BOOST_TEST(escape("𝓛 ⊂ T*M") == "𝓛 ⊂ T*M");
  BOOST_TEST(escape(std::string("x\0\x01\x1f\x7f\n\ty", 8)) == "x\uFFFD\uFFFD\uFFFD\uFFFD\n\ty");
}

BOOST_AUTO_TEST_CASE(text_reads_back_as_it_was) {
  const Markup markup = element("g", {{"id", nasty}}, element("text", {}, nasty) + nasty);
  const auto tree = parsed(markup.str());
  BOOST_TEST(tree.get<std::string>("g.<xmlattr>.id") == nasty);
  BOOST_TEST(tree.get<std::string>("g.text") == nasty);
  BOOST_TEST(markup.str().find("<script") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(root_has_title_and_description) {
  const auto tree =
      parsed(courant::plot::svg(320, 200.5, nasty, "what one sees", element("g", {})).str());
  BOOST_TEST(tree.get<std::string>("svg.<xmlattr>.viewBox") == "0 0 320 200.5");
  BOOST_TEST(tree.get<std::string>("svg.<xmlattr>.role") == "img");
  BOOST_TEST(tree.get<std::string>("svg.title") == nasty);
  BOOST_TEST(tree.get<std::string>("svg.desc") == "what one sees");
}

BOOST_AUTO_TEST_CASE(style_sheet_cannot_end_early) {
  BOOST_TEST(style_sheet("a>b{}").str() == "<style>a>b{}</style>");
  BOOST_CHECK_THROW(style_sheet("a{}</style><script>"), std::invalid_argument);
  BOOST_CHECK_THROW(style_sheet("a{content:'&lt;'}"), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(coordinates_are_short) {
  BOOST_TEST(coordinate(12) == "12");
  BOOST_TEST(coordinate(12.345) == "12.35");
  BOOST_TEST(coordinate(-0.001) == "0");
  BOOST_TEST(coordinate(100) == "100");
  BOOST_TEST(coordinate(-1.50) == "-1.5");
  BOOST_TEST(coordinate(std::numeric_limits<double>::quiet_NaN()) == "0");
}

BOOST_AUTO_TEST_CASE(path_leaves_out_repeated_vertices) {
  PathData path;
  BOOST_TEST(path.empty());
  path.move_to(0, 1);
  path.line_to(0.04, 1.04);
  path.line_to(2, 3.26);
  path.close();
  BOOST_TEST(path.str() == "M0 1L2 3.3Z");
}

BOOST_AUTO_TEST_CASE(script_cannot_end_early) {
  const std::string text = script("if (1 < 2 && true) done();\n").str();
  BOOST_TEST(parsed(text).get<std::string>("script").find("1 < 2 && true") != std::string::npos);
  BOOST_CHECK_THROW(script("'</script>'"), std::invalid_argument);
  BOOST_CHECK_THROW(script("a[b[0]]>1"), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
