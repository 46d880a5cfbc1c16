// Netlists of SPICE: whole commands that read any text as one.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "importing.hpp"
#include "mutation.hpp"
#include "words_in_lines.hpp"

namespace courant::fuzz {

namespace {

// A word, or a line, is replaced by another one of the netlist or of the language, left out or doubled.
void mutate_netlist(Lines& lines, Generator& generator) {
  static const std::vector<std::string> words = {"0",
                                                 "-1",
                                                 "1e308",
                                                 "1e-308",
                                                 "5e-324",
                                                 "-0",
                                                 "1f",
                                                 "1meg",
                                                 "1e17",
                                                 "nan",
                                                 "inf",
                                                 "{1/0}",
                                                 "{a}",
                                                 "'x+1'",
                                                 "dc",
                                                 "ac",
                                                 "sin(0 1 1k)",
                                                 "pulse(0 1 0 0 0 0 0)",
                                                 "pwl(0 0 1 1 1 2)",
                                                 "pwl(1 0 0 1)",
                                                 "exp(0 1 0 0 0 0)",
                                                 "sffm(0 1 1 1 1)",
                                                 "ic=1e308",
                                                 "m=0",
                                                 "m=-1",
                                                 "uic",
                                                 "off",
                                                 "tc=1,1",
                                                 "k=1",
                                                 "poly(2)",
                                                 "v(a)",
                                                 "i(V1)",
                                                 "=",
                                                 "(",
                                                 ")",
                                                 ",",
                                                 "+",
                                                 "*",
                                                 "D",
                                                 "NPN",
                                                 "NMOS",
                                                 "SW",
                                                 "gnd"};
  static const std::vector<std::vector<std::string>> statements = {
      {".param", "a=1/0"},
      {".param", "a={b}", "b={a}"},
      {".ic", "v(a)=1e308"},
      {".nodeset", "v(a)=1"},
      {".tran", "0", "0"},
      {".tran", "1u", "1m", "uic"},
      {".tran", "1e-300", "1e300"},
      {".model", "d", "d", "is=0"},
      {".model", "d", "d", "n=0", "rs=1e308"},
      {".subckt", "s", "a", "b"},
      {".ends"},
      {".end"},
      {"X1", "a", "0", "s"},
      {"R9", "a", "a", "1"},
      {"L9", "a", "0", "0"},
      {"C9", "a", "0", "-1u"},
      {"K9", "L1", "L2", "1"},
      {"K9", "L1", "L1", "0.5"},
      {"E9", "a", "0", "a", "0", "1"},
      {"B9", "a", "0", "v=sqrt(v(a))"},
      {"B9", "a", "0", "i=log(v(a))"},
      {"V9", "a", "0", "1"},
      {"V9", "a", "0", "sin(0", "1e308", "1e308)"},
      {".include", "x"},
      {".lib", "x", "y"},
      {"S9", "a", "0", "a", "0", "sw"},
      {"+", "1"},
      {"T9", "a", "0", "b", "0", "z0=50", "td=0"}};
  const std::size_t at = below(lines.size(), generator);
  switch (below(7, generator)) {
    case 0:
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
      return;
    case 1:
      lines.push_back(lines[at]);
      return;
    case 2:
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at),
                   statements[below(statements.size(), generator)]);
      return;
    case 3:
      std::swap(lines[at], lines[below(lines.size(), generator)]);
      return;
    default:
      break;
  }
  // Another kind of element.
  mutate_word(lines, at, words, generator, [&](std::vector<std::string>&, std::string& word) {
    constexpr std::string_view kinds = "RCLKVIEFGHBDQMSWTXJAOU.+*";
    word[0] = kinds[below(kinds.size(), generator)];
  });
}

}  // namespace

}  // namespace courant::fuzz

// Three of four executions change the lines and words of the netlist rather than its letters.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  return courant::fuzz::mutate_lines(data, size, most, seed, courant::fuzz::mutate_netlist);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  courant::fuzz::require_import({reinterpret_cast<const char*>(data), size});
  return 0;
}
