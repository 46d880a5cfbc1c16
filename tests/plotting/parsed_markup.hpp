// Reading back what was drawn.
#pragma once

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace courant::test {

using Tree = boost::property_tree::ptree;

inline Tree parsed(const std::string& xml) {
  std::istringstream stream(xml);
  Tree tree;
  boost::property_tree::read_xml(stream, tree);
  return tree;
}

inline std::string attribute(const Tree& element, const std::string& name) {
  return element.get<std::string>("<xmlattr>." + name, "");
}

// All elements of a tag whose class begins with `style`, in document order.
inline void find(const Tree& tree, const std::string& tag, const std::string& style,
                 std::vector<Tree>& found) {
  for (const auto& [name, child] : tree) {
    if (name == tag && attribute(child, "class").starts_with(style)) found.push_back(child);
    find(child, tag, style, found);
  }
}

inline std::vector<Tree> find(const Tree& tree, const std::string& tag,
                              const std::string& style = "") {
  std::vector<Tree> found;
  find(tree, tag, style, found);
  return found;
}

// The vertices of a path's d attribute: the numbers of "M1 2L3 4Z", in pairs.
inline std::vector<std::pair<double, double>> vertices(const std::string& data) {
  std::string numbers = data;
  for (char& c : numbers) {
    if (c == 'M' || c == 'L' || c == 'Z') c = ' ';
  }
  std::istringstream stream(numbers);
  std::vector<std::pair<double, double>> all;
  for (double x, y; stream >> x >> y;) all.emplace_back(x, y);
  return all;
}

}  // namespace courant::test
