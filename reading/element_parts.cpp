#include "courant/reading/element_parts.hpp"

namespace courant::element_parts {

using Kind = NetworkBranch::Kind;
using Role = NetworkBranch::Role;

Key name() { return required_key("name", takes::text(), "letters, digits and _"); }
Key from(const char* summary) { return required_key("from", takes::text(), summary); }
Key to(const char* summary) { return required_key("to", takes::text(), summary); }
Key current_from() { return from("the node where the current enters"); }
Key current_to() { return to("the node where it leaves"); }
Key value(const char* summary) { return required_key("value", takes::formula(), summary); }

Read source(const NetworkDomain& domain, Kind kind) {
  return [&domain, kind](ObjectReader& object, const NetworkSite& site) {
    ElementReader reader(object, site);
    if (const auto value = reader.formula("value"))
      reader.formula_branch(domain, reader.node("from"), reader.node("to"), kind, Role::source,
                            *value);
    return reader.result();
  };
}

std::optional<double> read_energy(ElementReader& reader, const std::string& law,
                                  bool by_stiffness) {
  const std::string key = reader.one_of({"value", "energy", law});
  if (key == "value") {
    const double given = reader.positive("value");
    const double value = by_stiffness ? 1.0 / given : given;
    reader.quadratic_energy(value);
    return value;
  }
  if (const auto formula = reader.formula(key))
    key == "energy" ? reader.energy(*formula) : reader.law_of_state(*formula);
  return std::nullopt;
}

ElementReader::OwnLaw resistance(ElementReader::OwnLaw factor) {
  return [factor = std::move(factor)](const NetworkVariables& variables, Index first) {
    return factor(variables, first) * variables.current(first);
  };
}

void transform(ElementReader& reader, double ratio, const Side& first, const Side& second) {
  reader.branch(
      first.domain, first.from, first.to, Kind::current, Role::coupler,
      [ratio](const NetworkVariables& variables, Index index) {
        return ratio * variables.voltage(index + 1);
      },
      first.suffix);
  reader.branch(
      second.domain, second.from, second.to, Kind::voltage, Role::coupler,
      [ratio](const NetworkVariables& variables, Index index) {
        return -ratio * variables.current(index);
      },
      second.suffix);
}

void store_in_junction(ElementReader& reader, const JunctionCharge& junction, Index beside,
                       const NetworkTerminal& from, const NetworkTerminal& to,
                       const std::string& part, const MoreCharge& more) {
  const std::string between = part.empty() ? "_" : "_" + part + "_";
  reader.implicit_storage(
      domains::electrical, from, to, "q" + between, between + "charge",
      [junction, beside, also = more.charge](const NetworkVariables& variables, Index first,
                                             const Expr& charge) {
        const Expr v = variables.voltage(first + beside);
        Expr whole = junction.charge(v);
        if (also) whole += also(variables, first);
        return v + junction.about_voltage(charge) - junction.about_voltage(whole);
      },
      [junction, beside, also = more.energy](const NetworkVariables& variables, Index first) {
        const Expr stored = junction.energy(variables.voltage(first + beside));
        return also ? stored + also(variables, first) : stored;
      });
}

}  // namespace courant::element_parts
