// The script of the report's page.
#pragma once

#include <string_view>

namespace courant {

// The files of reporting/page/ in one. It finds the figures by what plot::draw writes beside the
// curves, and adds values under the pointer, zoom and an instant that moves along time.
std::string_view report_script();

}  // namespace courant
