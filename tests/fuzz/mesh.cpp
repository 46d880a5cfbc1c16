// Meshes of Gmsh: whole commands whose experiment has any text as its mesh.
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "answer.hpp"
#include "mutation.hpp"
#include "words_in_lines.hpp"

namespace courant::fuzz {

namespace {

// A word, or a line, is replaced by another one of the mesh or by a number at an edge, left out or doubled.
void mutate_mesh(Lines& lines, Generator& generator) {
  static const std::vector<std::string> words = {"0",
                                                 "-1",
                                                 "1",
                                                 "2",
                                                 "4",
                                                 "15",
                                                 "16",
                                                 "1000000",
                                                 "1000001",
                                                 "2147483648",
                                                 "9223372036854775807",
                                                 "-9223372036854775808",
                                                 "18446744073709551616",
                                                 "1e308",
                                                 "-1e308",
                                                 "5e-324",
                                                 "1e-17",
                                                 "nan",
                                                 "inf",
                                                 "0x1",
                                                 "\"",
                                                 "\"rim\"",
                                                 "\"a b",
                                                 "$Nodes",
                                                 "$Elements",
                                                 "$Entities",
                                                 "$PhysicalNames",
                                                 "$EndNodes",
                                                 "2.2",
                                                 "4.1"};
  const std::size_t at = below(lines.size(), generator);
  switch (below(6, generator)) {
    case 0:
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
      return;
    case 1:
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at),
                   std::vector<std::string>(lines[below(lines.size(), generator)]));
      return;
    default:
      break;
  }
  mutate_word(lines, at, words, generator,
              [](std::vector<std::string>& line, std::string&) { line.pop_back(); });
}

constexpr const char* kExperiment = R"json({
  "system": { "type": "stokes-dirac", "complex": { "mesh": "m.msh" }, "states": ["p", "q"],
    "efforts": ["v", "F"], "energy": { "p": "p^2/2", "q": "q^2/2" },
    "boundary": { "rim": { "v": 0 } } },
  "initial": { "p": { "form": "x" } }, "method": "discretize-first",
  "time": { "step": 0.01, "end": 0.05 } })json";

}  // namespace

}  // namespace courant::fuzz

// Three of four executions change the lines and words of the mesh rather than its letters.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  return courant::fuzz::mutate_lines(data, size, most, seed, courant::fuzz::mutate_mesh);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace courant::fuzz;
  static const std::string folder = [] {
    const std::string made = empty_folder();
    std::ofstream(made + "/e.json") << kExperiment;
    return made;
  }();
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::ofstream(folder + "/m.msh", std::ios::binary) << text;
  require_answer({"run", folder + "/e.json", "--quiet", "--force", "--backend", "interpreter", "-o",
                  folder + "/run"},
                 text);
  return 0;
}
