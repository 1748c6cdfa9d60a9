// GLSL that reads a baked asset: a published lookup of examples/lookups, and functions that call it
// with the numbers of the bake.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/air/ray.h"
#include "bakers/assets/description/probe_places.h"
#include "bakers/field/conventions.h"

namespace skybake {

// Its arguments are what only a runtime knows; those that a probe names too have the probe's names.
struct GlslFunction {
    std::string comment;    // what it returns and takes, with units, in sentences
    std::string result;     // "vec3"
    std::string arguments;  // "sampler2D table, float altitude_km"
    std::string value;      // an expression
    std::string before{};   // statements that the value needs
    std::string suffix{};   // of its name; the first function of an asset has none
};

struct AssetLookup {
    std::string_view library;             // "sky_view" of examples/lookups/sky_view.glsl
    std::vector<GlslFunction> functions;  // the first one returns the texels' channels
};

// A number as a float, always with a point: "6360.0", "1.0e-05".
std::string glsl_number(double value);
// "vec3(3000.0, 3200.0, 1000.0)".
std::string glsl_vector(const std::array<double, 3>& values);
// Numbers of texels as floats: "vec2(256.0, 64.0)".
std::string glsl_size(std::span<const int> size);
// The ground's radius and the thickness of the air in km: "6360.0, 100.0".
std::string glsl_shell(const Shell& shell);

// The function as it returns so many channels of a value that has `components`.
GlslFunction with_channels(std::size_t channels, std::size_t components, GlslFunction function);

// The end of the name of a published lookup: "_of_4" of the one for four wavelengths.
std::string_view of_4(std::size_t channels);

// The function as it returns the channels of a lookup whose name ends as of_4 says.
GlslFunction with_wavelengths(std::size_t channels, GlslFunction function);

// "baked_sky" of the asset `sky`: a name that GLSL allows.
std::string glsl_name(std::string_view asset);

// The functions of the lookup under this name, below what they need of the published file.
std::string lookup_glsl(const AssetLookup& lookup, const std::string& name);

// Returns the cost of the first function: the sum of those that stand above the published functions it needs.
LookupCost cost_of(const AssetLookup& lookup);
// "fetches 1, operations 30, divisions 0, special functions 2", as those lines have it.
std::string cost_text(const LookupCost& cost);

// A function NAME_color that turns light at the wavelengths of a file into colours, with what it does
// as a comment. If the file holds one packet, its colours are a part of those of all.
std::string color_glsl(const ColorConvention& color, const std::vector<double>& wavelengths_nm,
                       bool is_packet, const std::string& name);

// The text of a file of examples/lookups by its name, such as "film.glsl", which the build puts into the
// program. Throws std::out_of_range where there is none.
std::string_view published_lookup(std::string_view name);

// Text as a comment, in lines of at most 100 characters.
std::string glsl_comment(std::string_view text);

}  // namespace skybake
