#include "courant/reporting/report.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "courant/core/files/own_file.hpp"
#include "courant/core/words/word_list.hpp"
#include "courant/integrators/certificate/constraint_brackets.hpp"
#include "courant/plotting/curve_data.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/reporting/energy_figures.hpp"
#include "courant/reporting/figure_drawing.hpp"
#include "courant/reporting/ladder_diagram.hpp"
#include "courant/reporting/ladder_page.hpp"
#include "courant/reporting/page_frame.hpp"
#include "courant/reporting/report_figures.hpp"
#include "courant/reporting/report_head.hpp"
#include "courant/reporting/report_script.hpp"
#include "courant/reporting/report_tables.hpp"
#include "courant/reporting/typesetting.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/other_values.hpp"

namespace courant {

namespace {

using Json = nlohmann::ordered_json;
using plot::element;
using plot::Markup;

// At least this many rows of each curve go along for the script.
constexpr std::size_t fewest_rows = 16;

// Numbers the figures as they come.
class Figures {
 public:
  explicit Figures(std::size_t rows) : rows_(rows) {}

  Markup add(const Figure& figure) {
    return element("figure", {}, panels_and_legend(figure, rows_) + caption(figure.caption));
  }

  Markup add(const std::vector<Figure>& figures) {
    Markup all;
    for (const Figure& figure : figures) all += add(figure);
    return all;
  }

  Markup add(const std::optional<Figure>& figure) { return figure ? add(*figure) : Markup(); }

 private:
  Markup caption(const std::string& text) {
    const std::string number = "Figure " + std::to_string(++count_) + ".";
    return element("figcaption", {}, element("b", {}, number) + " " + unbroken(text));
  }

  std::size_t rows_;
  int count_ = 0;
};

std::string page_title(std::span<const Run> runs) {
  std::vector<std::string> titles;
  for (const Run& run : runs) {
    const Json* title = run.experiment.contains("title") ? &run.experiment.at("title") : nullptr;
    const std::string text =
        title != nullptr && title->is_string() ? title->get<std::string>() : run.name;
    if (std::find(titles.begin(), titles.end(), text) == titles.end()) titles.push_back(text);
  }
  return word_list(titles, " · ");
}

// What went wrong, of the runs that did not complete.
Markup messages(std::span<const Run> runs, std::span<const std::string> labels) {
  Markup all;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const RunSummary& summary = runs[i].summary;
    if (summary.status == RunStatus::completed) continue;
    all += element("p", {{"class", "message"}},
                   element("span", {{"class", "bad"}}, to_string(summary.status)) + " — " +
                       labels[i] + ". " + summary.message);
  }
  return all;
}

// What tells two ladders apart: not the point, which every run has its own of.
std::string kind_of(const LadderReport& ladder) {
  std::string kind = to_string(ladder.verdict);
  for (const LadderReport::Level& level : ladder.levels)
    kind += " " + std::to_string(level.dim_S.value_or(-1)) + "/" +
            std::to_string(level.dim_M.value_or(-1));
  return kind + (ladder.is_ambiguous ? "?" : "");
}

// The formulas of brackets, which only the equations tell. An experiment of another time may not be read any more.
std::optional<ConstraintBrackets> brackets_of(const Run& run, const LadderReport& ladder) {
  if (!ladder.classes || !ladder.classes->brackets) return std::nullopt;
  try {
    const Experiment experiment = read_experiment_document(run.experiment);
    const ConsistentStart start = consistent_start(experiment);
    const ImplicitSystem& system = *experiment.model.system;
    return constraint_brackets(system, start, formulas_of_start(experiment, start));
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

// The names, or the first of many.
std::string in_short(const std::vector<std::string>& names) {
  constexpr std::size_t most = 8;
  if (names.size() <= most) return word_list(names, ", ");
  return word_list(std::span(names).first(most - 1), ", ") + " and " +
         std::to_string(names.size() - most + 1) + " more";
}

// Each ladder once, with the runs it belongs to.
Markup ladders(std::span<const Run> runs, std::span<const std::string> labels) {
  struct Distinct {
    const LadderReport* ladder;
    const Run* run;
    std::string kind;
    std::vector<std::string> owners;
  };
  std::vector<Distinct> distinct;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto& ladder = runs[i].summary.ladder;
    if (!ladder) continue;
    const std::string kind = kind_of(*ladder);
    auto same = std::find_if(distinct.begin(), distinct.end(),
                             [&](const Distinct& other) { return other.kind == kind; });
    if (same == distinct.end()) same = distinct.insert(same, {&*ladder, &runs[i], kind, {}});
    same->owners.push_back(labels[i]);
  }
  Markup all;
  for (const auto& [ladder, run, kind, owners] : distinct) {
    if (distinct.size() > 1) all += element("p", {{"class", "lead"}}, in_short(owners));
    all += element("p", {}, typeset(verdict_in_words(*ladder)));
    for (const std::string& doubt : doubts_in_words(*ladder))
      all += element("p", {{"class", "message"}}, typeset(doubt));
    all += element("figure", {{"class", "diagram scroll"}}, ladder_diagram(*ladder));
    all += ladder_table(*ladder);
    all += ladder_in_words(*ladder, brackets_of(*run, *ladder));
  }
  if (distinct.empty()) return {};
  return element("p", {{"class", "lead"}},
                 typeset("M_k = τ(S_k), S_{k+1} = S_k ∩ TM_k, until nothing changes.")) +
         all;
}

Markup experiments(std::span<const Run> runs, std::span<const std::string> labels) {
  Markup all;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string text = runs[i].experiment.dump(2, ' ', false, Json::error_handler_t::replace);
    all +=
        element("details", {},
                element("summary", {}, labels[i]) + element("pre", {}, element("code", {}, text)));
  }
  return all;
}

// The figures of a page, which have copies of all rows: made once.
struct PageFigures {
  explicit PageFigures(std::span<const Run> runs)
      : motion(motion_figures(runs)),
        energy(energy_figures(runs)),
        constraints(constraint_figure(runs)),
        observables(observable_figure(runs)) {}

  std::vector<const plot::Series*> all_series() const {
    std::vector<const plot::Series*> all;
    const auto add = [&](const Figure& figure) {
      for (const plot::Panel& panel : figure.panels)
        for (const plot::Series& series : panel.series) all.push_back(&series);
    };
    for (const Figure& figure : motion) add(figure);
    for (const Figure& figure : energy) add(figure);
    if (constraints) add(*constraints);
    if (observables) add(*observables);
    return all;
  }

  std::vector<Figure> motion, energy;
  std::optional<Figure> constraints, observables;
};

// The page with at most `rows` rows of each curve for the script.
std::string page_with_rows(std::span<const Run> runs, const PageFigures& made, std::size_t rows) {
  const std::vector<std::string> labels = run_labels(runs);
  const std::string title = page_title(runs);
  Figures figures(rows);
  Markup body = element("h1", {}, title) + report_head(runs) + messages(runs, labels);
  body += page_section("Motion", figures.add(made.motion));
  body += page_section("Energy", figures.add(made.energy));
  body += page_section("Constraint algorithm", ladders(runs, labels));
  body += page_section("Constraints", figures.add(made.constraints));
  body += page_section("Expectations", expectations_table(runs, labels));
  body +=
      page_section("Observables", figures.add(made.observables) + observables_table(runs, labels));
  body += page_section("Runs and solver", runs_table(runs, labels));
  body += page_section("Experiments", experiments(runs, labels));
  body += element("footer", {}, "Made by courant report.");
  return whole_page(title, body, plot::script(report_script()));
}

// The greatest number of rows with which the page stays below a megabyte.
std::size_t rows_for_script(std::span<const Run> runs, const PageFigures& figures) {
  constexpr std::size_t most_bytes = 950'000;
  const std::size_t size = page_with_rows(runs, figures, fewest_rows).size();
  const std::size_t rest = most_bytes - std::min(most_bytes, size);
  return std::max(fewest_rows, plot::rows_that_fit(figures.all_series(), rest));
}

}  // namespace

std::string report_html(std::span<const Run> runs) {
  if (runs.empty())
    throw std::invalid_argument("report_html: there are no runs, expected at least one.");
  const PageFigures figures(runs);
  return page_with_rows(runs, figures, rows_for_script(runs, figures));
}

void write_report(std::span<const Run> runs, const std::filesystem::path& output, bool force) {
  const OwnFiles files("report", force);
  files.check(output);
  files.write(output, report_html(runs));
}

}  // namespace courant
