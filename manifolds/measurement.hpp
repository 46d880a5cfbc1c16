// How derivatives and orders are measured by the law checkers.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/manifolds/law_result.hpp"
#include "courant/manifolds/manifold.hpp"

namespace courant {

// The slope of the least-squares line through (log step, log error): the order of an error.
// Infinite if no error is above `floor`, the round-off level: there is nothing to measure then, the
// map is exact. Errors at or below the floor are left out otherwise.
double log_log_slope(const std::vector<double>& steps, const std::vector<double>& errors,
                     double floor);

// A family of curves t ↦ F(t; data) ∈ R^m, traced once with its first two derivatives.
class CurveFamily {
 public:
  using Curve = std::function<ExprVector(const Expr& t, const ExprVector& data)>;
  CurveFamily(const Curve& curve, Index data_size);

  // How far F'(0) and F''(0) are from differences of order 6 of F and F', relative to 1 + their
  // size; infinite where one is not finite. The least of three steps, `step`, a quarter and a
  // sixteenth of it: where F changes quickly the larger ones truncate, and where it does not the
  // smallest one is at round-off. A derivative that is wrong is wrong with all of them.
  double derivative_defect(const VectorXd& data, double step) const;

 private:
  double difference_defect(const VectorXd& data, const MatrixXd& exact, double step) const;
  MatrixXd at(double t, const VectorXd& data) const;  // F, F', F'' as columns

  Function function_;
};

// A point to measure laws at.
struct LawSample {
  VectorXd x;
  double radius;                  // injectivity radius there
  std::vector<VectorXd> vectors;  // tangent vectors of the lengths that check_manifold names
  VectorXd w, u;                  // unit tangent vectors, directions to differentiate along
};

// `count` random ones. `far` is the length that stands for the last 1 % of an infinite radius;
// radii are at most `limit`.
std::vector<LawSample> draw_samples(const Manifold& M, int count, double far,
                                    std::mt19937& generator,
                                    double limit = std::numeric_limits<double>::infinity());

// Calls visit(sample, v) for each tangent vector of each sample.
template <class Visit>
void for_vectors(const std::vector<LawSample>& samples, const Visit& visit) {
  for (const LawSample& s : samples)
    for (const VectorXd& v : s.vectors) visit(s, v);
}

// A curve t ↦ F(t) to differentiate at t = 0, made of a sample's x, w and u and one of its vectors.
using SampleCurve =
    std::function<ExprVector(const Expr& t, const ExprVector& x, const ExprVector& w,
                             const ExprVector& v, const ExprVector& u)>;

// The derivative_defect of the curve for each tangent vector of each sample. A curve that cannot be
// traced is an infinite defect.
LawResult measure_derivatives(LawMeasurement measured, const Manifold& M,
                              const std::vector<LawSample>& samples, const SampleCurve& curve);

// A point of M at about that ambient distance from x, made by projection and not by the retraction.
VectorXd point_near(const Manifold& M, const VectorXd& x, double distance, std::mt19937& generator);

// ‖difference‖ / (1 + ‖scale‖)
double relative(const VectorXd& difference, const VectorXd& scale);

// "x = (0.5, -0.5, …)", at most six entries, for LawResult::where.
std::string describe(const char* name, const VectorXd& x);
std::string describe(const LawSample& sample, const VectorXd& v);

}  // namespace courant
