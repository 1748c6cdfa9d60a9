// The textures of a live page: texels as text, of tables, volumes and grids of cells.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bakers/field/image.h"
#include "bakers/march/cloud_medium.h"
#include "bakers/render/sky_tables.h"

namespace skybake {

using LiveJson = nlohmann::ordered_json;

// Volumes that would take more as halves are held as unorm8.
inline constexpr std::size_t kMostHalfBytes = std::size_t{8} << 20;

// Compresses bytes (RFC 1950).
std::string zlib_bytes(const std::string& bytes);

// Describes a texture and holds its texels. `type` is "float", "half" or "unorm8".
LiveJson texture(const std::string& name, const std::string& label, std::vector<int> size,
                 int channels, const char* type, const std::string& texels);

LiveJson table_texture(const std::string& name, const std::string& label,
                       const Image2<float>& table);

// The first channel of a volume, as unorm8 or half.
struct PackedVolume {
    const char* type = "half";
    std::string texels;
    double greatest_error = 0;
};

PackedVolume packed_volume(const PreviewAsset& asset);

// Returns the leaps of a grid in cells, as bytes. Longer ones than 255 cells are held as 255.
std::string leap_bytes(const LeapGrid& grid);

}  // namespace skybake
