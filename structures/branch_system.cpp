#include "courant/structures/branch_system.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"

namespace courant {
namespace {

bool is_left_out(const BranchSystem::Equations& equations, Index i) {
  return std::ranges::find(equations.left_out, i) != equations.left_out.end();
}

ImplicitSystem::Names names_of_branch(const std::shared_ptr<const ImplicitSystem>& whole,
                                      const BranchSystem::Equations& equations) {
  if (!whole)
    throw std::invalid_argument("BranchSystem::BranchSystem: there is no system; expected one.");
  ImplicitSystem::Names names = whole->names();
  std::vector<std::string> kept;
  for (Index i = 0; i < whole->equation_count(); ++i)
    if (!is_left_out(equations, i)) kept.push_back(names.equations[static_cast<std::size_t>(i)]);
  kept.insert(kept.end(), equations.names.begin(), equations.names.end());
  names.equations = std::move(kept);
  return names;
}

Index count_of_branch(const std::shared_ptr<const ImplicitSystem>& whole,
                      const BranchSystem::Equations& equations) {
  return (whole ? whole->equation_count() : 0) - std::ssize(equations.left_out) +
         equations.functions.size();
}

}  // namespace

BranchSystem::BranchSystem(std::shared_ptr<const ImplicitSystem> whole, Equations equations)
    : ImplicitSystem(whole ? whole->manifold() : nullptr, whole ? whole->auxiliary_size() : 0,
                     count_of_branch(whole, equations), names_of_branch(whole, equations)),
      whole_(std::move(whole)),
      equations_(std::move(equations)) {
  const Manifold& M = *manifold();
  if (equations_.x.size() != M.ambient_dimension() ||
      equations_.v.size() != M.tangent_dimension() || equations_.z.size() != auxiliary_size() ||
      equations_.functions.size() != std::ssize(equations_.names))
    throw std::invalid_argument(
        "BranchSystem::BranchSystem: the equations have other variables than " + M.name() +
        " and the unknowns of the system, or not a name each.");
  const Index first = whole_->tangent_blocks() * M.tangent_dimension();
  for (const Index i : equations_.left_out)
    if (i < first || i >= whole_->equation_count())
      throw std::invalid_argument("BranchSystem::BranchSystem: equation " + std::to_string(i) +
                                  " is left out; expected one of " + std::to_string(first) +
                                  " to " + std::to_string(whole_->equation_count() - 1) + ".");
  for (Index i = 0; i < whole_->equation_count(); ++i)
    if (!is_left_out(equations_, i)) kept_.push_back(i);
  own_.resize(std::ssize(equations_.rewritten));
  for (std::size_t k = 0; k < equations_.rewritten.size(); ++k)
    own_[static_cast<Index>(k)] = equations_.rewritten[k].second;
  own_ = joined(own_, equations_.functions);
  variables_ =
      joined(equations_.x, equations_.v, equations_.z, ExprVector::Constant(1, equations_.t));
}

ExprVector BranchSystem::do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                                     const Expr& t) const {
  ExprVector all = whole_->residual(x, v, z, t);
  const ExprVector own = substitute(own_, variables_, joined(x, v, z, ExprVector::Constant(1, t)));
  for (std::size_t k = 0; k < equations_.rewritten.size(); ++k)
    all[equations_.rewritten[k].first] = own[static_cast<Index>(k)];
  return joined(ExprVector(all(kept_)), own.tail(equations_.functions.size()));
}

std::optional<Expr> BranchSystem::do_energy(const ExprVector& x, const ExprVector& z,
                                            const Expr& t) const {
  return whole_->energy(x, z, t);
}

VectorXd BranchSystem::do_auxiliary_guess(const VectorXd& x, const VectorXd& v) const {
  return whole_->auxiliary_guess(x, v);
}

}  // namespace courant
