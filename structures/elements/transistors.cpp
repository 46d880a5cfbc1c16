#include "courant/structures/elements/transistors.hpp"

#include <optional>
#include <utility>

namespace courant::elements {
namespace {

using Kind = NetworkBranch::Kind;
using Role = NetworkBranch::Role;

// The voltage between two terminals as that of a branch of the element; 0 where they are one node, which needs no
// branch.
struct Across {
  std::optional<Index> branch;

  Expr at(const Variables& own) const { return branch ? own.voltage(*branch) : Expr(0.0); }
};

bool stores(const Across& across, const JunctionCharge& charge) {
  return across.branch && (charge.capacitance != 0.0 || charge.transit != 0.0);
}

// Adds the branches of an element whose terminals may be joined.
class Terminals {
 public:
  // Branches from the first to the second, for `reversed` from the second to the first.
  Terminals(const std::vector<Index>& joined, bool reversed)
      : joined_(joined), reversed_(reversed) {
    element.terminals = std::ssize(joined);
  }

  Across across(Index from, Index to) {
    const auto node = [&](Index terminal) { return joined_[static_cast<std::size_t>(terminal)]; };
    if (node(from) == node(to)) return {};
    return {count_++};
  }
  void conduct(const Across& across, Index from, Index to, const std::string& suffix, Law current) {
    if (!across.branch) return;
    element.branches.push_back({.from = reversed_ ? to : from,
                                .to = reversed_ ? from : to,
                                .kind = Kind::voltage,
                                .role = Role::resistor,
                                .law = std::move(current),
                                .suffix = suffix});
  }
  void store(const Across& across, Index from, Index to, const std::string& part,
             const JunctionCharge& charge, const MoreCharge& more) {
    if (!stores(across, charge)) return;
    store_in_junction(element, charge, *across.branch, reversed_ ? to : from, reversed_ ? from : to,
                      part, more);
  }

  Element element = {};

 private:
  const std::vector<Index>& joined_;
  bool reversed_;
  Index count_ = 0;
};

}  // namespace

Element bipolar_transistor(const BipolarTransistor& law, const JunctionCharge& at_emitter,
                           const JunctionCharge& at_collector, bool is_pnp,
                           const std::vector<Index>& joined) {
  constexpr Index collector = 0, base = 1, emitter = 2;
  Terminals terminals(joined, is_pnp);
  const Across e = terminals.across(base, emitter), c = terminals.across(base, collector);
  terminals.conduct(e, base, emitter, "_be", [=](const Variables& own) {
    const Expr v_e = e.at(own);
    return law.emitter_current(v_e) + law.transport(v_e, c.at(own));
  });
  terminals.conduct(c, base, collector, "_bc", [=](const Variables& own) {
    const Expr v_c = c.at(own);
    return law.collector_current(v_c) - law.transport(e.at(own), v_c);
  });
  MoreCharge more_at_emitter, more_at_collector;
  if (law.early_forward != 0.0 && stores(e, at_emitter) && stores(c, at_collector)) {
    const auto part = [=](Expr BipolarTransistor::Widening::*which) -> Law {
      return [=](const Variables& own) {
        return law.widening(at_emitter.transit, e.at(own), c.at(own)).*which;
      };
    };
    more_at_emitter = {part(&BipolarTransistor::Widening::at_emitter),
                       part(&BipolarTransistor::Widening::energy)};
    more_at_collector = {part(&BipolarTransistor::Widening::at_collector), {}};
  }
  terminals.store(e, base, emitter, "be", at_emitter, more_at_emitter);
  terminals.store(c, base, collector, "bc", at_collector, more_at_collector);
  return std::move(terminals.element);
}

Element mos_transistor(const MosChannel& channel, bool is_p, const std::vector<Index>& joined) {
  constexpr Index drain = 0, gate = 1, source = 2, bulk = 3;
  Terminals terminals(joined, is_p);
  const Across d = terminals.across(drain, source), g = terminals.across(gate, source),
               b = terminals.across(bulk, source);
  terminals.conduct(d, drain, source, "_ds", [=](const Variables& own) {
    return channel.current(g.at(own), d.at(own), b.at(own));
  });
  terminals.conduct(g, gate, source, "_gs", constant(0.0));
  terminals.conduct(b, bulk, source, "_bs", constant(0.0));
  return std::move(terminals.element);
}

}  // namespace courant::elements
