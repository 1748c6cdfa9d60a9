#include "bakers/preview/preview_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "bakers/assets/description/glsl_lookup.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/output_folder.h"
#include "bakers/math/parallel.h"
#include "bakers/preview/page_text.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

// Returns a safe file name for a name from a manifest, which may be anything ("../../.profile").
// The result consists of letters, digits and `_-.`, does not name a hidden file, and is not too
// long for file systems.
std::string file_stem(std::string_view name) {
    constexpr std::size_t longest = 120;
    std::string stem(name.substr(0, longest));
    for (char& c : stem) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
        if (!plain) c = '_';
    }
    if (stem.empty() || stem.front() == '.') stem.insert(stem.begin(), '_');
    return stem;
}

}  // namespace

std::vector<PagePicture> PictureEncoder::encode(
    const std::string& key, const std::function<std::vector<PreviewPicture>()>& make) {
    const std::vector<PagePicture>* known = remembered(key);
    std::vector<PagePicture> pictures = known != nullptr ? *known : encoded(make());
    if (memory_ != nullptr) shown_[key] = pictures;
    last_key_ = key;
    for (PagePicture& picture : pictures) picture.name = free_name(picture.name);
    return pictures;
}

const std::vector<PagePicture>* PictureEncoder::remembered(const std::string& key) const {
    if (memory_ == nullptr) return nullptr;
    for (const PicturesByKey* pictures : {&memory_->pictures, &memory_->unfinished}) {
        if (const auto found = pictures->find(key); found != pictures->end()) return &found->second;
    }
    return nullptr;
}

void PictureEncoder::give_up() {
    shown_.erase(last_key_);
    if (memory_ != nullptr) memory_->unfinished = std::move(shown_);
}

std::vector<Diagnostic> PictureEncoder::finish() {
    if (memory_ != nullptr) *memory_ = {std::move(shown_), {}};
    return std::move(problems_);
}

std::vector<PagePicture> PictureEncoder::encoded(std::vector<PreviewPicture> pictures) {
    std::vector<Outcome<std::string>> bytes(pictures.size());
    parallel_for(static_cast<int>(pictures.size()), threads_, [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        bytes[at] = png_bytes(pictures[at].picture);
    });
    std::vector<PagePicture> result;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        if (!bytes[i].value) {
            std::move(bytes[i].diagnostics.begin(), bytes[i].diagnostics.end(),
                      std::back_inserter(problems_));
            return {};
        }
        pictures[i].picture.rgb = {};
        result.push_back({std::move(pictures[i]), std::move(*bytes[i].value)});
    }
    return result;
}

std::string PictureEncoder::free_name(std::string_view name) {
    const std::string stem = file_stem(name);
    std::string free = stem;
    for (int i = 2; !names_.insert(free).second; ++i) free = fmt::format("{}_{}", stem, i);
    return free;
}

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void append(const std::vector<PagePicture>& pictures, std::vector<const PagePicture*>& all) {
    for (const PagePicture& picture : pictures) all.push_back(&picture);
}

// Returns the pictures that are files of their own. A live page has none.
std::vector<const PagePicture*> written_pictures(const PreviewPage& page) {
    std::vector<const PagePicture*> all;
    if (!page.live_scene.empty()) return all;
    for (const PageTable& table : page.tables) {
        append(table.pictures, all);
        for (const PageVariant& variant : table.variants) {
            if (variant.picture) all.push_back(&*variant.picture);
        }
    }
    for (const PageScene& scene : page.scenes) append(scene.pictures, all);
    for (const PageAsset& asset : page.assets) append(asset.pictures, all);
    return all;
}

std::string shaders_json() {
    Json shaders;
    for (const char* name : {"sky", "tiles", "clouds", "light", "direct", "picture"}) {
        shaders[name] = embedded_text(std::string(name) + ".glsl");
    }
    shaders["screen"] =
        fmt::format("{}\n{}", published_lookup("film.glsl"), embedded_text("screen.glsl"));
    return safe_in_script(shaders.dump());
}

// Returns a page that renders a scene while one flies through it: one HTML file that contains everything
// it shows. Where the browser cannot, it shows the pictures of the page. It needs no other file and no
// network, except that a page that follows a recipe reads the files page_state_name and swap_name_of
// beside it.
std::string live_html(const PreviewPage& page) {
    return filled(embedded_text("live.html"),
                  {{"head", head_html(page, "live.css")},
                   {"title", html_text(page.title)},
                   {"pictures", pictures_html(page)},
                   {"shaders", shaders_json()},
                   {"scene", safe_in_script(page.live_scene)},
                   {"files", other_files(page)},
                   {"renderer", std::string(embedded_text("live_diffuse.js")) +
                                    std::string(embedded_text("live_clouds.js")) +
                                    std::string(embedded_text("live_renderer.js"))},
                   {"script", std::string(embedded_text("live.js"))},
                   {"watch", watch_element(page.watch_revision)}});
}

}  // namespace

std::vector<NamedFile> preview_files(const PreviewPage& page) {
    std::vector<NamedFile> files;
    for (const PagePicture* picture : written_pictures(page)) {
        files.push_back({picture->name + ".png", picture->png});
    }
    if (page.watch_revision > 0) files.push_back({swap_name_of(page), page_swap_text(page)});
    files.push_back({page_name, page.live_scene.empty() ? page_html(page) : live_html(page)});
    return files;
}

std::vector<std::string> preview_file_names(const PreviewPage& page) {
    auto names = mapped<std::string>(
        written_pictures(page), [](const PagePicture* picture) { return picture->name + ".png"; });
    if (page.watch_revision > 0) names.emplace_back(swap_name_of(page));
    names.emplace_back(page_name);
    return names;
}

std::vector<std::string> earlier_preview_files(const fs::path& folder) {
    const Outcome<std::string> page = read_file(folder / page_name);
    auto names = page.value ? files_of_page(*page.value) : std::nullopt;
    if (!names) return {};
    names->emplace_back(page_name);
    return std::move(*names);
}

std::vector<Diagnostic> foreign_preview_files(const fs::path& folder,
                                              const std::vector<std::string>& names,
                                              const std::vector<std::string>& earlier) {
    std::vector<Diagnostic> diagnostics;
    for (const std::string& name : names) {
        std::error_code error;
        if (!fs::exists(fs::symlink_status(folder / name, error))) continue;
        if (std::ranges::find(earlier, name) != earlier.end()) continue;
        diagnostics.push_back(foreign_file(folder / name, "was not written by a preview"));
    }
    return diagnostics;
}

}  // namespace skybake
