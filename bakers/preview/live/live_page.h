// A page that renders a scene while one flies through it: one HTML file that contains everything it
// shows. Where the browser cannot, it shows the pictures of the page.
#pragma once

#include <string>
#include <vector>

#include "bakers/preview/page.h"
#include "bakers/preview/preview_files.h"

namespace skybake {

// Returns the page's text, for a page with a live_scene. It needs no other file and no network,
// except that a page that follows a recipe reads the files page_state_name and live_scene_name
// beside it.
std::string live_html(const PreviewPage& page);

// The file from which a page that follows a recipe takes what has changed.
inline constexpr const char* live_scene_name = "live_scene.js";

// Returns the files of such a page, itself as the last, and their names.
std::vector<PreviewFile> live_files(const PreviewPage& page);
std::vector<std::string> live_file_names(const PreviewPage& page);

}  // namespace skybake
