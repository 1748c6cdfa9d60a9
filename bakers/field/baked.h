// The result of a bake, which is a table or a volume: what files and manifests say about it, and
// its voxels on demand. A table is a volume of one slice whose texels are held in memory.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bakers/field/conventions.h"
#include "bakers/field/image.h"
#include "bakers/field/level.h"
#include "bakers/math/facts.h"
#include "config/sections/files.h"

namespace skybake {

// A text file that readers of the volume's files need beside them.
struct CompanionFile {
    std::string format;  // "json"; also the file name's extension
    std::string text;
};

struct Baked : config::AssetFiles {
    std::string name;                        // NAME of [bake.NAME]
    std::string kind;                        // "transmittance", "noise_volume"
    std::string content;                     // what a texel means, with its unit, in one line
    std::string mapping;                     // "bruneton", "ue", "tile", "layer"
    std::vector<AxisMapping> axes;           // u, v of a table; u, v, w of a volume
    std::vector<std::string> channel_names;  // {"R", "G", "B", "A"}, {"R", "G", "B"} or {"Y"}
    std::vector<Level> levels;
    RangeCounts range;
    bool certified = false;
    Certificate certificate;
    std::string parameters;  // TOML: the resolved parameters that this asset depends on
    Conventions conventions;
    Facts details;  // further facts, for example counts

    // These members are for volumes only.
    std::vector<std::string> grid_names;     // VDB: one per channel; empty: density, or R, G, ...
    bool sparse = false;                     // VDB: voxels stored as 0 are background, not active
    std::array<double, 3> voxel_size_m{};    // VDB: edges of a voxel of level 0
    std::array<double, 3> minimum_m{};       // VDB: the lower corner of voxel (0, 0, 0)
    std::string up_axis;                     // "+z", of VDB files
    std::optional<CompanionFile> companion;  // NAME.json
    double seam_error = 0;  // largest difference between voxel 0 and voxel `size`, over all axes

    bool is_table() const { return axes.size() == 2; }
    // The texels of a table.
    const Image2<float>& image() const;
};

// Copies the recipe's settings for the files into the asset.
void set_files(const config::AssetFiles& files, Baked& baked);

// Makes these texels the table's only level. The level is not surveyed.
void set_image(Image2<float> image, Baked& table);

}  // namespace skybake
