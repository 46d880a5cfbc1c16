#include "courant/reading/element_parts.hpp"

namespace courant::element_parts {

Key name() { return required_key("name", takes::text(), "letters, digits and _"); }
Key from(const char* summary) { return required_key("from", takes::text(), summary); }
Key to(const char* summary) { return required_key("to", takes::text(), summary); }
Key current_from() { return from("the node where the current enters"); }
Key current_to() { return to("the node where it leaves"); }
Key value(const char* summary) { return required_key("value", takes::formula(), summary); }

const std::vector<std::string> between = {"from", "to"};

Read of_value(const std::function<Element(elements::Law)>& make) {
  return [make](ObjectReader& object, const NetworkSite& site) {
    ElementReader reader(object, site);
    return reader.result(make(reader.law("value")), between);
  };
}

std::optional<double> read_energy(ElementReader& reader, Element& storage, const std::string& law,
                                  bool by_stiffness) {
  const std::string key = reader.one_of({"value", "energy", law});
  if (key == "value") {
    const double given = reader.positive("value");
    const double value = by_stiffness ? 1.0 / given : given;
    storage.energy = elements::quadratic(value);
    return value;
  }
  if (key == "energy")
    storage.energy = reader.state_law(key);
  else
    reader.take_law_of_state(storage, key);
  return std::nullopt;
}

}  // namespace courant::element_parts
