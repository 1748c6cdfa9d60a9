// The result of a bake, which is a table or a volume: what files and manifests say about it, and
// its voxels on demand. A table is a volume of one slice whose texels are held in memory. A volume
// may be larger than memory, so writers ask for it box by box, in the order of a BoxSequence.
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

// The value of a lookup beyond the ends of an axis: that of the end, or that of the repeated axis.
enum class AxisWrap { clamp, repeat };

// Whether a lookup interpolates between texels or takes the nearest one.
enum class AxisFilter { linear, nearest };

// How one texture coordinate is calculated from a physical quantity.
struct AxisMapping {
    std::string quantity;    // "cos_zenith", "sun_cos_zenith", "altitude_km"
    std::string formula;     // texture coordinate in [0, 1] from physical quantities
    std::string convention;  // "end points on texel centres" or "end points on texture edges"
    double first = 0;        // the quantity where the axis begins (u or v smallest)
    double last = 0;

    // The rest is for programs. The formula and the convention say the same in words.
    TexelConvention end_points = TexelConvention::end_points_on_texel_centres;
    AxisWrap wrap = AxisWrap::clamp;
    AxisFilter filter = AxisFilter::linear;
    Facts constants = {};  // the formula's numbers, with units in their names
};

// How the light of the wavelengths becomes colours: colour = sum over wavelengths of their weights
// times light.
struct ColorConvention {
    std::string space;                 // "linear_srgb"
    std::string white;                 // "sun", "space"
    std::string sun;                   // "measured", "flat": the sunlight that the weights contain
    std::string observer;              // "cie_1931"
    bool is_applied = false;           // channels are colours; else they are wavelengths
    std::vector<double> weights = {};  // three for each of wavelengths_nm, in their order
};

// The meaning of an asset's numbers. A member is empty if it does not apply: a noise has no
// lengths, and a transmittance does not depend on the sun's irradiance.
struct Conventions {
    std::string length_unit;       // of lengths along the axes: "km", "m"
    std::string coefficient_unit;  // of scattering and extinction coefficients: "1/km", "1/m"
    std::string angle_unit;        // of angles along the axes: "cosine", "deg"
    std::string radiance_unit;     // of values that are radiances
    std::vector<double> solar_irradiance = {};  // E of each colour; all values contain this factor
    std::vector<double> wavelengths_nm = {};    // of each channel, or what colours are made of
    std::optional<ColorConvention> color = {};
    std::string up_axis = {};  // "+z", of assets that lie in space
};

struct ErrorFigures {
    double max = 0;
    double rms = 0;
};

// The error of the light that a runtime finds in an asset or makes with it, |found / reference - 1|,
// against paths of light. All errors are in it: of the solution, of the quadrature along rays, of
// the lookup, and the noise of the reference.
struct SkyError {
    double median = 0;
    double ninth_decile = 0;  // nine in ten errors are below this
    double max = 0;
    int points = 0;             // values: places times channels
    std::string reference;      // paths and places
    double standard_error = 0;  // of the reference, relative: the median of its values
    int left_out = 0;           // further values, where there is too little light to tell an error
    std::string worst;          // the place of the largest error
    std::optional<double> worst_sun_deg = {};  // the sun's elevation there, where places have suns
    std::string better = {};                   // what would have a smaller error, or empty
};

// How far colours made of the recipe's wavelengths are from those of whole spectra: the largest
// difference of a channel, over luminance. Air, light and lookups are the same for both.
struct ColorError {
    double median = 0;
    double ninth_decile = 0;
    double max = 0;
    std::array<double, 3> disc{};  // of the sun seen from the ground, at 5, 1 and 0 degrees
    int skies = 0;                 // views of the sky that were measured
};

// The measured error of a table. All figures are pure functions of the parameters.
struct Certificate {
    ErrorFigures texel;  // stored texels against the reference at their centres
    ErrorFigures
        lookup;  // bilinear lookups of the stored texels against the reference, between texels
    int texel_points = 0;
    int lookup_points = 0;
    std::string reference;  // what the errors were measured against
    std::string scale;      // what an error of 1 means
    std::string
        worst;  // where the largest lookup error was: "altitude_km 0.02, sun_cos_zenith -0.01"
    std::string advice;                    // what would help, or empty
    std::optional<SkyError> sky = {};      // of assets of light that is scattered more than once
    std::optional<ColorError> color = {};  // of recipes with colours
};

// Counts of texels, over all levels, that a pixel type cannot hold accurately.
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

// A pure function from voxel indices to values. Any thread may call it. An implementation may use
// scratch memory during a call but must not keep it between calls.
class VoxelSource {
  public:
    virtual ~VoxelSource() = default;
    // Writes channel c to channels[c]: box.count() floats, x fastest, then y, then z. A null
    // pointer means that the channel is not wanted. Values are as baked, before rounding to a pixel
    // type.
    virtual void fill(const VoxelBox& box, const std::vector<float*>& channels) const = 0;
    // Returns true only if every voxel of the box is known to be 0 in every channel without being
    // evaluated.
    virtual bool is_empty(const VoxelBox& /*box*/) const { return false; }
};

// A table's texels as stored, already rounded to the pixel type. Row y of the image is row y of the
// only slice.
class DenseTexels : public VoxelSource {
  public:
    explicit DenseTexels(Image2<float> image) : image_(std::move(image)) {}
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;
    const Image2<float>& image() const { return image_; }

  private:
    Image2<float> image_;
};

// Statistics of one channel as stored.
struct ValueStatistics {
    double min = 0;
    double max = 0;
    double mean = 0;
    std::array<double, 2> histogram_range{};  // the bins' outer bounds, [0, 1] for most noises
    std::vector<std::int64_t> histogram;      // bins of equal width; values outside are not counted
};

// A second lookup for a blended value: it has the weight `share`, the first lookup has the rest.
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
    std::vector<double> tolerance;  // one per channel; allows filtering in steps of 1/256 texel
    std::vector<double> column_km = {};       // of tables of columns: what their lookups make of value
    std::optional<BlendedLookup> blend = {};  // of two sub-images, as in Bruneton's tables along nu
};

// A voxel whose value is large compared with its neighbours.
struct VoxelPeak {
    std::array<int, 3> voxel{};
    int channel = 0;
    float value = 0;
};

// One level of detail. Level 0 is the asset itself.
struct Level {
    std::array<int, 3> size{};                      // voxels along u, v, w; a table has one along w
    std::array<bool, 3> repeats{true, true, true};  // for lookups; other axes are clamped
    std::shared_ptr<const VoxelSource> voxels;
    std::shared_ptr<const VoxelSource> uncoded = {};  // before coding in blocks (block_voxels.h)
    std::vector<ValueStatistics> statistics;          // one per channel
    std::string content_hash;  // xxh3 of the voxels as stored, in x, y, z order, interleaved
    std::vector<Probe> probes;
    std::vector<std::string> catches;  // wrong lookups that the probes detect (wrong_lookups.h)
    bool nearest = false;              // lookups take the nearest voxel
    std::vector<VoxelPeak> peaks;      // large voxels; for the choice of probes
};

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

// Returns the axes along which lookups repeat.
std::array<bool, 3> repeating_axes(const std::vector<AxisMapping>& axes);

// Whether lookups take the nearest voxel.
bool is_looked_up_nearest(const std::vector<AxisMapping>& axes);

// The boxes that a volume is cut into, in the order in which a file needs its rows; they are made,
// converted and written one after the other. A group is `columns` slices: the cells of one row of
// an atlas, or one slice of a stack. Small groups share a box; large groups are cut into several
// boxes of whole rows. With columns = 1, the voxels of successive boxes are the volume's voxels in
// the order x, y, z. A box has at most kFloats values unless a single row of a group has more. The
// boxes are a pure function of the arguments, so sums over boxes are the same on every machine.
class BoxSequence {
  public:
    static constexpr std::int64_t kFloats = 1 << 21;  // 8 MiB

    BoxSequence(std::array<int, 3> size, int channels, int columns = 1);

    int count() const { return groups_ * parts_; }
    VoxelBox operator[](int index) const;
    // The number of voxels in the largest box.
    std::int64_t largest_count() const;

  private:
    std::array<int, 3> size_;
    int depth_ = 1;   // slices per box
    int rows_ = 1;    // rows per box
    int groups_ = 1;  // boxes along z
    int parts_ = 1;   // boxes along y
};

// How many boxes may be in memory while `threads` threads make them: enough to keep all threads
// busy, but at most 24, so that memory does not grow with the number of cores.
int box_slots(int threads);

}  // namespace skybake
