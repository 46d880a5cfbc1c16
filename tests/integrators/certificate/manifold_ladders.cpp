// Systems on manifolds, with their ladders.
#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/product.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"
#include "ladder_families.hpp"

namespace courant::examples {
namespace {

using V = const ExprVector&;
using T = const Expr&;

}  // namespace

void on_manifolds(std::vector<KnownLadder>& table) {
  const auto sphere = std::make_shared<Sphere>(2);
  const auto rotations = std::make_shared<SpecialOrthogonal3>();
  // x' = a × x: a vector field; of its three equations two are independent.
  table.push_back({"rotation of S²",
                   {std::make_shared<FormulaSystem>(sphere, 0, 3,
                                                    [](V x, V v, V, T) {
                                                      return equations(
                                                          {v[0] - 0.3 * x[2] + 1.1 * x[1],
                                                           v[1] - 1.1 * x[0] + 0.2 * x[2],
                                                           v[2] - 0.2 * x[1] + 0.3 * x[0]});
                                                    }),
                    at({0.6, 0.0, 0.8})},
                   {{2, 2}, {2, 2}},
                   Verdict::regular,
                   0,
                   1});
  // x' = a × x + λ (e_3 - x_3 x), x_3 = c: a circle of latitude, λ from the derivative.
  table.push_back({"constraint on S²",
                   {std::make_shared<FormulaSystem>(
                        sphere, 1, 4,
                        [](V x, V v, V z, T) {
                          return equations(
                              {v[0] - 0.3 * x[2] + 1.1 * x[1] + z[0] * x[2] * x[0],
                               v[1] - 1.1 * x[0] + 0.2 * x[2] + z[0] * x[2] * x[1],
                               v[2] - 0.2 * x[1] + 0.3 * x[0] - z[0] * (1 - square(x[2])),
                               x[2] - 0.5});
                        }),
                    at({0.6, 0.0, 0.8})},
                   {{2, 1}, {1, 1}, {1, 1}},
                   Verdict::regular,
                   1,
                   1});
  // Ω = (0.2, z, 0.1) with the third component of R e_1 fixed.
  table.push_back({"constraint on SO(3)",
                   {std::make_shared<FormulaSystem>(
                        rotations, 1, 4,
                        [](V x, V v, V z, T) {
                          return equations({v[0] - 0.2, v[1] - z[0], v[2] - 0.1, x[6] - 0.3});
                        }),
                    at({0.8, 0, 0.6, 0, 1, 0, -0.6, 0, 0.8})},
                   {{3, 2}, {2, 2}, {2, 2}},
                   Verdict::regular,
                   1});
  // Suslov's problem: Π' = Π × Ω + λ a, ⟨a, Ω⟩ = 0, on SO(3) × R³.
  table.push_back({"Suslov's problem",
                   {std::make_shared<FormulaSystem>(
                        std::make_shared<Product>(std::vector<std::shared_ptr<const Manifold>>{
                            rotations, std::make_shared<Euclidean>(3)}),
                        1, 7,
                        [](V x, V v, V z, T) {
                          const ExprVector P = x.tail(3);
                          ExprVector W(3), F(7);
                          W << P[0] + 0.2 * P[2], P[1] / 2.0, P[2] / 3.0 + 0.2 * P[0];
                          F.head(3) = v.head(3) - W;
                          F[3] = v[3] - P[1] * W[2] + P[2] * W[1];
                          F[4] = v[4] - P[2] * W[0] + P[0] * W[2];
                          F[5] = v[5] - P[0] * W[1] + P[1] * W[0] - z[0];
                          F[6] = W[2];
                          return F;
                        }),
                    at({0.8, 0, 0.6, 0, 1, 0, -0.6, 0, 0.8, 0.5, 0.4, 0.1})},
                   {{6, 5}, {5, 5}, {5, 5}},
                   Verdict::regular,
                   1});
  // H = ½|p|² + x_3 on T*S²: canonical, regular.
  const auto phase_space = std::make_shared<CotangentBundle>(sphere);
  table.push_back(
      {"spherical pendulum on T*S²",
       {std::make_shared<DiracSystem>(
            std::make_shared<CanonicalSymplectic>(phase_space),
            std::make_shared<Hamiltonian>(
                phase_space, [](V x, T) { return 0.5 * x.tail(3).squaredNorm() + x[2]; })),
        at({0.6, 0.0, -0.8, 0.4, 0.5, 0.3})},
       {{4, 4}, {4, 4}},
       Verdict::regular,
       0,
       2});
}

}  // namespace courant::examples
