// skybake bake: bakes the assets of a recipe that are missing or out of date.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/io/files/file_diagnostic.h"
#include "bakers/preview/load_sweep.h"
#include "bakers/workspace/asset_cache.h"
#include "bakers/workspace/bake_folder.h"
#include "bakers/workspace/depfile.h"
#include "bakers/workspace/sweep/index_files.h"
#include "cli/bake_events.h"
#include "cli/bake_reporter.h"
#include "cli/bake_selection.h"
#include "cli/bake_summary.h"
#include "cli/byte_size.h"
#include "cli/cache_folder.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/interrupt.h"
#include "cli/parse_arguments.h"
#include "cli/recipe_argument.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;
using config::Outcome;

Certification certification_option(const Invocation& invocation) {
    const std::string text = invocation.value("certify");
    if (text == "off") return Certification::off;
    return text == "full" ? Certification::full : Certification::quick;
}

// What stands between the command line and a bake.
Outcome<FolderBake> folder_bake(const Invocation& invocation, const BakeSelection& selection) {
    FolderBake bake;
    bake.recipe = &selection.recipe;
    bake.bakes = selection.bakes;
    bake.folder = invocation.value("output");
    if (bake.folder.empty()) return {{}, {usage_error("-o: the folder's name is empty")}};
    bake.threads = selection.threads;
    bake.certification = certification_option(invocation);
    bake.force = invocation.has("force");
    bake.prune = invocation.has("prune");
    if (invocation.has("max-memory")) {
        const auto bytes = parse_byte_size(invocation.value("max-memory"));
        if (!bytes) return {{}, {byte_size_error("--max-memory", invocation.value("max-memory"))}};
        bake.memory_limit_mib = static_cast<double>(*bytes) / (1024.0 * 1024.0);
    }
    return {std::move(bake), {}};
}

// A bake in the root of a sweep would mix its files with the variants' folders.
std::vector<config::Diagnostic> check_no_sweep(const FolderBake& bake) {
    if (bake.force || !is_sweep_folder(bake.folder)) return {};
    const std::string folder = bake.folder.string();
    config::Diagnostic diagnostic =
        file_error("E0303", folder,
                   fmt::format("`{}` holds a sweep: it has a {}", folder, sweep_manifest_name));
    diagnostic.label = "choose another folder with -o, or bake into this one with --force";
    return {std::move(diagnostic)};
}

ExitCode dry_run(const FolderBake& bake, bool json, Console& console) {
    const auto plan = plan_folder(bake);
    if (const ExitCode code = console.report(plan.diagnostics); !plan.value) return code;
    console.result(json ? plan_event(*plan.value) : plan_text(*plan.value));
    return ExitCode::done;
}

std::string paths_text(const BakedFolder& baked, const fs::path& folder) {
    std::string text;
    for (const FinishedAsset& asset : baked.assets) {
        for (const ManifestFile& file : asset.entry.files) {
            text += (folder / file.path).string() + "\n";
        }
    }
    return text + (folder / manifest_name).string() + "\n";
}

Outcome<WriteResult> write_depfile(const fs::path& path, const FolderBake& bake,
                                   const BakedFolder& baked) {
    std::vector<fs::path> targets;
    for (const FinishedAsset& asset : baked.assets) {
        for (const ManifestFile& file : asset.entry.files) {
            targets.push_back(bake.folder / file.path);
        }
    }
    targets.push_back(bake.folder / manifest_name);
    return write_file_atomically(path, depfile_text(targets, bake.recipe->inputs));
}

ExitCode run_bake(const Invocation& invocation, Console& console) {
    const auto start = std::chrono::steady_clock::now();
    auto selection = select_bakes(invocation);
    if (const ExitCode code = console.report(selection.diagnostics); !selection.value) return code;
    auto bake = folder_bake(invocation, *selection.value);
    if (const ExitCode code = console.report(bake.diagnostics); !bake.value) return code;
    if (const ExitCode code = console.report(check_no_sweep(*bake.value)); code != ExitCode::done) {
        return code;
    }
    const bool json = console.display().json;
    if (invocation.has("dry-run")) return dry_run(*bake.value, json, console);

    std::optional<AssetCache> cache;
    if (const std::string folder = cache_folder(invocation); !folder.empty()) {
        bake.value->sources.push_back(&cache.emplace(folder));
    }
    BakeReporter reporter(console, json);
    const auto baked = bake_folder(*bake.value, reporter);
    if (interrupted() && !baked.value) {
        console.note("interrupted; nothing was written\n");
        return ExitCode::interrupted;
    }
    if (const ExitCode code = console.report(baked.diagnostics); !baked.value) return code;
    if (cache) console.report(cache->problems());
    if (invocation.has("depfile")) {
        const auto written = write_depfile(invocation.value("depfile"), *bake.value, *baked.value);
        if (!written.value) return console.report(written.diagnostics);
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    console.result(json ? finished_events(*baked.value, bake.value->folder, elapsed.count())
                        : paths_text(*baked.value, bake.value->folder));
    console.note(
        summary_text(*baked.value, {elapsed.count(), console.error_columns(), bake.value->prune}));
    return ExitCode::done;
}

}  // namespace

Command bake_command() {
    return {
        .name = "bake",
        .brief = "bake a recipe",
        .summary = "bake the assets that are missing or out of date",
        .arguments = {{.name = "recipe.toml", .help = recipe_help}},
        .options = {{.name = "output",
                     .short_name = 'o',
                     .value = "FOLDER",
                     .help = "write the files into this folder",
                     .fallback = "out"},
                    set_option(),
                    only_option("bake only [bake.NAME] and keep the other assets"),
                    {.name = "certify",
                     .value = "HOW",
                     .help = "how thoroughly to measure errors",
                     .choices = {"quick", "full", "off"},
                     .fallback = "quick"},
                    jobs_option("use N threads; results do not depend on N (default: all)"),
                    {.name = "dry-run", .help = "show what would be baked and why, without baking"},
                    cache_option(),
                    {.name = "depfile",
                     .value = "FILE",
                     .help = "write the files' dependencies for Make and Ninja"},
                    {.name = "max-memory",
                     .value = "SIZE",
                     .help = "stop before starting if more memory may be needed (2GiB, 500M)"},
                    {.name = "prune",
                     .help = "remove unchanged files of assets that left the recipe"},
                    {.name = "force", .help = "overwrite files that skybake did not write"}},
        .examples = {{"skybake bake earth.toml", "writes ./out"},
                     {"skybake bake earth.toml --set atmosphere.layers.mie.g=0.76 -o haze",
                      "changes one value"},
                     {"skybake bake earth.toml --only transmittance --certify full",
                      "measures the error of one table at every texel"},
                     {"generate | skybake bake - -o out",
                      "reads a recipe whose paths are relative to the current folder"}},
        .exit_codes = {ExitCode::io, ExitCode::checks},
        .run = run_bake};
}

}  // namespace skybake::cli
