#include "courant/structures/constrained_family.hpp"

#include <stdexcept>

namespace courant {
namespace {

const GeneratingFamily& checked(const std::shared_ptr<const GeneratingFamily>& family,
                                const ConstrainedFamily::Condition& condition) {
  if (!family || !condition)
    throw std::invalid_argument(
        "ConstrainedFamily::ConstrainedFamily: the family or the condition is missing; expected "
        "both.");
  return *family;
}

}  // namespace

ConstrainedFamily::ConstrainedFamily(std::shared_ptr<const GeneratingFamily> family,
                                     Condition condition, Index m)
    // Braces evaluate from left to right: the check comes first.
    : GeneratingFamily{checked(family, condition).manifold(), family->parameter_size() + m},
      family_(std::move(family)),
      condition_(std::move(condition)),
      count_(m) {}

Expr ConstrainedFamily::do_value(const ExprVector& x, const ExprVector& lambda,
                                 const Expr& t) const {
  const ExprVector inner = lambda.head(family_->parameter_size());
  const ExprVector c = condition_(x, inner, t);
  if (c.size() != count_)
    throw std::invalid_argument("ConstrainedFamily: the condition has " + std::to_string(c.size()) +
                                " entries; expected " + std::to_string(count_) + ".");
  return family_->value(x, inner, t) + lambda.tail(count_).dot(c);
}

Expr ConstrainedFamily::do_energy(const ExprVector& x, const ExprVector& lambda,
                                  const Expr& t) const {
  return family_->energy(x, lambda.head(family_->parameter_size()), t);
}

VectorXd ConstrainedFamily::do_parameter_guess(const VectorXd& x, const VectorXd& v) const {
  VectorXd guess = VectorXd::Zero(parameter_size());
  guess.head(family_->parameter_size()) = family_->parameter_guess(x, v);
  return guess;
}

}  // namespace courant
