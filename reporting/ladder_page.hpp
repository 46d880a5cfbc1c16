// The constraint algorithm of one system as a page that can be handed out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/integrators/certificate/constraint_brackets.hpp"
#include "courant/plotting/svg.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/reporting/prose.hpp"
#include "courant/reporting/report_head.hpp"
#include "courant/running/ladder_report.hpp"

namespace courant {

// What a page on a ladder says, in the order in which it is read, whatever it is written in: the system, the diagram,
// what each S_k adds, hidden constraints, classes and brackets, how sure all of it is, and what had to move.
struct LadderPage {
  struct Paragraph {
    Prose text;
    bool is_displayed =
        false;  // a line of its own, indented: an equation, or what belongs to the line above
  };
  struct Section {
    std::string title;
    std::vector<Paragraph> paragraphs;
  };

  std::string title;
  std::string system;             // in words, with names of manifolds as the library writes them
  std::vector<ModelEntry> model;  // the formulas of the system
  LadderReport ladder;
  std::optional<ConstraintBrackets> brackets;
  std::vector<Section> sections;
};

LadderPage ladder_page(const Experiment& experiment, const LadderReport& ladder,
                       const std::optional<ConstraintBrackets>& brackets = std::nullopt);

// The words on a ladder with their formulas set, for a part of a page.
plot::Markup ladder_in_words(const LadderReport& ladder,
                             const std::optional<ConstraintBrackets>& brackets = std::nullopt);

// What a page says below its title, for pages of other frames: needs content_style().
plot::Markup to_markup(const LadderPage& page);
// What is said of a discrete ladder (discrete_ladder()), and the same with its diagram, for a part of a page.
std::vector<std::string> discrete_ladder_in_words(const Experiment& experiment,
                                                  const LadderReport& ladder);
plot::Markup discrete_markup(const Experiment& experiment, const LadderReport& ladder);

// A page that needs nothing else: no network, no script.
std::string to_html(const LadderPage& page);
// A document for LaTeX, which needs the packages amsmath, amssymb and graphicx alone.
std::string to_latex(const LadderPage& page);
// The sections alone, for a part of a text: their titles are bold, no headings.
std::string sections_in_markdown(const LadderPage& page);
// Markdown with $formulas$, as GitHub, Pandoc and notebooks read it.
std::string to_markdown(const LadderPage& page);

}  // namespace courant
