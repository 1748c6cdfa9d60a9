// This header reads the keys that name the cloud volume from which another asset is made: `of` and
// `channel`, or a key of that asset.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "config/assets/asset_kind.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/file_decoder.h"
#include "config/fields/fields.h"
#include "config/fields/section_decoder.h"
#include "config/sections/cloud.h"

namespace skybake::config {

inline constexpr Field source_volume_field = key(
    "of", Kind::text, "NAME of the [bake.NAME] with asset = \"cloud_volume\"", KeyFlag::required);

inline constexpr Field source_channel_field =
    key("channel", Kind::text, "channel of that volume; its first by default",
        Hint{"R, G, B or A, or Y for a volume of one channel"});

// Voxels along an edge of a cell.
inline constexpr Range cell_range{1, 16};

// Returns the volume that `key` names, or null. It reports a name that is not a cloud volume's
// (E0133), unless that volume has errors of its own.
const CloudVolumeBake* find_source_volume(const DecodedSection& bake, const RecipeSoFar& recipe,
                                          Decoder& decoder, std::string_view key = "of");

// Returns the volume of that name, which stands in the value of `key`, as find_source_volume does.
const CloudVolumeBake* find_volume_named(const DecodedSection& bake, std::string_view key,
                                         const std::string& name, const RecipeSoFar& recipe,
                                         Decoder& decoder);

// Reports a channel that the volume does not have (E0134).
void check_source_channel(const DecodedSection& bake, const CloudVolumeBake& volume,
                          const RecipeSoFar& recipe, Decoder& decoder);

// Returns the cloud of the volume, or null if it has errors.
const Cloud* find_cloud(const CloudVolumeBake& volume, const RecipeSoFar& recipe);

// Returns how many cells of `cell` voxels along each edge cover the volume, including those that
// stick out of it.
VoxelCounts cells_of(const CloudVolumeBake& volume, int cell);

// Reports cells that do not divide the volume along an axis (E0150), at the key `cell`.
void report_untiled(const DecodedSection& bake, const CloudVolumeBake& volume, int cell,
                    std::size_t axis, Decoder& decoder);

// Warns of cells that are not cubes in a VDB file (W0211).
void check_cell_cubes(const DecodedSection& bake, const CloudVolumeBake& volume, int cell,
                      const RecipeSoFar& recipe, Decoder& decoder);

// Resolves an asset whose texels are cells of `cell` voxels of a cloud volume. The resolver has the
// section as `bake`, `recipe` and `decoder`. Its check_contents() returns the number of channels,
// check_cells(cells) is called before the files are resolved and check_tiling(volume, cell) after that.
// `refused` says of which assets blocks are refused, and why. It reports a name that is not a cloud
// volume's (E0133), a channel that the volume does not have (E0134), and faults of the files of any
// volume (file_decoder.h), and warns of cells that are not cubes (W0211).
template <class Resolver>
void resolve_cells(const Resolver& resolver, const std::string& refused) {
    DecodedSection& bake = resolver.bake;
    Decoder& decoder = resolver.decoder;
    check_pixel_type(bake, decoder);
    refuse_blocks(bake, refused, decoder);
    const std::size_t contents = resolver.check_contents();
    const CloudVolumeBake* volume = find_source_volume(bake, resolver.recipe, decoder);
    if (!volume) return;
    check_source_channel(bake, *volume, resolver.recipe, decoder);
    const std::optional<int> cell = bake.whole("cell");
    if (!cell || volume->size[0] == 0) return;
    const VoxelCounts cells = cells_of(*volume, *cell);
    resolver.check_cells(cells);
    resolve_files(bake, cells, Halving::up, decoder);
    resolver.check_tiling(*volume, *cell);
    check_cell_cubes(bake, *volume, *cell, resolver.recipe, decoder);
    check_voxel_count(bake, cells, contents, bake.at("of").source->place, decoder);
}

// Lists the values of the cloud volume and of its cloud. Those of the volume's files are left out,
// unless the files that it has by default cannot hold its type of numbers: then the list would be no
// valid recipe.
std::vector<Read> reads_of_source_volume(const Parameters& parameters, const std::string& of);
template <class Asset>
std::vector<Read> reads_of_its_source(const Parameters& parameters, const Asset& bake) {
    return reads_of_source_volume(parameters, bake.of);
}

}  // namespace skybake::config
