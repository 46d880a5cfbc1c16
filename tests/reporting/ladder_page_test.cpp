#include "courant/reporting/ladder_page.hpp"

#include <boost/test/unit_test.hpp>
#include <string>

#include "courant/integrators/certificate/constraint_brackets.hpp"
#include "courant/running/consistent_start.hpp"

BOOST_AUTO_TEST_SUITE(ladder_page_test)

using namespace courant;

namespace {

LadderPage page_of(const Json& document) {
  const Experiment experiment = read_experiment(document.dump());
  const ImplicitSystem& system = *experiment.model.system;
  const ConstraintLadder ladder = consistent_start(experiment);
  const ConstraintFormulas formulas = constraint_formulas(system, ladder);
  return ladder_page(experiment, ladder_report(ladder, system, formulas),
                     constraint_brackets(system, ladder, formulas));
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const Json square = {
    {"title", "A square & <more>"},
    {"system",
     {{"type", "lagrangian"}, {"coordinates", {"x", "y"}}, {"lagrangian", "(x' - y)^2/2"}}},
    {"initial", {{"x", 1}, {"y", 0.5}, {"p_x", 0}}}};

}  // namespace

BOOST_AUTO_TEST_CASE(says_the_same_in_three_notations) {
  const LadderPage page = page_of(square);
  const std::string html = to_html(page), latex = to_latex(page), markdown = to_markdown(page);
  BOOST_TEST(has(latex, "\\frac{{\\left( \\dot{x} - y\\right)}^{2}}{2}"), latex);
  BOOST_TEST(has(markdown, "$\\frac{{\\left( \\dot{x} - y\\right)}^{2}}{2}$"), markdown);
  for (const std::string* text : {&html, &latex, &markdown}) {
    BOOST_TEST(has(*text, "Gauge. The algorithm stops at k = ") == (text != &html), *text);
    BOOST_TEST(has(*text, "Total Hamiltonian"));
    BOOST_TEST(!has(*text, "x'"), *text);  // velocities have dots
  }
  // p_y = 0, p_x = 0; their brackets vanish.
  BOOST_TEST(has(latex, "\\begin{pmatrix}\n0 & 0 \\\\\n0 & 0 \\\\\n\\end{pmatrix}"), latex);
  BOOST_TEST(has(latex, "S_{0} & \\supseteq & S_{1}"), latex);
}

BOOST_AUTO_TEST_CASE(what_is_typed_is_no_markup) {
  const LadderPage page = page_of(square);
  BOOST_TEST(has(to_html(page), "A square &amp; &lt;more&gt;"));
  BOOST_TEST(has(to_latex(page), "\\section*{A square \\& <more>}"), to_latex(page));
  BOOST_TEST(has(to_markdown(page), "# A square & \\<more\\>"), to_markdown(page));
}

BOOST_AUTO_TEST_CASE(numbers_have_powers_of_ten) {
  const std::string html = to_html(page_of(square));
  BOOST_TEST(has(html, "\u00a0×\u00a010"), html);
  BOOST_TEST(!has(html, "e+1"), html);
}

BOOST_AUTO_TEST_CASE(inconsistent_systems_have_pages) {
  const LadderPage page = page_of(
      {{"system", {{"type", "lagrangian"}, {"coordinates", {"q"}}, {"lagrangian", "q' + q"}}},
       {"initial", {{"q", 0}}}});
  BOOST_TEST(has(to_latex(page), "Inconsistent"), to_latex(page));
  BOOST_TEST(has(to_latex(page), "\\emptyset"), to_latex(page));
  BOOST_TEST(!has(to_html(page), "<table class=\"brackets\">"));
}

BOOST_AUTO_TEST_SUITE_END()
