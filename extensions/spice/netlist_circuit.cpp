#include "courant/extensions/spice/netlist_circuit.hpp"

#include <cmath>

#include "courant/core/language/formula.hpp"

namespace courant::netlist {

double NetlistCircuit::value_of(const std::string& formula, int line) const {
  try {
    const double value = parse_formula(formula, values).value();
    if (std::isfinite(value)) return value;
    throw LineError{line, "\"" + formula + "\" is not finite; expected a number"};
  } catch (const FormulaError& error) {
    throw LineError{line, "\"" + formula + "\": " + error.what()};
  }
}

Json written_value(const std::string& formula) {
  if (const auto value = number(formula)) return *value;
  return formula;
}

}  // namespace courant::netlist
