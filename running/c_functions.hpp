// Functions and equations as C source. Not installed API: c_program is.
#pragma once

#include <string>
#include <vector>

#include "courant/core/algebra/elimination.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/structures/state.hpp"

namespace courant {

// Collects the functions of one C file and what their arrays have to hold.
class CFunctions {
 public:
  // `static`-like maps `void symbol(const double *const *in, double *out)`.
  void add(const std::string& symbol, const std::vector<Function::Input>& inputs,
           const ExprVector& outputs, const std::string& comment);

  // `symbol_residual` and `symbol_jacobian`, which gives the residual and the entries of its Jacobian, with the arrays
  // symbol_row and symbol_column of their places and their number symbol_entries.
  void add_zeros(const std::string& symbol, const Function::Formulas& of,
                 const std::string& comment);

  // `static const struct equations symbol`, by what is left after elimination. `names` of the unknowns,
  // `groups` as of Newton; `options` null: nothing is eliminated. Throws std::invalid_argument, saying what
  // the matter is, unless they are square and of a size that Newton's method in C takes.
  struct Equations {
    std::string symbol;
    std::vector<Function::Input> inputs;
    ExprVector equations;
    std::vector<Index> groups;
    const Elimination::Options* elimination = nullptr;
  };
  // As of Newton: the unknowns that the iteration begins with, and those that it leaves as they are. Whether
  // exponentials are of them.
  struct Unknowns {
    std::vector<Index> sought, left;
    bool has_exponentials = false;
  };
  Unknowns add(const Equations& equations);

  const std::string& source() const { return source_; }  // all, in the order of add()
  std::string prelude() const;                           // what they call
  Index most_unknowns() const { return most_unknowns_; }
  Index most_size() const { return most_size_; }
  Index most_entries() const { return most_entries_; }
  Index most_arguments() const { return most_arguments_; }

 private:
  std::string source_;
  Index most_unknowns_ = 1, most_size_ = 4, most_entries_ = 1, most_arguments_ = 1;
};

// Numbers of an array in C, in braces; one zero if there are none.
std::string c_array(const VectorXd& numbers);
std::string c_array(const std::vector<Index>& numbers);
// A number that reads back, and is none of another type.
std::string c_number(double value);
// A text that may stand in a comment.
std::string c_comment(std::string text);
// A text between quotation marks.
std::string c_string(const std::string& text);
// A line that gives a whole number a name.
std::string c_define(const char* name, Index value);
// What a `struct state` begins with.
std::string c_state(const State& state);

}  // namespace courant
