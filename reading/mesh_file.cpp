#include "courant/reading/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "courant/core/words/message.hpp"

namespace courant {
namespace {

constexpr std::size_t kMostMeshParts = 1'000'000;  // nodes, elements, words of a line

struct MeshElement {
  std::size_t line = 0;
  long dimension = 0;
  std::vector<long> groups;  // physical
  std::vector<long> nodes;
};

// The lines of a file, in words.
class MeshLines {
 public:
  explicit MeshLines(std::istream& file) : file_(file) {}

  std::size_t line() const { return line_; }
  [[noreturn]] void refuse(const std::string& what) const { throw MeshError(line_, what); }

  // The next line that has something in it; nothing at the end of the file.
  std::optional<std::vector<std::string>> next() {
    std::string text;
    while (std::getline(file_, text)) {
      ++line_;
      std::vector<std::string> words;
      std::size_t at = 0;
      while ((at = text.find_first_not_of(" \t\r", at)) != std::string::npos) {
        const std::size_t end = text[at] == '"'
                                    ? std::min(text.find('"', at + 1), text.size() - 1) + 1
                                    : std::min(text.find_first_of(" \t\r", at), text.size());
        words.push_back(text.substr(at, end - at));
        at = end;
        if (words.size() > kMostMeshParts)
          refuse("has more than " + std::to_string(kMostMeshParts) + " words; expected fewer");
      }
      if (!words.empty()) return words;
    }
    return std::nullopt;
  }
  std::vector<std::string> expect(std::size_t least) {
    const auto words = next();
    if (!words) refuse("is the end of the file in the middle of a section");
    if (words->size() < least)
      refuse("has " + std::to_string(words->size()) + " words; expected " + std::to_string(least) +
             " at least");
    return *words;
  }
  long integer(const std::string& word) const {
    long value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    // The least one has no absolute value.
    if (error != std::errc() || end != word.data() + word.size() ||
        value == std::numeric_limits<long>::min())
      refuse("has " + in_quotes(printable(word)) + "; expected a whole number");
    return value;
  }
  std::size_t count(const std::string& word) const {
    const long value = integer(word);
    if (value < 0 || static_cast<std::size_t>(value) > kMostMeshParts)
      refuse("has " + std::to_string(value) + " parts; expected 0 to " +
             std::to_string(kMostMeshParts));
    return static_cast<std::size_t>(value);
  }
  double number(const std::string& word) const {
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
      refuse("has " + in_quotes(printable(word)) + "; expected a number");
    return value;
  }

 private:
  std::istream& file_;
  std::size_t line_ = 0;
};

class GmshFile {
 public:
  explicit GmshFile(std::istream& file) : lines_(file) {}

  Json read() {
    auto words = lines_.next();
    if (!words || words->front() != "$MeshFormat")
      lines_.refuse("does not begin with $MeshFormat; expected a mesh of Gmsh");
    const auto format = lines_.expect(3);
    if ((format[0] != "2.2" && format[0] != "4.1") || format[1] != "0")
      lines_.refuse("has the format " + printable(format[0]) +
                    (format[1] == "0" ? "" : ", not as text") +
                    "; expected 2.2 or 4.1 as text (gmsh -format msh41)");
    is_new_ = format[0] == "4.1";
    while ((words = lines_.next())) {
      const std::string& section = words->front();
      if (section == "$PhysicalNames")
        names();
      else if (section == "$Entities" && is_new_)
        entities();
      else if (section == "$Nodes")
        is_new_ ? new_nodes() : old_nodes();
      else if (section == "$Elements")
        is_new_ ? new_elements() : old_elements();
    }
    return complex();
  }

 private:
  void names() {
    const std::size_t count = lines_.count(lines_.expect(1)[0]);
    for (std::size_t i = 0; i < count; ++i) {
      const auto words = lines_.expect(3);
      std::string name = words[2];
      std::erase(name, '"');
      names_[{lines_.integer(words[0]), lines_.integer(words[1])}] = name;
    }
  }
  // Which physical groups each entity belongs to.
  void entities() {
    const auto counts = lines_.expect(4);
    for (long dimension = 0; dimension <= 3; ++dimension) {
      const std::size_t count = lines_.count(counts[static_cast<std::size_t>(dimension)]);
      const std::size_t at = dimension == 0 ? 4 : 7;  // after a point, or the corners of a box
      for (std::size_t i = 0; i < count; ++i) {
        const auto words = lines_.expect(at + 1);
        const std::size_t groups = lines_.count(words[at]);
        if (words.size() < at + 1 + groups) lines_.refuse("ends before its physical groups");
        for (std::size_t g = 0; g < groups; ++g)
          // A negative number is a group on which the entity is turned round.
          groups_[{dimension, lines_.integer(words[0])}].push_back(
              std::abs(lines_.integer(words[at + 1 + g])));
      }
    }
  }
  // Each section has a bound of its own, but there may be many.
  void require_few(std::size_t parts, const char* of_what) const {
    if (parts > kMostMeshParts)
      lines_.refuse("is beyond " + std::to_string(kMostMeshParts) + " " + of_what +
                    " in all; expected fewer");
  }
  void add_node(long tag, const std::vector<std::string>& words, std::size_t first) {
    nodes_[tag] = {lines_.number(words[first]), lines_.number(words[first + 1]),
                   lines_.number(words[first + 2])};
    require_few(nodes_.size(), "nodes");
  }
  void old_nodes() {
    const std::size_t count = lines_.count(lines_.expect(1)[0]);
    for (std::size_t i = 0; i < count; ++i) {
      const auto words = lines_.expect(4);
      add_node(lines_.integer(words[0]), words, 1);
    }
  }
  void new_nodes() {
    const std::size_t blocks = lines_.count(lines_.expect(4)[0]);
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::size_t count = lines_.count(lines_.expect(4)[3]);
      std::vector<long> tags;
      for (std::size_t i = 0; i < count; ++i) tags.push_back(lines_.integer(lines_.expect(1)[0]));
      for (const long tag : tags) add_node(tag, lines_.expect(3), 0);
    }
  }
  void add_element(long type, const std::vector<long>& groups,
                   const std::vector<std::string>& words, std::size_t first) {
    static const std::map<long, long> dimensions{{15, 0}, {1, 1}, {2, 2}, {4, 3}};
    const auto dimension = dimensions.find(type);
    if (dimension == dimensions.end())
      lines_.refuse("has an element of the type " + std::to_string(type) +
                    "; expected points, edges, triangles or tetrahedra of first order");
    group_places_ += groups.size();
    require_few(group_places_, "places of elements in groups");
    MeshElement element{lines_.line(), dimension->second, groups, {}};
    const auto count = static_cast<std::size_t>(element.dimension) + 1;
    if (words.size() < first + count) lines_.refuse("ends before the nodes of its element");
    for (std::size_t i = 0; i < count; ++i)
      element.nodes.push_back(lines_.integer(words[first + i]));
    elements_.push_back(std::move(element));
    require_few(elements_.size(), "elements");
  }
  void old_elements() {
    const std::size_t count = lines_.count(lines_.expect(1)[0]);
    for (std::size_t i = 0; i < count; ++i) {
      const auto words = lines_.expect(3);
      const std::size_t tags = lines_.count(words[2]);
      if (words.size() < 3 + tags) lines_.refuse("ends before its tags");
      std::vector<long> groups;
      if (tags > 0 && lines_.integer(words[3]) != 0) groups.push_back(lines_.integer(words[3]));
      add_element(lines_.integer(words[1]), groups, words, 3 + tags);
    }
  }
  void new_elements() {
    const std::vector<long> none;
    const std::size_t blocks = lines_.count(lines_.expect(4)[0]);
    for (std::size_t b = 0; b < blocks; ++b) {
      const auto block = lines_.expect(4);
      const auto groups = groups_.find({lines_.integer(block[0]), lines_.integer(block[1])});
      const long type = lines_.integer(block[2]);
      const std::size_t count = lines_.count(block[3]);
      for (std::size_t i = 0; i < count; ++i)
        add_element(type, groups == groups_.end() ? none : groups->second, lines_.expect(1), 1);
    }
  }

  Json complex() const {
    long dimension = 0;
    for (const MeshElement& element : elements_) dimension = std::max(dimension, element.dimension);
    if (dimension == 0) throw MeshError(0, "has no edges, triangles or tetrahedra");
    std::map<long, std::size_t> numbers;  // of nodes that are vertices of simplices
    for (const MeshElement& element : elements_)
      if (element.dimension == dimension)
        for (const long node : element.nodes) {
          if (!nodes_.contains(node))
            throw MeshError(element.line,
                            "has the node " + std::to_string(node) + ", which is not there");
          numbers.emplace(node, 0);
        }
    Json vertices = Json::array(), simplices = Json::array(), facets = Json::object();
    for (auto& [node, number] : numbers) {
      number = vertices.size();
      vertices.push_back(nodes_.at(node));
    }
    const auto numbered = [&](const MeshElement& element) {
      Json list = Json::array();
      for (const long node : element.nodes) {
        const auto found = numbers.find(node);
        if (found == numbers.end())
          throw MeshError(element.line,
                          "has the node " + std::to_string(node) + ", which belongs to no simplex");
        list.push_back(found->second);
      }
      return list;
    };
    for (const MeshElement& element : elements_) {
      if (element.dimension == dimension) simplices.push_back(numbered(element));
      if (element.dimension != dimension - 1) continue;
      for (const long group : element.groups) {
        const auto name = names_.find({element.dimension, group});
        facets[name == names_.end() ? std::to_string(group) : name->second].push_back(
            numbered(element));
      }
    }
    return {{"vertices", vertices}, {"simplices", simplices}, {"facets", facets}};
  }

  MeshLines lines_;
  bool is_new_ = false;
  std::map<std::pair<long, long>, std::string> names_;         // by dimension and number
  std::map<std::pair<long, long>, std::vector<long>> groups_;  // by dimension and entity
  std::map<long, std::array<double, 3>> nodes_;
  std::vector<MeshElement> elements_;
  std::size_t group_places_ = 0;  // of all elements
};

}  // namespace

Json read_mesh(std::istream& file) { return GmshFile(file).read(); }

}  // namespace courant
