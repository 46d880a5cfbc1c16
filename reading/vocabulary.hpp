// The words of an experiment's formulas.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/core/language/declaration.hpp"
#include "courant/reading/table.hpp"
#include "courant/reading/written_formula.hpp"

namespace courant {

// Names for the entries of a vector: declarations side by side, "x", "r[3]" for a vector of 4.
class NameList {
 public:
  void append(Declaration declaration);
  // Entries without a name, which no formula can refer to.
  void append_unnamed(Index count);

  const std::vector<Declaration>& declarations() const { return declarations_; }
  Index size() const { return size_; }
  bool contains(const std::string& name) const;  // as that of a declaration
  std::vector<std::string> element_names() const;
  // The entries that a reference such as r[2] (one) or r (all three) stands for: first and count.
  // Throws FormulaError if there are none, with the name that may have been meant.
  std::pair<Index, Index> find(const Reference& reference) const;

  // Adds the names with these values to a table, as velocities or as themselves.
  void add_to(SymbolTable& symbols, const ExprVector& values) const;
  // Those of these names only.
  void add_to(SymbolTable& symbols, const ExprVector& values,
              const std::vector<std::string>& names) const;
  void add_velocities_to(SymbolTable& symbols, const ExprVector& values) const;

 private:
  struct Place {
    std::size_t declaration;
    Index first;  // entry
  };

  std::vector<Declaration> declarations_;
  std::unordered_map<std::string, Place> places_;  // of the first declaration of each name
  Index size_ = 0;
};

// A named formula of an experiment, or an array of them, and where it stands.
struct Definition {
  std::string name;
  std::string pointer;
  WrittenFormulas formulas;
};

// What the names in the formulas of a system stand for: coordinates x ∈ R^N and their velocities,
// auxiliary unknowns z, the time t, constant parameters, tables, quantities of the kind of system,
// and definitions made of all of them.
//
// In a graph that was given parameters (add_parameters) of the names of their elements, "l" or "m[1]", parameters
// are its variables, and others that are made of these by formulas change with them.
struct Vocabulary {
  NameList coordinates;
  NameList unknowns;
  std::vector<std::pair<std::string, Symbol>> parameters;
  // Of those parameters whose values are formulas of earlier ones.
  std::vector<std::pair<std::string, WrittenFormulas>> parameter_formulas = {};
  std::vector<std::pair<std::string, Table>> tables = {};  // functions of t
  std::vector<Definition> definitions;                     // later ones may use earlier ones

  // What a formula may depend on; the others are no names in it.
  struct Arguments {
    std::optional<ExprVector> x = {};         // N
    std::optional<ExprVector> velocity = {};  // dx/dt, N
    std::optional<ExprVector> z = {};
    std::optional<Expr> t = {};
    // α where it is not d_xE at the point: at the stage of a step. Ñ.
    std::optional<ExprVector> effort = {};
  };
  // Quantities that the kind of system has besides: outputs, voltages. `values` gives nothing where
  // an argument that they need is missing.
  struct Derived {
    NameList names;
    std::function<std::optional<ExprVector>(const Arguments&)> values;
    // Their time derivatives, as name'; may be empty.
    std::function<std::optional<ExprVector>(const Arguments&)> rates = {};
  };
  std::vector<Derived> derived = {};

  // The table for a formula: parameters, arguments, and the definitions that need nothing else; of those that
  // coordinates and t give also their time derivatives along the velocity, as name'.
  // Throws FormulaError if a definition is wrong, std::invalid_argument if a name repeats or a size
  // is wrong.
  SymbolTable symbols(const Arguments& arguments) const;
  // Parameters and tables alone, without names of a system: what a formula of t may contain.
  Vocabulary of_time() const;
  // Parameters element by element, as numbers with names: what add_parameters() may make variables of a graph.
  std::vector<Parameter> numbers() const;
  // The part of it that formulas of x, t and these names need, and maybe more: quick where there are many
  // coordinates and the names are few.
  SymbolTable symbols_of(const std::vector<std::string>& names, const ExprVector& x,
                         const Expr& t) const;

 private:
  // Each parameter with what it is in this graph.
  std::vector<std::pair<std::string, Symbol>> parameters_in(const Graph& graph) const;
};

// The declarations of an array such as ["x", "r[n][3]"] are appended to `names`; `taken` has the
// names that may not be used again, and gets the new ones.
bool read_names(const JsonReader& value, SymbolTable& taken, NameList& names);
// Adds the names that something brings, such as "the ports", to those that are taken. Whether none of them has a meaning
// already; a problem at the place for the first that has one.
bool take_new_names(const NameList& names, const std::string& whose, SymbolTable& taken,
                    const JsonReader& place);
// The keys `parameters`, `tables` and `definitions` of a system. No parameter or table may have one of
// the `reserved` names. Each is evaluated at once; one that is wrong is a problem and stands for 1, so that
// formulas with it are not problems too. What definitions mean is not looked into before
// check_definitions.
Vocabulary read_vocabulary(ObjectReader& system, const std::vector<std::string>& reserved = {});
// Makes a problem of each definition that is wrong where formulas may depend on everything, and 1
// of its value.
void check_definitions(Vocabulary& vocabulary, Findings& findings);

}  // namespace courant
