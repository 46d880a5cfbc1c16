// The courant command as one function: for programs that have kinds of their own.
#pragma once

#include "courant/reading/method_kinds.hpp"
#include "courant/reading/space.hpp"
#include "courant/reading/structure_kinds.hpp"
#include "courant/reading/system_kinds.hpp"

namespace courant {

// What `courant` does with its arguments, and its exit status. A program that adds kinds to the
// registries first has them in every experiment, and in all of the command:
//
//   int main(int argc, char** argv) {
//     courant::manifold_kinds().add({{"nil", "…"}, read_heisenberg});
//     return courant::command_main(argc, argv);
//   }
//
// Handles SIGINT, SIGTERM and SIGHUP: call it once, from main. See docs/tutorial-new-kind.md.
int command_main(int argc, char** argv);

}  // namespace courant
