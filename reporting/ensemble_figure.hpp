// How the members of an ensemble are spread over time.
#pragma once

#include "courant/reporting/report_figures.hpp"
#include "courant/running/ensemble_folder.hpp"

namespace courant {

// A panel for each of the first eight columns but constraints: the mean of the members, the band of a standard deviation
// about it, the least and the greatest.
Figure ensemble_figure(const EnsembleTables& tables);

}  // namespace courant
