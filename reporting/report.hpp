// The report of finished runs: one page of HTML that needs nothing else.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "courant/running/run_files.hpp"

namespace courant {

// The page: the motion, the energy errors of all runs, the ladder of the constraint algorithm,
// expectations, observables, solver statistics and the experiments. No reference to another file; the
// only script is report_script(), without which the page is whole; whatever stands in the files of the
// runs is shown as text. Below 1 MB for up to a hundred curves, however long. Well-formed XML after the
// document type, in UTF-8. Throws std::invalid_argument when there are no runs.
std::string report_html(std::span<const Run> runs);

// Writes the page of the runs to `output`; a page that is there is replaced in one piece or not at
// all, and only if it is as this function wrote it, or `force`. Throws OutputError when it cannot be
// written, RefusedOutput when it may not be replaced.
void write_report(std::span<const Run> runs, const std::filesystem::path& output,
                  bool force = false);

}  // namespace courant
