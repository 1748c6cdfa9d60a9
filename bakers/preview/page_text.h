// Text of HTML pages: templates, and what stands in them.
//
// The figures of a page: its pictures as HTML, and as browsers without scripts show them.
//
// Texts that the program contains: shaders, scripts and pages.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "bakers/preview/page.h"

namespace skybake {

// The content of a page's <meta name="generator">, by which a later preview knows it.
std::string generator();

// Returns text for HTML, outside of tags or within quotes.
std::string html_text(std::string_view text);

// Returns JSON for a script element. "</script" would end the element even within a JSON string,
// and "<!--" would change how its end is found, so every "<" is escaped.
std::string safe_in_script(std::string_view json);

// Returns the template with each {{name}} replaced. Replacement is not repeated within the values.
std::string filled(std::string_view form, const std::map<std::string_view, std::string>& values);

// Lists the files beside the page that are not its pictures, as JSON for a script element.
std::string other_files(const PreviewPage& page);

// Returns the beginning of a page, up to its body, with the style of that file.
std::string head_html(const PreviewPage& page, std::string_view style);

// Returns the script of a page that follows a recipe; nothing for revision 0.
std::string watch_element(int revision);

// Returns "scene", "plot" or "image".
std::string_view kind_name(PictureKind kind);

// Returns the plot of an asset's report as a picture without bytes. Its file is NAME.svg.
PagePicture report_plot(const PageAsset& asset);

// Returns the HTML of all pictures of the page, in the order in which its scripts show them.
std::string pictures_html(const PreviewPage& page);

// Returns the text of a page's file or of one of bakers/preview/runtime by its name, such as "live.html". Throws std::out_of_range where there is none.
std::string_view embedded_text(std::string_view name);

}  // namespace skybake
