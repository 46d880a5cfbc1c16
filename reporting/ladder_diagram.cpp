#include "courant/reporting/ladder_diagram.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "courant/core/words/text_layout.hpp"
#include "courant/plotting/scale.hpp"

namespace courant {

namespace {

using plot::element;
using plot::Markup;

constexpr double column_width = 132, first_column = 46, upper_row = 40, lower_row = 128;

Markup label(double x, double y, std::string_view style, const Markup& content) {
  return element("text", {{"class", style}, {"x", x}, {"y", y}, {"text-anchor", "middle"}},
                 content);
}

// The set S_k or M_k with its dimension under it.
Markup node(double x, double y, std::string_view set, Index k, std::optional<Index> dimension) {
  const Markup name = element("tspan", {{"font-style", "italic"}}, set) + subscript(k);
  return label(x, y, "set", dimension ? name : name + " = ∅") +
         label(x, y + 16, "dimension", dimension ? "dim " + std::to_string(*dimension) : "");
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

std::string said(const LadderReport& ladder) {
  std::string text;
  for (const bool upper : {true, false}) {
    text += upper ? "S:" : "; M:";
    for (const LadderReport::Level& level : ladder.levels) {
      const auto dimension = upper ? level.dim_S : level.dim_M;
      text += " " + (dimension ? std::to_string(*dimension) : std::string("empty"));
    }
  }
  return "Dimensions of " + text + ".";
}

}  // namespace

Markup ladder_diagram(const LadderReport& ladder) {
  const std::vector<LadderReport::Level>& levels = ladder.levels;
  Markup content;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double x = first_column + static_cast<double>(i) * column_width;
    const LadderReport::Level& level = levels[i];
    content += node(x, upper_row, "S", level.k, level.dim_S) +
               node(x, lower_row, "M", level.k, level.dim_M);
    content += arrow_down(x, upper_row + 26, lower_row - 20);
    if (i == 0) continue;
    const auto relation = [](bool repeats) { return repeats ? "=" : "⊇"; };
    content += label(x - column_width / 2, upper_row, "relation",
                     relation(level.dim_S == levels[i - 1].dim_S));
    content += label(x - column_width / 2, lower_row, "relation",
                     relation(level.dim_M == levels[i - 1].dim_M));
  }
  const double width = 2 * first_column + column_width * (static_cast<double>(levels.size()) - 1);
  const Markup styled =
      element("g", {{"class", "ladder"}, {"font-size", 18.0}, {"font-family", "serif"}}, content);
  return plot::svg(width, lower_row + 30, "Ladder of the constraint algorithm", said(ladder),
                   styled);
}

std::string verdict_in_words(const LadderReport& ladder) {
  const LadderReport::Level* last = ladder.levels.empty() ? nullptr : &ladder.levels.back();
  const Index k = ladder.index.value_or(0);
  const std::string stop = "The algorithm stops at k = " + std::to_string(k) + ": ";
  std::string final_set = "M_f = M" + subscript(k);
  if (last && last->dim_M) final_set += ", of dimension " + std::to_string(*last->dim_M);
  switch (ladder.verdict) {
    case Verdict::regular:
      return "Regular. " + stop + "S_f = S" + subscript(k) + " is the graph of a vector field on " +
             final_set + "; through each of its points passes exactly one solution.";
    case Verdict::gauge:
      return "Gauge. " + stop + "solutions pass through each point of " + final_set +
             ", but their velocity is free in " + std::to_string(ladder.gauge_dimension) +
             (ladder.gauge_dimension == 1 ? " direction." : " directions.");
    case Verdict::inconsistent:
      return "Inconsistent. No point nearby satisfies the equations and their derivatives: there "
             "is no solution" +
             (last && std::isfinite(last->residual)
                  ? " (least residual " + plot::readable(last->residual, 3) + ")."
                  : ".");
    case Verdict::rank_change:
      return "The rank changes at this point: it is singular, and the dimensions hold there only.";
    case Verdict::not_reached:
      return "Not reached. The dimensions still fall at the last level tried, k = " +
             std::to_string(ladder.levels.empty() ? 0 : ladder.levels.size() - 1) + ".";
  }
  return "";
}

std::vector<std::string> doubts_in_words(const LadderReport& ladder) {
  if (!ladder.is_ambiguous) return {};
  std::vector<std::string> lines = {"Ambiguous: do not rely on the verdict."};
  for (const Doubt& doubt : ladder.doubts) lines.push_back("    " + doubt.text);
  return lines;
}

std::string discrete_verdict_in_words(const LadderReport& ladder) {
  const Index k = ladder.index.value_or(0);
  const Index dim_M = ladder.levels.empty() ? 0 : ladder.levels.back().dim_M.value_or(0);
  const std::string stop = "The algorithm stops at k = " + std::to_string(k) + ": ";
  const std::string M = "M" + subscript(k) + ", of dimension " + std::to_string(dim_M);
  switch (ladder.verdict) {
    case Verdict::regular:
      return "Regular. " + stop + "from each point of " + M +
             ", one step can be made, and from its end another one.";
    case Verdict::gauge:
      return "Gauge. " + stop + "from each point of " + M +
             ", steps can be made, and where they end is free in " +
             std::to_string(ladder.gauge_dimension) + " directions.";
    case Verdict::inconsistent:
      return "Inconsistent. From no point nearby so many steps can be made.";
    case Verdict::rank_change:
    case Verdict::not_reached:
      break;
  }
  return verdict_in_words(ladder);
}

}  // namespace courant
