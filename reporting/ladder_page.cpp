#include "courant/reporting/ladder_page.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>
#include <utility>

#include "courant/core/words/message.hpp"
#include "courant/core/words/text_layout.hpp"
#include "courant/reporting/bracket_words.hpp"
#include "courant/reporting/branch_words.hpp"
#include "courant/reporting/formula_typesetting.hpp"
#include "courant/reporting/ladder_diagram.hpp"
#include "courant/reporting/ladder_explanation.hpp"
#include "courant/reporting/page_frame.hpp"
#include "courant/reporting/prose_typesetting.hpp"
#include "courant/reporting/report_head.hpp"
#include "courant/reporting/report_tables.hpp"
#include "courant/reporting/typesetting.hpp"

namespace courant {
namespace {

using plot::element;
using plot::Markup;

// 5.2e+14 as 5.2 × 10¹⁴.
std::string with_powers_of_ten(std::string_view text) {
  static constexpr std::string_view above[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  const auto digit = [&](std::size_t i) {
    return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0;
  };
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool exponent = text[i] == 'e' && i > 0 && digit(i - 1) && i + 1 < text.size() &&
                          (text[i + 1] == '+' || text[i + 1] == '-') && digit(i + 2);
    if (!exponent) {
      result += text[i];
      continue;
    }
    result += "\u00a0×\u00a010";
    if (text[++i] == '-') result += "⁻";
    while (text[i + 1] == '0' && digit(i + 2)) ++i;
    while (digit(i + 1)) result += above[static_cast<std::size_t>(text[++i] - '0')];
  }
  return result;
}

// A line of the explanation: those that begin with spaces stand under the one before.
LadderPage::Paragraph paragraph(const Prose& line) {
  const bool is_displayed = line.str().starts_with("    ");
  Prose text;
  for (const Prose::Part& part : line.parts()) {
    std::string words = part.text;
    if (is_displayed && text.parts().empty() && !part.is_formula)
      words.erase(0, words.find_first_not_of(' '));
    if (words.empty()) continue;
    text += part.is_formula ? Prose::formula(words) : Prose(with_powers_of_ten(words));
  }
  return {text, is_displayed};
}

LadderPage::Section section(std::string title, const std::vector<Prose>& lines) {
  LadderPage::Section made{std::move(title), {}};
  for (const Prose& line : lines) made.paragraphs.push_back(paragraph(line));
  return made;
}

// The section that has the matrix, where it is small.
constexpr const char* kBrackets = "Brackets of the constraints";

bool has_matrix(const LadderPage& page) {
  if (!page.brackets || !page.brackets->missing.empty() || !page.ladder.classes ||
      !page.ladder.classes->brackets || page.brackets->constraints.size() > 8)
    return false;
  // What stands beside each other in a row of a page.
  constexpr std::size_t letters = 100;
  const auto& matrix = page.brackets->matrix;
  std::size_t width = 0;
  for (std::size_t b = 0; b < matrix.size(); ++b) {
    std::size_t widest = 0;
    for (const auto& row : matrix) widest = std::max(widest, row[b].text.size());
    width += widest;
  }
  return width <= letters;
}

std::string capitalized(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

// --- HTML ---

Markup paragraphs(const std::vector<LadderPage::Paragraph>& list) {
  Markup all;
  for (const LadderPage::Paragraph& one : list)
    all += one.is_displayed ? displayed_prose(one.text) : element("p", {}, typeset_prose(one.text));
  return all;
}

Markup matrix(const ConstraintBrackets& brackets) {
  Markup head = element("th", {}, "");
  Markup rows;
  for (std::size_t a = 0; a < brackets.matrix.size(); ++a) {
    const std::string name = "phi_" + std::to_string(a + 1);
    head += element("th", {{"scope", "col"}}, math(name));
    Markup cells = element("th", {{"scope", "row"}}, math(name));
    for (const ConstraintBrackets::Entry& entry : brackets.matrix[a])
      cells += element("td", {}, math(entry.text) + (entry.is_at_point ? " here" : ""));
    cells += element("td", {}, brackets.is_first_class[a] ? "first class" : "");
    rows += element("tr", {}, cells);
  }
  Markup constraints;
  for (std::size_t a = 0; a < brackets.constraints.size(); ++a)
    constraints += displayed_prose(
        Prose::formula("phi_" + std::to_string(a + 1) + " = " + brackets.constraints[a]));
  return constraints +
         element("div", {{"class", "scroll"}},
                 element("table", {{"class", "brackets"}},
                         element("caption", {}, typeset("Brackets {φ_a, φ_b} on M_f")) +
                             element("thead", {}, element("tr", {}, head + element("th", {}, ""))) +
                             element("tbody", {}, rows)));
}

// --- LaTeX ---

// Prose that is one formula and nothing else.
bool is_formula(const Prose& prose) {
  return prose.parts().size() == 1 && prose.parts()[0].is_formula;
}

// A formula that is set smaller where one of its lines, of a single term, is wider than the page.
std::string fitted(const std::string& formula) {
  return "\\fitted{" + latex_displayed(formula) + "}";
}
std::string displayed(const std::string& formula) { return "\\[ " + fitted(formula) + " \\]\n"; }
constexpr const char* kFitted =
    "\\newsavebox{\\fittedline}\n"
    "\\newcommand{\\fitted}[1]{\\sbox{\\fittedline}{$\\displaystyle #1$}%\n"
    "\\ifdim\\wd\\fittedline>\\linewidth\\resizebox{\\linewidth}{!}{\\usebox{\\fittedline}}%\n"
    "\\else\\usebox{\\fittedline}\\fi}\n";

// A paragraph that is displayed, cut before and behind formulas that need a line of their own.
std::vector<Prose> lines_of(const Prose& prose) {
  std::vector<Prose> lines(1);
  for (const Prose::Part& part : prose.parts()) {
    const bool is_long = part.is_formula && is_long_formula(part.text);
    if (is_long && !lines.back().parts().empty()) lines.emplace_back();
    lines.back() += part.is_formula ? Prose::formula(part.text) : Prose(part.text);
    if (is_long) lines.emplace_back();
  }
  if (lines.back().parts().empty()) lines.pop_back();
  return lines;
}

std::string latex_paragraphs(const std::vector<LadderPage::Paragraph>& list) {
  std::string all;
  for (const LadderPage::Paragraph& one : list) {
    if (!one.is_displayed) {
      all += latex_prose(one.text) + "\n\n";
      continue;
    }
    for (const Prose& line : lines_of(one.text))
      all += is_formula(line)
                 ? displayed(line.parts()[0].text)
                 : "\\begin{quote}\\raggedright\n" + latex_prose(line) + "\n\\end{quote}\n";
  }
  return all;
}

std::string latex_diagram(const LadderReport& ladder) {
  std::string S, arrows, M, dim_S, dim_M, columns;
  const LadderReport::Level* before = nullptr;
  for (const LadderReport::Level& level : ladder.levels) {
    const std::string k = std::to_string(level.k);
    if (before) {
      const auto relation = [](bool same) { return same ? " & = & " : " & \\supseteq & "; };
      S += relation(level.dim_S && before->dim_S == level.dim_S);
      M += relation(level.dim_M && before->dim_M == level.dim_M);
      arrows += " & & ";
      dim_S += " & & ";
      dim_M += " & & ";
    }
    S += "S_{" + k + "}";
    M += "M_{" + k + "}";
    arrows += "\\downarrow\\tau";
    dim_S += level.dim_S ? std::to_string(*level.dim_S) : "\\emptyset";
    dim_M += level.dim_M ? std::to_string(*level.dim_M) : "\\emptyset";
    columns += before ? "cc" : "c";
    before = &level;
  }
  if (columns.empty()) return "";
  return "\\[ \\begin{array}{r@{\\quad}" + columns + "}\n\\dim S & " + dim_S + " \\\\\n & " + S +
         " \\\\\n & " + arrows + " \\\\\n & " + M + " \\\\\n\\dim M & " + dim_M +
         "\n\\end{array} \\]\n";
}

std::string latex_entry(const ConstraintBrackets::Entry& entry) {
  return latex_math(entry.text) + (entry.is_at_point ? "\\text{ here}" : "");
}

std::string latex_matrix(const ConstraintBrackets& brackets) {
  std::string all;
  for (std::size_t a = 0; a < brackets.constraints.size(); ++a)
    all += displayed("phi_" + std::to_string(a + 1) + " = " + brackets.constraints[a]);
  all += "\\[ \\bigl(\\{\\phi_a, \\phi_b\\}\\bigr) = \\begin{pmatrix}\n";
  for (const auto& row : brackets.matrix) {
    for (std::size_t b = 0; b < row.size(); ++b) all += (b == 0 ? "" : " & ") + latex_entry(row[b]);
    all += " \\\\\n";
  }
  return all + "\\end{pmatrix} \\]\n";
}

// --- Markdown ---

std::string markdown_paragraphs(const std::vector<LadderPage::Paragraph>& list) {
  std::string all;
  for (const LadderPage::Paragraph& one : list) {
    if (!one.is_displayed)
      all += markdown_prose(one.text) + "\n\n";
    else if (is_formula(one.text))
      all += "$$" + latex_displayed(one.text.parts()[0].text) + "$$\n\n";
    else
      all += "> " + markdown_prose(one.text) + "\n\n";
  }
  return all;
}

std::string markdown_matrix(const ConstraintBrackets& brackets) {
  std::string text;
  for (std::size_t a = 0; a < brackets.constraints.size(); ++a)
    text += "$$" +
            latex_displayed("phi_" + std::to_string(a + 1) + " = " + brackets.constraints[a]) +
            "$$\n\n";
  text += "|  |";
  for (std::size_t a = 0; a < brackets.matrix.size(); ++a)
    text += " $\\phi_" + std::to_string(a + 1) + "$ |";
  text += "\n|";
  for (std::size_t a = 0; a <= brackets.matrix.size(); ++a) text += " --- |";
  text += "\n";
  for (std::size_t a = 0; a < brackets.matrix.size(); ++a) {
    text += "| $\\phi_" + std::to_string(a + 1) + "$ |";
    for (const ConstraintBrackets::Entry& entry : brackets.matrix[a])
      text += " $" + latex_entry(entry) + "$ |";
    text += "\n";
  }
  text += "\n";
  return text;
}

// What a section says.
std::string markdown_section(const LadderPage& page, const LadderPage::Section& one) {
  return markdown_paragraphs(one.paragraphs) +
         (one.title == kBrackets && has_matrix(page) ? markdown_matrix(*page.brackets) : "");
}

}  // namespace

LadderPage ladder_page(const Experiment& experiment, const LadderReport& ladder,
                       const std::optional<ConstraintBrackets>& brackets) {
  LadderPage page;
  page.title = experiment.title.empty() ? "Constraint algorithm" : experiment.title;
  page.system = capitalized(experiment.model.description);
  page.ladder = ladder;
  page.brackets = brackets;
  page.model = model_entries(experiment.document);
  std::vector<Prose> verdict = {verdict_in_words(ladder)};
  if (!ladder.reason.empty()) verdict.push_back(reason_in_words(ladder));
  page.sections.push_back(section("Verdict", verdict));
  const LadderWords words = ladder_words(ladder, brackets);
  page.sections.push_back(section("Branches", branches_in_words(branch_reports(experiment))));
  page.sections.push_back(section("Level by level", words.levels));
  page.sections.push_back(section("Freedom and classes", words.freedom));
  std::vector<Prose> of_brackets = words.brackets;
  if (has_matrix(page)) {
    of_brackets.clear();
    if (const std::string note = note_on_numbers(*page.brackets); !note.empty())
      of_brackets.emplace_back(note);
  }
  page.sections.push_back(section(kBrackets, of_brackets));
  page.sections.push_back(section("Hamiltonian dynamics", words.dynamics));
  page.sections.push_back(section("Unknowns", words.unknowns));
  std::vector<Prose> certainty = words.certainty;
  if (constexpr std::string_view title = "How sure: ";
      !certainty.empty() && certainty[0].str().starts_with(title))
    certainty[0] = capitalized(certainty[0].str().substr(title.size()));
  page.sections.push_back(section("How sure", certainty));
  LadderPage::Section moves{"What moved", {}};
  for (const Movement& move : ladder.moves)
    moves.paragraphs.push_back({Prose::formula(move.name) + " from " + number_text(move.from) +
                                    " to " + number_text(move.to),
                                true});
  page.sections.push_back(std::move(moves));
  std::erase_if(page.sections, [&](const LadderPage::Section& one) {
    return one.paragraphs.empty() && !(one.title == kBrackets && has_matrix(page));
  });
  return page;
}

Markup ladder_in_words(const LadderReport& ladder,
                       const std::optional<ConstraintBrackets>& brackets) {
  const LadderWords words = ladder_words(ladder, brackets);
  LadderPage page;
  page.ladder = ladder;
  page.brackets = brackets;
  const auto part = [](const std::vector<Prose>& lines) {
    return paragraphs(section("", lines).paragraphs);
  };
  return part(words.levels) + part(words.freedom) +
         (has_matrix(page) ? matrix(*brackets) : part(words.brackets)) + part(words.dynamics) +
         part(words.unknowns) + part(words.certainty);
}

Markup to_markup(const LadderPage& page) {
  Markup body = element("p", {{"class", "lead"}}, typeset_manifolds(page.system));
  body += model_markup(page.model);
  for (const LadderPage::Section& one : page.sections) {
    Markup content = paragraphs(one.paragraphs);
    if (one.title == "Verdict")
      content += element("figure", {{"class", "diagram scroll"}}, ladder_diagram(page.ladder)) +
                 ladder_table(page.ladder);
    if (one.title == kBrackets && has_matrix(page)) content += matrix(*page.brackets);
    body += page_section(one.title, content);
  }
  return body;
}

std::vector<std::string> discrete_ladder_in_words(const Experiment& experiment,
                                                  const LadderReport& ladder) {
  std::vector<std::string> lines = {
      "Pairs of points in place of velocities (Remark 6.1): S_k are the pairs (x\u2080, x\u2081) "
      "from which k more steps can be made, M_k their first points. By " +
      experiment.method->description + ", with the step " + number_text(experiment.time->step) +
      "."};
  if (experiment.method->description.starts_with("constrain-first"))
    lines.emplace_back(
        "S\u2080 are the pairs that satisfy the equations of the system, as those of "
        "discretize-first do; the steps of constrain-first satisfy those of S_f, and end on M_f.");
  lines.push_back(discrete_verdict_in_words(ladder));
  return lines;
}

Markup discrete_markup(const Experiment& experiment, const LadderReport& ladder) {
  Markup all = element("figure", {{"class", "diagram scroll"}}, ladder_diagram(ladder));
  for (const std::string& line : discrete_ladder_in_words(experiment, ladder))
    all += element("p", {}, typeset(line));
  return all;
}

std::string to_html(const LadderPage& page) {
  return whole_page(page.title, element("h1", {}, page.title) + to_markup(page) +
                                    element("footer", {}, "Made by courant constraints."));
}

std::string to_latex(const LadderPage& page) {
  std::string text =
      "\\documentclass{article}\n\\usepackage[utf8]{inputenc}\n\\usepackage{amsmath,amssymb,"
      "graphicx}\n" +
      std::string(kFitted) +
      "\\setlength{\\parindent}{0pt}\n\\setlength{\\parskip}{0.5ex}\n\\begin{document}\n\\section*"
      "{\\raggedright " +
      latex_sentence(page.title) + "}\n" + latex_sentence(manifolds_in_unicode(page.system)) +
      "\n\n";
  for (const ModelEntry& entry : page.model) {
    text += latex_sentence(entry.name) + ":\n" + "\\begin{quote}\\raggedright\n";
    for (const Prose& line : entry.lines) {
      for (const Prose::Part& part : line.parts())
        text += part.is_formula ? fitted(part.text) : latex_sentence(part.text);
      text += "\\\\\n";
    }
    text += "\\end{quote}\n";
  }
  for (const LadderPage::Section& one : page.sections) {
    text += "\\subsection*{" + latex_sentence(one.title) + "}\n" + latex_paragraphs(one.paragraphs);
    if (one.title == "Verdict") text += latex_diagram(page.ladder);
    if (one.title == kBrackets && has_matrix(page)) text += latex_matrix(*page.brackets);
  }
  return text + "\\end{document}\n";
}

std::string sections_in_markdown(const LadderPage& page) {
  std::string text;
  for (const LadderPage::Section& one : page.sections)
    text += "**" + markdown_text(one.title) + ".**\n\n" + markdown_section(page, one);
  return text;
}

std::string to_markdown(const LadderPage& page) {
  std::string text = "# " + markdown_text(page.title) + "\n\n" +
                     markdown_text(manifolds_in_unicode(page.system)) + "\n\n";
  for (const ModelEntry& entry : page.model) {
    text += markdown_text(entry.name) + ":\n\n";
    for (const Prose& line : entry.lines) text += "* " + markdown_prose(line) + "\n";
    text += "\n";
  }
  for (const LadderPage::Section& one : page.sections) {
    text += "## " + markdown_text(one.title) + "\n\n" + markdown_section(page, one);
    if (one.title == "Verdict") {
      text += "```text\n";
      for (const std::string& line : ladder_text_diagram(page.ladder)) text += line + "\n";
      text += "```\n\n";
    }
  }
  return text;
}

}  // namespace courant
