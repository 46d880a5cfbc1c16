// The families of the catalogue of ladders, each in a file of its own.
//
// In their derivations λ is a multiplier, ' the velocity; "fibre" is what is left of the velocity at
// a point of M_k. Where nothing else is said the sequence follows from one differentiation a level.
#pragma once

#include "ladder_catalogue.hpp"

namespace courant::examples {

// Each adds its ladders to the table.
void ordinary(std::vector<KnownLadder>& table);
void singular_lagrangians(std::vector<KnownLadder>& table);
void mechanics(std::vector<KnownLadder>& table);
void ports_and_circuits(std::vector<KnownLadder>& table);
void optimal_control(std::vector<KnownLadder>& table);
void on_manifolds(std::vector<KnownLadder>& table);
void without_answers(std::vector<KnownLadder>& table);

// Dimensions of a Hessenberg chain: each level takes one from both until (last, last).
Dimensions falling(Index dim_S, Index dim_M, Index steps);

}  // namespace courant::examples
