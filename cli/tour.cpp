#include <CLI/CLI.hpp>
#include <istream>
#include <memory>
#include <ostream>
#include <sstream>

#include "courant/cli/command.hpp"
#include "courant/cli/text.hpp"
#include "courant/core/files/work_folder.hpp"
#include "courant/reporting/tour_chapters.hpp"

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

std::string output_of(const TourChapter& chapter, const Console& console) {
  std::istringstream in(chapter.experiment);
  std::ostringstream out, err;
  const Console inner{
      .in = in, .out = out, .err = err, .columns = console.columns, .stop = console.stop};
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
  for (const std::string& paragraph : lines_of(text)) print_wrapped(console, paragraph, "  ");
}

// Waits for Enter where someone is there to press it.
void wait(const Console& console) {
  if (!console.is_terminal) return;
  console.out << "\n  (Enter for the answer) " << std::flush;
  std::string line;
  std::getline(console.in, line);
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
  wait(console);
  out << "\n  $ " << command_line(chapter) << "\n\n";
  for (const std::string& line : lines_of(output_of(chapter, console)))
    out << (line.empty() ? "" : "  ") << line << '\n';
  out << '\n';
  print_paragraphs(console, "Answer: " + chapter.answer);
  out << '\n';
  print_paragraphs(console, "Exercise: " + chapter.exercise);
  wait(console);
  print_paragraphs(console, "Solution: " + chapter.solution);
}

void print_page(const Console& console, std::size_t number) {
  const TourChapter& chapter = tour_chapters()[number - 1];
  std::ostream& out = console.out;
  out << "# " << number << ". " << chapter.title << "\n\n";
  for (const std::string& paragraph : lines_of(chapter.idea)) out << paragraph << "\n\n";
  out << "```json\n" << chapter.experiment << "\n```\n\n";
  out << "**Question.** " << chapter.question << "\n\n";
  out << "```text\n$ " << command_line(chapter) << '\n' << output_of(chapter, console) << "```\n\n";
  out << "**Answer.** " << chapter.answer << "\n\n";
  out << "**Exercise.** " << chapter.exercise << "\n\n";
  out << "**Solution.** " << chapter.solution << "\n\n";
  if (number < tour_chapters().size())
    out << "Next: [" << tour_chapters()[number].title << "](" << tour_chapters()[number].file
        << ".md)\n";
  else
    out << "Next: [the constraint algorithm](../constraint-algorithm.md) as a text, with what it "
           "rests on.\n";
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
}

}  // namespace

void add_tour(CLI::App& app, Session& session) {
  struct Arguments {
    std::size_t chapter = 0;
    bool markdown = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* tour = app.add_subcommand("tour", "The constraint algorithm in ten chapters");
  CLI::Option* chapter =
      tour->add_option("CHAPTER", arguments->chapter, "its number; without, the contents")
          ->check(CLI::Range(std::size_t{1}, tour_chapters().size()).description(""))
          ->type_name(chapter_numbers());
  tour->add_flag("--markdown", arguments->markdown, "print the page of docs/tour")->needs(chapter);
  tour->callback([&session, arguments] {
    session.action = [arguments](const Console& console) -> int {
      if (arguments->chapter == 0)
        print_contents(console);
      else if (arguments->markdown)
        print_page(console, arguments->chapter);
      else
        print_chapter(console, arguments->chapter);
      return done;
    };
  });
}

}  // namespace courant::cli
