// EquationRows: some equations of a system, as numbers that can be sent.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/core/linear/matching.hpp"
#include "courant/extensions/petsc/message.hpp"

namespace courant {

// Some equations in some unknowns u and parameters p of a system: the instructions of their graph, and no more of it.
struct EquationRows {
  // Operands are numbers of earlier instructions; a constant has its place among the constants in `a`, a variable its
  // place in u (a = 0) or p (a = 1) in `b`.
  std::vector<Node> instructions = {};
  std::vector<double> constants;
  std::vector<std::uint32_t> equations;  // the instructions that they end with
  Index unknowns = 0, parameters = 0;    // sizes of u and p

  void put_into(Message& message) const;
  static EquationRows taken_from(Message& message);

  // u; p ↦ the equations, with the Jacobian by u.
  Function compile(const std::string& name, const Backend& backend) const;
};

// The equations G(u; p) = 0 of a whole system, to be divided.
class DividedEquations {
 public:
  // `inputs`: u, then the groups of p.
  DividedEquations(const std::vector<Function::Input>& inputs, const ExprVector& equations);

  Index size() const { return equations_.size(); }
  // Which equation contains which unknown, by its number in u; rows ascend.
  const std::vector<PatternEntry>& pattern() const { return pattern_; }

  // A parameter: its group among the inputs (1, …), and its place in that.
  struct Parameter {
    Index group, place;
  };
  // Some of the equations, for a u of the unknowns that are given, those beside them that the equations contain
  // (`ghosts`, by their number in u), and a p of the parameters that they contain.
  struct Part {
    EquationRows rows;
    std::vector<Index> ghosts;
    std::vector<Parameter> parameters;
  };
  Part part(const std::vector<Index>& equations, const std::vector<Index>& unknowns) const;

 private:
  // Nodes that some equations consist of, operands first.
  std::vector<std::uint32_t> nodes_of(const std::vector<Index>& equations) const;

  Graph graph_ = Graph::none();
  ExprVector equations_;
  std::unordered_map<std::uint32_t, std::pair<Index, Index>>
      variables_;  // group and place, by node
  std::vector<PatternEntry> pattern_;
  mutable std::vector<std::uint32_t> seen_;  // of each node, by which search last
  mutable std::uint32_t search_ = 0;
};

}  // namespace courant
