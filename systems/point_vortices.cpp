#include "courant/systems/point_vortices.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "courant/core/words/message.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/lagrangian_system.hpp"
#include "courant/structures/poisson.hpp"

namespace courant {
namespace {

std::vector<std::string> coordinate_names(Index count, std::initializer_list<const char*> stems) {
  std::vector<std::string> names;
  for (const std::string stem : stems)
    for (Index i = 0; i < count; ++i) names.push_back(stem + "[" + std::to_string(i) + "]");
  return names;
}

}  // namespace

PointVortices::PointVortices(VectorXd strengths) : strengths_(std::move(strengths)) {
  for (Index i = 0; i < count(); ++i)
    if (!std::isfinite(strengths_[i]) || strengths_[i] == 0.0)
      throw std::invalid_argument("PointVortices::PointVortices: strength " + std::to_string(i) +
                                  " is " + number_text(strengths_[i]) +
                                  "; expected a number other than 0.");
}

Expr PointVortices::hamiltonian(const ExprVector& q) const {
  const auto x = q.head(count()), y = q.tail(count());
  Expr H = 0.0;
  for (Index i = 0; i < count(); ++i)
    for (Index j = i + 1; j < count(); ++j)
      H += Expr(strengths_[i] * strengths_[j]) * log(square(x[i] - x[j]) + square(y[i] - y[j]));
  return H / Expr(4.0 * std::numbers::pi);
}

ExprVector PointVortices::alpha(const ExprVector& q) const {
  const ExprVector half = constants(0.5 * strengths_);
  ExprVector alpha(2 * count());
  alpha << -half.cwiseProduct(q.tail(count())), half.cwiseProduct(q.head(count()));
  return alpha;
}

std::shared_ptr<const DiracSystem> PointVortices::lagrangian_form() const {
  const auto plane = std::make_shared<Euclidean>(2 * count());
  return lagrangian_system(
      std::make_shared<CotangentBundle>(plane),
      [vortices = *this](const ExprVector& q, const ExprVector& w, const Expr&) {
        return vortices.alpha(q).dot(w) - vortices.hamiltonian(q);
      },
      coordinate_names(count(), {"x", "y", "p_x", "p_y"}));
}

std::shared_ptr<const ImplicitSystem> PointVortices::hamiltonian_form() const {
  const auto plane = std::make_shared<Euclidean>(2 * count());
  const VectorXd inverse = strengths_.cwiseInverse();
  MatrixXd bivector = MatrixXd::Zero(2 * count(), 2 * count());
  bivector.topRightCorner(count(), count()).diagonal() = -inverse;
  bivector.bottomLeftCorner(count(), count()).diagonal() = inverse;
  return std::make_shared<DiracSystem>(
      std::make_shared<Poisson>(plane,
                                [bivector](const ExprVector&) { return constants(bivector); }),
      std::make_shared<Hamiltonian>(
          plane,
          [vortices = *this](const ExprVector& q, const Expr&) { return vortices.hamiltonian(q); }),
      ImplicitSystem::Names{coordinate_names(count(), {"x", "y"}), {}, {}});
}

std::optional<std::pair<Index, Index>> PointVortices::coinciding(const VectorXd& q) const {
  for (Index i = 0; i < count(); ++i)
    for (Index j = i + 1; j < count(); ++j)
      if (q[i] == q[j] && q[count() + i] == q[count() + j]) return std::pair(i, j);
  return std::nullopt;
}

}  // namespace courant
