// The parts of a program in C that are the same in all of them. Not installed API: c_program is.
#pragma once

#include <string_view>

namespace courant::c_program_text {

std::string_view numbers();
std::string_view newton();
std::string_view approach();
std::string_view field();
std::string_view predictor();
std::string_view longest_column();
std::string_view orthonormal();
std::string_view basis();
std::string_view round_off();
std::string_view turning();
std::string_view displaced();
std::string_view displaced_part();
std::string_view projected();
std::string_view projected_part();
std::string_view looks();
std::string_view step();
std::string_view main();

}  // namespace courant::c_program_text
