// A Dirac structure of one's own, and what the library then knows of it.
// docs/tutorial-new-structure.md explains it line by line.
#include <iostream>

#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/integrability.hpp"
#include "courant/structures/laws.hpp"

using namespace courant;

// The rolling penny: D = D_{ω_F} on T*Q ∋ (x, y, θ, φ; p), F = {x' = cos φ θ', y' = sin φ θ'}.
class RollingPenny final : public DiracStructure {
 public:
  explicit RollingPenny(std::shared_ptr<const Manifold> phase_space)
      : DiracStructure("RollingPenny", phase_space, 2, 10, {"lambda_x", "lambda_y"}) {}

 private:
  ExprVector do_membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& lambda) const override {
    const Expr c = cos(x[3]), s = sin(x[3]);
    ExprVector force(4);  // Σ λ_a μ^a
    force << lambda[0], lambda[1], -c * lambda[0] - s * lambda[1], 0.0;
    ExprVector residual(10);
    residual << v[0] - c * v[2], v[1] - s * v[2],  // v ∈ F
        v.head(4) - alpha.tail(4),                 // q' = ∂H/∂p
        v.tail(4) + alpha.head(4) - force;         // p' = -∂H/∂q + λ_a μ^a
    return residual;
  }
};

int main() {
  const RollingPenny penny(std::make_shared<Euclidean>(8));
  for (const LawResult& law : check_structure(penny)) std::cout << law << '\n';

  const VectorXd x = VectorXd{{0.0, 0.0, 0.0, 0.5, 1.0, 0.2, 0.3, 0.4}};
  std::cout << penny.linear(x) << "integrable: " << std::boolalpha
            << integrability(penny, x).integrable() << '\n';
  const bool as_known = all_passed(check_structure(penny)) &&
                        penny.linear(x).form().F.cols() == 6 &&
                        !integrability(penny, x).integrable();
  return as_known ? 0 : 1;
}
