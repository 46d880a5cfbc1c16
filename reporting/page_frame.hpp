// What all pages have in common: their head, their style.
#pragma once

#include <string>
#include <string_view>

#include "courant/plotting/svg.hpp"

namespace courant {

// A heading and what belongs under it; nothing where that is nothing.
plot::Markup page_section(std::string_view title, const plot::Markup& content);

// The style sheet of what stands on pages, whatever their frame.
std::string content_style();

// The whole file: `body` in the house's style, for light and dark screens, phones and paper. `script` may be
// nothing.
std::string whole_page(std::string_view title, const plot::Markup& body,
                       const plot::Markup& script = {});

}  // namespace courant
