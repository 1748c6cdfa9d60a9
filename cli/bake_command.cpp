// skybake bake: bakes the assets of a recipe that are missing or out of date.
#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "bakers/io/files/file_io.h"
#include "bakers/io/files/stopwatch.h"
#include "bakers/preview/load_sweep.h"
#include "bakers/workspace/asset_cache.h"
#include "bakers/workspace/bake_folder.h"
#include "bakers/workspace/cache_folder.h"
#include "bakers/workspace/depfile.h"
#include "bakers/workspace/http_cache.h"
#include "bakers/workspace/sweep/index_files.h"
#include "cli/bake_output.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/options.h"

namespace skybake::cli {
namespace options {

inline const Option<std::filesystem::path> depfile{"depfile", 0, "FILE"};
inline const Option<bool> prune{"prune"};

}  // namespace options

namespace {

namespace fs = std::filesystem;

// Translates the options of the command line into a bake.
FolderBake folder_bake(const Invocation& invocation, const BakeSelection& selection) {
    FolderBake bake;
    bake.recipe = &selection.recipe;
    bake.bakes = selection.bakes;
    bake.folder = invocation[options::output];
    bake.threads = selection.threads;
    bake.certification = invocation[options::certify];
    bake.force = invocation[options::force];
    bake.prune = invocation[options::prune];
    bake.depfile = invocation[options::depfile];
    bake.frame_by_frame = true;
    bake.memory_limit_mib = invocation.given(options::max_memory);
    return bake;
}

// A bake in the root of a sweep would mix its files with the variants' folders.
std::vector<Diagnostic> check_no_sweep(const FolderBake& bake) {
    if (bake.force || !is_sweep_folder(bake.folder)) return {};
    const std::string folder = bake.folder.string();
    return {file_error("E0303", folder,
                       fmt::format("`{}` holds a sweep: it has a {}", folder, sweep_manifest_name),
                       "choose another folder with -o, or bake into this one with --force")};
}

ExitCode dry_run(const FolderBake& bake, Console& console) {
    const auto plan = plan_folder(bake, false);
    if (const ExitCode code = console.report(plan.diagnostics); !plan.value) return code;
    console.report(long_bake(*plan.value));
    console.result(console.json() ? plan_event(*plan.value) : plan_text(*plan.value));
    return ExitCode::done;
}

// Returns the files of all assets, and the manifest.
std::vector<fs::path> files_of(const BakedFolder& baked, const fs::path& folder) {
    std::vector<fs::path> files;
    for (const FinishedAsset& asset : baked.assets) {
        for (const ManifestFile& file : asset.entry.files) files.push_back(folder / file.path);
    }
    files.push_back(folder / manifest_name);
    return files;
}

std::string paths_text(const std::vector<fs::path>& files) {
    std::string text;
    for (const fs::path& file : files) text += file.string() + "\n";
    return text;
}

// Returns E0303 if the dependencies would replace a file of another kind, E0301 if their folder is missing, and
// E0002 if no rule can name the outputs.
std::vector<Diagnostic> check_depfile(const FolderBake& bake) {
    std::error_code ignored;
    const fs::path& path = bake.depfile;
    if (path.empty()) return {};
    if (bake.folder.native().find('\n') != std::string::npos) {
        return {usage_error("--depfile: no rule can name a folder whose name has two lines")};
    }
    if (!fs::is_directory(fs::absolute(path, ignored).parent_path(), ignored)) {
        return {file_error("E0301", path.string(),
                           fmt::format("cannot write `{}`: its folder is missing", path.string()))};
    }
    if (bake.force || !fs::is_regular_file(path, ignored)) return {};
    const auto found = read_file(path);
    if (!found.value) return found.diagnostics;
    if (is_depfile(*found.value)) return {};
    return {foreign_file(path, "holds no dependencies that skybake wrote")};
}

// Returns E0302 if the output is the cache: its assets would lie beside the entries, and no later run could
// tell that the folder is a cache.
std::vector<Diagnostic> check_two_folders(const fs::path& cache, const fs::path& output) {
    std::error_code ignored;
    const bool is_one = !cache.empty() && fs::weakly_canonical(cache, ignored) ==
                                              fs::weakly_canonical(output, ignored);
    if (!is_one) return {};
    return {file_error(
        "E0302", cache.string(),
        fmt::format("`{}` is the output and the cache: choose two folders", cache.string()))};
}

ExitCode run_bake(const Invocation& invocation, Console& console) {
    const Stopwatch stopwatch;
    auto selection = select_bakes(invocation);
    if (const ExitCode code = console.report(selection.diagnostics); !selection.value) return code;
    FolderBake bake = folder_bake(invocation, *selection.value);
    if (const ExitCode code = console.report(check_no_sweep(bake)); code != ExitCode::done) {
        return code;
    }
    if (invocation[options::dry_run]) return dry_run(bake, console);

    const auto depfile = check_depfile(bake);
    if (!depfile.empty()) return console.report(depfile);
    const auto url = cache_url(invocation);
    if (!url.value) return console.report(url.diagnostics);
    const auto folder = cache_folder(invocation);
    if (!folder.value) return console.report(folder.diagnostics);
    const auto same = check_two_folders(*folder.value, bake.folder);
    if (!same.empty()) return console.report(same);
    std::optional<AssetCache> cache;
    std::optional<HttpCache> server;
    CachedBytes kept(*folder.value);
    bake.kept = &kept;
    if (!folder.value->empty()) bake.sources.push_back(&cache.emplace(*folder.value));
    if (!url.value->empty()) bake.sources.push_back(&server.emplace(*url.value, interrupted));
    BakeReporter reporter(console);
    const auto baked = bake_folder(bake, reporter);
    if (interrupted() && !baked.value) {
        console.note(has_frames(bake) ? "interrupted; frames that were complete are kept\n"
                                      : "interrupted; nothing was written\n");
        return ExitCode::interrupted;
    }
    const ExitCode code = console.report(baked.diagnostics);
    if (!baked.value) return code;
    if (cache) console.report(cache->problems());
    if (server) console.report(server->problems());
    const std::vector<fs::path> files = files_of(*baked.value, bake.folder);
    if (invocation.has(options::depfile)) {
        const auto written = write_file_atomically(
            invocation[options::depfile], depfile_text(files, selection.value->recipe.inputs));
        if (!written.value) return console.report(written.diagnostics);
    }
    const double elapsed_s = stopwatch.seconds();
    console.result(console.json() ? finished_events(*baked.value, bake.folder, elapsed_s)
                                  : paths_text(files));
    console.note(summary_text(*baked.value, elapsed_s, console.error_columns(), bake.prune));
    return code;
}

}  // namespace

Command bake_command() {
    return {
        .name = "bake",
        .brief = "bake a recipe",
        .summary = "bake the assets that are missing or out of date",
        .arguments = {{.name = "recipe.toml", .help = recipe_help}},
        .options = {options::output("write the files into this folder", "out"), set_row(),
                    options::only("bake only [bake.NAME] and keep the other assets"), certify_row(),
                    options::jobs("use N threads; results do not depend on N (default: all)"),
                    options::dry_run("show what would be baked and why, without baking"),
                    cache_row(), server_row(),
                    options::depfile("write the files' dependencies for Make and Ninja"),
                    options::max_memory(
                        "stop before starting if more memory may be needed (2GiB, 500M)"),
                    options::prune("remove unchanged files of assets that left the recipe"),
                    options::force("overwrite files that skybake did not write")},
        .examples = {{"skybake bake earth.toml", "writes ./out"},
                     {"skybake bake earth.toml --set atmosphere.layers.aerosol.g=0.76 -o haze",
                      "changes one value"},
                     {"skybake bake earth.toml --only transmittance --certify full",
                      "measures the error of one table at more places"},
                     {"generate | skybake bake - -o out",
                      "reads a recipe whose paths are relative to the current folder"}},
        .exit_codes = {ExitCode::io, ExitCode::checks},
        .run = run_bake};
}

}  // namespace skybake::cli
