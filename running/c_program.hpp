// The run of an experiment as a program in C.
#pragma once

#include <string>

#include "courant/reading/experiment.hpp"

namespace courant {

// One file in C99 whose program writes trajectory.csv of the run to standard output, to the last byte: the
// formulas of the step, Newton's method with its kept factorisation, the prediction, the rows. Compiled without
// contraction of a*b+c, with the same functions of the C library:
//
//   cc -std=c99 -O2 -ffp-contract=off FILE.c -lm
//
// A step that Newton's method does not solve at once, or whose solution may be that of another branch, ends the
// program with status 3: what a run does then (damped steps, continuation, least squares) is not in it.
//
// Throws ExperimentError, with the pointer, for what no such program can be written for: steps that a StepProgram
// does not describe (those of the reduced map), equations that leave something undetermined, more than 63 unknowns in
// one matrix, rows between steps.
std::string c_program(const Experiment& experiment);

}  // namespace courant
