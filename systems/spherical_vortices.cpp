#include "courant/systems/spherical_vortices.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "courant/core/words/message.hpp"
#include "courant/manifolds/product.hpp"
#include "courant/manifolds/rotation.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/poisson.hpp"

namespace courant {

SphericalVortices::SphericalVortices(VectorXd strengths) : strengths_(std::move(strengths)) {
  for (Index i = 0; i < count(); ++i)
    if (!std::isfinite(strengths_[i]) || strengths_[i] == 0.0)
      throw std::invalid_argument("SphericalVortices::SphericalVortices: strength " +
                                  std::to_string(i) + " is " + number_text(strengths_[i]) +
                                  "; expected a number other than 0.");
}

Expr SphericalVortices::hamiltonian(const ExprVector& x) const {
  Expr H = 0.0;
  for (Index i = 0; i < count(); ++i)
    for (Index j = i + 1; j < count(); ++j)
      H += Expr(strengths_[i] * strengths_[j]) *
           log((x.segment(3 * i, 3) - x.segment(3 * j, 3)).squaredNorm());
  return H / Expr(4.0 * std::numbers::pi);
}

ExprVector SphericalVortices::moment(const ExprVector& x) const {
  ExprVector moment = ExprVector::Zero(3);
  for (Index i = 0; i < count(); ++i) moment += Expr(strengths_[i]) * x.segment(3 * i, 3);
  return moment;
}

std::shared_ptr<const ImplicitSystem> SphericalVortices::system() const {
  std::vector<std::shared_ptr<const Manifold>> spheres;
  std::vector<std::string> names;
  for (Index i = 0; i < count(); ++i) {
    spheres.push_back(std::make_shared<Sphere>(2));
    for (Index k = 0; k < 3; ++k)
      names.push_back("x[" + std::to_string(i) + "][" + std::to_string(k) + "]");
  }
  const auto configurations = std::make_shared<Product>(std::move(spheres));
  const auto bivector = [strengths = strengths_](const ExprVector& x) {
    ExprMatrix result = ExprMatrix::Zero(x.size(), x.size());
    for (Index i = 0; i < strengths.size(); ++i)
      result.block(3 * i, 3 * i, 3, 3) = hat(x.segment(3 * i, 3)) / Expr(strengths[i]);
    return result;
  };
  return std::make_shared<DiracSystem>(
      std::make_shared<Poisson>(configurations, bivector),
      std::make_shared<Hamiltonian>(
          configurations,
          [vortices = *this](const ExprVector& x, const Expr&) { return vortices.hamiltonian(x); }),
      ImplicitSystem::Names{.coordinates = std::move(names)});
}

std::optional<std::pair<Index, Index>> SphericalVortices::coinciding(const VectorXd& x) const {
  for (Index i = 0; i < count(); ++i)
    for (Index j = i + 1; j < count(); ++j)
      if (x.segment(3 * i, 3) == x.segment(3 * j, 3)) return std::pair(i, j);
  return std::nullopt;
}

}  // namespace courant
