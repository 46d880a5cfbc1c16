// Model: the system of an experiment, with its names.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "courant/reading/vocabulary.hpp"
#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// S ⊂ TM, and what the words of the experiment's other formulas stand for.
struct Model {
  std::string description;  // one line, for summaries
  std::shared_ptr<const ImplicitSystem> system;
  Vocabulary vocabulary;
  // Structures that belong to the system, with a word for each; the one that it uses comes first.
  // Empty: that of a DiracSystem, or none is known.
  std::vector<std::pair<std::string, std::shared_ptr<const DiracStructure>>> structures;
  // The structure that the system uses; null where none is known.
  std::shared_ptr<const DiracStructure> structure() const {
    return structures.empty() ? system->structure() : structures.front().second;
  }
  // What is wrong with a point of M as an initial one, where the kind of system knows better than
  // the formulas (two vortices at one place); entries that are not known are NaN. May be empty.
  std::function<std::optional<std::string>(const VectorXd& x)> point_problem;

  // Whether coordinates that neither initial values nor constraints determine are 0 at the start. Of other
  // systems they have to be given.
  bool starts_at_zero = false;

  // Where the search for coordinates that are not given begins, by what else is given of the start, by name; 0 if
  // empty.
  std::function<VectorXd(const std::vector<std::pair<std::string, double>>& given)> reference;

  // Of quantities that are alike, and are compared next to the greatest of them, a common word by name: voltages and
  // potentials of a network, its currents.
  std::map<std::string, std::string, std::less<>> kinds = {};
  // Of these, what tells of each coordinate of a network in the units of its kind, ∂H/∂x; of others empty.
  std::vector<std::string> efforts = {};

  // Whether the point is (state, costate) of a problem of optimal control, with Pontryagin's function as energy.
  bool is_control_problem = false;
  // Of such a problem: a cost of the state at the end, in states and t, besides the integral.
  std::optional<WrittenFormula> final_cost = {};

  // The table for formulas at (x, v, z, t): the velocity of x is dx/dt = E(x) v.
  SymbolTable symbols(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                      const Expr& t) const {
    return vocabulary.symbols(
        {.x = x, .velocity = (system->manifold()->frame(x) * v).eval(), .z = z, .t = t});
  }
  // The same with the energy, H, where there is one and no word of the model has that name.
  SymbolTable symbols_with_energy(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                                  const Expr& t) const;
  // The same at the stage of a step, with its effort.
  SymbolTable symbols(const ExprVector& x, const ExprVector& v, const ExprVector& z, const Expr& t,
                      const ExprVector& effort) const {
    return vocabulary.symbols({.x = x,
                               .velocity = (system->manifold()->frame(x) * v).eval(),
                               .z = z,
                               .t = t,
                               .effort = effort});
  }
};

// The model of a system by its own names: elements "r[0]", "r[1]", … side by side are the array r. What is no name that
// a formula could have has none in formulas. `description` is by default the name of the manifold.
Model model_of(std::shared_ptr<const ImplicitSystem> system, std::string description = "");

}  // namespace courant
