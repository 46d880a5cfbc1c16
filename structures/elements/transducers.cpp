#include "courant/structures/elements/transducers.hpp"

#include <utility>

namespace courant::elements {

Element motor(double constant, const Domain& domain) {
  return transformer(constant, {},
                     {.domain = &domain, .from = 2, .to = Element::ground, .suffix = "_motion"});
}

Element electromagnet(StateLaw inductance) {
  const auto flux = NetworkBranch::Kind::flux;
  Element element = storage(domains::electrical, flux, "phi_",
                            [inductance = std::move(inductance)](
                                const ExprVector& own, const ExprVector& x, const Expr& t) {
                              return square(own[0]) / 2.0 / inductance(own, x, t);
                            });
  element.branches.push_back({.domain = &domains::translation,
                              .from = 2,
                              .to = Element::ground,
                              .kind = flux,
                              .role = NetworkBranch::Role::storage,
                              .suffix = "_motion",
                              .letters = "x_"});
  return element;
}

}  // namespace courant::elements
