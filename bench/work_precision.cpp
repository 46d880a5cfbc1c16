// Work against error: Courant beside Boost.Odeint and SUNDIALS, in one process.
//
// bench_work_precision EXPERIMENTS [SECONDS [NAME [SOLVERS]]] prints a line of JSON for each run: problem, periods,
// solver, seconds of processor time, error at the end, drift of the energy, constraints. EXPERIMENTS
// is the repository's folder of that name; a run should not take more than SECONDS, or six times as
// many over the longest horizons; NAME is part of the name of a problem, SOLVERS the beginning of those of
// solvers, to run these alone.
#include <cstdlib>
#include <string_view>

#include "work_precision/arkode_solver.hpp"
#include "work_precision/by_hand_solver.hpp"
#include "work_precision/courant_solver.hpp"
#include "work_precision/cvode_solver.hpp"
#include "work_precision/double_pendulum.hpp"
#include "work_precision/four_bar.hpp"
#include "work_precision/ida_solver.hpp"
#include "work_precision/kepler.hpp"
#include "work_precision/lc_circuit.hpp"
#include "work_precision/odeint_solver.hpp"
#include "work_precision/pendulum.hpp"

namespace {

using namespace work_precision;

template <class P>
void measure(Context context, std::string_view only) {
  if (std::string_view(P::name).find(only) == std::string_view::npos) return;
  const double most = context.seconds;
  for (const double periods : P::horizons) {
    context.periods = periods;
    context.seconds = periods > 1000.0 ? 6.0 * most : most;
    courant_solvers<P>(context);
    by_hand_solvers<P>(context);
    ida_solver<P>(context);
    cvode_solvers<P>(context);
    arkode_solvers<P>(context);
    odeint_solvers<P>(context);
  }
}

}  // namespace

int main(int count, char** words) {
  if (count < 2) {
    std::fprintf(stderr, "usage: bench_work_precision EXPERIMENTS [SECONDS [NAME [SOLVERS]]]\n");
    return 2;
  }
  const Context context{.experiments = words[1],
                        .seconds = count > 2 ? std::atof(words[2]) : 10.0,
                        .solvers = count > 4 ? words[4] : ""};
  const std::string_view only = count > 3 ? words[3] : "";
  measure<Pendulum>(context, only);
  measure<FourBar>(context, only);
  measure<DoublePendulum>(context, only);
  measure<Kepler>(context, only);
  measure<LcCircuit>(context, only);
}
