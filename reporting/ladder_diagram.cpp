#include "courant/reporting/ladder_diagram.hpp"

#include <array>
#include <optional>

#include "courant/plotting/scale.hpp"

namespace courant {

namespace {

using Json = nlohmann::ordered_json;
using plot::element;
using plot::Markup;

constexpr double column_width = 132, first_column = 46, upper_row = 40, lower_row = 128;

std::optional<int> whole(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number_integer()) return std::nullopt;
  return found->get<int>();
}

std::string subscript(int k) {
  static constexpr std::array<const char*, 10> digits = {"₀", "₁", "₂", "₃", "₄",
                                                         "₅", "₆", "₇", "₈", "₉"};
  std::string text;
  for (const char digit : std::to_string(k)) {
    text += digit == '-' ? "₋" : digits[static_cast<std::size_t>(digit - '0')];
  }
  return text;
}

Markup label(double x, double y, std::string_view style, const Markup& content) {
  return element("text", {{"class", style}, {"x", x}, {"y", y}, {"text-anchor", "middle"}},
                 content);
}

// The set S_k or M_k with its dimension under it.
Markup node(double x, double y, std::string_view set, int k, std::optional<int> dimension) {
  const Markup name = element("tspan", {{"font-style", "italic"}}, set) + subscript(k);
  const bool is_empty = !dimension || *dimension < 0;
  return label(x, y, "set", is_empty ? name + " = ∅" : name) +
         label(x, y + 16, "dimension", is_empty ? "" : "dim " + std::to_string(*dimension));
}

Markup arrow_down(double x, double from, double to) {
  const auto point = [](double px, double py) {
    return plot::coordinate(px) + " " + plot::coordinate(py);
  };
  const std::string path = "M" + point(x, from) + "L" + point(x, to) + "M" +
                           point(x - 3.5, to - 6) + "L" + point(x, to) + "L" +
                           point(x + 3.5, to - 6);
  return element("path", {{"class", "arrow"}, {"d", path}, {"fill", "none"}, {"stroke", "#777"}}) +
         element(
             "text",
             {{"class", "map"}, {"x", x + 9}, {"y", (from + to) / 2 + 4}, {"font-style", "italic"}},
             "τ");
}

std::string said(const Json& ladder) {
  const Json& levels = ladder.at("levels");
  std::string text;
  for (const char* key : {"dim_S", "dim_M"}) {
    text += key[4] == 'S' ? "S" : "; M";
    text += ":";
    for (const Json& level : levels) {
      const auto dimension = whole(level, key);
      text +=
          " " + (dimension && *dimension >= 0 ? std::to_string(*dimension) : std::string("empty"));
    }
  }
  return "Dimensions of " + text + ".";
}

}  // namespace

Markup ladder_diagram(const Json& ladder) {
  const Json& levels = ladder.at("levels");
  Markup content;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double x = first_column + static_cast<double>(i) * column_width;
    const int k = whole(levels[i], "k").value_or(static_cast<int>(i));
    const auto dim_S = whole(levels[i], "dim_S"), dim_M = whole(levels[i], "dim_M");
    content += node(x, upper_row, "S", k, dim_S) + node(x, lower_row, "M", k, dim_M);
    content += arrow_down(x, upper_row + 26, lower_row - 20);
    if (i == 0) continue;
    const auto relation = [&](const char* key) {
      return whole(levels[i], key) == whole(levels[i - 1], key) ? "=" : "⊇";
    };
    content += label(x - column_width / 2, upper_row, "relation", relation("dim_S"));
    content += label(x - column_width / 2, lower_row, "relation", relation("dim_M"));
  }
  const double width = 2 * first_column + column_width * (static_cast<double>(levels.size()) - 1);
  const Markup styled =
      element("g", {{"class", "ladder"}, {"font-size", 18.0}, {"font-family", "serif"}}, content);
  return plot::svg(width, lower_row + 30, "Ladder of the constraint algorithm", said(ladder),
                   styled);
}

std::string verdict_in_words(const Json& ladder) {
  std::string verdict = ladder.at("verdict");
  const Json& levels = ladder.at("levels");
  const Json last = levels.empty() ? Json::object() : levels.back();
  const int k = whole(ladder, "index").value_or(0);
  const std::string stop = "The algorithm stops at k = " + std::to_string(k) + ": ";
  const std::string fibre_dimension =
      std::to_string(whole(ladder, "gauge_dimension").value_or(whole(last, "fibre").value_or(0)));
  const auto dim_M = whole(last, "dim_M");
  const std::string final_set =
      "M_f = M" + subscript(k) + (dim_M ? ", of dimension " + std::to_string(*dim_M) : "");
  if (verdict == "regular") {
    return "Regular. " + stop + "S_f = S" + subscript(k) + " is the graph of a vector field on " +
           final_set + "; through each of its points passes exactly one solution.";
  }
  if (verdict == "gauge") {
    return "Gauge. " + stop + "solutions pass through each point of " + final_set +
           ", but their velocity is free in " + fibre_dimension +
           (fibre_dimension == "1" ? " direction." : " directions.");
  }
  if (verdict == "inconsistent") {
    const auto residual = last.find("residual");
    const bool known = residual != last.end() && residual->is_number();
    return "Inconsistent. No point nearby satisfies the equations and their derivatives: there is "
           "no solution" +
           (known ? " (least residual " + plot::readable(residual->get<double>(), 3) + ")." : ".");
  }
  if (verdict == "rank-change") {
    return "The rank changes at this point: it is singular, and the dimensions hold there only.";
  }
  if (verdict == "not-reached") {
    return "Not reached. The dimensions still fall at the last level tried, k = " +
           std::to_string(levels.empty() ? 0 : static_cast<int>(levels.size()) - 1) + ".";
  }
  return verdict;
}

std::string discrete_verdict_in_words(const Json& ladder) {
  const std::string verdict = ladder.at("verdict");
  const int k = whole(ladder, "index").value_or(0);
  const Json& levels = ladder.at("levels");
  const auto dim_M = whole(levels.empty() ? Json::object() : levels.back(), "dim_M");
  const std::string stop = "The algorithm stops at k = " + std::to_string(k) + ": ";
  const std::string M = "M" + subscript(k) + ", of dimension " + std::to_string(dim_M.value_or(0));
  if (verdict == "regular")
    return "Regular. " + stop + "from each point of " + M +
           ", one step can be made, and from its end another one.";
  if (verdict == "gauge")
    return "Gauge. " + stop + "from each point of " + M +
           ", steps can be made, and where they end is free in " +
           std::to_string(whole(ladder, "gauge_dimension").value_or(0)) + " directions.";
  if (verdict == "inconsistent")
    return "Inconsistent. From no point nearby so many steps can be made.";
  return verdict_in_words(ladder);
}

}  // namespace courant
