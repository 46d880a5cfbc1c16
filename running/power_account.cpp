#include "courant/running/power_account.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace courant {

void PowerAccount::open(double H) {
  memory_ = {.first = H,
             .last = H,
             .supplied = VectorXd::Zero(std::ssize(energies_.suppliers())),
             .dissipated = VectorXd::Zero(std::ssize(energies_.dissipators()))};
}

void PowerAccount::enter(const Step& step) {
  energies_.measure(step, last_, workspace_);
  memory_.supplied += last_.supplied;
  memory_.dissipated += last_.dissipated;
}

void PowerAccount::settle(double H) {
  Memory& now = memory_;
  now.balance = H - now.last - last_.supply() + last_.loss();
  now.size = std::max(now.size, std::fabs(H) + std::fabs(now.last) + last_.moved);
  now.moved = std::max(now.moved, last_.moved);
  // Not std::max: what is not a number stays.
  if (!(std::fabs(now.balance) <= now.greatest)) now.greatest = std::fabs(now.balance);
  const double at_stage = std::fabs(last_.stage_balance);
  if (!(at_stage <= now.stage_greatest)) now.stage_greatest = at_stage;
  now.last = H;
}

double PowerAccount::imbalance() const {
  return memory_.size > 0.0 ? memory_.greatest / memory_.size : memory_.greatest;
}

double PowerAccount::stage_imbalance() const {
  return memory_.moved > 0.0 ? memory_.stage_greatest / memory_.moved : memory_.stage_greatest;
}

PowerAccount::Report PowerAccount::report() const {
  const auto ports = [](const std::vector<std::string>& names, const VectorXd& energies) {
    std::vector<std::pair<std::string, double>> all;
    for (Index i = 0; i < energies.size(); ++i)
      all.emplace_back(names[static_cast<std::size_t>(i)], energies[i]);
    return all;
  };
  return {.supplied = ports(energies_.suppliers(), memory_.supplied),
          .dissipated = ports(energies_.dissipators(), memory_.dissipated),
          .stored = memory_.last - memory_.first,
          .max_balance = memory_.greatest,
          .max_imbalance = imbalance(),
          .max_stage_imbalance = stage_imbalance()};
}

void PowerAccount::recall(const Memory& memory) {
  if (memory.supplied.size() != std::ssize(energies_.suppliers()) ||
      memory.dissipated.size() != std::ssize(energies_.dissipators()))
    throw std::invalid_argument("PowerAccount::recall: the memory has " +
                                std::to_string(memory.supplied.size()) + " and " +
                                std::to_string(memory.dissipated.size()) + " ports, expected " +
                                std::to_string(energies_.suppliers().size()) + " and " +
                                std::to_string(energies_.dissipators().size()) + ".");
  memory_ = memory;
}

}  // namespace courant
