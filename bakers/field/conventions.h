// What the numbers of an asset mean, along its axes and in its channels, and how accurate they are.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bakers/field/image.h"
#include "bakers/math/facts.h"

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

// The most that a runtime pays for the lookup of a place: all that stands in its code counts, with all branches.
struct LookupCost {
    std::string library;  // "sky_view" of examples/lookups/sky_view.glsl
    int fetches = 0;      // of texels
    int operations = 0;   // of scalars, without those below
    int divisions = 0;
    int special_functions = 0;  // roots, powers, logarithms, arc tangents
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

// Returns the axes along which lookups repeat.
std::array<bool, 3> repeating_axes(const std::vector<AxisMapping>& axes);

// Whether lookups take the nearest voxel.
bool is_looked_up_nearest(const std::vector<AxisMapping>& axes);

}  // namespace skybake
