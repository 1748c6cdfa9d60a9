#include "bakers/preview/preview_files.h"

#include <fmt/format.h>

#include "bakers/io/file_diagnostic.h"
#include "bakers/io/read_file.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

void append(const std::vector<PagePicture>& pictures, std::vector<PreviewFile>& files) {
    for (const PagePicture& picture : pictures) {
        files.push_back({picture.name + ".png", picture.png});
    }
}

config::Diagnostic foreign_file(const fs::path& path) {
    config::Diagnostic diagnostic =
        file_error("E0303", path.string(),
                   fmt::format("`{}` is there already, and no preview made it", path.string()));
    diagnostic.label = "another folder by -o, or --force to overwrite it";
    return diagnostic;
}

}  // namespace

std::vector<PreviewFile> preview_files(const PreviewPage& page) {
    std::vector<PreviewFile> files;
    if (page.sweep) append(page.sweep->pictures, files);
    for (const PageScene& scene : page.scenes) append(scene.pictures, files);
    for (const PageAsset& asset : page.assets) append(asset.pictures, files);
    files.push_back({page_name, page_html(page)});
    return files;
}

std::vector<config::Diagnostic> foreign_preview_files(const fs::path& folder,
                                                      const std::vector<PreviewFile>& files) {
    const config::Outcome<std::string> page = read_file(folder / page_name);
    const std::string earlier = page.value && is_page_text(*page.value) ? *page.value : "";
    std::vector<config::Diagnostic> diagnostics;
    for (const PreviewFile& file : files) {
        std::error_code error;
        if (!fs::exists(fs::symlink_status(folder / file.name, error))) continue;
        const bool own = file.name == page_name ? !earlier.empty()
                                                : !earlier.empty() && is_page_text(earlier, file.name);
        if (!own) diagnostics.push_back(foreign_file(folder / file.name));
    }
    return diagnostics;
}

}  // namespace skybake
