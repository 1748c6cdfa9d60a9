// skybake preview: makes pictures of recipes and of baked files, and one page that shows them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bakers/io/files/output_folder.h"
#include "bakers/io/files/stopwatch.h"
#include "bakers/math/intermediates.h"
#include "bakers/plot/drawing.h"
#include "bakers/preview/bake_assets.h"
#include "bakers/preview/check_options.h"
#include "bakers/preview/load_assets.h"
#include "bakers/preview/make_preview.h"
#include "bakers/preview/sweep_preview.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/events.h"
#include "cli/options.h"
#include "cli/preview.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/table_printer.h"
#include "config/text/mapped.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;

// Returns the pictures of earlier previews that are in the folder and that this preview has not
// made.
std::vector<std::string> retired(const fs::path& folder, const std::vector<std::string>& earlier,
                                 const std::vector<std::string>& names) {
    std::vector<std::string> left;
    for (const std::string& name : earlier) {
        std::error_code error;
        const bool made = std::ranges::find(names, name) != names.end();
        if (!made && fs::exists(folder / name, error)) left.push_back(name);
    }
    return left;
}

// Returns the folders into which people bake a recipe: `out`, and one named like the recipe, in the
// current folder or beside the recipe.
std::vector<fs::path> likely_folders(const PreviewRequest& request) {
    if (request.subject != PreviewRequest::Subject::recipe) return {};
    const fs::path& recipe = request.paths[0];
    std::vector<fs::path> folders;
    for (const fs::path& place : {fs::path(), recipe.parent_path()}) {
        for (const fs::path& name : {fs::path("out"), recipe.stem()}) {
            const fs::path folder = place / name;
            if (std::ranges::find(folders, folder) == folders.end()) folders.push_back(folder);
        }
    }
    return folders;
}

using Subject = PreviewRequest::Subject;

// Intermediates that assets and pictures are made from.
struct SharedLight {
    explicit SharedLight(const PreviewRequest& request) : files(request) {}

    ReadyFiles files;
    Intermediates intermediates{BakeOptions().held_voxel_bytes, files.kept()};
    Intermediates::Expected pictures;
    std::vector<std::string> ready;  // names of assets that were not baked but found
    std::shared_ptr<PictureLight> clouds =
        std::make_shared<PictureLight>(&intermediates, files.light());
};

// Bakes the recipe's assets for the preview. Options that no picture uses or that contradict each
// other are reported before anything is baked.
Outcome<PreviewAssets> bake_recipe(const Invocation& invocation, PreviewRequest& request,
                                   SharedLight& shared, StageProgress& progress) {
    auto selection = select_bakes(invocation);
    if (!selection.value) return {{}, std::move(selection.diagnostics)};
    const std::vector<Bake>& bakes = selection.value->bakes;
    const LitPictures lit = lit_pictures_of(bakes);
    auto unused = unused_options(lit, request.options);
    if (!unused.empty()) return {{}, std::move(unused)};
    auto complete = completed(request.options, &selection.value->recipe, lit);
    if (!complete.value) return {{}, std::move(complete.diagnostics)};
    const BakeStages stages = {&progress, static_cast<int>(bakes.size()) +
                                              picture_stages(bakes.size(), lit, *complete.value)};
    request.options.stages_before = static_cast<int>(bakes.size());
    const BakeOptions options{.threads = selection.value->threads,
                              .certification = certification_of(request.options),
                              .progress = &progress,
                              .intermediates = &shared.intermediates};
    shared.pictures = shared.intermediates.expect(needs_of_pictures(selection.value->recipe));
    request.options.intermediates = &shared.intermediates;
    AssetMemo memory = shared.files.assets();
    auto assets = bake_assets(selection.value->recipe, bakes, request.paths[0].filename().string(),
                              options, &memory, stages);
    shared.ready = std::move(memory.ready);
    assets.diagnostics.insert(assets.diagnostics.begin(), selection.diagnostics.begin(),
                              selection.diagnostics.end());
    return assets;
}

Outcome<PreviewAssets> gather(const Invocation& invocation, PreviewRequest& request,
                              SharedLight& shared, StageProgress& progress) {
    if (request.subject == Subject::recipe) {
        return bake_recipe(invocation, request, shared, progress);
    }
    if (request.subject == Subject::folder) return load_folder(request.paths[0]);
    return load_files(request.paths);
}

// Makes the page. If the user interrupts it, it returns no value and no errors.
Outcome<PreviewPage> make_page(const Invocation& invocation, PreviewRequest& request,
                               SharedLight& shared, StageProgress& progress) {
    PreviewOptions& options = request.options;
    options.progress = &progress;
    if (request.subject == Subject::sweep) {
        return make_sweep_preview(request.paths[0], request.output, options);
    }
    auto assets = gather(invocation, request, shared, progress);
    if (!assets.value) return {{}, std::move(assets.diagnostics)};
    auto page = make_preview(*assets.value, options);
    page.diagnostics.insert(page.diagnostics.begin(), assets.diagnostics.begin(),
                            assets.diagnostics.end());
    return page;
}

// Returns the event of a finished preview. The page is the last of the paths.
std::string previewed_event(std::vector<std::string> paths, double seconds) {
    const std::string page = paths.back();
    paths.pop_back();
    return event_line(
        {{"event", "previewed"}, {"page", page}, {"pictures", paths}, {"seconds", seconds}});
}

// Writes a live page before its still pictures are made. Returns whether it is there.
bool show_early(const PreviewPage& page, const PreviewRequest& request, Console& console) {
    if (interrupted() || write_preview(page, request, console) != ExitCode::done) return false;
    console.note(fmt::format("open {}; pictures for browsers without WebGL 2 follow\n",
                             request.page_path()));
    return true;
}

ExitCode show(const Invocation& invocation, const PreviewRequest& request, Console& console) {
    const Stopwatch stopwatch;
    SharedLight shared(request);
    bool is_live = false;  // the live page is there
    auto page = [&] {
        BakeProgress progress("preview", console);
        PreviewRequest made = request;
        made.options.light = shared.clouds;
        if (request.options.live) {
            made.options.early_page = [&](const PreviewPage& early) {
                is_live = show_early(early, request, console);
            };
        }
        return make_page(invocation, made, shared, progress);
    }();
    if (interrupted()) {
        console.note(is_live ? "interrupted; the live page is there, without its still pictures\n"
                             : "interrupted; nothing was written\n");
        return ExitCode::interrupted;
    }
    if (!shared.ready.empty()) {
        console.note(fmt::format("baked before: {}\n", fmt::join(shared.ready, ", ")));
    }
    if (const ExitCode code = console.report(page.diagnostics); !page.value) return code;
    const ExitCode code = write_preview(*page.value, request, console);
    if (code != ExitCode::done) return code;
    const auto paths = mapped<std::string>(
        preview_file_names(*page.value),
        [&](const std::string& name) { return (request.output / name).string(); });
    const double elapsed_s = stopwatch.seconds();
    console.result(console.json() ? previewed_event(paths, elapsed_s)
                                  : fmt::format("{}\n", fmt::join(paths, "\n")));
    const std::string made = paths.size() > 1 ? counted(paths.size() - 1, "picture") : "a page";
    console.note(fmt::format("{} in {:.1f} s: open {}\n", made, elapsed_s, paths.back()));
    return ExitCode::done;
}

// Checks whether the folder may be written to, as far as this can be seen before the pictures are
// made. Reports E0302 or E0303 if not.
ExitCode check_output(const PreviewRequest& request, Console& console) {
    const auto folder = inspect_output_folder(request.output, {}, true);
    if (const ExitCode code = console.report(folder.diagnostics); !folder.value) return code;
    if (request.force) return ExitCode::done;
    return console.report(
        foreign_preview_files(request.output, {page_name}, earlier_preview_files(request.output)));
}

ExitCode run_preview(const Invocation& invocation, Console& console) {
    const auto request = preview_request(invocation);
    if (const ExitCode code = console.report(request.diagnostics); !request.value) return code;
    if (const ExitCode code = check_output(*request.value, console); code != ExitCode::done) {
        return code;
    }
    if (const auto problem = chart_problem()) {  // only a warning if just the font is missing
        const ExitCode code = console.report(std::array{*problem});
        if (code != ExitCode::done) return code;
    }
    if (request.value->watch) return watch_preview(invocation, *request.value, console);
    return show(invocation, *request.value, console);
}

}  // namespace

ReadyFiles::ReadyFiles(const PreviewRequest& request)
    : request_(request), folders_(likely_folders(request)), kept_(request.cache) {
    if (!request.cache.empty()) cache_.emplace(request.cache);
}

ReadyFiles::~ReadyFiles() {
    constexpr std::uint64_t most_bytes = std::uint64_t{256} << 20;
    if (cache_ && request_.owns_cache) {
        (void)collect_garbage(request_.cache, most_bytes);
    }
}

AssetMemo ReadyFiles::assets() {
    AssetMemo memo = light();
    memo.sources.insert(memo.sources.begin(), &folders_);
    return memo;
}

AssetMemo ReadyFiles::light() {
    AssetMemo memo;
    if (!cache_) return memo;
    memo.sources = {&*cache_};
    memo.cache = &*cache_;
    return memo;
}

ExitCode write_preview(PreviewPage page, const PreviewRequest& request, Console& console) {
    const std::vector<std::string> earlier = earlier_preview_files(request.output);
    const std::vector<std::string> names = preview_file_names(page);
    if (!request.force) {
        const auto foreign = foreign_preview_files(request.output, names, earlier);
        if (!foreign.empty()) return console.report(foreign);
    }
    page.retired = retired(request.output, earlier, names);
    return write_files(preview_files(page), request.output, console);
}

Command preview_command() {
    return {
        .name = "preview",
        .brief = "make pictures of it",
        .summary = "make pictures of a recipe or of baked files, and a page that shows them",
        .arguments = {{.name = "recipe|folder|file",
                       .help = "a recipe, a folder of a bake or sweep, EXR, VDB, bin files, or a "
                               "volume of another program",
                       .repeatable = true}},
        .options =
            {options::output("write index.html and its pictures into this folder", "preview"),
             set_row(),
             options::only("show only [bake.NAME]"),
             options::sun_elevation(
                 "show skies and clouds under these suns; separate them by commas"),
             options::sun_azimuth("place the sun of clouds, from +x towards +y (default: 112 "
                                  "degrees to the left of the view)"),
             options::at("place the sun as at this time, such as \"2026-06-21 18:30 +02:00\"; "
                         "without an offset or Z it is mean solar time"),
             options::place("take the time at this latitude and longitude, such as 47.4,8.5"),
             options::exposure("fix the exposure; 0 stops is a factor of 1 (default: chosen)"),
             options::tone_curve("show skies and clouds by this tone curve (default film)"),
             options::glare("scatter the sun's light in pictures of skies as a camera or an eye "
                            "does (default none)"),
             options::altitude("place the camera of skies at this altitude (default 200m)"),
             options::camera(
                 "place the camera of clouds by \"position=2km,3km,200m heading=63deg pitch=12deg "
                 "fov=50deg\" or some of these; the heading turns from +x towards +y"),
             options::size("make pictures of clouds this large (default 960x540)"),
             options::single("show a single tile of a cloud, framed as a whole"),
             options::table_sky("show clouds as runtimes with tables do: their sky behind, light "
                                "of octaves within"),
             options::turntable("make N pictures around a single tile, numbered for ffmpeg"),
             options::live("write a page that renders the baked files while you look around in it"),
             options::watch("follow the recipe until Ctrl-C, with a draft and then full quality"),
             options::draft("give a draft's volumes N voxels along the longest edge (default 64)"),
             options::cache_dir(
                 "take the light of skies from this folder and keep it there, or nowhere if it is "
                 "\"\" (default: $SKYBAKE_CACHE_DIR, else ~/.cache/skybake)"),
             options::jobs("use N threads; pictures do not depend on N (default: all)"),
             options::force("overwrite files that no preview has made")},
        .examples = {{"skybake preview cumulus.toml --live --watch",
                      "flies through a cloud while you write it"}},
        .exit_codes = {ExitCode::io, ExitCode::checks},
        .run = run_preview};
}

}  // namespace skybake::cli
