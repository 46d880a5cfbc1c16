// What a run is differentiated by, and of what.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/reading/initial_values.hpp"
#include "courant/reading/model.hpp"
#include "courant/reading/observable.hpp"
#include "courant/reading/symmetries.hpp"

namespace courant {

// The key `sensitivities` of an experiment:
//
//   {"by": ["L", "x"], "of": ["H", "x"], "lyapunov": true}
//
// Derivatives of each quantity in `of`, at each state of the run, by each number in `by`: an element of a parameter, or
// a value that `initial` has. They are those of the run of the experiment with another number in its place.
struct Sensitivities {
  // A number that is varied. `index`: of the entry of x, of the velocity or of z, of InitialValues::quantities, or of
  // the elements of the parameter.
  struct Variable {
    enum class Kind { parameter, coordinate, velocity, unknown, quantity };
    Kind kind = Kind::parameter;
    std::string name, pointer;
    std::string parameter = {};  // of which it is an element
    Index index = 0;
    double value = 0.0;
  };
  // A number of a state, by its name in words_of_state(); `coordinate`: where it is one, its entry of x.
  struct Quantity {
    std::string name;
    std::optional<Index> coordinate = {};
  };

  std::vector<Variable> by;
  std::vector<Quantity> of;
  bool has_exponents = false;  // Lyapunov's, at the end

  // Those of `by` that are parameters, in its order.
  std::vector<Parameter> parameters() const;
  // d(x)/d(L), …: for each of `of` those by each of `by`.
  std::vector<std::string> columns() const;
};

// The words of the model at (x, v, z, t), with H, the momenta of symmetries, and the observables that a state has.
SymbolTable words_of_state(const Model& model, const std::vector<DeclaredSymmetry>& symmetries,
                           const std::vector<Observable>& observables, const ExprVector& x,
                           const ExprVector& v, const ExprVector& z, const Expr& t);

// Reads it. Names of arrays mean their elements; `of` is by default all coordinates. What has no name, or is not given
// in `initial`, is a problem.
std::optional<Sensitivities> read_sensitivities(const JsonReader& value, const Model& model,
                                                const InitialValues& initial,
                                                const std::vector<DeclaredSymmetry>& symmetries,
                                                const std::vector<Observable>& observables);

}  // namespace courant
