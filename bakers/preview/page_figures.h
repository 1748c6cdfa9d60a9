// The figures of a page: its pictures as HTML, and as browsers without scripts show them.
#pragma once

#include <string>
#include <string_view>

#include "bakers/preview/page.h"

namespace skybake {

// Returns "scene", "plot" or "image".
std::string_view kind_name(PictureKind kind);

// Returns the plot of an asset's report as a picture without bytes. Its file is NAME.svg.
PagePicture report_plot(const PageAsset& asset);

// Returns the HTML of all pictures of the page, in the order in which its scripts show them.
std::string pictures_html(const PreviewPage& page);

}  // namespace skybake
