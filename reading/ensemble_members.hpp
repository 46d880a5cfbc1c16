// EnsembleMembers: the experiments of the members of an ensemble.
#pragma once

#include "courant/reading/experiment.hpp"

namespace courant {

// The experiments of the members, each as it would be read with its values in its document: `--set` of their pointers.
class EnsembleMembers {
 public:
  // Of an experiment with an ensemble. Throws ExperimentError where the first member cannot be read.
  explicit EnsembleMembers(const Experiment& experiment);

  Index count() const;
  // By several threads at once. Throws ExperimentError where its values are wrong.
  Experiment operator()(Index i) const;

 private:
  Json document(Index i) const;

  const Experiment& experiment_;
  Json base_;                  // with one member, which has no values
  bool shares_system_ = true;  // members differ in what they start with alone
};

}  // namespace courant
