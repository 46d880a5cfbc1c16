#include "courant/core/collected_terms.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "courant/core/subgraph.hpp"

namespace courant {
namespace {

// A coefficient below this part of what it was added up from is round-off.
constexpr double kRoundOff = 1e-15;

// Shared sums of more terms than this are not taken apart, nor are those of longer sums.
constexpr std::size_t kMostTerms = 32;

struct Term {
  Expr atom;
  double coefficient, magnitude;  // what it was added up from
};

// Σ c_k a_k + c_0. Operations are counted as they will be written.
class Sum {
 public:
  void add(const Expr& atom, double coefficient) {
    if (atom.is_constant()) {
      constant_ += coefficient * atom.value();
      return;
    }
    const auto [place, is_new] = places_.try_emplace(atom.node(), terms_.size());
    if (is_new) {
      terms_.push_back({atom, coefficient, std::fabs(coefficient)});
      return;
    }
    has_met_ = true;
    Term& term = terms_[place->second];
    term.coefficient += coefficient;
    term.magnitude += std::fabs(coefficient);
  }

  void add(const Sum& other, double factor) {
    for (const Term& term : other.terms_) add(term.atom, factor * term.coefficient);
    constant_ += factor * other.constant_;
  }

  // The same with a term that is a sum taken apart.
  Sum with_apart(const Expr& atom, const Sum& sum) const {
    Sum result;
    result.constant_ = constant_;
    for (const Term& term : terms_)
      if (term.atom.node() == atom.node())
        result.add(sum, term.coefficient);
      else
        result.add(term.atom, term.coefficient);
    return result;
  }

  void drop_zeros() {
    std::erase_if(terms_, [](const Term& term) {
      return std::fabs(term.coefficient) <= kRoundOff * term.magnitude;
    });
    places_.clear();
    for (std::size_t k = 0; k < terms_.size(); ++k) places_[terms_[k].atom.node()] = k;
  }

  bool has_met() const { return has_met_; }
  const std::vector<Term>& terms() const { return terms_; }

  std::size_t operations() const {
    std::size_t count = terms_.size() + (constant_ != 0.0 ? 1 : 0);
    if (count > 0) --count;
    if (terms_.empty()) return count;
    const double common = common_factor();
    if (common != 1.0) ++count;
    for (const Term& term : terms_)
      if (std::fabs(term.coefficient / common) != 1.0) ++count;
    return terms_[first()].coefficient / common == -1.0 ? count + 1 : count;
  }

  // c (a_1 - a_2 + …) where all coefficients but the constant have one size.
  Expr expression() const {
    if (terms_.empty()) return constant_;
    const double common = common_factor();
    const std::size_t first = this->first();
    Expr sum = terms_[first].coefficient / common * terms_[first].atom;
    for (std::size_t k = 0; k < terms_.size(); ++k) {
      if (k == first) continue;
      const double c = terms_[k].coefficient / common;
      sum = c > 0.0 ? sum + c * terms_[k].atom : sum - (-c) * terms_[k].atom;
    }
    return common * sum + constant_;
  }

 private:
  // The term to begin with: the first that is added.
  std::size_t first() const {
    const auto added = std::ranges::find_if(
        terms_, [](double c) { return c > 0.0; }, &Term::coefficient);
    return added == terms_.end() ? 0 : static_cast<std::size_t>(added - terms_.begin());
  }

  // That of all coefficients, with the sign of the first; 1 where they have several sizes.
  double common_factor() const {
    const double c = terms_[first()].coefficient;
    const bool is_common = terms_.size() > 1 && std::ranges::all_of(terms_, [&](const Term& term) {
                             return std::fabs(term.coefficient) == std::fabs(c);
                           });
    return is_common && std::fabs(c) != 1.0 ? c : 1.0;
  }

  std::vector<Term> terms_;  // in the order in which they came
  std::unordered_map<std::uint32_t, std::size_t> places_;
  double constant_ = 0.0;
  bool has_met_ = false;
};

class Collector {
 public:
  explicit Collector(const ExprVector& roots)
      : subgraph_(roots), image_(subgraph_.size()), is_head_(subgraph_.size(), false) {
    find_heads(roots);
    for (std::size_t at = 0; at < subgraph_.size(); ++at) {
      const Node& node = this->node(at);
      const int count = arity(node.op);
      if (count == 0) {
        image_[at] = subgraph_.graph().expression(subgraph_.nodes()[at]);
        continue;
      }
      const std::uint32_t operands[] = {node.a, node.b, node.c};
      Expr images[3];
      for (int k = 0; k < count; ++k) images[k] = image_[subgraph_.position(operands[k])];
      image_[at] = apply(node.op, node.k, images[0], images[1], images[2]);
      if (is_head_[at] && is_linear(node)) collect(at);
    }
  }

  Expr operator()(const Expr& root) const {
    return root.is_constant() ? root : image_[subgraph_.position(root)];
  }

 private:
  const Node& node(std::size_t at) const { return subgraph_.graph().node(subgraph_.nodes()[at]); }
  bool is_number(std::uint32_t operand) const {
    return subgraph_.graph().node(operand).op == Op::constant && std::isfinite(number(operand));
  }
  double number(std::uint32_t operand) const { return subgraph_.graph().constant(operand); }

  // A sum, or a number times something.
  bool is_linear(const Node& node) const {
    switch (node.op) {
      case Op::negate:
      case Op::add:
      case Op::subtract:
        return true;
      case Op::multiply:
        return is_number(node.a) || is_number(node.b);
      case Op::divide:
        return is_number(node.b) && number(node.b) != 0.0;
      default:
        return false;
    }
  }

  // What is asked for, or needed in several places or by another operation than a sum.
  void find_heads(const ExprVector& roots) {
    std::vector<bool> is_used(subgraph_.size(), false);
    for (std::size_t at = 0; at < subgraph_.size(); ++at) {
      const Node& node = this->node(at);
      const bool linear = is_linear(node);
      const std::uint32_t operands[] = {node.a, node.b, node.c};
      for (int k = 0; k < arity(node.op); ++k) {
        const std::size_t operand = subgraph_.position(operands[k]);
        if (!linear || is_used[operand]) is_head_[operand] = true;
        is_used[operand] = true;
      }
    }
    for (const Expr& root : roots)
      if (!root.is_constant()) is_head_[subgraph_.position(root)] = true;
  }

  // The sum that a head is, down to the next heads and to what is no sum; `operations`: how many it takes.
  Sum sum_of(std::size_t head, std::size_t& operations) const {
    struct Part {
      std::size_t at;
      double factor;
    };
    Sum sum;
    std::vector<Part> open = {{head, 1.0}};
    while (!open.empty()) {
      const std::size_t at = open.back().at;
      const double factor = open.back().factor;
      open.pop_back();
      const Node& node = this->node(at);
      if (at != head && (is_head_[at] || !is_linear(node))) {
        sum.add(image_[at], factor);
        continue;
      }
      ++operations;
      const auto part = [&](std::uint32_t operand, double times) {
        open.push_back({subgraph_.position(operand), factor * times});
      };
      switch (node.op) {
        case Op::negate:
          part(node.a, -1.0);
          break;
        case Op::multiply:
          if (is_number(node.a))
            part(node.b, number(node.a));
          else
            part(node.a, number(node.b));
          break;
        case Op::divide:
          part(node.a, 1.0 / number(node.b));
          break;
        default:  // the first operand is looked at first
          part(node.b, node.op == Op::add ? 1.0 : -1.0);
          part(node.a, 1.0);
      }
    }
    sum.drop_zeros();
    return sum;
  }

  void collect(std::size_t head) {
    std::size_t before = 0;
    Sum sum = sum_of(head, before);
    bool has_met = sum.has_met();
    for (bool is_apart = true; is_apart && sum.terms().size() <= kMostTerms;) {
      is_apart = false;
      for (const Term& term : sum.terms()) {
        const auto known = sums_.find(term.atom.node());
        if (known == sums_.end() || known->second.terms().size() > kMostTerms) continue;
        Sum apart = sum.with_apart(term.atom, known->second);
        if (!apart.has_met()) continue;
        apart.drop_zeros();
        if (apart.operations() > std::min(before, sum.operations())) continue;
        sum = std::move(apart);
        has_met = is_apart = true;
        break;
      }
    }
    if (has_met && sum.operations() <= before) image_[head] = sum.expression();
    if (!image_[head].is_constant()) sums_.try_emplace(image_[head].node(), std::move(sum));
  }

  Subgraph subgraph_;
  std::vector<Expr> image_;
  std::vector<bool> is_head_;
  std::unordered_map<std::uint32_t, Sum> sums_;  // by the nodes of images
};

}  // namespace

ExprVector collected(const ExprVector& expressions) {
  const Collector collector(expressions);
  return expressions.unaryExpr([&](const Expr& a) { return collector(a); });
}

}  // namespace courant
