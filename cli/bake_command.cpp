// skybake bake: makes what the recipe asks for.
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bakers/incremental/asset_cache.h"
#include "bakers/incremental/bake_folder.h"
#include "bakers/incremental/depfile.h"
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
    if (invocation.has("max-memory")) {
        const auto bytes = parse_byte_size(invocation.value("max-memory"));
        if (!bytes) return {{}, {byte_size_error("--max-memory", invocation.value("max-memory"))}};
        bake.memory_limit_mib = static_cast<double>(*bytes) / (1024.0 * 1024.0);
    }
    return {std::move(bake), {}};
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
    const bool json = invocation.has("json");
    if (invocation.has("dry-run")) return dry_run(*bake.value, json, console);

    std::optional<AssetCache> cache;
    if (const std::string folder = cache_folder(invocation); !folder.empty()) {
        bake.value->sources.push_back(&cache.emplace(folder));
    }
    BakeReporter reporter(console, json);
    const auto baked = bake_folder(*bake.value, reporter);
    if (interrupted() && !baked.value) return ExitCode::interrupted;
    if (const ExitCode code = console.report(baked.diagnostics); !baked.value) return code;
    if (cache) console.report(cache->problems());
    if (invocation.has("depfile")) {
        const auto written = write_depfile(invocation.value("depfile"), *bake.value, *baked.value);
        if (!written.value) return console.report(written.diagnostics);
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    console.result(json ? finished_events(*baked.value, bake.value->folder, elapsed.count())
                        : paths_text(*baked.value, bake.value->folder));
    console.note(summary_text(*baked.value, elapsed.count()));
    return ExitCode::done;
}

}  // namespace

Command bake_command() {
    return {
        .name = "bake",
        .brief = "make what a recipe asks for",
        .summary = "make what a recipe asks for and the folder has not: files and manifest.json",
        .arguments = {{.name = "recipe.toml", .help = "the recipe"}},
        .options = {{.name = "output",
                     .short_name = 'o',
                     .value = "FOLDER",
                     .help = "where the files go",
                     .fallback = "out"},
                    set_option(),
                    only_option("bake just [bake.NAME]; other entries of the manifest stay"),
                    {.name = "certify",
                     .value = "HOW",
                     .help = "how thoroughly to measure the error",
                     .choices = {"quick", "full", "off"},
                     .fallback = "quick"},
                    jobs_option("threads; results do not depend on it (default: all)"),
                    {.name = "dry-run", .help = "say what would be made and why; make nothing"},
                    cache_option(),
                    {.name = "depfile",
                     .value = "FILE",
                     .help = "write what the files depend on, for Make and Ninja"},
                    {.name = "max-memory",
                     .value = "SIZE",
                     .help = "refuse before work what may need more, such as 2GiB"},
                    {.name = "force", .help = "overwrite files that skybake did not write"},
                    {.name = "json", .help = "events as JSON Lines on stdout"}},
        .examples = {{"skybake bake earth.toml", "into ./out"},
                     {"skybake bake earth.toml --set atmosphere.layers.mie.g=0.76 -o haze",
                      "one value changed"},
                     {"skybake bake earth.toml --only transmittance --certify full",
                      "one table, its error measured at every texel"}},
        .exit_codes = {ExitCode::io, ExitCode::checks},
        .run = run_bake};
}

}  // namespace skybake::cli
