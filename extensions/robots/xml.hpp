// The elements of an XML file with their lines, and the numbers in them.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace courant::robots {

// An element of a document, with all that it contains.
struct Element {
  std::string name;
  int line = 0;        // in the file that is imported: of an included one, where it is included
  std::string origin;  // of an element of an included file: `(arm.xml, line 7) `
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<Element> children;
  std::string text;  // without white space at its ends

  // The first one of that name; nothing where there is none.
  const Element* child(std::string_view of) const;
  const std::string* attribute(std::string_view of) const;

  // Throws LineError with the line of the element.
  [[noreturn]] void fail(const std::string& what) const;
  // The value of an attribute that must be there and not empty. Throws LineError.
  const std::string& required(std::string_view of) const;
  // The numbers of an attribute, of which there must be `count`; nothing where there is no attribute. They are finite,
  // and at most 1e15; those below 1e-30 are 0. Throws LineError.
  std::optional<std::vector<double>> numbers(std::string_view of, std::size_t count) const;
  std::optional<double> number(std::string_view of) const;
  std::optional<Eigen::Vector3d> vector(std::string_view of) const;
  // The same of the text.
  std::vector<double> text_numbers(std::size_t count) const;
  Eigen::Vector3d text_vector() const;
  double text_number() const;
  bool text_flag() const;  // true, 1, false or 0
};

// All numbers that words of a text are; `what` is it in a message. Throws LineError of the element.
std::vector<double> numbers_in(const Element& element, std::string_view text,
                               const std::string& what);

// The root element. Entities other than the five of XML stay as they are written, since no document type is read.
// Throws LineError where the text is not well-formed, is nested deeper than 1000 elements or has more than a million of
// them.
Element parse_xml(std::string_view text);

}  // namespace courant::robots
