#include "courant/core/algebra/collected_terms.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "courant/core/algebra/sum_of_terms.hpp"
#include "courant/core/expressions/subgraph.hpp"
#include "courant/core/numbers/power_of_two.hpp"

namespace courant {
namespace {

// Shared sums of more terms than this are not taken apart, nor are those of longer sums.
constexpr std::size_t kMostCollected = 32;

class Collector {
 public:
  // Without `varying` everything varies, and products stay.
  Collector(const ExprVector& roots, const ExprVector* varying)
      : subgraph_(roots),
        image_(subgraph_.size()),
        is_head_(subgraph_.size(), false),
        varies_(varying == nullptr ? std::vector<bool>(subgraph_.size(), true)
                                   : contains_any(subgraph_, *varying)) {
    find_heads(roots);
    if (varying != nullptr) chains_.resize(subgraph_.size());
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
      if (!varies_[at] || !is_linear(node)) continue;
      if (!chains_.empty() && is_product(node)) join_chain(at);
      if (is_head_[at]) collect(at);
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

  bool is_known(std::uint32_t operand) const { return !varies_[subgraph_.position(operand)]; }

  // c f a as several operations: a power of two, at most one known factor, and the rest.
  struct Chain {
    double number = 1.0;
    Expr factor = 1.0, atom = 0.0;
    int length = 0;
  };

  static bool is_product(const Node& node) {
    return node.op == Op::negate || node.op == Op::multiply || node.op == Op::divide;
  }
  // Of a product that is linear: the operand, and what stands before it.
  std::pair<std::uint32_t, Expr> split(const Node& node) const {
    const auto known = [&](std::uint32_t operand) {
      return is_number(operand) ? Expr(number(operand)) : image_[subgraph_.position(operand)];
    };
    if (node.op == Op::negate) return {node.a, -1.0};
    if (node.op == Op::divide) return {node.a, 1.0 / known(node.b)};
    const bool is_second = is_number(node.b) || (!is_number(node.a) && is_known(node.b));
    return is_second ? std::pair(node.a, known(node.b)) : std::pair(node.b, known(node.a));
  }
  // One operation with what varies instead of all, with the same bits.
  void join_chain(std::size_t at) {
    const auto [operand, before] = split(node(at));
    const bool is_number = before.is_constant();
    if (is_number ? !is_power_of_two(before.value()) : node(at).op == Op::divide) return;
    const std::size_t place = subgraph_.position(operand);
    Chain chain = chains_[place];
    if (chain.length == 0 || (!is_number && !chain.factor.is_constant()))
      chain = {.atom = image_[place]};
    ++chain.length;
    if (is_number)
      chain.number *= before.value();
    else
      chain.factor = before;
    if (chain.length > 1) image_[at] = chain.number * chain.factor * chain.atom;
    chains_[at] = std::move(chain);
  }

  // Not a number.
  bool has_known_factor(const Node& node) const {
    const auto is_factor = [&](std::uint32_t operand) {
      return is_known(operand) && !is_number(operand);
    };
    return (node.op == Op::multiply && (is_factor(node.a) || is_factor(node.b))) ||
           (node.op == Op::divide && is_factor(node.b));
  }

  // A sum, or something times a number or what is known beforehand.
  bool is_linear(const Node& node) const {
    switch (node.op) {
      case Op::negate:
      case Op::add:
      case Op::subtract:
        return true;
      case Op::multiply:
        return is_number(node.a) || is_number(node.b) || is_known(node.a) != is_known(node.b);
      case Op::divide:
        return is_number(node.b) ? number(node.b) != 0.0 : is_known(node.b) && !is_known(node.a);
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
    // Products with what is known that stand in such a product: (a + (b + c/h)/h)/h keeps its parentheses, inside of
    // which terms may cancel.
    std::vector<bool> is_inside(subgraph_.size(), false);
    for (std::size_t at = subgraph_.size(); at-- > 0;) {
      const Node& node = this->node(at);
      if (!varies_[at] || !is_linear(node)) continue;
      if (is_inside[at] && has_known_factor(node)) is_head_[at] = true;
      const std::uint32_t operands[] = {node.a, node.b, node.c};
      for (int k = 0; k < arity(node.op); ++k)
        is_inside[subgraph_.position(operands[k])] =
            has_known_factor(node) || (is_inside[at] && !is_head_[at]);
    }
  }

  // A place in the tree of sums and products that a head is, down to the next heads and to what is no sum.
  struct Place {
    std::size_t at, parent;
    double number;  // what stands before it
    Expr factor;
    bool is_head = false, is_leaf = false;
    bool meets = false;    // a leaf there has an equal one
    std::size_t size = 1;  // of its own tree
  };

  // Each before what it is made of, the first operand before the second.
  std::vector<Place> places_of(std::size_t head) const {
    std::vector<Place>
        open = {{.at = head, .parent = 0, .number = 1.0, .factor = 1.0, .is_head = true}},
        places;
    while (!open.empty()) {
      Place place = std::move(open.back());
      open.pop_back();
      const Node& node = this->node(place.at);
      place.is_leaf = !place.is_head && (is_head_[place.at] || !is_linear(node));
      const auto part = [&](std::uint32_t operand, double times) {
        open.push_back({.at = subgraph_.position(operand),
                        .parent = places.size(),
                        .number = place.number * times,
                        .factor = place.factor});
      };
      if (!place.is_leaf && is_product(node)) {
        const auto [operand, before] = split(node);
        part(operand, before.is_constant() ? before.value() : 1.0);
        if (!before.is_constant()) open.back().factor = place.factor * before;
      } else if (!place.is_leaf) {
        part(node.b, node.op == Op::add ? 1.0 : -1.0);
        part(node.a, 1.0);
      }
      places.push_back(std::move(place));
    }
    // How many leaves there are of each atom, or of sums with it that may be taken apart.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> leaves;
    const auto for_each_atom = [&](const Place& leaf, const auto& visit) {
      if (image_[leaf.at].is_constant()) return;
      const std::uint32_t factor = node_number(leaf.factor), atom = node_number(image_[leaf.at]);
      visit(leaves[{factor, atom}]);
      if (const auto known = sums_.find(atom); known != sums_.end() && may_be_apart(known->second))
        for (const SumOfTerms::Term& term : known->second.terms())
          visit(leaves[{leaf.factor.is_constant() ? node_number(term.factor) : factor,
                        node_number(term.atom)}]);
    };
    for (const Place& place : places)
      if (place.is_leaf) for_each_atom(place, [](std::size_t& count) { ++count; });
    for (std::size_t i = places.size(); i-- > 1;) {
      Place& place = places[i];
      if (place.is_leaf) for_each_atom(place, [&](std::size_t count) { place.meets |= count > 1; });
      places[place.parent].size += place.size;
      if (place.meets) places[place.parent].meets = true;
    }
    return places;
  }

  static bool may_be_apart(const SumOfTerms& sum) { return sum.terms().size() <= kMostCollected; }
  bool stays(const Place& place) const {
    return place.is_leaf || (!place.is_head && !place.meets && !is_product(node(place.at)));
  }

  // Without what is in the sums that stay.
  template <class Visit>
  void for_each_open(const std::vector<Place>& places, const Visit& visit) const {
    for (std::size_t i = 0; i < places.size(); i += stays(places[i]) ? places[i].size : 1)
      visit(places[i]);
  }

  // What a head is. A sum none of whose terms meets another one stays in its parentheses, where terms may cancel, as in
  // I (exp(v) - 1).
  SumOfTerms sum_of(const std::vector<Place>& places) const {
    SumOfTerms sum;
    for_each_open(places, [&](const Place& place) {
      if (stays(place)) sum.add(place.number, place.factor, image_[place.at], varies_[place.at]);
    });
    sum.drop_zeros();
    return sum;
  }
  // All terms of it.
  SumOfTerms whole_sum_of(const std::vector<Place>& places) const {
    SumOfTerms sum;
    for (const Place& place : places)
      if (place.is_leaf) sum.add(place.number, place.factor, image_[place.at], varies_[place.at]);
    sum.drop_zeros();
    return sum;
  }
  // How many operations with what varies it takes, but for those in sums that stay.
  std::size_t operations_of(const std::vector<Place>& places) const {
    std::size_t count = 0;
    for_each_open(places, [&](const Place& place) {
      if (!stays(place) && varies_[place.at]) ++count;
    });
    return count;
  }

  void collect(std::size_t head) {
    const std::vector<Place> places = places_of(head);
    const std::size_t before = operations_of(places);
    SumOfTerms sum = sum_of(places);
    bool has_met = sum.has_met();
    for (bool is_apart = true; is_apart && sum.terms().size() <= kMostCollected;) {
      is_apart = false;
      for (const SumOfTerms::Term& term : sum.terms()) {
        if (!term.varies) continue;
        const auto known = sums_.find(term.atom.node());
        if (known == sums_.end() || !may_be_apart(known->second)) continue;
        if (!term.factor.is_constant() && known->second.has_factors()) continue;
        SumOfTerms apart = sum.with_apart(term.atom, known->second);
        if (!apart.has_met()) continue;
        apart.drop_zeros();
        if (apart.operations() > std::min(before, sum.operations())) continue;
        sum = std::move(apart);
        has_met = is_apart = true;
        break;
      }
    }
    const bool is_better = has_met && sum.is_exact() && sum.operations() <= before;
    if (is_better) {
      image_[head] = sum.expression();
      if (!chains_.empty()) chains_[head] = {};
    }
    if (!image_[head].is_constant())
      sums_.try_emplace(image_[head].node(), is_better ? std::move(sum) : whole_sum_of(places));
  }

  Subgraph subgraph_;
  std::vector<Expr> image_;
  std::vector<bool> is_head_, varies_;
  std::vector<Chain> chains_;
  std::unordered_map<std::uint32_t, SumOfTerms> sums_;  // by the nodes of images
};

}  // namespace

ExprVector collected(const ExprVector& expressions) {
  const Collector collector(expressions, nullptr);
  return expressions.unaryExpr([&](const Expr& a) { return collector(a); });
}

ExprVector collected(const ExprVector& expressions, const ExprVector& varying) {
  const Collector collector(expressions, &varying);
  return expressions.unaryExpr([&](const Expr& a) { return collector(a); });
}

}  // namespace courant
