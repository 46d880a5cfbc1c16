// Experiments: whole commands with any text as an experiment.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "answer.hpp"
#include "document_mutation.hpp"
#include "long_number.hpp"
#include "words.hpp"

namespace courant::fuzz {

namespace {

// Systems of thousands of repeated elements take minutes with the sanitizers, and find nothing that a few
// do not.
bool repeats_often(const std::string& text) {
  if (text.find("\"repeat\"") == std::string::npos) return false;
  std::size_t digits = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_digit = text[i] >= '0' && text[i] <= '9';
    if (text[i] == 'e' && digits > 0) return true;
    digits = is_digit ? digits + 1 : 0;
    if (digits > 2) return true;
  }
  return false;
}

// Half a million terms take some 20 s with the sanitizers before the command looks at its alarm.
bool has_long_sum(const std::string& text) {
  return text.find("sum(") != std::string::npos && has_long_number(text);
}

// A program of C without its comments and texts, as a compiler reads it: trigraphs and lines that are
// continued first.
std::string code_of(std::string program) {
  for (const std::string_view continued : {"?\?/\n", "\\\n"})
    for (std::size_t at; (at = program.find(continued)) != program.npos;)
      program.erase(at, continued.size());
  std::string code;
  for (std::size_t i = 0; i < program.size(); ++i) {
    const char letter = program[i];
    if (program.compare(i, 2, "/*") == 0) {
      i = program.find("*/", i + 2);
      if (i == program.npos) break;
      ++i;
    } else if (program.compare(i, 2, "//") == 0) {
      i = std::min(program.find('\n', i), program.size());
    } else if (letter == '"' || letter == '\'') {
      for (++i; i < program.size() && program[i] != letter && program[i] != '\n'; ++i)
        if (program[i] == '\\') ++i;
    } else {
      code += letter;
    }
  }
  return code;
}

// What somebody wrote into an experiment is no code of the program that is made of it.
void require_no_planted_code(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string program{std::istreambuf_iterator<char>(stream), {}};
  require(code_of(program).find(planted_word) == std::string::npos, "a text became code", program);
}

}  // namespace

}  // namespace courant::fuzz

// Three of four executions change the document rather than its letters, so that they come farther.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  using namespace courant::fuzz;
  return mutate_text(data, size, most, seed,
                     [](const std::string& text, std::size_t times, Generator& generator) {
                       Json document = Json::parse(text, nullptr, false);
                       if (document.is_discarded()) return std::string();
                       for (; times > 0; --times) mutate_document(document, generator);
                       return document.dump(-1, ' ', false, Json::error_handler_t::replace);
                     });
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string& folder = courant::fuzz::run_folder();
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (courant::fuzz::repeats_often(text) || courant::fuzz::has_long_sum(text)) return 0;
  // Which command it is depends on the text, so that a text that fails fails again.
  const std::vector<std::vector<std::string>> commands = {
      {"run", "-", "--quiet", "--force", "--backend", "interpreter", "-o", folder},
      {"run", "-", "--quiet", "--force", "--backend", "interpreter", "-o", folder},
      {"constraints", "-"},
      {"export", "-", "--language", "c", "-o", folder + ".c", "--force"},
      {"check", "-", "--brief"}};
  // Laws of a large system take seconds with the sanitizers, and nothing stops them.
  constexpr std::size_t longest_checked = 1000;
  const std::size_t kinds = commands.size() - (size > longest_checked ? 1 : 0);
  const std::vector<std::string>& command = commands[std::hash<std::string>()(text) % kinds];
  const courant::fuzz::Answer answer = courant::fuzz::require_answer(command, text);
  if (command.front() == "export" && answer.status == 0)
    courant::fuzz::require_no_planted_code(folder + ".c");
  return 0;
}
