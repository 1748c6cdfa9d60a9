// skybake bake: makes what the recipe asks for.
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bakers/io/atomic_file.h"
#include "bakers/io/file_names.h"
#include "bakers/io/manifest.h"
#include "bakers/io/output_folder.h"
#include "bakers/io/vdb_volume.h"
#include "bakers/registry.h"
#include "cli/bake_output.h"
#include "cli/bake_progress.h"
#include "cli/bake_selection.h"
#include "cli/bake_summary.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/interrupt.h"
#include "cli/parse_arguments.h"

namespace skybake::cli {
namespace {

using config::Bake;
using config::Diagnostic;
using config::Outcome;
using Json = nlohmann::ordered_json;

struct BakeJob {
    BakeSelection selection;
    std::filesystem::path folder;
    BakeOptions options;
    bool json = false;
};

Certification certification_option(const Invocation& invocation) {
    const std::string text = invocation.value("certify");
    if (text == "off") return Certification::off;
    return text == "full" ? Certification::full : Certification::quick;
}

std::vector<std::string> output_files(const BakeJob& job) {
    std::vector<std::string> names;
    for (const Bake& bake : job.selection.bakes) {
        for (std::string& name : skybake::file_names(bake)) names.push_back(std::move(name));
    }
    names.emplace_back(manifest_name);
    return names;
}

void append(std::vector<Diagnostic>& from, std::vector<Diagnostic>& to) {
    for (Diagnostic& diagnostic : from) to.push_back(std::move(diagnostic));
}

std::vector<ManifestAsset> entries_of(const std::vector<PreparedAsset>& assets) {
    std::vector<ManifestAsset> entries;
    for (const PreparedAsset& asset : assets) entries.push_back(entry_of(asset));
    return entries;
}

void print_event(Console& console, const Json& event) {
    console.result(event.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

void print_plan(const BakeJob& job, Console& console) {
    if (!job.json) {
        console.result(plan_text(job.selection.recipe.parameters, job.selection.bakes));
        return;
    }
    Json assets = Json::array();
    for (const Bake& bake : job.selection.bakes) {
        const Estimate estimate = baker_of(bake).estimate(job.selection.recipe.parameters, bake);
        assets.push_back({{"name", bake.name},
                          {"kind", baker_of(bake).asset},
                          {"size", estimate.size},
                          {"seconds", estimate.seconds},
                          {"memory_mib", estimate.memory_mib},
                          {"disk_mib", estimate.disk_mib}});
    }
    print_event(console, {{"event", "plan"}, {"assets", std::move(assets)}});
}

// Bakes everything before a byte is written: one failure leaves the folder as it was.
Outcome<std::vector<PreparedAsset>> bake_all(const BakeJob& job, Console& console) {
    Outcome<std::vector<PreparedAsset>> outcome;
    std::vector<PreparedAsset> assets;
    for (const Bake& bake : job.selection.bakes) {
        BakeProgress progress(bake.name, console);
        BakeOptions options = job.options;
        options.progress = &progress;
        Outcome<BakedAsset> baked = bake_asset(job.selection.recipe, bake, options);
        progress.finish();
        if (interrupted()) return outcome;
        append(baked.diagnostics, outcome.diagnostics);
        if (!baked.value) continue;
        Outcome<PreparedAsset> prepared = prepare(std::move(*baked.value), options.threads);
        append(prepared.diagnostics, outcome.diagnostics);
        if (prepared.value) assets.push_back(std::move(*prepared.value));
    }
    if (assets.size() == job.selection.bakes.size()) outcome.value = std::move(assets);
    return outcome;
}

Json file_event(const ManifestAsset& asset, const ManifestFile& file, const std::string& path,
                WriteResult result) {
    Json event = {{"event", "asset"},
                  {"name", asset.name},
                  {"kind", asset.kind},
                  {"path", path},
                  {"changed", result == WriteResult::written},
                  {"size", asset.size},
                  {"bake_s", asset.timing.bake_s},
                  {"write_s", asset.timing.write_s}};
    if (asset.is_volume()) {
        event["size"] = asset.levels[static_cast<std::size_t>(file.level)].size;
        event["format"] = file.format;
        event["level"] = file.level;
    }
    if (asset.error) {
        event["lookup_error"] = {{"max", asset.error->lookup.max},
                                 {"rms", asset.error->lookup.rms}};
        event["texel_error"] = {{"max", asset.error->texel.max}, {"rms", asset.error->texel.rms}};
    }
    return event;
}

// What stdout gets once all files have their names.
struct Announcement {
    std::vector<Json> events;
    std::string paths;

    void add(const BakeJob& job, const ManifestAsset& asset,
             const std::vector<WriteResult>& results) {
        for (std::size_t i = 0; i < asset.files.size(); ++i) {
            const std::string path = (job.folder / asset.files[i].path).string();
            events.push_back(file_event(asset, asset.files[i], path, results[i]));
            paths += path + "\n";
        }
    }
};

// Brings all files to the disk, then renames them: an error leaves every old file in place.
ExitCode write_all(const BakeJob& job, const OutputFolder& folder,
                   std::vector<PreparedAsset>& assets, Console& console) {
    Manifest manifest = new_manifest(job.selection.recipe);
    AtomicFiles files;
    Announcement announcement;
    for (PreparedAsset& asset : assets) {
        BakeProgress progress(entry_of(asset).name, console);
        const auto staged = stage(asset, job.folder, files, job.options.threads, progress);
        progress.finish();
        if (const ExitCode code = console.report(staged.diagnostics); !staged.value) return code;
        if (staged.value->back() == WriteResult::interrupted) return ExitCode::interrupted;
        announcement.add(job, entry_of(asset), *staged.value);
        manifest.assets.push_back(entry_of(asset));
    }
    const bool partial = job.selection.bakes.size() < job.selection.recipe.parameters.bakes.size();
    if (partial && folder.previous)
        manifest = merge_manifests(*folder.previous, std::move(manifest));
    const std::filesystem::path path = job.folder / manifest_name;
    announcement.paths += path.string() + "\n";
    const BakeProgress progress("manifest", console);
    const auto staged = files.stage(path, std::string_view(manifest_json(manifest)), &progress);
    if (const ExitCode code = console.report(staged.diagnostics); !staged.value) return code;
    if (*staged.value == WriteResult::interrupted) return ExitCode::interrupted;
    const auto failures = files.commit();
    if (!failures.empty()) return console.report(failures);
    if (job.json) {
        for (const Json& event : announcement.events) print_event(console, event);
    } else {
        console.result(announcement.paths);
    }
    return ExitCode::done;
}

ExitCode bake(const BakeJob& job, bool force, Console& console) {
    const auto start = std::chrono::steady_clock::now();
    const auto folder = inspect_output_folder(job.folder, output_files(job), force);
    if (const ExitCode code = console.report(folder.diagnostics); !folder.value) return code;
    for (const std::string& file : output_files(job)) {
        if (std::filesystem::path(file).extension() != ".vdb") continue;
        if (const auto obstacle = vdb_obstacle(job.folder / file)) {
            return console.report(std::array{*obstacle});
        }
        break;
    }
    auto assets = bake_all(job, console);
    if (interrupted()) return ExitCode::interrupted;
    if (const ExitCode code = console.report(assets.diagnostics); !assets.value) return code;
    const auto made = create_output_folder(job.folder);
    if (const ExitCode code = console.report(made.diagnostics); !made.value) return code;
    if (const ExitCode code = write_all(job, *folder.value, *assets.value, console);
        code != ExitCode::done) {
        remove_empty_folders(*made.value);
        return code;
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    if (job.json) {
        print_event(
            console,
            {{"event", "done"}, {"assets", assets.value->size()}, {"seconds", elapsed.count()}});
    }
    console.note(summary_text(entries_of(*assets.value), elapsed.count()));
    return ExitCode::done;
}

ExitCode run(const Invocation& invocation, Console& console) {
    auto selection = select_bakes(invocation);
    if (const ExitCode code = console.report(selection.diagnostics); !selection.value) return code;
    BakeJob job;
    job.selection = std::move(*selection.value);
    job.folder = invocation.value("output");
    if (job.folder.empty()) {
        return console.report(std::array{usage_error("-o: the folder's name is empty")});
    }
    job.options.threads = job.selection.threads;
    job.options.certification = certification_option(invocation);
    job.json = invocation.has("json");
    if (job.json || invocation.has("dry-run")) print_plan(job, console);
    if (invocation.has("dry-run")) return ExitCode::done;
    return bake(job, invocation.has("force"), console);
}

}  // namespace

Command bake_command() {
    return {.name = "bake",
            .summary = "make what a recipe asks for: tables, volumes and manifest.json",
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
                        {.name = "dry-run", .help = "say what would be made, and make nothing"},
                        {.name = "force", .help = "overwrite files that skybake did not write"},
                        {.name = "json", .help = "events as JSON Lines on stdout"}},
            .examples = {{"skybake bake earth.toml", "into ./out"},
                         {"skybake bake earth.toml --set atmosphere.layers.mie.g=0.76 -o haze",
                          "one value changed"},
                         {"skybake bake earth.toml --only transmittance --certify full",
                          "one table, its error measured at every texel"}},
            .exit_codes = {ExitCode::io, ExitCode::checks},
            .run = run};
}

}  // namespace skybake::cli
