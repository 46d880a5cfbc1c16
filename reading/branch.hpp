// The key "branch" of an experiment.
#pragma once

#include "courant/reading/json_reader.hpp"
#include "courant/reading/model.hpp"

namespace courant {

// Restricts a model to branch k = 1, 2, … of its system (branches()); the description says which one it is. A number
// that no branch has is a problem that says how many there are.
void choose_branch(const JsonReader& key, Model& model);

// The system that the branch of a model is one of; that of the model where none was chosen.
std::shared_ptr<const ImplicitSystem> whole_system(const Model& model);

}  // namespace courant
