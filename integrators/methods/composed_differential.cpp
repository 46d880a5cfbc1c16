#include "courant/integrators/methods/composed_differential.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace courant {

std::shared_ptr<const StepDifferential> ComposedDifferential::of(std::string method, Parts parts) {
  if (std::ranges::find(parts, nullptr) != parts.end()) return nullptr;
  return std::shared_ptr<const StepDifferential>(
      new ComposedDifferential(std::move(method), std::move(parts)));
}

ComposedDifferential::ComposedDifferential(std::string method, Parts of_parts)
    : method_(std::move(method)), of_parts_(std::move(of_parts)) {}

MatrixXd ComposedDifferential::do_images(const Step& step, const MatrixXd& V) const {
  require_parts(step);
  MatrixXd images = V;
  for (std::size_t i = 0; i < step.parts.size(); ++i) images = of_part(i)(step.parts[i], images);
  return images;
}

MatrixXd ComposedDifferential::do_pull_back(const Step& step, const MatrixXd& Lambda) const {
  require_parts(step);
  MatrixXd covectors = Lambda;
  for (std::size_t i = step.parts.size(); i-- > 0;)
    covectors = of_part(i).pull_back(step.parts[i], covectors);
  return covectors;
}

void ComposedDifferential::require_parts(const Step& step) const {
  // Parts that are not told have h = 0.
  if (step.parts.empty() || step.parts.front().h == 0.0)
    throw std::invalid_argument(method_ +
                                ": the step does not know its parts; expected one that was made "
                                "after Stepper::tell_parts().");
}

}  // namespace courant
