// The cloud volume that another asset is made of: its `of` names the bake.
//
// Assets whose texels are blocks of a volume's voxels: where they lie, and what they are called.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/field/conventions.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/facts.h"
#include "bakers/occupancy/cell_grid.h"
#include "config/assets/cloud_volume.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"

namespace skybake {

struct Baked;

// Returns the bake that `of` names. A recipe that was read has it.
const CloudVolumeBake& source_volume(const Parameters& parameters, const std::string& of);

// Returns the voxels of that volume as its files hold them, which it shares with the volume's own
// bake. Adds what its cloud is made of to the details of what is made of them. Returns E0300 or E0304
// if a file of the cloud cannot be read, and neither value nor diagnostics after an interruption.
Outcome<Baked> hold_source_volume(const Parameters& parameters, const std::string& of,
                                  const BakeOptions& options, Facts& details);

// Returns whether a march may sum the densities of the volume as its files hold them.
bool is_marched_as_stored(const Cloud& cloud);

// Returns what an asset that is made of a cloud volume needs, for its baker's row.
template <class Asset>
std::vector<Need> needs_of_source(const Parameters& parameters, const Asset& asset, Certification) {
    return needs_of_voxels(parameters, source_volume(parameters, asset.of));
}

// Returns the files that such an asset reads, for its baker's row.
template <class Asset>
std::vector<InputFile> inputs_of_source(const Parameters& parameters, const Asset& asset) {
    return cloud_volume_inputs(parameters, source_volume(parameters, asset.of));
}

// Returns the edges of what the blocks of a volume span, which may go on beyond the volume.
Uvw spanned_m(const occupancy::CellGrid& grid, const Cloud& cloud);

// How files speak of the blocks.
struct BlockWords {
    std::string_view block;  // "cell" or "texel"; constants of the axes begin with it
    std::string place;       // where block i of an axis is, behind "repeats; " or "clamped; "
    AxisFilter filter = AxisFilter::linear;
};

// Fills in what says where the blocks of `of` lie: mapping, axes, edges, corner and conventions. Blocks
// go on beyond the volume where they do not divide it.
void place_blocks(const Baked& of, const occupancy::CellGrid& grid, const BlockWords& words,
                  Baked& volume);

}  // namespace skybake
