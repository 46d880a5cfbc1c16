// The differential of a step that is made of others.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "courant/integrators/step/step_differential.hpp"

namespace courant {

// T Φ_s ∘ … ∘ T Φ_1 at a Step with parts 1, …, s. With one differential for all of them, or
// with several in turn: part i has that of i modulo their number.
class ComposedDifferential final : public StepDifferential {
 public:
  using Parts = std::vector<std::shared_ptr<const StepDifferential>>;

  // Nothing if one of them is missing. `method` is named in messages.
  static std::shared_ptr<const StepDifferential> of(std::string method, Parts parts);

 private:
  ComposedDifferential(std::string method, Parts of_parts);

  // Throws std::invalid_argument where the step does not know its parts.
  MatrixXd do_images(const Step& step, const MatrixXd& V) const override;
  MatrixXd do_pull_back(const Step& step, const MatrixXd& Lambda) const override;
  void require_parts(const Step& step) const;
  const StepDifferential& of_part(std::size_t i) const { return *of_parts_[i % of_parts_.size()]; }

  std::string method_;
  Parts of_parts_;
};

}  // namespace courant
