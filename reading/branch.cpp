#include "courant/reading/branch.hpp"

#include "courant/integrators/certificate/branches.hpp"
#include "courant/structures/branch_system.hpp"

namespace courant {

void choose_branch(const JsonReader& key, Model& model) {
  const auto number = key.integer(1);
  if (!number) return;
  const std::vector<Branch> all = branches(model.system);
  const Index count = std::ssize(all);
  if (count == 0) {
    key.problem("is " + std::to_string(*number) +
                ", and none of the equations is seen to be a product; expected no \"branch\"");
    return;
  }
  if (*number > count) {
    key.problem("is " + std::to_string(*number) + ", and there are " + std::to_string(count) +
                " branches; expected a number from 1 to " + std::to_string(count));
    return;
  }
  const Branch& chosen = all[static_cast<std::size_t>(*number - 1)];
  model.system = chosen.system;
  model.description += ", branch " + std::to_string(*number) + " of " + std::to_string(count) + ":";
  for (const std::string& equation : chosen.equations)
    model.description += (&equation == &chosen.equations.front() ? " " : ", ") + equation + " = 0";
}

std::shared_ptr<const ImplicitSystem> whole_system(const Model& model) {
  std::shared_ptr<const ImplicitSystem> system = model.system;
  while (const auto branch = std::dynamic_pointer_cast<const BranchSystem>(system))
    system = branch->whole();
  return system;
}

}  // namespace courant
