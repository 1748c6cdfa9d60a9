// What a bake makes, a table or a volume: what files and manifests say of it, and its voxels on
// demand. A table is a volume of one slice whose texels are held in memory. Volumes may be larger
// than memory, so writers ask for boxes of them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/field/image.h"
#include "bakers/math/facts.h"
#include "config/sections/files.h"

namespace skybake {

// What a lookup beyond the ends of an axis returns.
enum class AxisWrap { clamp, repeat };

// How a lookup between texels is made.
enum class AxisFilter { linear, nearest };

// How one texture axis follows from a physical quantity.
struct AxisMapping {
    std::string quantity;    // "cos_zenith", "sun_cos_zenith", "altitude_km"
    std::string formula;     // texture coordinate in [0, 1] from physical quantities
    std::string convention;  // "end points on texel centres" or "end points on texture edges"
    double first = 0;        // the quantity where the axis begins (u or v smallest)
    double last = 0;

    // For programs; all of it stands in words in the formula and the convention.
    TexelConvention end_points = TexelConvention::end_points_on_texel_centres;
    AxisWrap wrap = AxisWrap::clamp;
    AxisFilter filter = AxisFilter::linear;
    Facts constants = {};  // the numbers of the formula, with their units in their names
};

// What the numbers of an asset mean. A member is empty where it does not apply: a noise has no
// lengths, a transmittance is the same whatever the sun's irradiance.
struct Conventions {
    std::string length_unit;       // of lengths along the axes: "km", "m"
    std::string coefficient_unit;  // of scattering and extinction coefficients: "1/km", "1/m"
    std::string angle_unit;        // of angles along the axes: "cosine", "deg"
    std::string radiance_unit;     // of values that are radiances
    std::vector<double> solar_irradiance = {};  // E of each colour, which all values are times
    std::vector<double> wavelengths_nm = {};    // of each colour
    std::string up_axis = {};                   // "+z", of assets that lie in space
};

struct ErrorFigures {
    double max = 0;
    double rms = 0;
};

// Of a table that stands for an approximation: radiance of the sky made with it, |value / reference
// - 1| over sky directions.
struct SkyError {
    double median = 0;
    double ninth_decile = 0;  // nine in ten are below
    double max = 0;
    int points = 0;
    std::string reference;
};

// The error that a table has, measured. All figures are pure functions of the parameters.
struct Certificate {
    ErrorFigures texel;  // stored texels against the reference at their centres
    ErrorFigures
        lookup;  // bilinear lookups of the stored texels against the reference, between texels
    int texel_points = 0;
    int lookup_points = 0;
    std::string reference;  // what they were measured against
    std::string scale;      // what an error of 1 means
    std::string
        worst;  // where the largest lookup error was: "altitude_km 0.02, sun_cos_zenith -0.01"
    std::string advice;  // what would help, or empty
    std::optional<SkyError> sky = {};
};

// The texels of all levels that a pixel type holds badly.
struct RangeCounts {
    long below_normal = 0;  // not 0 in double, and stored as a denormal or as 0
    long above_range = 0;   // beyond what the type can hold
};

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

// A table's texels as stored: already rounded to the pixel type. Row y of the image is row y of the
// one slice.
class DenseTexels : public VoxelSource {
  public:
    explicit DenseTexels(Image2<float> image) : image_(std::move(image)) {}
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;
    const Image2<float>& image() const { return image_; }

  private:
    Image2<float> image_;
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

// A place in a level and the value that a correct lookup of the stored file returns there.
struct Probe {
    std::vector<std::pair<std::string, double>> at = {};  // {"altitude_km", 0.5}, {"x_m", 500}
    std::array<double, 3> uvw{};    // texture coordinates: texel i is at (i + 1/2) / size; w of a
                                    // table is 1/2
    std::vector<double> value;      // one per channel, in double, as the level is looked up
    std::vector<double> tolerance;  // one per channel: room for filtering in 1/256 texel
    std::optional<BlendedLookup> blend = {};  // of two sub-images, Bruneton's along nu
};

// A voxel that is large among those about it.
struct VoxelPeak {
    std::array<int, 3> voxel{};
    int channel = 0;
    float value = 0;
};

// One level of detail. Level 0 is the asset itself.
struct Level {
    std::array<int, 3> size{};                      // voxels along u, v, w; a table has one along w
    std::array<bool, 3> repeats{true, true, true};  // for lookups; axes that do not are clamped
    std::shared_ptr<const VoxelSource> voxels;
    std::vector<ValueStatistics> statistics;  // one per channel
    std::string content_hash;  // xxh3 of the voxels as stored: x, y, z order, channels interleaved
    std::vector<Probe> probes;
    std::vector<std::string> catches;  // wrong lookups that the probes tell (wrong_lookups.h)
    bool nearest = false;              // looked up so, in place of between voxels
    std::vector<VoxelPeak> peaks;      // where there is something; for the choice of probes
};

// A text that readers of the volume's files want beside them.
struct CompanionFile {
    std::string format;  // "json": the end of its name too
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
    double bake_seconds =
        0;                   // wall time of making the texels once: the one figure that is not pure
    std::string parameters;  // TOML: the resolved parameters that this asset depends on
    Conventions conventions;
    Facts details;  // further facts, for example counts

    // Of volumes.
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

// How the files are to be, as a recipe says it.
void set_files(const config::AssetFiles& files, Baked& baked);

// Gives a table these texels as its only level, which is not surveyed.
void set_image(Image2<float> image, Baked& table);

// Along which axes lookups repeat, as the axes say.
std::array<bool, 3> repeating_axes(const std::vector<AxisMapping>& axes);

// Whether lookups take the nearest voxel, as the axes say.
bool is_looked_up_nearest(const std::vector<AxisMapping>& axes);

// How a volume is cut into boxes that are made, converted and written one after the other.

// The boxes of a volume in the order in which a file's rows want them: groups of `columns` slices
// (the cells of one row of an atlas; 1 for a stack), several groups a box where they are small,
// parts of their rows where they are large. With columns = 1 the voxels of box after box are those
// of the volume in the order x, y, z. A box has at most kFloats values unless one row of a group
// has more. A pure function of its arguments: sums over boxes are the same on every machine.
class BoxSequence {
  public:
    static constexpr std::int64_t kFloats = 1 << 21;  // 8 MiB

    BoxSequence(std::array<int, 3> size, int channels, int columns = 1);

    int count() const { return groups_ * parts_; }
    VoxelBox operator[](int index) const;
    // The most voxels that a box has.
    std::int64_t largest_count() const;

  private:
    std::array<int, 3> size_;
    int depth_ = 1;   // slices of a box
    int rows_ = 1;    // rows of a box
    int groups_ = 1;  // boxes along z
    int parts_ = 1;   // boxes along y
};

// How many boxes may be alive while `threads` threads make them: enough to keep all at work, and
// few enough for memory not to grow with the machine.
int box_slots(int threads);

}  // namespace skybake
