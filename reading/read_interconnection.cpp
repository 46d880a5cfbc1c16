#include <algorithm>
#include <stdexcept>

#include "courant/core/language/declaration.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/word_list.hpp"
#include "courant/reading/system_kinds.hpp"
#include "courant/structures/interconnection.hpp"

namespace courant {
namespace {

// A system with ports, and how its names begin in the whole.
struct Part {
  std::string name;
  std::shared_ptr<const PortSystem> system;
  Vocabulary vocabulary;
};

std::optional<std::vector<Part>> read_parts(const JsonReader& value) {
  std::vector<Part> parts;
  const auto entries = value.entries();
  if (!entries) return std::nullopt;
  if (entries->empty()) value.problem("is empty; expected one system at least");
  for (const auto& [name, entry] : *entries) {
    try {
      if (!parse_declaration(name, SymbolTable()).shape.empty())
        throw FormulaError(1, "\"" + name + "\" has a size; expected a name");
    } catch (const FormulaError& error) {
      entry.problem(std::string("key, ") + error.what());
      continue;
    }
    const auto model = system_kinds().read(entry);
    if (!model) continue;
    auto system = std::dynamic_pointer_cast<const PortSystem>(model->system);
    if (!system)
      entry.problem(
          "has no ports; expected a port-hamiltonian or stokes-dirac system, a network or an "
          "interconnection");
    else
      parts.push_back({name, std::move(system), model->vocabulary});
  }
  return !parts.empty() && parts.size() == entries->size() ? std::optional(parts) : std::nullopt;
}

// What the coordinates, unknowns, ports and outputs of the whole are called.
struct WholeNames {
  NameList coordinates, unknowns, ports, outputs;
};

WholeNames names_of(const std::vector<Part>& parts) {
  WholeNames whole;
  for (const Part& part : parts) {
    for (const Declaration& declaration : part.vocabulary.coordinates.declarations())
      whole.coordinates.append({part.name + "_" + declaration.name, declaration.shape});
    const std::vector<Index>& inputs = part.system->inputs();
    Index first = 0;
    for (const Declaration& unknown : part.vocabulary.unknowns.declarations()) {
      const bool is_input = std::find(inputs.begin(), inputs.end(), first) != inputs.end();
      first += unknown.size();
      if (!is_input) {
        whole.unknowns.append({part.name + "_" + unknown.name, unknown.shape});
        continue;
      }
      // u, u[m] or u_<port> of the part.
      const std::string port = part.name + unknown.name.substr(1);
      whole.ports.append({port, unknown.shape});
      whole.unknowns.append({"u_" + port, unknown.shape});
      whole.outputs.append({"y_" + port, unknown.shape});
    }
  }
  return whole;
}

bool is_output(const std::string& name) { return name == "y" || name.starts_with("y_"); }

// The quantities of the parts, their outputs aside, with names that begin with the part; those whose names
// are taken are left out.
std::vector<Vocabulary::Derived> quantities(const std::vector<Part>& parts,
                                            const SymbolTable& taken) {
  std::vector<Vocabulary::Derived> all;
  Index point = 0, unknown = 0, tangent = 0;
  for (const Part& part : parts) {
    const Index N = part.system->manifold()->ambient_dimension(),
                n = part.system->manifold()->tangent_dimension(), m = part.system->auxiliary_size();
    for (const Vocabulary::Derived& derived : part.vocabulary.derived) {
      NameList names;
      bool is_free = true;
      for (const Declaration& declaration : derived.names.declarations()) {
        names.append({part.name + "_" + declaration.name, declaration.shape});
        is_free = is_free && !is_output(declaration.name) &&
                  !taken.find(part.name + "_" + declaration.name);
      }
      if (!is_free) continue;
      all.push_back({names, [=, values = derived.values](const Vocabulary::Arguments& of_whole) {
                       Vocabulary::Arguments own{.t = of_whole.t};
                       if (of_whole.x) own.x = of_whole.x->segment(point, N);
                       if (of_whole.velocity) own.velocity = of_whole.velocity->segment(point, N);
                       if (of_whole.z) own.z = of_whole.z->segment(unknown, m);
                       if (of_whole.effort) own.effort = of_whole.effort->segment(tangent, n);
                       return values(own);
                     }});
    }
    point += N;
    tangent += n;
    unknown += m;
  }
  return all;
}

// The numbers of the ports that an array names.
std::optional<std::vector<Index>> read_ports(const JsonReader& value, const NameList& ports) {
  const auto elements = value.elements();
  if (!elements) return std::nullopt;
  std::vector<Index> numbers;
  bool right = true;
  for (const JsonReader& element : *elements) {
    const auto text = element.text();
    right = right && text.has_value();
    if (!text) continue;
    try {
      const auto [first, count] = ports.find(parse_reference(*text));
      for (Index i = 0; i < count; ++i) numbers.push_back(first + i);
    } catch (const FormulaError& error) {
      element.problem(std::string("names no port: ") + error.what());
      right = false;
    }
  }
  if (numbers.empty() && right) value.problem("is empty; expected the names of ports");
  return right && !numbers.empty() ? std::optional(numbers) : std::nullopt;
}

std::optional<MatrixXd> read_constants(const JsonReader& value, Index size,
                                       const SymbolTable& constants) {
  const auto written = read_formula_matrix(value, size, size);
  if (!written) return std::nullopt;
  const auto entries = evaluate_constants(*written, constants, value.findings());
  if (!entries) return std::nullopt;
  return MatrixXd(Eigen::Map<const MatrixXd>(entries->data(), size, size).transpose());
}

// {"ports": […], and one of "shared", "matrix", "F" with "E", "input"}.
std::optional<Joint> read_joint(const JsonReader& value, const Vocabulary& vocabulary,
                                const WholeNames& names) {
  ObjectReader object(value);
  if (!value.value().is_object()) return std::nullopt;
  const auto ports_key = object.required("ports");
  const auto shared = object.optional("shared"), matrix = object.optional("matrix"),
             F_key = object.optional("F"), E_key = object.optional("E"),
             input = object.optional("input");
  const int kinds = int(shared.has_value()) + int(matrix.has_value()) +
                    int(F_key.has_value() || E_key.has_value()) + int(input.has_value());
  if (kinds != 1 || F_key.has_value() != E_key.has_value()) {
    value.problem(
        "says in " + std::to_string(kinds) +
        R"( ways what its ports have in common; expected one of "shared", "matrix", "input", or "F" and "E")");
    return std::nullopt;
  }
  const auto ports = ports_key ? read_ports(*ports_key, names.ports) : std::nullopt;
  if (!ports) return std::nullopt;
  const Index p = std::ssize(*ports);
  const SymbolTable constants = vocabulary.symbols({});
  try {
    if (shared) {
      const auto word = shared->word({"input", "output"});
      if (!word) return std::nullopt;
      return *word == "input" ? Joint::shared_input(*ports) : Joint::shared_output(*ports);
    }
    if (matrix) {
      const auto K = read_constants(*matrix, p, constants);
      return K ? std::optional(Joint::gyrator(*ports, *K)) : std::nullopt;
    }
    if (F_key) {
      const auto F = read_constants(*F_key, p, constants), E = read_constants(*E_key, p, constants);
      return F && E ? std::optional(Joint(*ports, *F, *E)) : std::nullopt;
    }
  } catch (const std::invalid_argument& error) {
    value.problem(without_place(error.what()));
    return std::nullopt;
  }
  if (p != 1) {
    ports_key->problem("names " + std::to_string(p) + " ports; expected one with an input");
    return std::nullopt;
  }
  const auto formula = read_formula(*input);
  const auto table = [vocabulary, outputs = names.outputs](const Expr& t, const ExprVector& y) {
    SymbolTable symbols = vocabulary.symbols({.t = t});
    outputs.add_to(symbols, y);
    return symbols;
  };
  Graph graph;
  if (!formula ||
      !check(*formula, table(graph.variable("t"), graph.variables("y", names.outputs.size())),
             value.findings()))
    return std::nullopt;
  return Joint::source(ports->front(),
                       [formula = *formula, table](const Expr& t, const ExprVector& y) {
                         return evaluate(formula, table(t, y));
                       });
}

// Whether the ports of a joint are free for it; they are not afterwards.
bool take_ports(const Joint& joint, const WholeNames& names, std::vector<bool>& is_free,
                const JsonReader& place) {
  bool right = true;
  for (const Index port : joint.ports()) {
    const auto at = static_cast<std::size_t>(port);
    if (!is_free[at]) {
      place.problem("the port \"" + names.ports.element_names()[at] +
                    "\" is in another joint, or its system says its input; expected a free port");
      right = false;
    }
    is_free[at] = false;
  }
  return right;
}

}  // namespace

// Systems that are joined at their ports.
std::optional<Model> read_interconnection(ObjectReader& system) {
  Findings& findings = system.place().findings();
  Model model;
  Vocabulary& vocabulary = model.vocabulary = read_vocabulary(system);
  const auto systems_key = system.required("systems");
  const auto joints_key = system.required("joints");
  if (!systems_key) return std::nullopt;
  const auto parts = read_parts(*systems_key);
  if (!parts) return std::nullopt;
  const WholeNames names = names_of(*parts);
  SymbolTable taken = vocabulary.symbols({.t = Expr(0.0)});
  for (const Definition& definition : vocabulary.definitions)
    if (!taken.find(definition.name)) taken.add(definition.name, 0.0);
  for (const NameList* list : {&names.coordinates, &names.unknowns, &names.outputs})
    for (const Declaration& declaration : list->declarations()) {
      if (taken.find(declaration.name)) {
        systems_key->problem("the whole has two meanings for \"" + declaration.name +
                             "\"; expected another name of a system, coordinate or port");
        return std::nullopt;
      }
      taken.add(declaration.name, declaration.shape, ExprVector::Ones(declaration.size()));
    }
  std::vector<bool> is_free;
  for (const Part& part : *parts)
    for (Index a = 0; a < part.system->port_count(); ++a)
      is_free.push_back(part.system->is_free(a));
  std::vector<Joint> joints;
  bool right = joints_key.has_value();
  if (const auto elements = joints_key ? joints_key->elements() : std::nullopt)
    for (const JsonReader& element : *elements) {
      auto joint = read_joint(element, vocabulary, names);
      right = joint && take_ports(*joint, names, is_free, element) && right;
      if (joint) joints.push_back(std::move(*joint));
    }
  if (!right) return std::nullopt;
  vocabulary.coordinates = names.coordinates;
  vocabulary.unknowns = names.unknowns;
  check_definitions(vocabulary, findings);

  std::vector<Interconnection::Part> systems;
  for (const Part& part : *parts) systems.push_back({part.name, part.system});
  const auto whole = std::make_shared<Interconnection>(std::move(systems), std::move(joints));
  model.description =
      "interconnection of " + word_list(*parts, &Part::name) + " on " + whole->manifold()->name();
  model.system = whole;
  vocabulary.derived = quantities(*parts, taken);
  if (names.outputs.size() > 0)
    vocabulary.derived.push_back(
        {names.outputs, [whole](const Vocabulary::Arguments& at) -> std::optional<ExprVector> {
           if (!at.x || !at.z || !at.t) return std::nullopt;
           return whole->output(*at.x, at.effort ? *at.effort : whole->effort(*at.x, *at.z, *at.t),
                                *at.z);
         }});
  return model;
}

}  // namespace courant
