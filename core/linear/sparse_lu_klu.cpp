#include <amd.h>
#include <klu.h>

#include <algorithm>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "courant/core/linear/sparse_lu.hpp"
#include "courant/core/linear/two_ended_ordering.hpp"

namespace courant {
namespace {

// Factors whose pivots were chosen for another matrix are kept while entries do not grow by more.
constexpr double kLeastReciprocalGrowth = 1e-4;

// The sign of a permutation of 0 … n-1.
int sign(const int* permutation, int n) {
  std::vector<bool> is_seen(static_cast<std::size_t>(n), false);
  int result = 1;
  for (int begin = 0; begin < n; ++begin)
    for (int i = begin, length = 0; !is_seen[static_cast<std::size_t>(i)]; i = permutation[i]) {
      is_seen[static_cast<std::size_t>(i)] = true;
      if (++length > 1) result = -result;
    }
  return result;
}

// Of a diagonal block, in the place of minimum degree alone, which KLU would take. How many entries L may have, or 0.
int order(int n, int* offsets, int* rows, int* order, klu_common*) {
  try {
    const auto size = static_cast<std::size_t>(n);
    const auto entries = static_cast<std::size_t>(offsets[n]);
    const std::vector<int> two_ended = two_ended_ordering({offsets, size + 1}, {rows, entries});
    if (!two_ended.empty()) {
      std::ranges::copy(two_ended, order);
      return n + offsets[n];
    }
    double info[AMD_INFO];
    if (amd_order(n, offsets, rows, order, nullptr, info) < AMD_OK) return 0;
    return n + static_cast<int>(info[AMD_LNZ]);
  } catch (const std::exception&) {  // KLU is C
    return 0;
  }
}

}  // namespace

struct SparseLu::Factors {
  klu_common common;
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;

  explicit Factors(const Matrix& S) {
    klu_defaults(&common);
    common.scale = 0;  // who calls has scaled
    common.ordering = 3;
    common.user_order = &order;
    if (S.rows() == 0) return;
    symbolic = klu_analyze(static_cast<int>(S.rows()), offsets(S), rows(S), &common);
    if (symbolic == nullptr)
      throw std::runtime_error("SparseLu: KLU found no ordering of a matrix of " +
                               std::to_string(S.rows()) + " rows, status " +
                               std::to_string(common.status) + ".");
  }
  ~Factors() {
    klu_free_numeric(&numeric, &common);
    klu_free_symbolic(&symbolic, &common);
  }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;

  bool refactorize(const Matrix& S) {
    return numeric != nullptr &&
           klu_refactor(offsets(S), rows(S), entries(S), symbolic, numeric, &common) != 0 &&
           klu_rgrowth(offsets(S), rows(S), entries(S), symbolic, numeric, &common) != 0 &&
           common.rgrowth > kLeastReciprocalGrowth;
  }

  // KLU does not declare what it only reads as such.
  static int* offsets(const Matrix& S) { return const_cast<int*>(S.outerIndexPtr()); }
  static int* rows(const Matrix& S) { return const_cast<int*>(S.innerIndexPtr()); }
  static double* entries(const Matrix& S) { return const_cast<double*>(S.valuePtr()); }
};

SparseLu::SparseLu(const Matrix& S) : factors_(std::make_unique<Factors>(S)) {}
SparseLu::~SparseLu() = default;

bool SparseLu::factorize(const Matrix& S) {
  Factors& f = *factors_;
  if (f.symbolic == nullptr || f.refactorize(S)) return true;
  klu_free_numeric(&f.numeric, &f.common);
  f.numeric =
      klu_factor(Factors::offsets(S), Factors::rows(S), Factors::entries(S), f.symbolic, &f.common);
  return f.numeric != nullptr;
}

void SparseLu::forget() { klu_free_numeric(&factors_->numeric, &factors_->common); }

double SparseLu::pivot_ratio() const {
  Factors& f = *factors_;
  if (f.symbolic == nullptr) return 1.0;
  return klu_rcond(f.symbolic, f.numeric, &f.common) != 0 ? f.common.rcond : 0.0;
}

int SparseLu::orientation() const {
  const Factors& f = *factors_;
  if (f.symbolic == nullptr) return 1;
  int result = sign(f.numeric->Pnum, f.symbolic->n) * sign(f.symbolic->Q, f.symbolic->n);
  const auto* pivots = static_cast<const double*>(f.numeric->Udiag);
  for (int i = 0; i < f.symbolic->n; ++i)
    if (pivots[i] < 0.0) result = -result;
  return result;
}

void SparseLu::solve(double* b) const {
  Factors& f = *factors_;
  if (f.symbolic != nullptr) klu_solve(f.symbolic, f.numeric, f.symbolic->n, 1, b, &f.common);
}

}  // namespace courant
