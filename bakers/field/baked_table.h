// A finished table with everything that a file or a manifest says of it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/field/image.h"
#include "bakers/field/texel_axis.h"
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

// A place and the value that a correct lookup of the stored file returns there.
struct Probe {
    std::vector<std::pair<std::string, double>> at;  // {"altitude_km", 0.5}, {"cos_zenith", -0.01}
    std::array<double, 2> uv{};                      // texture coordinates of that place
    std::vector<double> value;                       // one per channel: bilinear lookup in double
    std::vector<double> tolerance;  // one per channel: room for filtering in 1/256 texel
};

struct RangeCounts {
    long below_normal =
        0;                 // texels, not 0 in double, that the pixel type stores as a denormal or 0
    long above_range = 0;  // texels that the pixel type cannot hold
};

struct BakedTable {
    std::string name;                        // NAME of [bake.NAME]
    std::string kind;                        // "transmittance", "multiple_scattering"
    std::string content;                     // what a texel means, with its unit, in one line
    std::string mapping;                     // "bruneton", "ue", "hillaire", "twilight"
    std::array<AxisMapping, 2> axes;         // u, v
    std::vector<std::string> channel_names;  // {"R", "G", "B"} or {"Y"}
    config::PixelType pixel_type = config::PixelType::float32;
    config::Compression compression = config::Compression::zip;
    Image2<float> image;  // the values as stored: already rounded to the pixel type
    RangeCounts range;
    bool certified = false;
    Certificate certificate;
    double bake_seconds = 0;  // wall time of making the texels: the one figure that is not pure
    std::vector<Probe> probes;
    std::vector<std::string> catches;  // wrong lookups that the probes tell (wrong_lookups.h)
    std::string parameters;            // TOML: the resolved parameters that this table depends on
    Conventions conventions;
    Facts details;  // further facts, for example counts
};

}  // namespace skybake
