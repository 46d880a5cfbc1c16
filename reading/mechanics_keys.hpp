// The keys of constraints and forces, and the words of their formulas.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "courant/reading/space.hpp"
#include "courant/structures/mechanics.hpp"

namespace courant {

// The words of formulas on T*Q: coordinates q and momenta p, velocities q' and, where vectors of Q
// are not represented in R^N (groups), their components v_<name> of the shape of p_<name>: the body
// angular velocity v_R[3] of "R[3][3]". On a manifold that is no cotangent bundle there are
// coordinates and no velocities.
class PhaseWords {
 public:
  // On a space with its names. The vocabulary has parameters and definitions; it gets the
  // coordinates, the v_<name> as unknowns (with unnamed places where there are none, Ñ in all), and
  // its definitions are checked. `taken` gets the v_<name>; one whose name is taken has none.
  PhaseWords(const Space& space, Vocabulary& vocabulary, SymbolTable& taken, Findings& findings);

  const std::shared_ptr<const CotangentBundle>& bundle() const { return bundle_; }  // or null
  const std::shared_ptr<const Manifold>& manifold() const { return manifold_; }
  // The components of covectors of Q by the names of the coordinates: "R" for three of them.
  const NameList& forces() const { return forces_; }
  Index force_size() const { return forces_.size(); }  // Ñ, 0 without a bundle

  // The table at x = (q, p) and the velocity w of q (Ñ). On the base alone: at q, w.
  SymbolTable at(const ExprVector& x, const ExprVector& w, const Expr& t) const;
  SymbolTable at_rest(const ExprVector& x, const Expr& t) const;  // without velocities
  SymbolTable on_base(const ExprVector& q, const ExprVector& w, const Expr& t) const;
  SymbolTable on_base_at_rest(const ExprVector& q, const std::optional<Expr>& t = {}) const;

 private:
  SymbolTable table(Vocabulary::Arguments arguments, const std::optional<ExprVector>& p,
                    const std::optional<ExprVector>& w) const;

  std::shared_ptr<const Manifold> manifold_;
  std::shared_ptr<const CotangentBundle> bundle_;
  Vocabulary base_;  // coordinates q
  NameList momenta_, velocities_, forces_;
};

// `holonomic`, `nonholonomic`, `forces` and `damping`.
std::vector<Key> mechanics_keys();

// Reads these keys as far as the kind declares them. Nothing, and problems, where one is wrong.
std::optional<Mechanics> read_mechanics(ObjectReader& system, const PhaseWords& words);

// " with 2 holonomic constraints, forces".
std::string described(const Mechanics& mechanics);

// The names of the multipliers lambda, unless that is the name of something else: `count` places.
void append_multipliers(NameList& unknowns, Index count, SymbolTable& taken);

// Functions that are affine in some variables, each with one of them in it: one-forms such as
// "z' - y*x'". A problem where one is not; `velocity` is an example of their names.
std::optional<WrittenFormulas> read_one_forms(const JsonReader& value, const SymbolTable& symbols,
                                              const ExprVector& velocities,
                                              const std::string& velocity);

// A matrix of n × n formulas: given so, by its diagonal, or as a multiple of the identity.
std::optional<WrittenFormulas> read_square(const JsonReader& value, Index n);

}  // namespace courant
