#include "courant/core/solve/unknown_selection.hpp"

#include <algorithm>

namespace courant {

ContainedUnknowns::ContainedUnknowns(const Function& function) : places(function.pattern_col()) {
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  pattern.rows = function.output_size();
  pattern.columns = std::ssize(places);
  pattern.row = function.pattern_row();
  for (const Index column : function.pattern_col())
    pattern.column.push_back(std::lower_bound(places.begin(), places.end(), column) -
                             places.begin());
}

std::vector<Index> group_ends(const std::vector<Index>& sizes, const std::vector<Index>& places) {
  std::vector<Index> ends;
  Index end = 0;
  for (const Index size : sizes) {
    end += size;
    ends.push_back(std::lower_bound(places.begin(), places.end(), end) - places.begin());
  }
  return ends;
}

}  // namespace courant
