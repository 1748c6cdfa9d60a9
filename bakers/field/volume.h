// A baked volume: what files and manifests say of it, and its voxels on demand. Volumes may be
// larger than memory, so nobody holds all voxels: writers ask for boxes of them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bakers/field/baked_table.h"
#include "config/sections/files.h"

namespace skybake {

// Voxels origin ... origin + size - 1 along x, y, z.
struct VoxelBox {
    std::array<int, 3> origin{};
    std::array<int, 3> size{};
    std::int64_t count() const { return std::int64_t{size[0]} * size[1] * size[2]; }
};

// A pure function from voxel indices to values; any thread may ask. An implementation may keep
// scratch memory per call, not between calls.
class VoxelSource {
  public:
    virtual ~VoxelSource() = default;
    // channels[c] is where channel c goes, box.count() floats, x fastest, then y, then z; null
    // where it is not wanted. Values are as baked, before rounding to a pixel type.
    virtual void fill(const VoxelBox& box, const std::vector<float*>& channels) const = 0;
    // True only if every voxel of the box is known to be 0 in every channel, without making them.
    virtual bool is_empty(const VoxelBox& /*box*/) const { return false; }
};

// Of one channel, as stored.
struct ValueStatistics {
    double min = 0;
    double max = 0;
    double mean = 0;
    std::array<double, 2> histogram_range{};  // the bins' outer bounds, [0, 1] for most noises
    std::vector<std::int64_t> histogram;      // bins of equal width; values outside are not counted
};

// A second lookup that a value is blended with: `share` of it, the rest of the first.
struct BlendedLookup {
    std::array<double, 3> uvw{};
    double share = 0;
};

// A place in the volume and the value that a correct lookup of the stored file returns there.
struct VolumeProbe {
    std::array<double, 3> uvw{};    // texture coordinates: voxel i is at (i + 1/2) / size
    std::vector<double> value;      // one per channel, in double, as the level is looked up
    std::vector<double> tolerance;  // one per channel: room for filtering in 1/256 voxel
    std::vector<std::pair<std::string, double>> at = {};  // {"x_m", 500}, {"altitude_m", 1200}
    std::optional<BlendedLookup> blend = {};              // of two sub-images, Bruneton's along nu
};

// A voxel that is large among those about it.
struct VoxelPeak {
    std::array<int, 3> voxel{};
    int channel = 0;
    float value = 0;
};

// One level of detail. Level 0 is the volume itself.
struct VolumeLevel {
    std::array<int, 3> size{};
    std::array<bool, 3> repeats{true, true, true};  // for lookups; axes that do not are clamped
    std::shared_ptr<const VoxelSource> voxels;
    std::vector<ValueStatistics> statistics;  // one per channel
    std::string content_hash;  // xxh3 of the voxels as stored: x, y, z order, channels interleaved
    std::vector<VolumeProbe> probes;
    std::vector<std::string> catches;  // wrong lookups that the probes tell (wrong_lookups.h)
    bool nearest = false;              // looked up so, in place of between voxels
    std::vector<VoxelPeak> peaks;      // where there is something; for the choice of probes
};

// Along which axes a volume of a mapping repeats: all of a "tile", x and y of a "layer", whose
// lookups are clamped along z; none of any other.
std::array<bool, 3> repeating_axes(std::string_view mapping);

// Whether a volume of a kind is looked up at the nearest voxel, as "occupancy" is.
bool is_looked_up_nearest(std::string_view kind);

// A text that readers of the volume's files want beside them.
struct CompanionFile {
    std::string format;  // "json": the end of its name too
    std::string text;
};

struct BakedVolume {
    std::string name;     // NAME of [bake.NAME]
    std::string kind;     // "noise_volume"
    std::string content;  // what a voxel means, with its unit, in one line
    std::string mapping;  // "tile", "layer"; see repeating_axes
    std::array<AxisMapping, 3> axes;
    std::vector<std::string> channel_names;  // {"R", "G", "B", "A"}, {"R", "G", "B"} or {"Y"}
    std::vector<std::string> grid_names;     // VDB: one per channel; empty: density, or R, G, ...
    bool sparse = false;                     // VDB: voxels stored as 0 are background, not active
    config::PixelType pixel_type = config::PixelType::half;
    std::vector<config::VolumeFormat> formats;
    config::VolumeLayout layout = config::VolumeLayout::stack;  // of EXR
    int columns = 0;                                            // of an atlas; 0: to be chosen
    bool flipped = false;                                       // EXR: the whole image upside down
    std::optional<CompanionFile> companion;                     // NAME.json
    config::Compression compression = config::Compression::zip;
    config::VdbCompression vdb_compression = config::VdbCompression::blosc;
    std::array<double, 3> voxel_size_m{};  // VDB: edges of a voxel of level 0
    std::array<double, 3> minimum_m{};     // VDB: the lower corner of voxel (0, 0, 0)
    std::string up_axis;                   // "+z", of VDB files
    std::vector<VolumeLevel> levels;
    RangeCounts range;
    bool certified = false;
    Certificate certificate;
    double seam_error = 0;    // largest difference between voxel 0 and voxel `size`, over all axes
    double bake_seconds = 0;  // wall time of making the voxels of all levels once
    std::string parameters;   // TOML: the resolved parameters that this volume depends on
    Conventions conventions;
    Facts details;
};

}  // namespace skybake
