#include "bakers/preview/preview_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "bakers/io/files/file_diagnostic.h"
#include "bakers/io/files/read_file.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

void append(const std::vector<PagePicture>& pictures, std::vector<const PagePicture*>& all) {
    for (const PagePicture& picture : pictures) all.push_back(&picture);
}

std::vector<const PagePicture*> pictures_of(const PreviewPage& page) {
    std::vector<const PagePicture*> all;
    if (page.sweep) {
        append(page.sweep->pictures, all);
        for (const PageVariant& variant : page.sweep->variants) {
            if (variant.picture) all.push_back(&*variant.picture);
        }
    }
    for (const PageScene& scene : page.scenes) append(scene.pictures, all);
    for (const PageAsset& asset : page.assets) append(asset.pictures, all);
    return all;
}

config::Diagnostic foreign_file(const fs::path& path) {
    config::Diagnostic diagnostic = file_error(
        "E0303", path.string(),
        fmt::format("`{}` already exists and was not written by a preview", path.string()));
    diagnostic.label = "overwrite it with --force, or choose another folder with -o";
    return diagnostic;
}

}  // namespace

std::vector<PreviewFile> preview_files(const PreviewPage& page) {
    std::vector<PreviewFile> files;
    for (const PagePicture* picture : pictures_of(page)) {
        files.push_back({picture->name + ".png", picture->png});
    }
    files.push_back({page_name, page_html(page)});
    return files;
}

std::vector<std::string> preview_file_names(const PreviewPage& page) {
    std::vector<std::string> names;
    for (const PagePicture* picture : pictures_of(page)) names.push_back(picture->name + ".png");
    names.emplace_back(page_name);
    return names;
}

std::vector<std::string> earlier_preview_files(const fs::path& folder) {
    const config::Outcome<std::string> page = read_file(folder / page_name);
    auto names = page.value ? files_of_page(*page.value) : std::nullopt;
    if (!names) return {};
    names->emplace_back(page_name);
    return std::move(*names);
}

std::vector<config::Diagnostic> foreign_preview_files(const fs::path& folder,
                                                      const std::vector<std::string>& names,
                                                      const std::vector<std::string>& earlier) {
    std::vector<config::Diagnostic> diagnostics;
    for (const std::string& name : names) {
        std::error_code error;
        if (!fs::exists(fs::symlink_status(folder / name, error))) continue;
        if (std::find(earlier.begin(), earlier.end(), name) != earlier.end()) continue;
        diagnostics.push_back(foreign_file(folder / name));
    }
    return diagnostics;
}

}  // namespace skybake
