#include "bakers/workspace/asset_identity.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "bakers/assets/registry.h"
#include "bakers/io/files/file_input.h"
#include "bakers/io/manifest/release.h"
#include "bakers/math/hash.h"
#include "config/recipe/parameter_changes.h"

namespace skybake {
namespace {

std::string_view spell(Certification certification) {
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
        const auto same_file = std::find_if(
            previous.inputs.begin(), previous.inputs.end(),
            [&input](const ManifestInput& before) { return before.file == input.file; });
        if (same_file != previous.inputs.end() && same_file->xxh3 != input.xxh3) {
            reasons.push_back(fmt::format("{} has changed content", input.file));
        }
    }
}

}  // namespace

// Each part with its length, so that no two identities join to one text.
std::string key_of(const AssetIdentity& identity) {
    Hasher hasher;
    const auto add = [&hasher](std::string_view part) {
        hasher.update(fmt::format("{}\n", part.size()));
        hasher.update(part);
    };
    add(identity.kind);
    add(identity.release);
    add(std::to_string(identity.baker_version));
    add(spell(identity.certification));
    add(identity.parameters);
    for (const ManifestInput& input : identity.inputs) {
        add(input.file);
        add(input.xxh3);
    }
    return hasher.hex();
}

config::Outcome<AssetIdentity> asset_identity(const config::Recipe& recipe,
                                              const config::Bake& bake,
                                              Certification certification) {
    config::Outcome<AssetIdentity> outcome;
    const AnyBaker& baker = baker_of(bake);
    AssetIdentity identity;
    identity.kind = baker.asset;
    identity.release = release();
    identity.baker_version = baker.version;
    identity.certification = certification;
    identity.parameters = asset_parameters(recipe, bake);
    for (const InputFile& file : baker.inputs(recipe.parameters, bake)) {
        config::Outcome<FileFingerprint> print = fingerprint(file.path);
        if (!print.value) return {{}, std::move(print.diagnostics)};
        identity.inputs.push_back({file.name, print.value->xxh3});
    }
    identity.key = key_of(identity);
    outcome.value = std::move(identity);
    return outcome;
}

void sign(const AssetIdentity& identity, ManifestAsset& entry) {
    entry.key = identity.key;
    entry.certification = spell(identity.certification);
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
    if (previous.certification != spell(identity.certification)) {
        reasons.push_back(fmt::format("--certify {} → {}", previous.certification,
                                      spell(identity.certification)));
    }
    // Whatever the manifest says of itself, the key decides.
    if (reasons.empty()) reasons.emplace_back("another key");
    if (reasons.size() > longest) {
        const std::size_t more = reasons.size() - longest;
        reasons.resize(longest);
        reasons.push_back(fmt::format("{} more", more));
    }
    return reasons;
}

}  // namespace skybake
