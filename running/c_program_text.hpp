// The parts of a program in C that are the same in all of them. Not installed API: c_program is.
#pragma once

#include <string_view>

namespace courant::c_program_text {

std::string_view numbers();
std::string_view newton();
std::string_view field();
std::string_view predictor();
std::string_view solved_step();
std::string_view main();

}  // namespace courant::c_program_text
