#include "bakers/preview/live/live_page.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bakers/assets/description/glsl_lookup.h"
#include "bakers/preview/page_text.h"

namespace skybake {
namespace {

using Json = nlohmann::ordered_json;

std::string shaders_json() {
    Json shaders;
    for (const char* name : {"sky", "tiles", "clouds", "light", "direct", "picture"}) {
        shaders[name] = embedded_text(std::string(name) + ".glsl");
    }
    shaders["screen"] =
        fmt::format("{}\n{}", published_lookup("film"), embedded_text("screen.glsl"));
    return safe_in_script(shaders.dump());
}

// Lists the files beside the page, as pages of pictures list theirs.
std::string files_json(const PreviewPage& page) {
    Json files = Json::array();
    for (const std::string& name : page.retired) files.push_back({{"file", name}});
    if (page.watch_revision > 0) files.push_back({{"file", live_scene_name}});
    return safe_in_script(files.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace

std::string live_html(const PreviewPage& page) {
    return filled(embedded_text("live.html"),
                  {{"generator", html_text(generator())},
                   {"title", html_text(page.title)},
                   {"style", std::string(embedded_text("live.css"))},
                   {"pictures", pictures_html(page)},
                   {"shaders", shaders_json()},
                   {"scene", safe_in_script(page.live_scene)},
                   {"files", files_json(page)},
                   {"renderer", std::string(embedded_text("live_diffuse.js")) +
                                    std::string(embedded_text("live_clouds.js")) +
                                    std::string(embedded_text("live_renderer.js"))},
                   {"script", std::string(embedded_text("live.js"))},
                   {"watch", watch_element(page.watch_revision)}});
}

std::vector<PreviewFile> live_files(const PreviewPage& page) {
    std::vector<PreviewFile> files;
    if (page.watch_revision > 0) {
        files.push_back({live_scene_name, fmt::format("skybakeScene({}, {});\n",
                                                      page.watch_revision, page.live_scene)});
    }
    files.push_back({page_name, live_html(page)});
    return files;
}

std::vector<std::string> live_file_names(const PreviewPage& page) {
    if (page.watch_revision == 0) return {page_name};
    return {live_scene_name, page_name};
}

}  // namespace skybake
