// EquationEngine: what solves the equations of steps in the place of this thread.
#pragma once

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/core/expressions/inputs.hpp"

namespace courant {

// G(u; p) = 0 in the hands of an engine: as many equations as unknowns u that they contain. Several threads may
// ask; they wait for each other.
class EngineEquations {
 public:
  virtual ~EngineEquations() = default;

  // Places of the unknowns that the equations contain, ascending; the others stay as they are.
  virtual const std::vector<Index>& contained() const = 0;
  virtual bool is_native() const = 0;  // whether compiled C code evaluates the equations

  // What is to be solved, and how.
  struct Question {
    const Inputs& in;  // u, where the iteration begins and the solution is written, and p
    std::span<const Index> ends;  // of consecutive groups of contained()
    const double* scales;  // a nominal size of each group, next to which changes are measured
    const void* asker;     // whose matrices these are: those of another asker are not kept
    bool keeps_matrix;     // whether the matrix of the asker's last question may be used
    bool is_damped;        // whether steps that do not reduce the residual are shortened
  };
  struct Answer {
    bool has_converged = false;
    bool is_finite = true;
    int iterations = 0, factorizations = 0;
    double residual = 0.0;  // ‖G‖₂ at the last iterate but one
  };
  // Newton's method to round-off. Throws EngineStopped, and std::runtime_error where the engine has failed.
  virtual Answer solve(const Question& question) const = 0;
};

// Solves the equations of steps: several processes, say, of which each evaluates the equations that it owns. It is
// brought along as the compiler of a Backend is; StepFormulas::compile() gives it whole systems where there is one.
//
// To subclass, override take, taken and, as of NativeCompiler, compile.
class EquationEngine : public NativeCompiler {
 public:
  // Equations for the unknowns inputs[0], and the groups of p. Throws std::invalid_argument for systems
  // that it does not solve: those that are not square, or are structurally singular.
  virtual std::shared_ptr<const EngineEquations> take(const std::string& name,
                                                      const std::vector<Function::Input>& inputs,
                                                      const ExprVector& equations,
                                                      Backend::Kind backend) const = 0;
  // How many systems it has taken.
  virtual int taken() const = 0;

  // As summaries have it: "petsc"; so many processes.
  virtual std::string name() const = 0;
  virtual int ranks() const = 0;
};

// That of a back end, else null.
std::shared_ptr<const EquationEngine> engine_of(const Backend& backend);

// Thrown by solve() where someone asked for an end while it waited. The engine is of no use any more.
class EngineStopped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace courant
