#include "courant/reading/mechanism_values.hpp"

#include <array>

#include "courant/core/numbers/as_size.hpp"
#include "courant/core/words/message.hpp"

namespace courant {
namespace {

// R = R_z(yaw) R_y(pitch) R_x(roll), entry by entry: the language knows that cos(pi/2) is 0.
MechanismValues::Formulas rotation_formulas(const MechanismValues::Formulas& rpy) {
  const auto part = [&](const char* function, std::size_t i) {
    return std::string(function) + "((" + rpy[i].text + "))";
  };
  const std::string cr = part("cos", 0), sr = part("sin", 0), cp = part("cos", 1),
                    sp = part("sin", 1), cy = part("cos", 2), sy = part("sin", 2);
  const std::array<std::string, 9> entries{cy + "*" + cp,
                                           cy + "*" + sp + "*" + sr + "-" + sy + "*" + cr,
                                           cy + "*" + sp + "*" + cr + "+" + sy + "*" + sr,
                                           sy + "*" + cp,
                                           sy + "*" + sp + "*" + sr + "+" + cy + "*" + cr,
                                           sy + "*" + sp + "*" + cr + "-" + cy + "*" + sr,
                                           "-" + sp,
                                           cp + "*" + sr,
                                           cp + "*" + cr};
  MechanismValues::Formulas formulas;
  for (const std::string& entry : entries) formulas.push_back({entry, rpy.front().pointer});
  return formulas;
}

}  // namespace

VectorXd MechanismValues::value_of(const Formulas& formulas) const {
  return values(evaluate({{}, formulas}, constants_));
}

void MechanismValues::problem(const JsonReader& place, std::string what) {
  place.problem(std::move(what));
  right_ = false;
}

bool MechanismValues::flag(ObjectReader& object, const std::string& key) {
  const auto value = object.optional(key);
  if (!value) {
    object.default_value(key, false);
    return false;
  }
  if (!value->value().is_boolean()) {
    value->expected("true or false");
    right_ = false;
    return false;
  }
  return value->value().get<bool>();
}

bool MechanismValues::constant(const Formulas& formulas) {
  for (const WrittenFormula& formula : formulas)
    if (!evaluate_constants({{}, {formula}}, constants_, findings_)) return right_ = false;
  return true;
}

std::optional<MechanismValues::Formulas> MechanismValues::components(const JsonReader& value) {
  const auto formulas = read_formula_vector(value);
  if (!formulas) {
    right_ = false;
    return std::nullopt;
  }
  Formulas all = formulas->formulas;
  if (is_plane_ && all.size() == 2) all.push_back(literal("0"));
  if (all.size() != 3) {
    problem(value, "has " + std::to_string(all.size()) + " numbers; expected " +
                       (is_plane_ ? "2, in a plane" : "3"));
    return std::nullopt;
  }
  if (is_plane_ && !is_zero(all[2])) {
    problem(value, "leaves the plane; expected 2 numbers, or 0 as the third");
    return std::nullopt;
  }
  return all;
}

bool MechanismValues::is_zero(const WrittenFormula& formula) const {
  Findings findings;
  const auto value = evaluate_constants({{}, {formula}}, constants_, findings);
  return value && (*value)[0] == 0.0;
}

MechanismValues::Formulas MechanismValues::along_z(const JsonReader& value) {
  const auto formulas = read_formula_vector(value);
  if (!formulas || !constant(formulas->formulas)) {
    right_ = false;
    return zeros();
  }
  const Formulas& f = formulas->formulas;
  if (f.size() == 3 && is_zero(f[0]) && is_zero(f[1])) return f;
  value.expected("[0, 0, z], in a plane");
  right_ = false;
  return zeros();
}

MechanismValues::Formulas MechanismValues::vector(const JsonReader& value) {
  const auto formulas = components(value);
  return formulas && constant(*formulas) ? *formulas : zeros();
}

WrittenFormula MechanismValues::number_at_least_0(ObjectReader& object, const std::string& key) {
  const auto value = object.optional(key);
  const auto formula = value ? read_formula(*value) : std::nullopt;
  if (value && !formula) right_ = false;
  if (!formula || !constant({*formula})) return literal("0");
  if (!(evaluate(*formula, constants_).value() >= 0.0)) {
    problem(*value,
            "is " + exact_text(evaluate(*formula, constants_).value()) + "; expected at least 0");
  }
  return *formula;
}

WrittenMechanism::Pose MechanismValues::pose(ObjectReader& object, const std::string& key) {
  WrittenMechanism::Pose result{zeros(), rotation_formulas(zeros())};
  const auto value = object.optional(key);
  if (!value) return result;
  if (is_plane_ && !value->value().is_object()) {
    const auto formulas = read_formula_vector(*value);
    if (formulas && formulas->formulas.size() == 3) {
      if (!constant(formulas->formulas)) return result;
      const Formulas& f = formulas->formulas;
      return {{f[0], f[1], literal("0")}, rotation_formulas({literal("0"), literal("0"), f[2]})};
    }
    if (formulas) value->expected("[x, y, angle], in a plane");
    right_ = false;
    return result;
  }
  ObjectReader entries(*value);
  if (!value->value().is_object()) right_ = false;
  if (const auto xyz = entries.optional("xyz")) result.xyz = vector(*xyz);
  if (const auto rpy = entries.optional("rpy"))
    result.rotation = rotation_formulas(is_plane_ ? along_z(*rpy) : vector(*rpy));
  return result;
}

MechanismValues::Formulas MechanismValues::formulas(const JsonReader& value, Index n,
                                                    bool repeats) {
  const auto formulas = read_formulas(value);
  if (!formulas) {
    right_ = false;
    return {};
  }
  if (formulas->shape.empty() && repeats) return Formulas(as_size(n), formulas->formulas.front());
  if (formulas->shape.size() > 1 || std::ssize(formulas->formulas) != n) {
    problem(value, "has " + std::to_string(formulas->formulas.size()) + " formulas; expected " +
                       std::to_string(n) + ", one for each degree of freedom");
    return {};
  }
  return formulas->formulas;
}

MechanismValues::Formulas MechanismValues::coefficients(const JsonReader& value, Index n) {
  Formulas formulas = this->formulas(value, n, true);
  return constant(formulas) ? formulas : Formulas();
}

}  // namespace courant
