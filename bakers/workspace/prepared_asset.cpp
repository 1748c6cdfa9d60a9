#include "bakers/workspace/prepared_asset.h"

#include <utility>

#include "bakers/io/formats/write_volume.h"
#include "bakers/math/parallel.h"

namespace skybake {
namespace {

using config::Outcome;

Outcome<PreparedAsset> prepare_table(const BakedTable& table, int threads) {
    Outcome<EncodedTable> encoded = encode_table(table);
    Outcome<PreparedAsset> outcome;
    outcome.diagnostics = std::move(encoded.diagnostics);
    if (!encoded.value) return outcome;
    encoded.value->asset.timing.bake_s = table.bake_seconds;
    encoded.value->asset.timing.threads = thread_count(threads);
    outcome.value = std::move(*encoded.value);
    return outcome;
}

Outcome<PreparedAsset> prepare_volume(BakedVolume volume, int threads) {
    ManifestAsset asset = describe_with_files(volume);
    asset.timing.bake_s = volume.bake_seconds;
    asset.timing.threads = thread_count(threads);
    return {PreparedAsset(DescribedVolume{std::move(volume), std::move(asset)}), {}};
}

}  // namespace

const ManifestAsset& entry_of(const PreparedAsset& asset) {
    return std::visit([](const auto& prepared) -> const ManifestAsset& { return prepared.asset; },
                      asset);
}

ManifestAsset& entry_of(PreparedAsset& asset) {
    return std::visit([](auto& prepared) -> ManifestAsset& { return prepared.asset; }, asset);
}

Outcome<PreparedAsset> prepare(BakedAsset baked, int threads) {
    if (auto* volume = std::get_if<BakedVolume>(&baked)) {
        return prepare_volume(std::move(*volume), threads);
    }
    return prepare_table(std::get<BakedTable>(baked), threads);
}

Outcome<std::vector<WriteResult>> stage(PreparedAsset& asset, const std::filesystem::path& folder,
                                        AtomicFiles& files, int threads, Progress& progress) {
    if (auto* volume = std::get_if<DescribedVolume>(&asset)) {
        return stage_volume(volume->volume, volume->asset, folder, files, threads, &progress);
    }
    auto staged = stage_table(std::get<EncodedTable>(asset), folder, files, &progress);
    Outcome<std::vector<WriteResult>> outcome;
    outcome.diagnostics = std::move(staged.diagnostics);
    if (staged.value) outcome.value = {*staged.value};
    return outcome;
}

}  // namespace skybake
