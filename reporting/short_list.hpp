// Lists in prose that say what they leave out.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "courant/reporting/prose.hpp"

namespace courant {

// How many of so many lines of a kind are shown: no line says that one or two more are left out.
inline std::size_t shown_of(std::size_t count) { return count <= 8 ? count : 6; }

inline void tell_rest(std::size_t count, std::vector<Prose>& lines) {
  if (const std::size_t left = count - shown_of(count); left > 0)
    lines.push_back("    \u2026 and " + std::to_string(left) + " more");
}

// Formulas with commas between them.
inline Prose listed(const std::vector<std::string>& names) {
  Prose list;
  for (const std::string& name : names)
    list += (list.parts().empty() ? "" : ", ") + Prose::formula(name);
  return list;
}

}  // namespace courant
