#include "courant/lab/engine.hpp"

#include <exception>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"
#include "courant/extensions/spice/netlist.hpp"
#include "courant/reading/catalogue.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/reading/json_document.hpp"
#include "courant/reading/new_experiment.hpp"
#include "courant/reading/table.hpp"
#include "courant/reporting/figure_drawing.hpp"
#include "courant/reporting/ladder_page.hpp"
#include "courant/reporting/page_frame.hpp"
#include "courant/reporting/prose_typesetting.hpp"
#include "courant/reporting/report_figures.hpp"
#include "courant/reporting/report_tables.hpp"
#include "courant/reporting/tour_chapters.hpp"
#include "courant/running/c_program.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/discrete_ladder.hpp"
#include "courant/running/ladder_report.hpp"
#include "courant/running/other_values.hpp"
#include "courant/running/run_files.hpp"

namespace courant::lab {
namespace {

Json problem(const std::string& where, const std::string& what) {
  return {{"problems", {{{"where", where}, {"what", what}}}}};
}

Json listed(const std::vector<Problem>& problems) {
  Json list = Json::array();
  for (const Problem& one : problems) list.push_back({{"where", one.where}, {"what", one.what}});
  return list;
}

Json start() {
  Json chapters = Json::array();
  const auto set = [](const std::string& words) {
    return typeset_prose(marked_prose(words)).str();
  };
  for (const TourChapter& chapter : tour_chapters())
    chapters.push_back({{"file", chapter.file},
                        {"title", chapter.title},
                        {"idea", set(chapter.idea)},
                        {"experiment", chapter.experiment},
                        {"arguments", chapter.arguments},
                        {"question", set(chapter.question)},
                        {"answer", set(chapter.answer)},
                        {"exercise", set(chapter.exercise)},
                        {"solution", set(chapter.solution)}});
  Json kinds = Json::array();
  for (const Shelf& shelf : catalogue())
    if (shelf.name == "systems")
      for (const KindDescription& kind : shelf.kinds)
        if (!kind.example.is_null())
          kinds.push_back({{"type", kind.type}, {"summary", kind.sentence()}});
  return {{"style", content_style()}, {"chapters", chapters}, {"kinds", kinds}};
}

// The text of a file that lies beside the experiment; nothing where there is none of that name.
std::optional<std::string> file_beside(const Json& question, const std::string& name) {
  const auto files = question.find("files");
  if (files == question.end() || !files->contains(name)) return std::nullopt;
  return files->at(name).get<std::string>();
}

// An experiment with the tables that lie beside it.
Experiment experiment_of(const Json& question, const std::string& text) {
  Json document = parse_json(text);
  load_tables(document, [&](const std::string& pointer, const std::string& name) {
    auto table = file_beside(question, name);
    if (!table) {
      std::vector<std::string> names;
      const Json files = question.value("files", Json::object());
      for (const auto& [one, content] : files.items()) names.push_back(one);
      throw ExperimentError(pointer,
                            "is " + name +
                                ", which is not here; expected a file that was added under "
                                "Files" +
                                did_you_mean(name, names));
    }
    return TableFile{name, std::make_unique<std::istringstream>(std::move(*table))};
  });
  return read_experiment_document(document);
}

Experiment experiment_of(const Json& question) {
  return experiment_of(question, question.at("text").get<std::string>());
}

// The experiment that a netlist describes, which may include files that lie beside it.
Json imported(const Json& question) {
  std::vector<Problem> notes;
  const Json experiment =
      import_netlist(question.at("text").get<std::string>(), &notes, [&](const std::string& name) {
        auto text = file_beside(question, name);
        if (!text)
          throw std::runtime_error("is not here; expected a file that was added under Files");
        return std::move(*text);
      });
  return {{"document", experiment.dump(2)}, {"remarks", listed(notes)}};
}

struct PageOfLadder {
  LadderReport ladder;
  LadderPage page;
};

PageOfLadder constraint_algorithm(const Experiment& experiment) {
  const ConsistentStart start = consistent_start(experiment);
  const ImplicitSystem& system = *experiment.model.system;
  const ConstraintFormulas formulas = formulas_of_start(experiment, start);
  PageOfLadder found;
  found.ladder = ladder_report(start, system, formulas);
  tell_of_start(experiment, start, found.ladder);
  found.page = ladder_page(experiment, found.ladder, constraint_brackets(system, start, formulas));
  return found;
}

// Of a network: what is across its nodes, as potential_a, for eight of them.
Json waveforms(const Experiment& experiment) {
  constexpr std::size_t most = 8;
  Json names = Json::array();
  const Json& system = experiment.document.at("system");
  if (!system.is_object() || system.value("type", "") != "network") return names;
  for (const Vocabulary::Derived& derived : experiment.model.vocabulary.derived)
    for (const std::string& name : derived.names.element_names())
      for (const char* of_node : {"potential_", "velocity_", "speed_", "pressure_", "temperature_"})
        if (name.starts_with(of_node) && names.size() < most) names.push_back(name);
  return names;
}

Json ladder(const Json& question) {
  const Experiment experiment = experiment_of(question);
  const PageOfLadder found = constraint_algorithm(experiment);
  return {{"ladder", to_json(found.ladder)},
          {"title", found.page.title},
          {"page", to_markup(found.page).str()},
          {"method", experiment.method ? experiment.method->description : ""},
          {"waveforms", waveforms(experiment)},
          {"remarks", listed(experiment.remarks)}};
}

Json discrete(const Json& question) {
  const Experiment experiment = experiment_of(question);
  const LadderReport found = discrete_ladder(experiment, consistent_start(experiment));
  return {{"ladder", to_json(found)}, {"page", discrete_markup(experiment, found).str()}};
}

Json document(const Json& question) {
  const Experiment experiment = experiment_of(question);
  const std::string form = question.at("form");
  if (form == "c") return {{"document", c_program(experiment)}};
  const LadderPage page = constraint_algorithm(experiment).page;
  return {{"document", form == "latex"      ? to_latex(page)
                       : form == "markdown" ? to_markdown(page)
                                            : to_html(page)}};
}

TrajectoryTable table_of(const RunTable& rows) {
  std::vector<std::vector<double>> columns(rows.names.size());
  for (std::size_t i = 0; i < rows.values.size(); ++i)
    columns[i % rows.names.size()].push_back(rows.values[i]);
  return {rows.names, std::move(columns)};
}

// As the pages of reports have it.
Run told(const RunInMemory& run, const Json& document, std::size_t place) {
  Run result{.name = "run " + std::to_string(place + 1),
             .trajectory = table_of(run.rows),
             .summary = run.outcome.summary,
             .experiment = document};
  for (const auto& [name, rows] : run.events) result.events.emplace(name, table_of(rows));
  return result;
}

// Those with rows.
std::vector<Run> told(std::span<const RunInMemory> runs, std::span<const Json> documents) {
  std::vector<Run> all;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (runs[i].rows.rows() > 0) all.push_back(told(runs[i], documents[i], i));
  return all;
}

}  // namespace

Json Engine::run(const Json& question) {
  runs_.clear();
  std::vector<Json> documents;
  Json answers = Json::array();
  for (const Json& text : question.at("texts")) {
    const Experiment experiment = experiment_of(question, text.get<std::string>());
    if (!experiment.method || !experiment.time)
      return problem("", "There is no method to run it by; expected the keys method and time");
    RunInMemoryOptions options;
    options.run.on_progress = watch_;
    runs_.push_back(run_in_memory(experiment, options));
    documents.push_back(experiment.document);
    const RunOutcome& outcome = runs_.back().outcome;
    answers.push_back({{"status", to_string(outcome.status)},
                       {"message", outcome.message},
                       {"expected", outcome.as_expected()},
                       {"summary", to_json(outcome.summary)},
                       {"names", runs_.back().rows.names},
                       {"rows", runs_.back().rows.rows()}});
  }
  const std::vector<Run> all = told(runs_, documents);
  Json figures = Json::array();
  std::string tables;
  if (!all.empty()) {
    const auto rows = question.value("rows", std::size_t{2000});
    for (const Figure& figure : all_figures(all))
      figures.push_back({{"name", figure.name},
                         {"markup", panels_and_legend(figure, rows).str()},
                         {"svg", figure_svg(figure)},
                         {"caption", figure.caption}});
    const std::vector<std::string> labels = run_labels(all);
    tables =
        (expectations_table(all, labels) + observables_table(all, labels) + runs_table(all, labels))
            .str();
  }
  return {{"runs", answers}, {"figures", figures}, {"tables", tables}};
}

Json Engine::answer(const Json& question) {
  try {
    const std::string task = question.at("task");
    if (task == "start") return start();
    if (task == "ladder") return ladder(question);
    if (task == "discrete") return discrete(question);
    if (task == "document") return document(question);
    if (task == "import") return imported(question);
    if (task == "new") return {{"document", new_experiment(question.at("kind"))}};
    if (task == "run") return run(question);
    return problem("", "There is no task " + in_quotes(task));
  } catch (const ExperimentError& error) {
    return {{"problems", listed(error.problems())}};
  } catch (const std::bad_alloc&) {
    return problem("", "There is not enough memory for this in a browser");
  } catch (const std::exception& error) {
    return problem("", without_place(error.what()));
  }
}

}  // namespace courant::lab
