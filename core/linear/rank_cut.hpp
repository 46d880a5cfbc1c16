// Where dense and sparse rank decisions cut between numbers and noise. Not installed API:
// RankDecision is.
#pragma once

#include "courant/core/linear/rank_decision.hpp"

namespace courant {

// What singular values are held against.
struct NoiseLevel {
  double floor;  // ε of RankDecision
  // Stands for σ₀, above a cut at rank 0: the magnitude, or 1 for an equilibrated matrix.
  double top;
  // Above so many times ε a singular value is a number: 10² where ε is an estimate, 1 where it is a
  // bound.
  double number = 1e2;
};

// For an m × n matrix with this largest singular value.
NoiseLevel noise_level(Index m, Index n, double largest, const RankOptions& options);

// An entry at most this times the largest of its row and column counts as zero: 64 roundings, or
// data_error.
double entry_noise(const RankOptions& options);

// How many of these singular values count: `values` decreases and has all that are no numbers and, if
// there is one, a value above that.
Index count_above_cut(const VectorXd& values, const NoiseLevel& noise);

// Sets rank, above, below, gap and threshold.
void conclude(RankDecision& decision, Index rank, double above, double below,
              const NoiseLevel& noise);

}  // namespace courant
