// What a user may say, as plain structs. A member's name is its TOML key, its --set path and its
// name in the parameters that files carry. The field tables (fields.h) say unit, range, default and
// source of each; load_recipe (recipe.h) fills the structs, so every value here is resolved and
// valid.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "config/quantity.h"

namespace skybake::config {

enum class Profile { exponential, tent, slab, tabulated };
enum class Phase { isotropic, rayleigh, henyey_greenstein, cornette_shanks };

// One entry of `table = [["0 km", 1.0], ...]`.
struct DensityPoint {
    Length altitude;
    double density = 0;
};

// One kind of particle or gas: a density profile over altitude times coefficients per channel.
struct Layer {
    std::string name;
    bool enabled = true;
    Profile profile = Profile::exponential;
    Length scale_height;                    // exponential
    Length center_altitude, half_width;     // tent
    Length bottom_altitude, top_altitude;   // slab
    std::vector<DensityPoint> table;        // tabulated: linear between, zero outside
    std::vector<InverseLength> scattering;  // one per channel, at density 1
    std::vector<InverseLength> extinction;  // one per channel, at density 1; never below scattering
    Phase phase = Phase::isotropic;
    double g = 0;  // henyey_greenstein, cornette_shanks
};

struct Atmosphere {
    Length ground_radius;
    Length top_radius;
    std::vector<double> ground_albedo;  // one per channel
    std::vector<Layer> layers;          // enabled ones, by name
};

enum class PixelType { float32, half };  // spelled "float" and "half"
enum class Compression { none, zip, zips, piz };

enum class TransmittanceContent { transmittance, optical_depth };
enum class TransmittanceMapping { bruneton, ue };

struct TransmittanceBake {
    std::array<int, 2> size{};        // texels along the zenith angle, along altitude
    std::optional<double> max_error;  // in place of size: bound on the maximum lookup error
    TransmittanceContent content = TransmittanceContent::transmittance;
    TransmittanceMapping mapping = TransmittanceMapping::bruneton;
    PixelType pixel_type = PixelType::float32;
    Compression compression = Compression::zip;
};

enum class MultipleScatteringMapping { hillaire, twilight };
enum class MultipleScatteringMethod { converged, as_in_paper };

struct MultipleScatteringBake {
    std::array<int, 2> size{};        // texels along the sun cosine, along altitude
    std::optional<double> max_error;  // in place of size: bound on the maximum lookup error
    double max_texel_error = 0;       // sets the quadrature's counts
    MultipleScatteringMapping mapping = MultipleScatteringMapping::hillaire;
    MultipleScatteringMethod method = MultipleScatteringMethod::converged;
    PixelType pixel_type = PixelType::float32;
    Compression compression = Compression::zip;
};

// One [bake.NAME] section.
struct Bake {
    std::string name;
    std::variant<TransmittanceBake, MultipleScatteringBake> asset;  // `asset = "..."`, default NAME
};

struct Parameters {
    std::vector<Length> wavelengths;  // one per channel: 1 (a luminance table, Y) or 3 (R, G, B)
    Atmosphere atmosphere;
    std::vector<Bake> bakes;  // in the order of the file
};

}  // namespace skybake::config
