#include "courant/reading/ensemble_members.hpp"

#include <optional>
#include <string>
#include <utility>

#include "courant/core/words/message.hpp"

namespace courant {

EnsembleMembers::EnsembleMembers(const Experiment& experiment)
    : experiment_(experiment), base_(experiment.document) {
  base_["ensemble"] = {{"members", 1}};
  if (base_["initial"] == "rest") base_["initial"] = {{"rest", true}};
  for (const std::string& pointer : experiment_.ensemble->pointers)
    shares_system_ = shares_system_ && pointer.starts_with("/initial/");
}

Index EnsembleMembers::count() const { return experiment_.ensemble->members(); }

Json EnsembleMembers::document(Index i) const {
  const Ensemble& ensemble = *experiment_.ensemble;
  Json result = base_;
  for (std::size_t k = 0; k < ensemble.pointers.size(); ++k)
    result[Json::json_pointer(ensemble.pointers[k])] = ensemble.values(i, static_cast<Index>(k));
  return result;
}

Experiment EnsembleMembers::operator()(Index i) const {
  Json written = document(i);
  if (!shares_system_) {
    Experiment member = read_experiment_document(written);
    const TimeSpan &time = *member.time, &common = *experiment_.time;
    if (time.start != common.start || time.step != common.step || time.steps != common.steps ||
        member.output.at != experiment_.output.at)
      throw ExperimentError("/time", "is made of parameters that members change: the step is " +
                                         exact_text(time.step) + " in place of " +
                                         exact_text(common.step) +
                                         "; expected the same times for all of them");
    member.ensemble.reset();
    return member;
  }
  Findings findings;
  const auto place = [&](const char* key) {
    return written.contains(key)
               ? std::optional(JsonReader(written[key], std::string("/") + key, findings))
               : std::nullopt;
  };
  auto values = read_initial_values(*place("initial"), place("hold"), place("weights"),
                                    place("nominal"), experiment_.model);
  findings.require_clean();
  Experiment member = experiment_;
  member.ensemble.reset();
  member.initial = *std::move(values);
  member.document = std::move(written);
  return member;
}

}  // namespace courant
