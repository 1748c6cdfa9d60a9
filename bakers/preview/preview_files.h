// The files of a preview, and the signs by which it knows its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/preview/page.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct PreviewFile {
    std::string name;  // relative to the preview's folder
    std::string bytes;
};

// NAME.png of each picture, and the page last.
std::vector<PreviewFile> preview_files(const PreviewPage& page);

// Their names alone.
std::vector<std::string> preview_file_names(const PreviewPage& page);

// The files that earlier previews left in the folder, as its page says; none without such a page.
std::vector<std::string> earlier_preview_files(const std::filesystem::path& folder);

// E0303 for each of these files that is in the folder and not among `earlier`.
std::vector<config::Diagnostic> foreign_preview_files(const std::filesystem::path& folder,
                                                      const std::vector<std::string>& names,
                                                      const std::vector<std::string>& earlier);

}  // namespace skybake
