// The files of a preview, and the signs by which it knows its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/preview/page.h"
#include "config/diagnostic.h"

namespace skybake {

struct PreviewFile {
    std::string name;  // relative to the preview's folder
    std::string bytes;
};

// NAME.png of each picture, and the page last.
std::vector<PreviewFile> preview_files(const PreviewPage& page);

// E0303 for each of these files that is in the folder and that no earlier preview there has made:
// a page that is not a preview's, pictures that the preview's page does not show.
std::vector<config::Diagnostic> foreign_preview_files(const std::filesystem::path& folder,
                                                      const std::vector<PreviewFile>& files);

}  // namespace skybake
