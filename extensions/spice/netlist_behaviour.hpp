// The expressions of SPICE as formulas: those of nonlinear sources, and of constants.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "courant/extensions/spice/netlist_text.hpp"

namespace courant::netlist {

// What an expression may ask for: the formula of the potential of a node, that of the current of an element, and, if there is one, that
// of d/dt of a formula.
struct BehaviourWords {
  std::function<std::string(const std::string& node)> potential;
  std::function<std::string(const std::string& source)> current;
  std::function<std::string(const std::string& of)> derivative = {};
};

// `V(a,b)*max(I(V1), 0) > 1 ? 2 : time` as a formula: potentials and currents by their words, names of
// parameters by the scope, `time` as t, `c ? a : b` as if(c, a, b), functions by their names in formulas. Throws
// LineError where it has none.
std::string behaviour(const std::string& expression, const Scope& scope, int line,
                      const BehaviourWords& words);

// A number, a name or an expression of constants in braces, as a formula. Throws LineError if it is none.
std::string formula(const std::string& word, const Scope& scope, int line);

// POLY: Σ p_k over the products of the controls u_1, …, u_n, in the order 1, u_1, …, u_n, u_1², u_1 u_2, …. One coefficient
// alone, of one control, is that of u_1. Throws LineError where there are more than those of the third order.
std::string polynomial(const std::vector<std::string>& controls,
                       const std::vector<std::string>& coefficients, int line);

}  // namespace courant::netlist
