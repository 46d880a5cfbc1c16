#include "courant/running/study.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <ostream>
#include <span>

#include "courant/cli/backend.hpp"
#include "courant/cli/command.hpp"
#include "courant/cli/experiment_file.hpp"
#include "courant/cli/sweep.hpp"
#include "courant/cli/text.hpp"
#include "courant/cli/waiting.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/word_list.hpp"
#include "courant/reading/setting.hpp"
#include "courant/reporting/figure_file.hpp"
#include "courant/reporting/study_figure.hpp"
#include "courant/running/overdue.hpp"
#include "courant/running/result_folder.hpp"

namespace courant::cli {
namespace {

struct StudyArguments {
  std::vector<std::string> files;
  std::vector<std::string> methods;
  StudyOptions study;
  Backend::Kind backend = Backend::Kind::automatic;
  std::string folder;
  std::vector<std::string> settings;
  SweepArguments sweep;
  bool force = false, json = false;
};

std::string name_of(const std::string& file) {
  return file == "-" ? "stdin" : std::filesystem::path(file).stem().string();
}

// The experiment of a document, with each of the methods, or with its own.
void add_subjects(const std::string& name, Json document, const std::vector<std::string>& methods,
                  std::vector<StudySubject>& subjects) {
  if (methods.empty()) subjects.push_back({name, read_experiment_document(document)});
  for (const std::string& method : methods) {
    const Setting setting = read_setting("/method=" + method, "--method");
    apply_setting(setting, document);
    subjects.push_back({name, read_experiment_document(document)});
  }
}

void print_study(const Console& console, const StudyReport& study) {
  std::ostream& out = console.out;
  for (const StudyReport::Method& method : study.methods) {
    out << printable(method.experiment) << ": " << method.method << '\n';
    TextTable table({"  step", "error", "order", "iterations/step", "seconds"});
    for (const StudyReport::Row& row : method.rows)
      table.add({"  " + shown(row.step), shown_if_known(row.error, 4), shown_if_known(row.order, 3),
                 shown(static_cast<double>(row.iterations) / static_cast<double>(row.steps), 3),
                 shown_if_known(row.seconds, 3)});
    table.print(out, "");
    out << "  order " << shown_if_known(method.order.value_or(StudyReport::kUnknown), 3)
        << "; reference: " << method.reference;
    if (method.reference_error > 0.0) out << ", off by some " << shown(method.reference_error, 1);
    out << '\n';
    if (!method.remark.empty()) print_wrapped(console, method.remark, "  ");
    for (const StudyReport::Row& row : method.rows)
      if (!row.message.empty())
        print_wrapped(console, "step " + shown(row.step) + ": " + row.message, "  ");
    out << '\n';
  }
  if (const auto quantities = study.quantities()) {
    constexpr std::size_t most = 8;
    const auto told = std::span(*quantities).first(std::min(quantities->size(), most));
    print_wrapped(console,
                  "The error is the greatest distance of (" + word_list(told) +
                      (quantities->size() > most ? ", …" : "") + ") from the reference.",
                  "");
  }
}

void write_files(const ResultFolder& folder, const StudyReport& study) {
  const auto figure = study_figure(study);
  folder.write(to_json(study), study_csv(study), figure ? figure_svg(*figure) : "");
}

int status_of_study(const StudyReport& study) {
  if (study.is_interrupted) return interrupted;
  for (const StudyReport::Method& method : study.methods)
    for (const StudyReport::Row& row : method.rows)
      if (!row.message.empty()) return failed;
  return done;
}

void tell(const Console& console, const StudyArguments& arguments, const std::string& names,
          const StudyReport& study) {
  if (!arguments.folder.empty())
    write_files(ResultFolder(arguments.folder, "study", arguments.force), study);
  if (arguments.json)
    console.out << to_json(study).dump(2) << '\n';
  else
    print_study(console, study);
  if (study.is_interrupted) print_error(console, names + ": interrupted");
}

int study_files(const Console& console, const StudyArguments& arguments) {
  if (!arguments.folder.empty()) ResultFolder::check(arguments.folder, "study", arguments.force);
  std::vector<StudySubject> subjects;
  for (const std::string& file : arguments.files) {
    const auto add = [&](const Json& document) {
      add_subjects(name_of(file), document, arguments.methods, subjects);
      return done;
    };
    if (const int status = with_document(console, file, add, arguments.settings); status != done)
      return status;
  }
  StudyOptions options = arguments.study;
  options.backend = arguments.backend;
  options.stop = console.stop;
  std::optional<Waiting> waiting;
  options.on_progress = [&](const std::string& what) {
    waiting.reset();
    waiting.emplace(console, what);
  };
  const std::string names =
      arguments.files.size() == 1 ? arguments.files.front() : arguments.files.front() + ", …";
  std::mutex mutex;
  StudyReport known{.is_interrupted = true,
                    .methods = {}};  // of the methods that have been studied
  options.on_method = [&](const StudyReport::Method& method) {
    const std::scoped_lock lock(mutex);
    known.methods.push_back(method);
  };
  std::optional<Overdue> overdue;
  if (console.heeds_stop) {
    overdue.emplace(console.stop, [&] {
      end_overdue(console, [&] {
        const std::scoped_lock lock(mutex);
        tell(console, arguments, names, known);
        return interrupted;
      });
    });
    *console.heeds_stop = true;
  }
  StudyReport result;
  const int status = reporting_errors(console, names, [&] {
    result = study(subjects, options);
    return done;
  });
  overdue.reset();
  waiting.reset();
  if (console.heeds_stop) *console.heeds_stop = false;
  if (status != done) return status;
  tell(console, arguments, names, result);
  return status_of_study(result);
}

Json study_case(const SweepCase& one, const std::filesystem::path& folder,
                const StudyArguments& arguments, const Console& console) {
  StudyOptions options = arguments.study;
  options.backend = arguments.backend;
  options.stop = console.stop;
  const StudySubject subject{one.name, read_experiment_document(one.document)};
  const StudyReport result = study(std::span(&subject, 1), options);
  if (result.is_interrupted)
    return {{"status", "interrupted"}, {"message", "interrupted"}, {"values", Json::object()}};
  std::string written;
  if (!folder.empty()) {
    const ResultFolder mine(folder / one.name, "study", arguments.sweep.resume);
    write_files(mine, result);
    written = one.name;
  }
  const StudyReport::Method& method = result.methods.front();
  std::string message = method.remark;
  for (const StudyReport::Row& row : method.rows)
    if (message.empty()) message = row.message;
  // The names and values of study.json.
  const Json of_method = to_json(result).at("methods").front();
  const Json& last = of_method.at("rows").back();
  return {{"folder", written},
          {"status", "completed"},
          {"message", message},
          {"as_expected", status_of_study(result) == done},
          {"seconds", last.at("seconds")},
          {"values",
           {{"method", of_method.at("method")},
            {"order", of_method.at("order")},
            {"step", last.at("step")},
            {"error", last.at("error")},
            {"iterations", last.at("iterations")},
            {"reference", of_method.at("reference")},
            {"reference_error", of_method.at("reference_error")}}}};
}

int study_cases(const Console& console, const StudyArguments& arguments) {
  return run_sweep(console, {.file = arguments.files.front(),
                             .settings = arguments.settings,
                             .sweep = arguments.sweep,
                             .folder = arguments.folder,
                             .replace = arguments.force,
                             .json = arguments.json,
                             .action =
                                 [&](const SweepCase& one, const std::filesystem::path& folder) {
                                   return study_case(one, folder, arguments, console);
                                 },
                             .columns = {{"method", "method"},
                                         {"order", "order"},
                                         {"step", "smallest step"},
                                         {"error", "error there"},
                                         {"seconds", "seconds"}}});
}

}  // namespace

void add_study(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<StudyArguments>();
  CLI::App* study = app.add_subcommand(
      "study", "Measure the error of methods against step size and work, and their order");
  study
      ->add_option("FILE", arguments->files,
                   "experiments, whose method is studied at their step, a half of it, …; or - for "
                   "standard input")
      ->required();
  CLI::Option* methods =
      study
          ->add_option("--method", arguments->methods,
                       "a method instead of that of the experiment, as in --method rk4 or "
                       "--method '{\"type\": …}'; may be repeated")
          ->type_name("METHOD")
          ->expected(1)
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  study
      ->add_option("--steps", arguments->study.steps,
                   "how many step sizes, 2 to 16, each a half of the one before (default: 5)")
      ->check(CLI::Range(2, 16).description(""))
      ->type_name("N");
  study
      ->add_option("--of", arguments->study.quantities,
                   "a coordinate or observable whose error is measured; may be repeated (default: "
                   "what has a closed form, or else all coordinates)")
      ->type_name("NAME")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_backend(*study, arguments->backend);
  add_settings(*study, arguments->settings);
  add_sweep(*study, arguments->sweep);
  study->get_option("--sweep")->excludes(methods);
  study->add_flag("--json", arguments->json, "print JSON");
  CLI::Option* folder =
      study
          ->add_option("-o", arguments->folder,
                       "where table and figure go, as study.json, study.csv and study.svg")
          ->type_name("DIR");
  study->add_flag("--force", arguments->force, "replace a study that is in the folder already")
      ->needs(folder);
  study->callback([&session, arguments] {
    const bool is_sweep = !arguments->sweep.ranges.empty();
    if (is_sweep && arguments->files.size() > 1)
      throw CLI::ValidationError("--sweep", "is one of a single FILE");
    session.action = [arguments, is_sweep](const Console& console) {
      return is_sweep ? study_cases(console, *arguments) : study_files(console, *arguments);
    };
  });
}

}  // namespace courant::cli
