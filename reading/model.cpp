#include "courant/reading/model.hpp"

#include <algorithm>

namespace courant {
namespace {

std::optional<Reference> element_of(const std::string& name) {
  try {
    Reference found = parse_reference(name);
    if (!found.is_velocity) return found;
  } catch (const FormulaError&) {  // no name
  }
  return std::nullopt;
}

// The declaration whose elements are the names from `first` on, as many of them as there are.
std::optional<Declaration> array_from(const std::vector<std::string>& names, std::size_t first) {
  const auto begin = element_of(names[first]);
  if (!begin) return std::nullopt;
  Declaration found{.name = begin->name, .shape = {}};
  for (std::size_t i = first; i < names.size(); ++i) {
    const auto element = element_of(names[i]);
    if (!element || element->name != begin->name ||
        element->indices.size() != begin->indices.size())
      break;
    found.shape.assign(element->indices.begin(), element->indices.end());
    for (auto& extent : found.shape) ++extent;
  }
  const std::vector<std::string> elements = found.element_names();
  const auto from = names.begin() + static_cast<std::ptrdiff_t>(first);
  if (elements.size() > names.size() - first || !std::equal(elements.begin(), elements.end(), from))
    return std::nullopt;
  return found;
}

NameList declared_list(const std::vector<std::string>& names) {
  NameList list;
  for (std::size_t i = 0; i < names.size();) {
    auto found = array_from(names, i);
    const bool is_new = found && !list.contains(found->name);
    i += is_new ? static_cast<std::size_t>(found->size()) : 1;
    if (is_new)
      list.append(*std::move(found));
    else
      list.append_unnamed(1);
  }
  return list;
}

}  // namespace

SymbolTable Model::symbols_with_energy(const ExprVector& x, const ExprVector& v,
                                       const ExprVector& z, const Expr& t) const {
  SymbolTable words = symbols(x, v, z, t);
  if (words.find("H") == nullptr)
    if (const auto energy = system->energy(x, z, t)) words.add("H", *energy);
  return words;
}

Model model_of(std::shared_ptr<const ImplicitSystem> system, std::string description) {
  if (!system) throw std::invalid_argument("model_of: system is null.");
  Model model;
  model.description =
      description.empty() ? "system on " + system->manifold()->name() : std::move(description);
  model.vocabulary.coordinates = declared_list(system->names().coordinates);
  model.vocabulary.unknowns = declared_list(system->names().auxiliary);
  model.system = std::move(system);
  return model;
}

}  // namespace courant
