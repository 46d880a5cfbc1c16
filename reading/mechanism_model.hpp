// The formulas of a written mechanism at a point, and what can be observed of it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "courant/reading/mechanics_keys.hpp"
#include "courant/reading/written_mechanism.hpp"

namespace courant {

// A written mechanism with its names: coordinates of joints are called as the joints, those of rotations in space
// R_<joint>[3][3], of positions r_<joint>[3]; those of bodies that are free, as the bodies likewise.
class MechanismModel {
 public:
  // `constants` has the parameters alone.
  MechanismModel(WrittenMechanism written, Vocabulary constants);

  const WrittenMechanism& written() const { return written_; }
  const Mechanism& typed() const { return typed_; }  // at the values of the parameters
  NameList coordinates() const;                      // of Q
  NameList momenta() const;
  // Of all loops, in their order, then of joints that mimic others.
  std::vector<std::string> condition_names() const;
  ExprVector conditions(const ExprVector& q) const;  // their values, in the graph of q

  // The q where a search for a start begins: joints have the coordinates that are given by name, others those of the
  // pose in which nothing has moved, or what closes the loops from there, if that is found near.
  VectorXd reference(const std::vector<std::pair<std::string, double>>& given) const;

  // In the graph of q.
  Mechanism at(const ExprVector& q) const;
  // All but gravity, dampers and springs: what drives joints and pulls at bodies, by these symbols.
  std::vector<ExprVector> efforts(const SymbolTable& symbols) const;  // of each joint, n or none
  std::vector<Mechanism::Load> forces(const Mechanism& mechanism, const Mechanism::Motion& motion,
                                      const SymbolTable& symbols) const;

  // Positions, velocities and energies as words; the argument x is q or (q, p), with momenta of `momentum_size`
  // entries.
  std::vector<Vocabulary::Derived> quantities() const;
  // f_<joint>[3], m_<joint>[3], once the words of all other formulas are known.
  Vocabulary::Derived reactions(std::shared_ptr<const PhaseWords> words) const;
  NameList reaction_names() const;

 private:
  ExprVector configuration(const ExprVector& x) const;
  // The velocity in the representation of Q; nothing where the arguments do not have it.
  std::optional<ExprVector> velocity(const Vocabulary::Arguments& arguments) const;

  WrittenMechanism written_;
  Vocabulary constants_;
  Mechanism typed_;
};

}  // namespace courant
