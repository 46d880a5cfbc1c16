// Robots: whole commands that read any text as URDF, SDF or MJCF.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "importing.hpp"
#include "mutation.hpp"

namespace courant::fuzz {

namespace {

// Tags, and what is between them.
std::vector<std::string> pieces_of(const std::string& text) {
  std::vector<std::string> pieces;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end =
        text[i] == '<' ? text.find('>', i) : std::min(text.find('<', i), text.size()) - 1;
    if (end == std::string::npos) return {};
    pieces.push_back(text.substr(i, end - i + 1));
    i = end + 1;
  }
  return pieces;
}

// From a quotation mark to the next one, both within; npos if there is none.
std::pair<std::size_t, std::size_t> value_in(const std::string& piece, Generator& generator) {
  std::vector<std::pair<std::size_t, std::size_t>> values;
  for (std::size_t i = piece.find('"'); i != std::string::npos; i = piece.find('"', i + 1)) {
    const std::size_t end = piece.find('"', i + 1);
    if (end == std::string::npos) break;
    values.emplace_back(i + 1, end);
    i = end;
  }
  if (values.empty()) return {std::string::npos, 0};
  return values[below(values.size(), generator)];
}

// A tag or a text is left out, doubled or moved, or a value is replaced by another one of the robot or of the formats.
void mutate_pieces(std::vector<std::string>& pieces, Generator& generator) {
  static const std::vector<std::string> words = {
      "0",      "-1",       "1e308",     "1e30",    "1e-320",      "nan",       "inf",   "0 0 0",
      "1 0 0",  "0 0 1",    "1 2",       "",        "world",       "ground",    "t",     "sin",
      "fixed",  "floating", "planar",    "ball",    "universal",   "revolute2", "screw", "revolute",
      "free",   "hinge",    "slide",     "capsule", "ellipsoid",   "mesh",      "main",  "true",
      "degree", "xyzw",     "__model__", "a::b",    "0 0 0 0 0 0", "leg.xml",   "x",     "1 0 0 0"};
  static const std::vector<std::string> statements = {
      "<link name=\"x\"/>",
      "<inertial><mass value=\"0\"/></inertial>",
      "<mimic joint=\"elbow\"/>",
      "<freejoint/>",
      "<joint name=\"x\" type=\"ball\"/>",
      "<geom size=\"1\"/>",
      "<body><geom size=\"0.1\"/></body>",
      "<include file=\"leg.xml\"/>",
      "<frame name=\"x\" attached_to=\"x\"/>",
      "<pose relative_to=\"x\">0 0 0 0 0 0</pose>",
      "<static>true</static>",
      "<gravity>false</gravity>",
      "<default class=\"x\"><joint armature=\"1\"/></default>",
      "<equality><connect body1=\"bob\" anchor=\"0 0 0\"/></equality>",
      "<equality><weld body1=\"bob\"/></equality>",
      "<!DOCTYPE r [<!ENTITY a \"b\">]>",
      "<![CDATA[x]]>"};
  const std::size_t at = below(pieces.size(), generator);
  const std::size_t other = below(pieces.size(), generator);
  switch (below(8, generator)) {
    case 0:
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(at));
      return;
    case 1:
      pieces.insert(pieces.begin() + static_cast<std::ptrdiff_t>(at), std::string(pieces[other]));
      return;
    case 2:
      std::swap(pieces[at], pieces[other]);
      return;
    case 3:
      pieces.insert(pieces.begin() + static_cast<std::ptrdiff_t>(at),
                    statements[below(statements.size(), generator)]);
      return;
    default:
      break;
  }
  const std::string word = words[below(words.size(), generator)];
  if (pieces[at][0] != '<') {
    pieces[at] = word;
    return;
  }
  const auto [first, end] = value_in(pieces[at], generator);
  if (first == std::string::npos) return;
  const auto [of_other, other_end] = value_in(pieces[other], generator);
  if (below(2, generator) == 0 && of_other != std::string::npos)
    pieces[at] = pieces[at].substr(0, first) +
                 pieces[other].substr(of_other, other_end - of_other) + pieces[at].substr(end);
  else
    pieces[at] = pieces[at].substr(0, first) + word + pieces[at].substr(end);
}

}  // namespace

}  // namespace courant::fuzz

// Three of four executions change tags and values rather than letters.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  using namespace courant::fuzz;
  return mutate_text(data, size, most, seed,
                     [](const std::string& robot, std::size_t times, Generator& generator) {
                       auto pieces = pieces_of(robot);
                       if (pieces.size() < 2) return std::string();
                       for (; times > 0 && !pieces.empty(); --times)
                         mutate_pieces(pieces, generator);
                       std::string text;
                       for (const std::string& piece : pieces) text += piece;
                       return text;
                     });
}

// What begins with a comment of XML is read as a robot, not as a netlist.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  courant::fuzz::require_import("<!-- -->" +
                                std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
