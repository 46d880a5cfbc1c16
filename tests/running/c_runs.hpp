// Programs in C of experiments, compiled and run.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "courant/core/expressions/host.hpp"
#include "courant/running/c_program.hpp"
#include "run_in.hpp"

namespace courant::test {

struct CRun {
  std::string compiler;  // what it says of the source
  int status = -1;       // of the program
  std::string out, err;
};

// As the program says that it is to be compiled, warnings being errors; a long one without effort, which changes no
// bit.
inline CRun run_c(const TemporaryFolder& folder, const std::string& source) {
  const std::string chosen = environment_variable("COURANT_CC");
  const auto path = [&](const char* name) { return "'" + (folder / name).string() + "'"; };
  const auto status_of = [](const std::string& command) {
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  write_text(folder / "program.c", source);
  CRun run;
  const int compiled = status_of(
      (chosen.empty() ? "cc" : chosen) + " -std=c99 " + (source.size() > 100'000 ? "-O0" : "-O2") +
      " -ffp-contract=off -Wall -Wextra -pedantic -Werror " + path("program.c") + " -o " +
      path("program") + " -lm 2> " + path("compiler.txt"));
  run.compiler = read_text(folder / "compiler.txt");
  if (compiled != 0) return run;
  run.status = status_of(path("program") + " > " + path("out.csv") + " 2> " + path("err.txt"));
  run.out = read_text(folder / "out.csv");
  run.err = read_text(folder / "err.txt");
  return run;
}

inline CRun run_c(const TemporaryFolder& folder, const Json& experiment) {
  return run_c(folder, c_program(read_experiment(experiment.dump())));
}

// The rows of a run by this library.
inline std::string rows_of_run(const TemporaryFolder& folder, const Json& experiment) {
  run_in(folder, experiment);
  return read_text(folder / "run" / "trajectory.csv");
}

}  // namespace courant::test
