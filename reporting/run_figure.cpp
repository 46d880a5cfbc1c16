#include "courant/reporting/run_figure.hpp"

#include <algorithm>
#include <set>

namespace courant {

std::vector<plot::Series> columns_over_time(std::span<const Run> runs, const std::string& column) {
  const std::vector<std::string> labels = run_labels(runs);
  std::vector<plot::Series> series;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const TrajectoryTable& table = runs[i].trajectory;
    if (!table.contains(column)) continue;
    series.push_back({labels[i], first_rows(table.column("t"), table.rows()),
                      first_rows(table.column(column), table.rows()), i});
  }
  return series;
}

std::vector<double> first_rows(std::span<const double> values, std::size_t rows) {
  return {values.begin(),
          values.begin() + static_cast<std::ptrdiff_t>(std::min(rows, values.size()))};
}

std::string axis_label(std::span<const Run> runs, const std::string& quantity) {
  for (const Run& run : runs)
    if (run.trajectory.contains(quantity)) return run.axis_label(quantity);
  return quantity;
}

std::vector<std::string> run_labels(std::span<const Run> runs) {
  std::multiset<std::string> methods;
  for (const Run& run : runs) methods.insert(run.summary.method);
  std::vector<std::string> labels;
  for (const Run& run : runs) {
    const std::string& method = run.summary.method;
    labels.push_back(methods.count(method) == 1 ? method : method + " — " + run.name);
  }
  return labels;
}

}  // namespace courant
