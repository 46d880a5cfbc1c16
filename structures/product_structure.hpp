// The product of Dirac structures.
#pragma once

#include "courant/manifolds/product.hpp"
#include "courant/structures/dirac_structure.hpp"

namespace courant {

// D₁ × … × D_k on M₁ × … × M_k: (v, α) with (v_i, α_i) ∈ D_i for the part of each factor. Dirac if
// every factor is, integrable if every factor is. Port variables are those of the factors, one
// after the other.
class ProductStructure final : public DiracStructure {
 public:
  // On Product({M₁, …, M_k}), or on the product object given, whose factors must have the sizes of
  // the structures' manifolds (else std::invalid_argument).
  explicit ProductStructure(std::vector<std::shared_ptr<const DiracStructure>> factors);
  ProductStructure(std::vector<std::shared_ptr<const DiracStructure>> factors,
                   std::shared_ptr<const Product> manifold);
  bool is_dirac() const override;

 private:
  ExprVector do_membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& u) const override;
  std::vector<std::shared_ptr<const DiracStructure>> factors_;
  std::shared_ptr<const Product> product_;
};

}  // namespace courant
