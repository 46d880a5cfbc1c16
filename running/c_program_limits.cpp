#include "courant/running/c_program_limits.hpp"

namespace courant {

void check_exportable(const Experiment& experiment) {
  if (!experiment.method)
    throw ExperimentError("/method", "is missing; expected the method whose steps are exported");
  if (experiment.output.coordinates)
    throw ExperimentError("/output/coordinates",
                          "cannot be exported: the program writes all coordinates");
  if (experiment.boundary)
    throw ExperimentError("/boundary",
                          "is not solved by a program in C; expected an experiment without, such "
                          "as the one that a run "
                          "writes, whose initial values are those of the solution");
  if (experiment.ensemble)
    throw ExperimentError("/ensemble",
                          "is of many runs, and a program in C makes one; expected an experiment "
                          "without");
  if (!experiment.defects.empty())
    throw ExperimentError("/defects",
                          "are not measured by a program in C; expected an experiment without");
  if (experiment.sensitivities)
    throw ExperimentError("/sensitivities",
                          "are not computed by a program in C; expected an experiment without");
  if (const std::optional<std::string> place = place_of_resets(experiment.events))
    throw ExperimentError(*place,
                          "is done by a run, not by a program in C; expected events that set "
                          "nothing");
  if (experiment.time->is_transformed())
    throw ExperimentError("/time/transformation",
                          "is not written in C; expected steps of one size in t");
  if (experiment.time->division)
    throw ExperimentError("/time",
                          "has corners or halvings, and steps that are divided are not "
                          "written in C; expected neither");
  if (!experiment.output.at.empty())
    throw ExperimentError("/output/at",
                          "asks for rows between steps, which a program in C does not write; "
                          "expected \"every\"");
}

}  // namespace courant
