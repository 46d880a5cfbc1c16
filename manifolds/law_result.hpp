// The outcome of measuring a law, and what measures it.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace courant {

// One law of one object: the largest defect that was found, where, and the bound that it must keep.
struct LawResult {
  std::string subject;  // name of the object: "Sphere(2, exponential)"
  std::string law;      // "M1 R(x, 0) = x"
  double defect = 0.0;
  double bound = 0.0;
  std::string where;  // at which point the defect was largest

  bool passed() const { return defect <= bound; }
};

bool all_passed(const std::vector<LawResult>& results);

// One line: passed or failed, subject, law, defect, bound; and where, if failed.
std::ostream& operator<<(std::ostream& out, const LawResult& result);

// Collects the defects of one law and keeps the worst; a law that was never measured fails.
class LawMeasurement {
 public:
  LawMeasurement(std::string subject, std::string law, double bound);

  // Takes a defect; one that is not a number counts as infinite.
  void add(double defect, const std::string& where);
  // The same for a defect that has to be computed; an exception counts as infinite, and `where`
  // then also says what it was.
  void add(const std::function<double()>& defect, const std::string& where);

  const LawResult& result() const { return result_; }

 private:
  LawResult result_;
  bool measured_ = false;
};

}  // namespace courant
