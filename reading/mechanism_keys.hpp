// The keys of a mechanism in an experiment.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "courant/reading/kind.hpp"
#include "courant/structures/joint.hpp"

namespace courant {

// Keys of the kind `mechanism`.
std::vector<Key> mechanism_keys();
// Of the entries under these.
const KindDescription& body_keys();
const KindDescription& joint_keys();
const KindDescription& mimic_keys();
const KindDescription& spring_keys();
const KindDescription& force_keys();

// The word of a joint, its type, and the key of what drives it.
struct JointWord {
  const char* word;
  JointType type;
  const char* effort;
};
std::span<const JointWord> joint_types();
std::vector<std::string> joint_words();

}  // namespace courant
