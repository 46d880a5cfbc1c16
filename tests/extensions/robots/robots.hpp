// Robots of tests: files, and texts.
#pragma once

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "courant/extensions/robots/import_robot.hpp"
#include "courant/tests/core/files/temporary_folder.hpp"

namespace courant {

// The experiment of a file of tests/corpus/robots.
inline Json robot_in(const std::string& file, std::vector<Problem>* notes = nullptr) {
  return import_robot(read_text("tests/corpus/robots/" + file), notes,
                      files_below("tests/corpus/robots"));
}

// The problem that an importer tells of a text; empty if it tells none.
inline std::string problem_of_robot(const std::string& text, const IncludedText& included = {}) {
  try {
    import_robot(text, nullptr, included);
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "";
}

// Entries of a list, each to 1e-14 of the largest; texts as they are.
inline void require_entries(const Json& list, const Json& expected) {
  BOOST_TEST_REQUIRE(list.size() == expected.size(), list.dump());
  double scale = 1e-3;
  for (const Json& entry : expected)
    if (entry.is_number()) scale = std::max(scale, std::abs(entry.get<double>()));
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (expected[i].is_string())
      BOOST_TEST(list[i] == expected[i], list.dump());
    else
      BOOST_TEST(std::abs(list[i].get<double>() - expected[i].get<double>()) <= 1e-14 * scale,
                 list.dump() << " and " << expected.dump());
  }
}

}  // namespace courant
