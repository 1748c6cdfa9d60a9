// This header reads the keys that name the cloud volume from which another asset is made: `of` and
// `channel`, or a key of that asset.
#pragma once

#include <cstddef>
#include <optional>
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

// Returns the volume that `of` names, or null. It reports a name that is not a cloud volume's
// (E0133), unless that volume has errors of its own.
const CloudVolumeBake* find_source_volume(const DecodedSection& bake, const RecipeSoFar& recipe,
                                          Decoder& decoder);

// Returns the volume of that name, which stands in the value of `key`, as find_source_volume does.
const CloudVolumeBake* find_volume_named(const DecodedSection& bake, std::string_view key,
                                         const std::string& name, const RecipeSoFar& recipe,
                                         Decoder& decoder);

// Reports a channel that the volume does not have (E0134).
void check_source_channel(const DecodedSection& bake, const CloudVolumeBake& volume,
                          const RecipeSoFar& recipe, Decoder& decoder);

// Returns the cloud of the volume, or null if it has errors.
const Cloud* find_cloud(const CloudVolumeBake& volume, const RecipeSoFar& recipe);

// Returns how many cells of `edge` voxels along each edge cover the volume, including those that stick
// out of it.
VoxelCounts cells_of(const CloudVolumeBake& volume, int edge);

// The cells of a cloud volume that are the texels of an asset.
struct VolumeCells {
    const CloudVolumeBake& volume;
    int edge = 1;          // voxels along each edge of a cell
    VoxelCounts counts{};  // cells along each axis
};

// Returns the cells of the volume that `of` names, or none. It reports a name that is not a cloud volume's
// (E0133), a channel that the volume does not have (E0134), and pixel types that the files cannot have
// (E0131). `refused` says of which assets blocks are refused, and why.
std::optional<VolumeCells> find_cells(const DecodedSection& bake, const RecipeSoFar& recipe,
                                      const std::string& refused, Decoder& decoder);

// Fills in what the files take from their cells. It reports faults of the files of any volume
// (file_decoder.h), and warns of cells that are not cubes (W0211).
void resolve_cells(DecodedSection& bake, const VolumeCells& cells, std::size_t channels,
                   const RecipeSoFar& recipe, Decoder& decoder);

// Reports cells that do not divide the volume along x or y (E0150), at the key `cell`. Where
// `one_may_hold_all`, a single cell may be longer than the volume.
void check_tiling(const DecodedSection& bake, const VolumeCells& cells, bool one_may_hold_all,
                  Decoder& decoder);

// Lists the values of the cloud volume and of its cloud. Those of the volume's files are left out,
// unless the files that it has by default cannot hold its type of numbers: then the list would be no
// valid recipe.
std::vector<Read> reads_of_source_volume(const Parameters& parameters, const std::string& of);
template <class Asset>
std::vector<Read> reads_of_its_source(const Parameters& parameters, const Asset& bake) {
    return reads_of_source_volume(parameters, bake.of);
}

}  // namespace skybake::config
