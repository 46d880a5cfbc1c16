#include "courant/manifolds/torus.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

namespace courant {

Torus::Torus(Index dimension)
    : Manifold("Torus(" + std::to_string(dimension) + ")", dimension, dimension, dimension) {}

ExprVector Torus::do_inverse_retract(const ExprVector& x, const ExprVector& y) const {
  return (y - x).unaryExpr([](const Expr& angle) { return atan2(sin(angle), cos(angle)); });
}

ExprMatrix Torus::do_frame(const ExprVector& x) const {
  return ExprMatrix::Identity(x.size(), x.size());
}

double Torus::do_separation(const VectorXd& x, const VectorXd& y) const {
  constexpr double turn = 2.0 * std::numbers::pi;
  return (y - x).unaryExpr([](double angle) { return std::remainder(angle, turn); }).norm();
}

double Torus::do_injectivity_radius(const VectorXd&) const { return std::numbers::pi; }

VectorXd Torus::do_random_point(std::mt19937& generator) const {
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi);
  return VectorXd::NullaryExpr(dimension(), [&] { return angle(generator); });
}

Manifold::ScalingSymmetries Torus::do_scaling_symmetries() const {
  const std::vector<Index> angles(static_cast<std::size_t>(dimension()), ScalingSymmetries::none);
  std::vector<Index> each(angles.size());
  std::iota(each.begin(), each.end(), Index{0});
  return {.point = angles, .tangent = angles, .fibre = each};
}

}  // namespace courant
