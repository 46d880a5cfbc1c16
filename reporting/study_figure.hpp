// What a study found, as a picture.
#pragma once

#include <optional>

#include "courant/reporting/report_figures.hpp"
#include "courant/running/study_report.hpp"

namespace courant {

// Of a result of `study`: the error over the step size, and over the time that the steps took, a
// curve for each method, all axes logarithmic. Nothing where there is no error to show.
std::optional<Figure> study_figure(const StudyReport& study);

}  // namespace courant
