// A baker makes one kind of asset. The folder of an asset defines its own:
//
//   Baker<config::IrradianceBake> baker(BakerTag<config::IrradianceBake>);
//
// registry.h collects those of config/assets/assets.h; an asset without a baker does not link.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/assets/description/asset_label.h"
#include "bakers/assets/description/estimate.h"
#include "bakers/assets/description/glsl_lookup.h"
#include "bakers/assets/description/probe_places.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/intermediates.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"

namespace skybake {

struct Baked;
struct TracedLight;

// A file besides the recipe that an asset is made from.
struct InputFile {
    std::string name;  // as the recipe has it
    std::filesystem::path path;
};

// A key in which variants of an asset differ, for reports (report/measurement.h).
struct VariantKey {
    std::string_view name;
    std::string_view published = {};  // a value that is a published method
    std::string_view baseline = {};   // the name of that method
};

template <class Asset>
struct Baker {
    int version = 0;  // raised when its bytes change for equal parameters
    // `label` has what all assets say of themselves: name, parameters, details.
    Outcome<Baked> (*bake)(const Parameters& parameters, const Asset& asset,
                           const BakeOptions& options, AssetLabel label) = nullptr;
    Estimate (*estimate)(const Parameters& parameters, const Asset& asset) = nullptr;
    // Returns what it is made from and shares with other assets. Null: nothing.
    std::vector<Need> (*needs)(const Parameters& parameters, const Asset& asset,
                               Certification certification) = nullptr;
    // How a runtime looks up what the probes name, of a table or volume as it is stored.
    AssetPlaces (*places)(const Parameters& parameters, const Asset& asset,
                          const StoredTexels& stored) = nullptr;
    // The GLSL with which a runtime reads a file of it.
    AssetLookup (*lookup)(const Parameters& parameters, const Asset& asset,
                          const StoredTexels& stored) = nullptr;
    // Returns what its light is compared with. Null: it holds no light that is scattered more than once.
    std::optional<TracedLight> (*traced)(const Parameters& parameters,
                                         const Asset& asset) = nullptr;
    // Makes the asset small enough for pictures in a second; the longest edge of a volume has at
    // most `most_voxels`. None: it is small already.
    void (*draft)(Asset& asset, int most_voxels) = nullptr;
    std::vector<InputFile> (*inputs)(const Parameters& parameters, const Asset& asset) = nullptr;
    std::vector<VariantKey> variants = {};
};

// The friend is a function of its own for each asset, which is what GCC warns of.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wnon-template-friend"
#endif
template <class Asset>
struct BakerTag {
    friend Baker<Asset> baker(BakerTag<Asset>);
};
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

// --- Reduced sizes, for draft pictures that take about a second ---------------------------------

// Reduces the longest edge to at most `most_voxels` and the other edges in proportion, rounded.
inline std::array<int, 3> reduced(const std::array<int, 3>& size, int most_voxels) {
    const std::int64_t longest = *std::ranges::max_element(size);
    if (longest <= most_voxels) return size;
    std::array<int, 3> fewer{};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::int64_t edge =
            (2 * most_voxels * std::int64_t{size[i]} + longest) / (2 * longest);
        fewer[i] = static_cast<int>(std::max<std::int64_t>(edge, 1));
    }
    return fewer;
}

// Reduces a table to at most `most` texels along each axis. A table without a size of its own
// (max_error is given) gets that size.
template <class Table>
void reduce_table(Table& table, const std::array<int, 2>& most) {
    table.max_error.reset();
    for (std::size_t i = 0; i < 2; ++i) {
        table.size[i] = table.size[i] > 0 ? std::min(table.size[i], most[i]) : most[i];
    }
}

}  // namespace skybake
