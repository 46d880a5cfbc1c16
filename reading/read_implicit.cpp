#include "courant/reading/space.hpp"
#include "courant/reading/system_kinds.hpp"

namespace courant {
namespace {

// S = {(x, v) : F(x, E(x) v, z, t) = 0 for some z}, with F (and perhaps an energy) in formulas.
class FormulaSystem final : public ImplicitSystem {
 public:
  FormulaSystem(std::shared_ptr<const Manifold> manifold, Vocabulary vocabulary,
                WrittenFormulas equations, std::optional<WrittenFormula> energy)
      : ImplicitSystem(std::move(manifold), vocabulary.unknowns.size(),
                       static_cast<Index>(equations.formulas.size()),
                       {vocabulary.coordinates.element_names(), vocabulary.unknowns.element_names(),
                        texts(equations)}),
        vocabulary_(std::move(vocabulary)),
        equations_(std::move(equations)),
        energy_(std::move(energy)) {}

 private:
  ExprVector do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                         const Expr& t) const override {
    const ExprVector velocity = manifold()->frame(x) * v;
    return evaluate(equations_,
                    vocabulary_.symbols({.x = x, .velocity = velocity, .z = z, .t = t}));
  }
  std::optional<Expr> do_energy(const ExprVector& x, const ExprVector& z,
                                const Expr& t) const override {
    if (!energy_) return std::nullopt;
    return evaluate(*energy_, vocabulary_.symbols({.x = x, .z = z, .t = t}));
  }

  Vocabulary vocabulary_;
  WrittenFormulas equations_;
  std::optional<WrittenFormula> energy_;
};

}  // namespace

std::optional<Model> read_implicit(ObjectReader& system) {
  Findings& findings = system.place().findings();
  Model model;
  Vocabulary& vocabulary = model.vocabulary = read_vocabulary(system);
  SymbolTable taken = vocabulary.symbols({.t = Expr(0.0)});
  const auto space = read_space(system, vocabulary, taken);
  const auto unknowns = system.optional("unknowns");
  const bool named = !unknowns || read_names(*unknowns, taken, vocabulary.unknowns);
  const auto equations_key = system.required("equations");
  const auto equations = equations_key ? read_formula_vector(*equations_key) : std::nullopt;
  const auto energy_key = system.optional("energy");
  const auto energy = energy_key ? read_formula(*energy_key) : std::nullopt;
  if (!space || !named) return std::nullopt;

  vocabulary.coordinates = space->coordinates;
  check_definitions(vocabulary, findings);
  Graph graph;
  const Index N = vocabulary.coordinates.size();
  Vocabulary::Arguments arguments{.x = graph.variables("x", N),
                                  .velocity = graph.variables("v", N),
                                  .z = graph.variables("z", vocabulary.unknowns.size()),
                                  .t = graph.variable("t")};
  const bool right = equations && check(*equations, vocabulary.symbols(arguments), findings);
  arguments.velocity.reset();
  if (energy && !check(*energy, vocabulary.symbols(arguments), findings)) return std::nullopt;
  if (!right) return std::nullopt;

  model.description = "implicit system on " + space->manifold->name();
  model.system = std::make_shared<FormulaSystem>(space->manifold, vocabulary, *equations, energy);
  return model;
}

}  // namespace courant
