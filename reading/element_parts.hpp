// What the keys of elements of several domains are read by.
#pragma once

#include "courant/reading/network_element.hpp"

namespace courant::element_parts {

namespace domains = elements::domains;
using elements::Domain;
using elements::Element;
using Read = Registry<NetworkElement, NetworkSite>::Read;

Key name();
Key from(const char* summary);
Key to(const char* summary);
Key current_from();
Key current_to();
Key value(const char* summary);

// The keys of the nodes of most elements.
extern const std::vector<std::string> between;  // "from", "to"

// An element between "from" and "to" that is made of the law under "value".
Read of_value(const std::function<Element(elements::Law)>& make);

// The energy of a storage of one state by one of three keys: x²/(2 value) from "value", or with
// `by_stiffness` value x²/2; a formula under "energy"; or the law under `law`. Returns what stands
// below: nothing for formulas.
std::optional<double> read_energy(ElementReader& reader, Element& storage, const std::string& law,
                                  bool by_stiffness = false);

}  // namespace courant::element_parts
