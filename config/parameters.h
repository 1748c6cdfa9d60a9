// What a user may say, as plain structs. A member's name is its TOML key, its --set path and its
// name in the parameters that files carry. The field tables (fields.h) say unit, range, default and
// source of each; load_recipe (recipe.h) fills the structs, so every value here is resolved and
// valid.
#pragma once

#include <array>
#include <cstdint>
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

enum class PixelType { float32, half, unorm8, unorm16 };  // "float" ...; tables: the first two
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

enum class NoiseType { constant, perlin, worley, perlin_worley, curl };
enum class NoiseFractal { fbm, rectified, ridged, billow };
enum class WorleyFeature { f1, f2, f2_minus_f1 };
enum class WorleyValue {
    distance,
    one_minus_distance,
    one_minus_distance_over_sqrt3,
    one_minus_distance_squared
};
enum class CurlComponent { x, y, z };

// A sum of octaves of one kind of noise. `frequencies[i]` are lattice cells a tile along x, y, z of
// octave i, `gains[i]` its weight before the weights are divided by their sum.
struct NoiseOctaves {
    std::vector<std::array<int, 3>> frequencies;
    std::vector<double> gains;
};

// One channel of a noise.
struct NoiseChannel {
    std::string name;  // "R", "G", "B", "A", or "Y" where it is the only one
    NoiseType type = NoiseType::perlin;
    double value = 0;      // constant
    NoiseOctaves octaves;  // all types but constant; the gradient part of perlin_worley
    NoiseFractal fractal = NoiseFractal::fbm;   // perlin, perlin_worley
    NoiseOctaves worley_octaves;                // the cellular part of perlin_worley
    WorleyFeature feature = WorleyFeature::f1;  // worley, perlin_worley
    WorleyValue value_form = WorleyValue::one_minus_distance;
    CurlComponent component = CurlComponent::x;  // curl
    std::uint64_t seed = 0;                      // besides the noise's own
    std::array<double, 4> remap{0, 1, 0, 1};     // [in low, in high, out low, out high], linear
    bool invert = false;                         // 1 - v, after remap
    double bias = 0.5;                           // Schlick's, after invert; 0.5 changes nothing
};

enum class NoiseSampling { centers, corners, slices_at_corners };
enum class NoisePacking { none, shape, detail };

// One [noise.NAME].
struct Noise {
    std::string name;
    std::uint64_t seed = 0;
    std::array<int, 3> size{};  // what it is made for; the default of a bake's size
    NoiseSampling sampling = NoiseSampling::centers;
    NoisePacking pack = NoisePacking::none;
    std::vector<NoiseChannel> channels;  // in the order R, G, B, A
};

enum class VolumeFormat { exr, vdb, bin };
enum class VolumeLayout { stack, atlas };
enum class VdbCompression { none, zip, blosc };

struct NoiseVolumeBake {
    std::string noise;                  // NAME of a [noise.NAME]
    std::array<int, 3> size{};          // voxels along x, y, z
    std::vector<VolumeFormat> formats;  // without duplicates
    PixelType pixel_type = PixelType::half;
    VolumeLayout layout = VolumeLayout::stack;   // of EXR
    int columns = 0;                             // of an atlas; 0: chosen
    int mips = 1;                                // levels, the volume itself among them
    Compression compression = Compression::zip;  // of EXR
    VdbCompression vdb_compression = VdbCompression::blosc;
};

// One [bake.NAME] section.
struct Bake {
    std::string name;
    // `asset = "..."`, default NAME
    std::variant<TransmittanceBake, MultipleScatteringBake, NoiseVolumeBake> asset;
};

struct Parameters {
    std::vector<Length> wavelengths;  // one per channel: 1 (a luminance table, Y) or 3 (R, G, B)
    Atmosphere atmosphere;            // without radii and layers in a recipe of noises alone
    std::vector<Noise> noises;        // by name
    std::vector<Bake> bakes;          // in the order of the file
};

}  // namespace skybake::config
