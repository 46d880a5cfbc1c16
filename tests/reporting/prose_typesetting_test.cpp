#include "courant/reporting/prose_typesetting.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "courant/core/language/formula_tree.hpp"
#include "courant/reporting/tour_chapters.hpp"
#include "courant/reporting/typesetting.hpp"

BOOST_AUTO_TEST_SUITE(prose_typesetting_test)

using namespace courant;

BOOST_AUTO_TEST_CASE(formulas_stand_between_marks) {
  const Prose prose = marked_prose("From $x' = v$ and M_f: *no* $p_z$.");
  BOOST_TEST(prose.str() == "From x' = v and M_f: *no* p_z.");
  BOOST_TEST(markdown_prose(prose) == "From $\\dot{x} = v$ and M\\_f: \\*no\\* $p_{z}$.");
  BOOST_TEST(latex_prose(prose) ==
             "From $\\dot{x} = v$ and \\ensuremath{M}\\ensuremath{_{f}}: *no* $p_{z}$.");
  const std::string markup = typeset_prose(prose).str();
  BOOST_TEST(markup.starts_with("From <math>"), markup);
  BOOST_TEST(markup.find("<i>M</i><sub><i>f</i></sub>: *no* <math>") != std::string::npos, markup);
  // A letter of two bytes below another one.
  BOOST_TEST(latex_sentence("∂_λE") ==
             "\\ensuremath{\\partial}\\ensuremath{_{\\ensuremath{\\lambda}}}E");
  const std::string below = typeset("∂_λE").str();
  BOOST_TEST(below.find("<sub><math><mi>λ</mi></math></sub><i>E</i>") != std::string::npos, below);
  BOOST_TEST(marked_prose("").parts().empty());
  BOOST_TEST(marked_prose("no formula").parts().size() == 1u);
}

// What is marked in the tour is a formula, and every mark has its other one.
BOOST_AUTO_TEST_CASE(the_words_of_the_tour_have_formulas) {
  int formulas = 0;
  for (const TourChapter& chapter : tour_chapters()) {
    const std::vector<std::string> words = {chapter.idea, chapter.question, chapter.answer,
                                            chapter.exercise, chapter.solution};
    for (const std::string& text : words) {
      BOOST_TEST(std::ranges::count(text, '$') % 2 == 0, text);
      const Prose prose = marked_prose(text);
      for (const Prose::Part& part : prose.parts()) {
        if (!part.is_formula) continue;
        ++formulas;
        const bool is_formula = formula_tree(part.text).has_value();
        BOOST_TEST(is_formula, part.text);
      }
    }
  }
  BOOST_TEST(formulas > 20);
}

BOOST_AUTO_TEST_SUITE_END()
