// page.html, page.css, page.js and page_watch.js as they travel inside the program.
#pragma once

#include <string_view>

namespace skybake {

std::string_view page_html_template();
std::string_view page_style();
std::string_view page_script();
std::string_view page_watch_script();

}  // namespace skybake
