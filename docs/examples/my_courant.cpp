// The courant command with kinds of one's own: a manifold, a structure and a system.
#include <courant/cli/command_main.hpp>
#include <courant/courant.hpp>

using namespace courant;

// The Heisenberg group: R³ with (a, b, c)(a', b', c') = (a + a', b + b', c + c' + (a b' - b a')/2),
// see tutorial-new-manifold.md.
class Heisenberg final : public Manifold {
 public:
  Heisenberg() : Manifold("Heisenberg", 3, 3, 3) {}
  bool is_geodesic() const override { return true; }

 private:
  static ExprVector product_of(const ExprVector& x, const ExprVector& y) {
    ExprVector result = x + y;
    result[2] += (x[0] * y[1] - x[1] * y[0]) / 2.0;
    return result;
  }
  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override {
    return product_of(x, v);
  }
  ExprVector do_inverse_retract(const ExprVector& x, const ExprVector& y) const override {
    return product_of(-x, y);
  }
  ExprMatrix do_frame(const ExprVector& x) const override {
    ExprMatrix E = ExprMatrix::Identity(3, 3);
    E.row(2) << -x[1] / 2.0, x[0] / 2.0, 1.0;
    return E;
  }
  ExprMatrix do_coframe(const ExprVector& x) const override {
    ExprMatrix C = ExprMatrix::Identity(3, 3);
    C.row(2) << x[1] / 2.0, -x[0] / 2.0, 1.0;
    return C;
  }
};

// A manifold without keys.
std::optional<std::shared_ptr<const Manifold>> read_heisenberg(ObjectReader&, const Vocabulary&) {
  return std::make_shared<Heisenberg>();
}

// A system with one key: a charge on the group in a field along the third axis,
//
//   H = (p_a² + (p_b - strength a)²)/2.
std::optional<Model> read_charge(ObjectReader& keys) {
  const double strength = keys.number("strength");
  const auto phase_space = std::make_shared<CotangentBundle>(std::make_shared<Heisenberg>());
  const auto energy = [strength](const ExprVector& x, const Expr&) {
    return (square(x[3]) + square(x[4] - strength * x[0])) / 2.0;
  };
  Model model;
  model.description = "a charge on the Heisenberg group";
  for (const char* name : {"a", "b", "c", "p_a", "p_b", "p_c"})
    model.vocabulary.coordinates.append({name, {}});
  model.system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(phase_space),
      std::make_shared<Hamiltonian>(phase_space, energy),
      ImplicitSystem::Names{.coordinates = {"a", "b", "c", "p_a", "p_b", "p_c"}});
  return model;
}

int main(int argc, char** argv) {
  manifold_kinds().add({{"nil", "the Heisenberg group, R³"}, read_heisenberg});
  system_kinds().add({{"heisenberg-charge",
                       "a charge on the Heisenberg group",
                       {default_key("strength", takes::number(), 1.0, "of the field")}},
                      read_charge});
  return command_main(argc, argv);
}
