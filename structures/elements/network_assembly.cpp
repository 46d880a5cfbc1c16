#include "courant/structures/elements/network_assembly.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "courant/core/numbers/as_size.hpp"

namespace courant::elements {
namespace {

[[noreturn]] void refuse(const char* function, const std::string& what) {
  throw std::invalid_argument(std::string("NetworkAssembly::") + function + ": " + what);
}

// What an element stores.
struct Store {
  StateLaw energy;
  std::vector<Index> states;
};

}  // namespace

void NetworkAssembly::add(const std::string& name, Element element,
                          const std::vector<Index>& nodes) {
  if (numbers_.contains(name)) refuse("add", "there is an element " + name + " already.");
  if (std::ssize(nodes) != element.terminal_count())
    refuse("add", name + " has " + std::to_string(element.terminal_count()) +
                      " terminals, and there are " + std::to_string(nodes.size()) + " nodes.");
  for (const Index node : nodes)
    if (node < 0)
      refuse("add", name + " is at the node " + std::to_string(node) +
                        "; expected 0, the ground, or more.");
  Place place{name, std::move(element), std::ssize(branches_)};
  for (Index k = 0; k < place.element.state_count(); ++k) place.states.push_back(states_ + k);
  std::vector<NetworkBranch> branches =
      placed(place.element, name, nodes, place.first_branch, place.states);
  for (const NetworkBranch& branch : branches)
    if (branch.from == branch.to)
      refuse("add",
             branch.name + " has both its ends at the node " + std::to_string(branch.from) + ".");
  states_ += place.element.state_count();
  for (const Index node : nodes) nodes_ = std::max(nodes_, node + 1);
  for (NetworkBranch& branch : branches) branches_.push_back(std::move(branch));
  numbers_.emplace(name, places_.size());
  places_.push_back(std::move(place));
}

Index NetworkAssembly::member(const std::string& inductor) {
  const auto found = numbers_.find(inductor);
  if (found == numbers_.end() || !places_[found->second].element.inductance)
    refuse("couple", inductor + " is no inductor that is given by its inductance.");
  const auto known = std::ranges::find(members_, found->second);
  if (known != members_.end()) return known - members_.begin();
  members_.push_back(found->second);
  return coupled_.add(*places_[found->second].element.inductance);
}

bool NetworkAssembly::couple(const std::string& first, const std::string& second, double coupling) {
  if (first == second) refuse("couple", first + " is both of the inductors.");
  const Index i = member(first), j = member(second);
  return coupled_.add(i, j, coupling);
}

Network::Energy NetworkAssembly::energy() const {
  std::vector<Store> stores;
  for (std::size_t k = 0; k < places_.size(); ++k)
    if (places_[k].element.energy && std::ranges::find(members_, k) == members_.end())
      stores.push_back({places_[k].element.energy, places_[k].states});
  std::vector<Index> fluxes;
  for (const std::size_t member : members_) fluxes.push_back(places_[member].states[0]);
  return [stores = std::move(stores), fluxes = std::move(fluxes), inverse = coupled_.inverse()](
             const ExprVector& x, const Expr& t) {
    Expr sum = 0.0;
    for (const Store& store : stores) sum += store.energy(x(store.states), x, t);
    if (fluxes.empty()) return sum;
    const ExprVector flux = x(fluxes);
    return sum + 0.5 * flux.cwiseProduct(inverse * flux).sum();
  };
}

std::shared_ptr<const Network> NetworkAssembly::network() const {
  if (!has_positive_inductances())
    refuse("network", "the inductors are coupled so that their energy is not positive.");
  return std::make_shared<const Network>(nodes_, branches_, energy());
}

}  // namespace courant::elements
