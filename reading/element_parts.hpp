// What the elements of several domains are made of.
#pragma once

#include "courant/reading/junction_charge.hpp"
#include "courant/reading/network_element.hpp"

namespace courant::element_parts {

using Read = Registry<NetworkElement, NetworkSite>::Read;

Key name();
Key from(const char* summary);
Key to(const char* summary);
Key current_from();
Key current_to();
Key value(const char* summary);

// A branch between "from" and "to" whose law is the formula under "value".
Read source(const NetworkDomain& domain, NetworkBranch::Kind kind);

// The energy of the state of a storage by one of three keys: x²/(2 value) from "value", or with
// `by_stiffness` value x²/2; a formula under "energy"; or the law under `law`. Returns the value that
// stands below: nothing for formulas.
std::optional<double> read_energy(ElementReader& reader, const std::string& law,
                                  bool by_stiffness = false);

// across = factor through
ElementReader::OwnLaw resistance(ElementReader::OwnLaw factor);

// Two branches without loss: across₁ = ratio across₂, through₂ = -ratio through₁.
struct Side {
  const NetworkDomain& domain;
  NetworkTerminal from, to;
  std::string suffix;
};
void transform(ElementReader& reader, double ratio, const Side& first, const Side& second);

// The charge of a junction beside the branch that conducts, number `beside` of the element: a state q_<name>, or
// q_<part>_<name>, which q = q(v) ties to the voltage of that branch. Where it is tied, the voltage of the charge is
// that of the branch, as it is side by side. `more` is added to q(v), and `more_energy` to what is stored.
struct MoreCharge {
  ElementReader::OwnLaw charge = {}, energy = {};
};
void store_in_junction(ElementReader& reader, const JunctionCharge& junction, Index beside,
                       const NetworkTerminal& from, const NetworkTerminal& to,
                       const std::string& part = "", const MoreCharge& more = {});

}  // namespace courant::element_parts
