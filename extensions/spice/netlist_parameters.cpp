#include "courant/extensions/spice/netlist_parameters.hpp"

#include <cctype>
#include <map>
#include <set>
#include <stdexcept>
#include <vector>

#include "courant/extensions/importing/different_names.hpp"
#include "courant/extensions/spice/netlist_behaviour.hpp"

namespace courant::netlist {

void NetlistParameters::define(Scope& scope, const std::string& prefix, const std::string& name,
                               const std::string& formula, int line) {
  if (std::isalpha(static_cast<unsigned char>(name[0])) == 0 && name[0] != '_')
    throw LineError{
        line, "\"" + name + "\" is no name of a parameter; expected one that begins with a letter"};
  const double value = circuit_.value_of(formula, line);
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) != 0)
    throw LineError{line, "the parameter \"" + name + "\" is no name; expected a letter first"};
  std::string global = identifier(prefix + name);
  static const std::set<std::string> reserved = {"e", "pi", "h"};
  for (bool added = false; !added;) {
    try {
      if (reserved.contains(global)) throw std::invalid_argument("");
      circuit_.values.add(global, value);
      added = true;
    } catch (const std::invalid_argument&) {
      global += "_";
    }
  }
  circuit_.parameters[global] = written_value(formula);
  circuit_.parameter_lines[global] = line;
  scope[name] = global;
}

void NetlistParameters::define(Scope& scope, const std::string& prefix, const Assignments& list) {
  std::map<std::string, const Assignment*> last;
  for (const Assignment& assignment : list) last[assignment.name] = &assignment;
  std::vector<const Assignment*> open;
  for (const Assignment& assignment : list)
    if (last[assignment.name] == &assignment) open.push_back(&assignment);
  const Scope outside = scope;
  for (const Assignment* assignment : open) scope.erase(assignment->name);
  while (!open.empty()) {
    std::vector<const Assignment*> left;
    std::vector<LineError> errors;
    for (const Assignment* assignment : open) {
      try {
        Scope known = scope;
        if (const auto outer = outside.find(assignment->name); outer != outside.end())
          known.insert(*outer);
        define(scope, prefix, assignment->name, formula(assignment->value, known, assignment->line),
               assignment->line);
      } catch (const LineError& error) {
        errors.push_back(error);
        left.push_back(assignment);
      }
    }
    if (left.size() == open.size()) {
      for (const LineError& error : errors) problems_.add(error.line, error.what);
      // What uses them is right for all that is known.
      for (const Assignment* assignment : left) scope[assignment->name] = "1";
      return;
    }
    open = left;
  }
}

}  // namespace courant::netlist
