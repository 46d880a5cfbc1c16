#include <array>

#include "courant/reading/element_parts.hpp"

namespace courant {
namespace {

using namespace element_parts;
using Kind = NetworkBranch::Kind;

// What the input of a port may be: the variable that whatever is joined to it gives.
struct PortInput {
  std::string word;
  const Domain& domain;
  Kind kind;
};

const std::array<PortInput, 10>& inputs() {
  using namespace domains;
  static const std::array<PortInput, 10> all = {{{"voltage", electrical, Kind::current},
                                                 {"current", electrical, Kind::voltage},
                                                 {"velocity", translation, Kind::current},
                                                 {"force", translation, Kind::voltage},
                                                 {"angular-velocity", rotation, Kind::current},
                                                 {"torque", rotation, Kind::voltage},
                                                 {"pressure", hydraulic, Kind::current},
                                                 {"flow", hydraulic, Kind::voltage},
                                                 {"temperature", thermal, Kind::current},
                                                 {"entropy-flow", thermal, Kind::voltage}}};
  return all;
}

std::vector<std::string> words() {
  std::vector<std::string> list;
  for (const PortInput& input : inputs()) list.push_back(input.word);
  return list;
}

std::optional<NetworkElement> read_port(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const auto key = object.required("input");
  const auto word = key ? key->word(words()) : std::nullopt;
  if (!word) return std::nullopt;
  for (const PortInput& input : inputs())
    if (input.word == *word)
      return reader.result(elements::port(input.domain, input.kind), between);
  return std::nullopt;
}

}  // namespace

ElementKinds port_elements() {
  return {
      {{"port",
        "two nodes where another system may be joined: input u_<name>, output y_<name>",
        {name(), from("the node where what is joined sends its flow in"),
         to("the node where it comes back"),
         required_key("input", takes::word(words()),
                      "what the other side gives; the output is the other variable of the two")}},
       read_port}};
}

}  // namespace courant
