#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <istream>
#include <memory>
#include <ostream>
#include <sstream>

#include "courant/cli/command.hpp"
#include "courant/cli/force.hpp"
#include "courant/cli/text.hpp"
#include "courant/core/files/own_file.hpp"
#include "courant/core/files/work_folder.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/reporting/ladder_diagram.hpp"
#include "courant/reporting/ladder_page.hpp"
#include "courant/reporting/prose_typesetting.hpp"
#include "courant/reporting/tour_chapters.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/discrete_ladder.hpp"
#include "courant/running/ladder_report.hpp"
#include "courant/running/other_values.hpp"

namespace courant::cli {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// What a chapter shows of the output of its command: not the table of levels, whose residuals are
// round-off, nor what the ranks rest on.
std::string shown_part(const std::string& output) {
  std::string text;
  bool is_table = false;
  for (const std::string& line : lines_of(output)) {
    if (line.starts_with("  k  dim S")) is_table = true;
    if (line.starts_with("  How sure:")) break;
    if (!is_table) text += line + "\n";
    if (is_table && line.empty()) is_table = false;
  }
  while (text.starts_with("\n")) text.erase(0, 1);
  while (text.ends_with("\n\n")) text.pop_back();
  return text;
}

// What of a run is the same on every machine: what was expected, and whether it came out.
std::string expectations(const std::string& output) {
  std::string text;
  for (const std::string& line : lines_of(output)) {
    std::istringstream in(line);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    // … value bound passed
    if (words.size() < 4 || (words.back() != "passed" && words.back() != "FAILED")) continue;
    text += " ";
    for (std::size_t i = 0; i + 3 < words.size(); ++i) text += " " + words[i];
    text += ", allowed " + words[words.size() - 2] + ": " + words.back() + "\n";
  }
  return text;
}

// In lines of at most `columns` characters; what is read from rows of a table needs them whole.
std::string output_of(const TourChapter& chapter, const Console& console, std::size_t columns) {
  constexpr std::size_t whole = 1000;
  std::istringstream in(chapter.experiment);
  std::ostringstream out, err;
  const Console inner{.in = in,
                      .out = out,
                      .err = err,
                      .columns = chapter.arguments[0] == "run" ? whole : columns,
                      .stop = console.stop};
  std::vector<std::string> arguments = chapter.arguments;
  if (arguments[0] != "run") {
    command(arguments, inner);
    return shown_part(out.str()) + err.str();
  }
  // A run writes a folder, which is not the reader's.
  const WorkFolder folder;
  arguments.insert(arguments.end(), {"-o", (folder.path() / "run").string()});
  command(arguments, inner);
  return expectations(out.str()) + err.str();
}

std::string command_line(const TourChapter& chapter) {
  std::string line = "courant";
  for (const std::string& argument : chapter.arguments)
    line += " " + (argument == "-" ? chapter.file + ".json" : argument);
  return line;
}

void print_paragraphs(const Console& console, const std::string& text) {
  for (const std::string& paragraph : lines_of(text))
    print_wrapped(console, marked_prose(paragraph).str(), "  ");
}

// Waits for Enter where someone is there to press it; whether they did.
bool wait(const Console& console, const std::string& what) {
  if (!console.is_terminal) return false;
  console.out << "\n  (Enter for " << what << ") " << std::flush;
  std::string line;
  return static_cast<bool>(std::getline(console.in, line));
}

void print_chapter(const Console& console, std::size_t number) {
  const TourChapter& chapter = tour_chapters()[number - 1];
  std::ostream& out = console.out;
  out << number << ". " << chapter.title << "\n\n";
  print_paragraphs(console, chapter.idea);
  out << '\n';
  for (const std::string& line : lines_of(chapter.experiment)) out << "    " << line << '\n';
  out << '\n';
  print_paragraphs(console, "Question: " + chapter.question);
  wait(console, "the answer");
  out << "\n  $ " << command_line(chapter) << "\n\n";
  const std::string indent = "  ";
  for (const std::string& line :
       lines_of(output_of(chapter, console, console.columns - indent.size())))
    out << (line.empty() ? "" : indent) << line << '\n';
  out << '\n';
  print_paragraphs(console, "Answer: " + chapter.answer);
  out << '\n';
  print_paragraphs(console, "Exercise: " + chapter.exercise);
  wait(console, "the solution");
  print_paragraphs(console, "Solution: " + chapter.solution);
}

// This chapter and, as long as someone presses Enter, those after it.
void print_chapters(const Console& console, std::size_t number) {
  print_chapter(console, number);
  while (number < tour_chapters().size() &&
         wait(console, "chapter " + std::to_string(number + 1))) {
    console.out << '\n';
    print_chapter(console, ++number);
  }
}

// What the command of a chapter finds, as a page.
LadderPage page_of_chapter(const TourChapter& chapter) {
  const Experiment experiment = read_experiment(chapter.experiment);
  const ConsistentStart start = consistent_start(experiment);
  const ImplicitSystem& system = *experiment.model.system;
  const ConstraintFormulas formulas = formulas_of_start(experiment, start);
  const auto has = [&](const char* option) {
    return std::ranges::find(chapter.arguments, option) != chapter.arguments.end();
  };
  if (has("--discrete")) {
    LadderPage page = ladder_page(experiment, discrete_ladder(experiment, start));
    page.sections.clear();
    LadderPage::Section words{"Verdict", {}};
    for (const std::string& line : discrete_ladder_in_words(experiment, page.ladder))
      words.paragraphs.push_back({line, false});
    page.sections.push_back(std::move(words));
    return page;
  }
  LadderReport ladder = report_of_start(experiment, start);
  if (has("--level"))
    return ladder_page(experiment,
                       up_to_level(std::move(ladder), std::stoi(chapter.arguments.back())));
  return ladder_page(experiment, ladder, constraint_brackets(system, start, formulas));
}

std::string folding(const std::string& title, const std::string& text) {
  return "<details>\n<summary>" + title + "</summary>\n\n" + text + "\n</details>\n\n";
}

std::string page_in_markdown(const Console& console, std::size_t number, const LadderPage& found) {
  const TourChapter& chapter = tour_chapters()[number - 1];
  const auto words = [](const std::string& text) { return markdown_prose(marked_prose(text)); };
  std::string page = "# " + std::to_string(number) + ". " + chapter.title + "\n\n";
  for (const std::string& paragraph : lines_of(chapter.idea)) page += words(paragraph) + "\n\n";
  page += "```json\n" + chapter.experiment + "\n```\n\n";
  page += "**Question.** " + words(chapter.question) + "\n\n";
  page += folding("Answer", words(chapter.answer) + "\n\n![The ladder](" + chapter.file +
                                ".svg)\n\n" + sections_in_markdown(found));
  page += folding("What the command prints", "```text\n$ " + command_line(chapter) + "\n" +
                                                 output_of(chapter, console, console.columns) +
                                                 "```\n");
  page += "**Exercise.** " + words(chapter.exercise) + "\n\n";
  page += folding("Solution", words(chapter.solution) + "\n");
  if (number < tour_chapters().size())
    return page + "Next: [" + tour_chapters()[number].title + "](" + tour_chapters()[number].file +
           ".md)\n";
  return page +
         "Next: [the constraint algorithm](../constraint-algorithm.md) as a text, with what it "
         "rests on.\n";
}

// The chapter as files: its experiment, its page as text and as a page of a browser, its picture.
void write_chapter(const Console& console, std::size_t number, const std::filesystem::path& folder,
                   bool force) {
  const TourChapter& chapter = tour_chapters()[number - 1];
  const LadderPage found = page_of_chapter(chapter);
  const OwnFiles files("tour", force);
  const std::vector<std::pair<const char*, std::string>> contents = {
      {".json", chapter.experiment + "\n"},
      {".md", page_in_markdown(console, number, found)},
      {".svg", ladder_diagram(found.ladder).str() + "\n"},
      {".html", to_html(found)}};
  for (const auto& [ending, content] : contents) files.check(folder / (chapter.file + ending));
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);  // what is wrong with it, writing says
  for (const auto& [ending, content] : contents) {
    const std::filesystem::path file = folder / (chapter.file + ending);
    files.write(file, content);
    console.out << shown_name(file) << '\n';
  }
}

std::string chapter_numbers() {
  std::string list = "1";
  for (std::size_t i = 2; i <= tour_chapters().size(); ++i) list += "|" + std::to_string(i);
  return list;
}

void print_contents(const Console& console) {
  console.out
      << "The constraint algorithm in ten chapters, each one idea on a system that runs.\n\n";
  for (std::size_t i = 0; i < tour_chapters().size(); ++i)
    console.out << (i < 9 ? "  " : " ") << i + 1 << "  " << tour_chapters()[i].title << '\n';
  console.out << "\n`courant tour 1` begins.\n";
  if (wait(console, "chapter 1")) {
    console.out << '\n';
    print_chapters(console, 1);
  }
}

}  // namespace

void add_tour(CLI::App& app, Session& session) {
  struct Arguments {
    std::size_t chapter = 0;
    bool markdown = false, force = false;
    std::filesystem::path folder;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* tour = app.add_subcommand("tour", "The constraint algorithm in ten chapters");
  CLI::Option* chapter =
      tour->add_option("CHAPTER", arguments->chapter, "its number; without, the contents")
          ->check(CLI::Range(std::size_t{1}, tour_chapters().size()).description(""))
          ->type_name(chapter_numbers());
  CLI::Option* markdown =
      tour->add_flag("--markdown", arguments->markdown, "print the page of docs/tour")
          ->needs(chapter);
  tour->add_option("-o", arguments->folder,
                   "write the files of the chapter into a folder: experiment, page, picture")
      ->type_name("DIR")
      ->needs(chapter)
      ->excludes(markdown);
  add_force(*tour, arguments->force);
  tour->callback([&session, arguments] {
    session.action = [arguments](const Console& console) -> int {
      if (arguments->chapter == 0)
        print_contents(console);
      else if (!arguments->folder.empty())
        write_chapter(console, arguments->chapter, arguments->folder, arguments->force);
      else if (arguments->markdown)
        console.out << page_in_markdown(console, arguments->chapter,
                                        page_of_chapter(tour_chapters()[arguments->chapter - 1]));
      else
        print_chapters(console, arguments->chapter);
      return done;
    };
  });
}

}  // namespace courant::cli
