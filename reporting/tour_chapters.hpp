// The chapters of `courant tour`, from which the pages of docs/tour are made too.
#pragma once

#include <string>
#include <vector>

namespace courant {

// One idea of the paper on a system that runs. Words have $formulas$ in the language of experiments.
struct TourChapter {
  std::string file;  // of the page, without .md
  std::string title;
  std::string idea;                    // paragraphs, each one line
  std::string experiment;              // JSON
  std::vector<std::string> arguments;  // of the command, FILE being "-"
  std::string question;                // before the output
  std::string answer;                  // after it
  std::string exercise, solution;
};

const std::vector<TourChapter>& tour_chapters();

}  // namespace courant
