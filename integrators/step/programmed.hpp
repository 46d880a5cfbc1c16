// Programmed: a method that knows its steps as formulas.
#pragma once

namespace courant {

struct StepProgram;

// A method that knows its steps as formulas.
class Programmed {
 public:
  virtual ~Programmed() = default;
  // Throws std::invalid_argument, with what is the matter, for steps that a StepProgram does not describe.
  virtual StepProgram program() const = 0;
};

}  // namespace courant
