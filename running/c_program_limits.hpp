// What programs in C are not written for. Not installed API: c_program is.
#pragma once

#include "courant/reading/experiment.hpp"

namespace courant {

// Throws ExperimentError, at its place, for what the experiment asks for and a program in C does not do.
// Methods and systems are looked at where their steps are written.
void check_exportable(const Experiment& experiment);

}  // namespace courant
