// MechanismValues: the numbers of a mechanism as an experiment writes them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/core/expressions/expr.hpp"
#include "courant/reading/json_reader.hpp"
#include "courant/reading/written_mechanism.hpp"

namespace courant {

// What reads the numbers of a mechanism: components, directions, poses, coefficients. They are formulas, which are
// checked at the values of the parameters. What is wrong is a problem at its place, after which `is_right` is false, and
// a value that can be gone on with stands for it.
class MechanismValues {
 public:
  using Formulas = std::vector<WrittenFormula>;

  // The table and the findings have to outlive this object.
  MechanismValues(const SymbolTable& constants, Findings& findings)
      : constants_(constants), findings_(findings) {}

  const SymbolTable& constants() const { return constants_; }
  Findings& findings() const { return findings_; }
  bool is_right() const { return right_; }
  bool is_plane() const { return is_plane_; }
  void set_plane(bool is_plane) { is_plane_ = is_plane; }

  // What is wrong has been said already.
  void fail() { right_ = false; }
  void problem(const JsonReader& place, std::string what);

  static WrittenFormula literal(const char* text) { return {text, ""}; }
  static Formulas zeros() { return {literal("0"), literal("0"), literal("0")}; }
  VectorXd value_of(const Formulas& formulas) const;

  bool flag(ObjectReader& object, const std::string& key);
  // Whether the formulas are constants.
  bool constant(const Formulas& formulas);
  // Components in space (3), or in the plane; the third one is 0 then, and may be written.
  std::optional<Formulas> components(const JsonReader& value);
  // The same of constants; zeros where they are wrong.
  Formulas vector(const JsonReader& value);
  // An axis, or angles (3), along z alone, where all is in a plane.
  Formulas along_z(const JsonReader& value);
  WrittenFormula number_at_least_0(ObjectReader& object, const std::string& key);
  WrittenMechanism::Pose pose(ObjectReader& object, const std::string& key);
  // n formulas; a single one stands for all where it `repeats`.
  Formulas formulas(const JsonReader& value, Index n, bool repeats);
  // n constants, or one for all.
  Formulas coefficients(const JsonReader& value, Index n);

 private:
  bool is_zero(const WrittenFormula& formula) const;

  const SymbolTable& constants_;
  Findings& findings_;
  bool is_plane_ = false, right_ = true;
};

}  // namespace courant
