#include "courant/extensions/robots/xml.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "courant/core/words/message.hpp"
#include "courant/extensions/importing/line_problems.hpp"

namespace courant::robots {
namespace {

constexpr double kLargest = 1e15;
// What is smaller is 0: squares and quotients of the others are numbers.
constexpr double kLeast = 1e-30;

}  // namespace

const Element* Element::child(std::string_view of) const {
  const auto found = std::ranges::find(children, of, &Element::name);
  return found == children.end() ? nullptr : &*found;
}

const std::string* Element::attribute(std::string_view of) const {
  const auto found = std::ranges::find(attributes, of, [](const auto& one) { return one.first; });
  return found == attributes.end() ? nullptr : &found->second;
}

void Element::fail(const std::string& what) const {
  const std::string* called = attribute("name");
  throw LineError{
      line, origin + "<" + name + (called ? " name=" + in_quotes(*called) : "") + "> " + what};
}

const std::string& Element::required(std::string_view of) const {
  const std::string* value = attribute(of);
  if (!value || value->empty())
    fail("has no " + std::string(of) + "; expected " + std::string(of) + "=\"…\"");
  return *value;
}

std::vector<double> numbers_in(const Element& element, std::string_view text,
                               const std::string& what) {
  std::vector<double> numbers;
  constexpr std::string_view space = " \t\r\n";
  for (std::size_t i = text.find_first_not_of(space); i != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(space, i), text.size());
    std::string_view word = text.substr(i, end - i);
    const std::string written(word);
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    double value = 0.0;
    const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool is_read = rest == word.data() + word.size();
    const std::size_t power = word.find_first_of("eE");
    const bool is_tiny = error == std::errc::result_out_of_range &&
                         power != std::string_view::npos && word.substr(power + 1).starts_with('-');
    if (!is_read || (error != std::errc{} && !is_tiny) || !(std::abs(value) <= kLargest))
      element.fail("has " + in_quotes(written) + " in " + what +
                   "; expected a number of at most 1e15");
    if (is_tiny || std::abs(value) < kLeast) value = 0.0;
    numbers.push_back(value);
    i = text.find_first_not_of(space, end);
  }
  return numbers;
}

namespace {

std::vector<double> counted(const Element& element, std::string_view text, const std::string& what,
                            std::size_t count) {
  std::vector<double> numbers = numbers_in(element, text, what);
  if (numbers.size() != count)
    element.fail("has " + std::to_string(numbers.size()) +
                 (numbers.size() == 1 ? " number in " : " numbers in ") + what + "; expected " +
                 std::to_string(count));
  return numbers;
}

}  // namespace

std::optional<std::vector<double>> Element::numbers(std::string_view of, std::size_t count) const {
  const std::string* value = attribute(of);
  if (!value) return std::nullopt;
  return counted(*this, *value, std::string(of), count);
}

std::optional<double> Element::number(std::string_view of) const {
  const auto found = numbers(of, 1);
  if (!found) return std::nullopt;
  return found->front();
}

std::optional<Eigen::Vector3d> Element::vector(std::string_view of) const {
  const auto found = numbers(of, 3);
  if (!found) return std::nullopt;
  return Eigen::Vector3d(found->data());
}

std::vector<double> Element::text_numbers(std::size_t count) const {
  return counted(*this, text, "its text", count);
}

Eigen::Vector3d Element::text_vector() const { return Eigen::Vector3d(text_numbers(3).data()); }

double Element::text_number() const { return text_numbers(1).front(); }

bool Element::text_flag() const {
  if (text == "true" || text == "1") return true;
  if (text != "false" && text != "0") fail("is " + in_quotes(text) + "; expected true or false");
  return false;
}

}  // namespace courant::robots
