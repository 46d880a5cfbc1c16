// The energy errors of runs, as pictures and in words.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "courant/reporting/energy_error.hpp"
#include "courant/reporting/energy_trend.hpp"
#include "courant/reporting/run_figure.hpp"

namespace courant {

// The energy errors of all runs that have H, so that each is seen: a panel for each run, all with the same
// axis, linear where the greatest errors are within a factor of thirty of one another, symmetric-log
// otherwise; of more than eight runs all in one panel. The caption has the trends in words. Then,
// where the axis is symmetric-log and the greatest errors are a decade or more above all others, or
// where runs are long: the others alone on linear axes, of long runs their beginning and the whole.
// Before all of these, of up to eight runs in which energy comes in or goes out: what is stored, supplied
// and dissipated.
std::vector<Figure> energy_figures(std::span<const Run> runs);

// The trend of the energy error of a run; nothing without H.
std::optional<EnergyTrend> energy_trend(const Run& run);

// The threshold of a symmetric-log axis that shows all of the curves: the power of ten below the
// median |y| of the curve where that is least, so that this curve swings inside the linear zone and
// single outliers of it do not matter; but no more than twelve decades below the greatest of all.
double symmetric_log_threshold(std::span<const plot::Series> series);

}  // namespace courant
