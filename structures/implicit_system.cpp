#include "courant/structures/implicit_system.hpp"

#include <algorithm>
#include <stdexcept>

#include "courant/core/numbers/as_size.hpp"

namespace courant {
namespace {

void complete(std::vector<std::string>& names, Index size, const char* stem) {
  if (names.empty())
    for (Index i = 0; i < size; ++i)
      names.push_back(std::string(stem) + "[" + std::to_string(i) + "]");
  if (static_cast<Index>(names.size()) != size)
    throw std::invalid_argument("ImplicitSystem::ImplicitSystem: there are " +
                                std::to_string(names.size()) + " names for " + stem +
                                ", expected " + std::to_string(size) + ".");
}

void check_size(const char* function, const char* argument, Index size, Index expected) {
  if (size != expected)
    throw std::invalid_argument(std::string("ImplicitSystem::") + function + ": " + argument +
                                " has " + std::to_string(size) + " entries, expected " +
                                std::to_string(expected) + ".");
}

}  // namespace

std::optional<Index> ImplicitSystem::Names::momentum_of(Index coordinate) const {
  const auto found = std::ranges::find(coordinates, "p_" + coordinates[as_size(coordinate)]);
  if (found == coordinates.end()) return std::nullopt;
  return found - coordinates.begin();
}

ImplicitSystem::ImplicitSystem(std::shared_ptr<const Manifold> manifold, Index auxiliary_size,
                               Index equation_count, Names names)
    : manifold_(std::move(manifold)),
      auxiliary_size_(auxiliary_size),
      equation_count_(equation_count),
      names_(std::move(names)) {
  if (!manifold_) throw std::invalid_argument("ImplicitSystem::ImplicitSystem: manifold is null.");
  complete(names_.coordinates, manifold_->ambient_dimension(), "x");
  complete(names_.auxiliary, auxiliary_size_, "z");
  complete(names_.equations, equation_count_, "equation");
}

ExprVector ImplicitSystem::residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                                    const Expr& t) const {
  check_size("residual", "x", x.size(), manifold_->ambient_dimension());
  check_size("residual", "v", v.size(), manifold_->tangent_dimension());
  check_size("residual", "z", z.size(), auxiliary_size_);
  ExprVector result = do_residual(x, v, z, t);
  check_size("residual", "the residual", result.size(), equation_count_);
  return result;
}

VectorXd ImplicitSystem::auxiliary_guess(const VectorXd& x, const VectorXd& v) const {
  check_size("auxiliary_guess", "x", x.size(), manifold_->ambient_dimension());
  if (v.size() == 0 && manifold_->tangent_dimension() > 0)
    return auxiliary_guess(x, VectorXd::Zero(manifold_->tangent_dimension()));
  check_size("auxiliary_guess", "v", v.size(), manifold_->tangent_dimension());
  VectorXd result = do_auxiliary_guess(x, v);
  check_size("do_auxiliary_guess", "the result", result.size(), auxiliary_size_);
  return result;
}

VectorXd ImplicitSystem::do_auxiliary_guess(const VectorXd&, const VectorXd&) const {
  return VectorXd::Zero(auxiliary_size_);
}

VectorXd ImplicitSystem::residual(const VectorXd& x, const VectorXd& v, const VectorXd& z,
                                  double t) const {
  return values(residual(constants(x), constants(v), constants(z), Expr(t)));
}

}  // namespace courant
