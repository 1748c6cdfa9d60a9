#include "bakers/workspace/folder_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "bakers/assets/registry/registry.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/to_string.h"
#include "bakers/io/manifest/journal.h"
#include "bakers/io/manifest/release.h"
#include "bakers/io/targets/sidecar.h"
#include "bakers/math/hash.h"
#include "bakers/math/parallel.h"
#include "config/assets/asset_kind.h"
#include "config/sections/files.h"
#include "config/sections/targets.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> output_files(const FolderBake& bake) {
    std::vector<std::string> names;
    for (const Bake& section : bake.bakes) {
        for (std::string& name : file_names(section)) names.push_back(std::move(name));
    }
    names.emplace_back(manifest_name);
    return names;
}

// The file's folder, without links, and its name: a file that is written there replaces it.
fs::path place_of(const fs::path& file) {
    std::error_code ignored;
    const fs::path absolute = fs::absolute(file, ignored);
    return fs::weakly_canonical(absolute.parent_path(), ignored) / absolute.filename();
}

// Returns E0302 if the files to be written would replace each other or what they are made from.
std::vector<Diagnostic> check_places(const FolderBake& bake) {
    constexpr const char* kAdvice = "choose another folder with -o, or another name";
    const fs::path folder = place_of(bake.folder / manifest_name).parent_path();
    std::set<fs::path> outputs;
    for (const std::string& name : output_files(bake)) outputs.insert(folder / name);
    if (!bake.depfile.empty() && !outputs.insert(place_of(bake.depfile)).second) {
        const std::string name = bake.depfile.string();
        return {file_error("E0302", name,
                           fmt::format("`{}` is an output: dependencies would replace it", name),
                           kAdvice)};
    }
    for (const fs::path& input : bake.recipe->inputs) {
        std::error_code ignored;
        if (!outputs.contains(place_of(input)) &&
            !outputs.contains(fs::weakly_canonical(input, ignored))) {
            continue;
        }
        return {file_error(
            "E0302", input.string(),
            fmt::format("`{}` would be replaced, and the recipe is made from it", input.string()),
            kAdvice)};
    }
    return {};
}

// Returns why the files of an entry differ from those that it describes.
std::vector<std::string> file_faults(const fs::path& folder, const ManifestAsset& entry,
                                     const Bake& bake) {
    std::vector<std::string> faults;
    std::vector<std::string> listed;
    for (const ManifestFile& file : entry.files) {
        listed.push_back(file.path);
        const auto print = fingerprint(folder / file.path);
        if (!print.value) {
            faults.push_back(fmt::format("{} cannot be read", file.path));
        } else if (print.value->xxh3 != file.xxh3) {
            faults.push_back(fmt::format("{} does not match manifest.json", file.path));
        }
    }
    if (listed != file_names(bake)) faults.emplace_back("manifest.json lists other files");
    return faults;
}

void compare_with_folder(const OutputFolder& folder, PlannedAsset& planned) {
    const ManifestAsset* entry = entry_before(folder, planned.bake->name);
    if (!entry) {
        planned.reasons = {folder.reason.empty() ? "not baked yet" : folder.reason};
        return;
    }
    planned.reasons = differences(planned.identity, *entry);
    if (!planned.reasons.empty()) return;
    planned.reasons = file_faults(folder.path, *entry, *planned.bake);
    if (planned.reasons.empty()) planned.up_to_date = *entry;
}

// Returns the largest asset of those that must be made.
const PlannedAsset* largest_asset(const FolderPlan& plan) {
    const PlannedAsset* largest = nullptr;
    for (const PlannedAsset& asset : plan.assets) {
        if (!asset.stale()) continue;
        if (!largest || asset.estimate.memory_mib > largest->estimate.memory_mib) largest = &asset;
    }
    return largest;
}

// Returns the manifest's list of files as this bake will leave it. Assets that a bake of a part
// does not name stay in it.
Manifest files_after(const FolderBake& bake, const Manifest& previous) {
    Manifest manifest;
    for (const Bake& section : bake.bakes) {
        ManifestAsset& asset = manifest.assets.emplace_back();
        asset.name = section.name;
        for (std::string& name : file_names(section)) {
            asset.files.emplace_back().path = std::move(name);
        }
    }
    const bool partial = bake.bakes.size() < bake.recipe->parameters.bakes.size();
    return partial ? merge_manifests(previous, std::move(manifest)) : manifest;
}

std::vector<RetiredFile> retired_files(const FolderBake& bake, const Manifest& previous) {
    auto files = files_no_longer_made(previous, files_after(bake, previous));
    std::erase_if(files, [&bake](const RetiredFile& file) {
        std::error_code error;
        return !fs::exists(fs::symlink_status(bake.folder / file.path, error));
    });
    return files;
}

void plan_retired(const FolderBake& bake, FolderPlan& plan) {
    if (!plan.folder.previous) return;
    plan.retired = retired_files(bake, *plan.folder.previous);
    if (!bake.prune) return;
    for (const RetiredFile& file : plan.retired) {
        if (is_as_written(bake.folder, file)) plan.pruned.push_back(file);
    }
}

std::vector<Diagnostic> memory_excess(const FolderPlan& plan, std::optional<double> limit_mib) {
    if (!limit_mib || plan.memory_mib() <= *limit_mib) return {};
    return {diagnosis(
        "E0002",
        fmt::format(
            "baking may need {} of memory, most of it for `bake.{}`; --max-memory allows {}",
            byte_size_text(plan.memory_mib() * kMebibyte), largest_asset(plan)->bake->name,
            byte_size_text(*limit_mib * kMebibyte)),
        "raise --max-memory, or bake fewer assets at once with --only")};
}

// Returns what the writers of an asset's formats do in another way than before, without a change of
// their bakers. Keys of other assets do not know of it.
std::string revisions_of(const config::AssetFiles& files) {
    std::string text;
    for (const config::FileFormat format : files.formats) {
        if (format == config::FileFormat::nvdb) text += "nvdb: a checksum of every node";
        if (format == config::FileFormat::usda) text += "usda: a camera";
    }
    return text;
}

std::string_view to_string(Certification certification) {
    switch (certification) {
        case Certification::off:
            return "off";
        case Certification::full:
            return "full";
        case Certification::quick:
            break;
    }
    return "quick";
}

void add_input_changes(const AssetIdentity& identity, const ManifestAsset& previous,
                       std::vector<std::string>& reasons) {
    for (const ManifestInput& input : identity.inputs) {
        const auto same_file = std::ranges::find(previous.inputs, input.file, &ManifestInput::file);
        if (same_file != previous.inputs.end() && same_file->xxh3 != input.xxh3) {
            reasons.push_back(fmt::format("{} has changed content", input.file));
        }
    }
}

}  // namespace

const ManifestAsset* entry_before(const OutputFolder& folder, const std::string& name) {
    if (!folder.previous) return nullptr;
    const auto& entries = folder.previous->assets;
    const auto entry = std::ranges::find(entries, name, &ManifestAsset::name);
    return entry == entries.end() ? nullptr : &*entry;
}

std::int64_t bytes_to_keep(std::int64_t most, std::optional<double> limit_mib, double used_mib) {
    if (!limit_mib) return most;
    const double left = std::max(0.0, *limit_mib - used_mib) * kMebibyte;
    return left < static_cast<double>(most) ? static_cast<std::int64_t>(left) : most;
}

std::size_t FolderPlan::stale_count() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(assets, [](const PlannedAsset& asset) { return asset.stale(); }));
}

void add_need(const Need& need, const std::string& user, std::vector<PlannedIntermediate>& plan) {
    auto same =
        std::ranges::find_if(plan, [&](const auto& one) { return one.need.key == need.key; });
    if (same == plan.end()) same = plan.insert(plan.end(), {need, {}});
    if (same->users.empty() || same->users.back() != user) same->users.push_back(user);
}

std::vector<PlannedIntermediate> FolderPlan::intermediates() const {
    std::vector<PlannedIntermediate> found;
    for (const PlannedAsset& asset : assets) {
        for (const Need& need : asset.needs) add_need(need, asset.bake->name, found);
    }
    return found;
}

// Assets are made one after the other. Tables are held in memory until all files are written;
// volumes are made again while files are written, unless there is room to hold them too.
double FolderPlan::memory_mib() const {
    const PlannedAsset* largest = largest_asset(*this);
    if (!largest) return 0;
    double held = kProgramMib + kThreadMib * threads;
    for (const PlannedAsset& asset : assets) {
        if (asset.stale() && &asset != largest && config::kind_of(*asset.bake).facts.is_table) {
            held += asset.estimate.disk_mib;
        }
    }
    return largest->estimate.memory_mib + held;
}

double FolderPlan::seconds() const {
    double sum = 0;
    for (const PlannedAsset& asset : assets) {
        if (asset.stale()) sum += asset.estimate.seconds;
    }
    for (const PlannedIntermediate& one : intermediates()) sum += one.need.seconds;
    return sum;
}

Outcome<FolderPlan> plan_folder(const FolderBake& bake, bool to_be_written) {
    if (auto faults = check_places(bake); !faults.empty()) return {{}, std::move(faults)};
    auto folder = inspect_output_folder(bake.folder, output_files(bake), bake.force, false);
    if (!folder.value) return {{}, std::move(folder.diagnostics)};
    FolderPlan plan;
    plan.folder = std::move(*folder.value);
    plan.threads = thread_count(bake.threads);
    for (const Bake& section : bake.bakes) {
        PlannedAsset planned;
        planned.bake = &section;
        auto identity = asset_identity(*bake.recipe, section, bake.certification);
        if (!identity.value) return {{}, std::move(identity.diagnostics)};
        planned.identity = std::move(*identity.value);
        planned.estimate = baker_of(section).estimate(bake.recipe->parameters, section);
        compare_with_folder(plan.folder, planned);
        if (planned.stale()) {
            planned.needs =
                baker_of(section).needs(bake.recipe->parameters, section, bake.certification);
        }
        plan.assets.push_back(std::move(planned));
    }
    plan_retired(bake, plan);
    if (to_be_written && plan.stale_count() > 0) {
        auto writable = inspect_output_folder(bake.folder, {}, true);
        if (!writable.value) return {{}, std::move(writable.diagnostics)};
    }
    auto excess = memory_excess(plan, bake.memory_limit_mib);
    if (!excess.empty()) return {{}, std::move(excess)};
    return {std::move(plan), {}};
}

// Each part is hashed with its length, so that different identities never give the same text.
std::string key_of(const AssetIdentity& identity) {
    Hasher hasher;
    const auto add = [&hasher](std::string_view part) {
        hasher.update(fmt::format("{}\n", part.size()));
        hasher.update(part);
    };
    add(identity.kind);
    add(identity.release);
    add(std::to_string(identity.baker_version));
    add(to_string(identity.certification));
    add(identity.parameters);
    for (const ManifestInput& input : identity.inputs) {
        add(input.file);
        add(input.xxh3);
    }
    if (!identity.sidecars.empty()) add(identity.sidecars);
    return hasher.hex();
}

Outcome<AssetIdentity> asset_identity(const Recipe& recipe, const Bake& bake,
                                      Certification certification) {
    const AnyBaker& baker = baker_of(bake);
    AssetIdentity identity;
    identity.kind = baker.asset;
    identity.release = release();
    identity.baker_version = baker.version;
    identity.certification = certification;
    identity.parameters = asset_parameters(recipe, bake);
    for (const InputFile& file : baker.inputs(recipe.parameters, bake)) {
        Outcome<FileFingerprint> print = fingerprint(file.path);
        if (!print.value) return {{}, std::move(print.diagnostics)};
        identity.inputs.push_back({file.name, print.value->xxh3});
    }
    for (const std::string& name :
         config::sidecar_names(config::files_of(bake), identity.kind, "NAME")) {
        identity.sidecars += sidecar_template(name);
    }
    identity.sidecars += revisions_of(config::files_of(bake));
    identity.key = key_of(identity);
    return {std::move(identity), {}};
}

void sign(const AssetIdentity& identity, ManifestAsset& entry) {
    entry.key = identity.key;
    entry.certification = to_string(identity.certification);
    entry.inputs = identity.inputs;
}

std::vector<std::string> differences(const AssetIdentity& identity, const ManifestAsset& previous,
                                     std::size_t longest) {
    if (identity.key == previous.key) return {};
    if (previous.key.empty()) return {"baked by a release without keys"};
    std::vector<std::string> reasons;
    for (const auto& change : config::parameter_changes(previous.parameters, identity.parameters)) {
        reasons.push_back(config::change_text(change));
    }
    add_input_changes(identity, previous, reasons);
    if (previous.release != identity.release) {
        reasons.push_back(fmt::format("release {} → {}", previous.release, identity.release));
    }
    const std::string version = fact_named(previous.details, "baker_version");
    if (version != std::to_string(identity.baker_version)) {
        reasons.push_back(fmt::format("{} baker version {} → {}", identity.kind, version,
                                      identity.baker_version));
    }
    if (previous.certification != to_string(identity.certification)) {
        reasons.push_back(fmt::format("--certify {} → {}", previous.certification,
                                      to_string(identity.certification)));
    }
    // The key decides, whatever else the manifest says.
    if (reasons.empty()) reasons.emplace_back("another key");
    if (reasons.size() > longest) {
        const std::size_t more = reasons.size() - longest;
        reasons.resize(longest);
        reasons.push_back(fmt::format("{} more", more));
    }
    return reasons;
}

}  // namespace skybake
