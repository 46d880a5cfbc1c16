#include "courant/manifolds/law_result.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

#include "courant/core/words/message.hpp"

namespace courant {

bool all_passed(const std::vector<LawResult>& results) {
  return std::ranges::all_of(results, &LawResult::passed);
}

std::ostream& operator<<(std::ostream& out, const LawResult& result) {
  out << (result.passed() ? "passed  " : "FAILED  ") << result.subject << ": " << result.law
      << ": defect " << result.defect << ", bound " << result.bound;
  if (!result.passed()) out << ", " << result.where;
  return out;
}

LawMeasurement::LawMeasurement(std::string subject, std::string law, double bound) {
  result_.subject = std::move(subject);
  result_.law = std::move(law);
  result_.bound = bound;
  result_.defect = std::numeric_limits<double>::infinity();
  result_.where = "nothing was measured";
}

void LawMeasurement::add(double defect, const std::string& where) {
  if (std::isnan(defect)) defect = std::numeric_limits<double>::infinity();
  if (measured_ && !(defect > result_.defect)) return;
  measured_ = true;
  result_.defect = defect;
  result_.where = where;
}

void LawMeasurement::add(const std::function<double()>& defect, const std::string& where) {
  try {
    add(defect(), where);
  } catch (const std::exception& error) {
    add(std::numeric_limits<double>::infinity(), where + ": " + without_place(error.what()));
  }
}

}  // namespace courant
