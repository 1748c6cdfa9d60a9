// What a user may say, as plain structs. A member's name is its TOML key, its --set path and its
// name in the parameters that files carry. The field tables (fields.h) say unit, range, default and
// source of each; load_recipe (recipe.h) fills the structs, so every value here is resolved and
// valid.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "config/diagnostics/diagnostic.h"
#include "config/text/quantity.h"

namespace skybake::config {

enum class Profile { exponential, tent, slab, tabulated };
enum class Phase { isotropic, rayleigh, henyey_greenstein, cornette_shanks, mie };

enum class ParticleMaterial { water, constant };
enum class SizeDistribution { monodisperse, log_normal, gamma, modified_gamma };

// One [particles.NAME]: homogeneous spheres in air, and how many there are of each radius r:
//   monodisperse    all have r = radius
//   log_normal      n ~ 1/r exp(-ln^2(r / radius) / (2 ln^2 geometric_deviation))
//   gamma           n ~ r^((1 - 3 v) / v) exp(-r / (effective_radius v)), v the effective variance
//   modified_gamma  n ~ r^alpha exp(-(r / radius)^gamma)
struct Particles {
    std::string name;
    ParticleMaterial material = ParticleMaterial::water;
    double refractive_index = 1;  // constant: m = refractive_index + i absorption_index
    double absorption_index = 0;  // constant
    SizeDistribution sizes = SizeDistribution::gamma;
    Length radius;                   // all but gamma
    double geometric_deviation = 1;  // log_normal, above 1
    Length effective_radius;         // gamma: the mean radius, weighted with the cross-section
    double effective_variance = 0;   // gamma: relative to its square, in (0, 0.5)
    double alpha = 0;                // modified_gamma
    double gamma = 1;                // modified_gamma
};

// The particles of a layer whose density is 1.
struct LayerParticles {
    Particles particles;
    NumberDensity number_density;
    std::vector<Length> wavelengths;  // one per channel
};

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
    std::vector<InverseLength> scattering;  // one per channel, at density 1; none of mie
    std::vector<InverseLength> extinction;  // one per channel, at density 1; never below scattering
    Phase phase = Phase::isotropic;
    double g = 0;              // henyey_greenstein, cornette_shanks
    LayerParticles particles;  // mie: scattering, extinction and phase function follow from them
};

struct Atmosphere {
    Length ground_radius;
    Length top_radius;
    std::vector<double> ground_albedo;  // one per channel
    std::vector<Layer> layers;          // enabled ones, by name
};

// What a runtime will show: cameras and suns in ranges, so that tables need not hold more.
struct Scene {
    std::array<Length, 2> altitude;      // of cameras
    std::array<Angle, 2> sun_elevation;  // at the camera
    Length view_distance;
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
enum class MultipleScatteringMethod { converged, as_in_paper, solved };
enum class MultipleScatteringContent { hillaire, fitted, moments };

struct MultipleScatteringBake {
    std::array<int, 2> size{};        // texels along the sun cosine, along altitude
    std::optional<double> max_error;  // in place of size: bound on the maximum lookup error
    double max_texel_error = 0;       // sets the quadrature's counts
    MultipleScatteringMapping mapping = MultipleScatteringMapping::hillaire;
    MultipleScatteringMethod method = MultipleScatteringMethod::converged;
    MultipleScatteringContent content = MultipleScatteringContent::hillaire;  // solved
    int degree = 2;                                                           // moments
    PixelType pixel_type = PixelType::float32;
    Compression compression = Compression::zip;
};

// Which light: all of it; scattered once, in the air; or the rest, ground in sunlight included.
enum class SkyOrders { all, single, multiple };

// How light scattered twice or more is found: all orders solved for; or the second alone, from a
// sky of eight strips.
enum class SkyMethod { solved, strips };

struct SkyViewBake {
    std::array<int, 2> size{};  // texels along azimuth, along elevation; of one sun
    Length altitude;            // of the camera, which may be in space
    std::vector<Angle> sun_elevations;
    SkyOrders orders = SkyOrders::all;
    std::vector<std::string> layers;  // single: what scatters; empty: every layer
    SkyMethod sky = SkyMethod::solved;
    PixelType pixel_type = PixelType::float32;
    Compression compression = Compression::zip;
};

enum class IrradianceContent { direct, sky, total };

struct IrradianceBake {
    std::array<int, 2> size{};  // texels along the sun cosine, along altitude
    IrradianceContent content = IrradianceContent::total;
    SkyOrders orders = SkyOrders::all;  // sky
    std::vector<std::string> layers;    // single
    double max_texel_error = 0;         // sets the quadrature's counts
    MultipleScatteringMapping mapping = MultipleScatteringMapping::twilight;
    PixelType pixel_type = PixelType::float32;
    Compression compression = Compression::zip;
};

enum class PhaseContent { phase, inverse_cumulative };
enum class PhaseSpacing { best, angle, cosine, peaks };

// How particles or a layer scatter by angle.
struct PhaseBake {
    std::string particles;            // NAME of a [particles.NAME], or
    std::string layer;                // of a layer of the atmosphere
    int size = 0;                     // texels
    std::optional<double> max_error;  // in place of size: bound on the maximum lookup error
    PhaseContent content = PhaseContent::phase;
    PhaseSpacing spacing = PhaseSpacing::best;  // phase
    int degree = 0;                             // of the Legendre moments in the manifest
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
    // What becomes of a value v, in this order.
    std::array<double, 4> remap{0, 1, 0, 1};          // [in low, in high, out low, out high]
    std::optional<std::array<double, 2>> smoothstep;  // from 0 at the first to 1 at the second
    bool invert = false;                              // 1 - v
    double bias = 0.5;                                // Schlick's; 0.5 changes nothing
    std::array<double, 2> clamp{-std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::infinity()};
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
    bool aliases = false;                // octaves too fine for `size` are meant to be
    std::vector<NoiseChannel> channels;  // in the order R, G, B, A
};

enum class VolumeFormat { exr, vdb, bin };
enum class VolumeLayout { stack, atlas };
enum class VdbCompression { none, zip, blosc };

// What the files of a volume are like.
struct VolumeFiles {
    std::vector<VolumeFormat> formats;  // without duplicates
    PixelType pixel_type = PixelType::half;
    VolumeLayout layout = VolumeLayout::stack;   // of EXR
    int columns = 0;                             // of an atlas; 0: chosen
    int mips = 1;                                // levels, the volume itself among them
    Compression compression = Compression::zip;  // of EXR
    VdbCompression vdb_compression = VdbCompression::blosc;
};

struct NoiseVolumeBake : VolumeFiles {
    std::string noise;          // NAME of a [noise.NAME]
    std::array<int, 3> size{};  // voxels along x, y, z
};

// How full a cloud is by height h, 0 at its base and 1 at its top.
enum class HeightProfileType { thesis, cumulus, stratus, stratocumulus, blended, tabulated };

// One entry of `table = [[0, 0.0], [0.2, 1.0]]`.
struct HeightPoint {
    double height = 0;  // in [0, 1]
    double value = 0;
};

struct HeightProfile {
    HeightProfileType type = HeightProfileType::cumulus;
    double bottom_sharpness = 50;    // thesis: (1 - exp(-bottom_sharpness h)) exp(-top_falloff h)
    double top_falloff = 4;          // thesis
    double cloud_type = 1;           // blended: 0 stratus, 0.5 stratocumulus, 1 cumulus
    std::vector<HeightPoint> table;  // tabulated: linear between, its end values beyond
};

enum class MapWrap { repeat, clamp };
enum class MapFilter { nearest, linear };
enum class MapColorSpace { linear, srgb };

// A picture laid over a cloud's extent, x to the right and y downwards from its first row.
struct CloudMap {
    std::string file;            // as the recipe has it; empty: none
    std::filesystem::path path;  // where it is: `file` in the folder of the recipe that names it
    std::string channel;         // "R", "Y", "coverage"; empty: the first
    MapWrap wrap = MapWrap::repeat;
    MapFilter filter = MapFilter::linear;
    MapColorSpace color_space = MapColorSpace::linear;
    SourceRange file_place;     // of `file` in the recipe
    SourceRange channel_place;  // of `channel`; of `file` where the recipe names no channel
};

// A Gaussian of height `amplitude` over the ground plan, in tiles; its periodic images are summed.
struct Tower {
    std::array<double, 2> center{};  // x, y
    std::array<double, 2> sigma{};   // along its own axes
    Angle rotation;                  // of its axes against x, y, counterclockwise
    double correlation = 0;          // between its axes, in (-1, 1)
    double amplitude = 0;
    std::string name = {};  // what the recipe calls it: "0", "1" ... in a list
};

// Towers at random places: each value is uniform in its range, sigma in its logarithm.
struct TowerScatter {
    int count = 0;
    std::uint64_t seed = 0;
    std::array<double, 2> sigma{};      // of the smaller axis
    std::array<double, 2> aspect{};     // the greater axis over the smaller, from 1 on
    std::array<double, 2> amplitude{};  // rotations are uniform
};

enum class ThresholdAt { bake, runtime };
enum class CloudChannels { density, noise };

// One [clouds.NAME].
struct Cloud {
    std::string name;
    std::string noise;                        // NAME of the base's [noise.NAME]
    std::array<int, 3> noise_scale{1, 1, 1};  // multiplies its frequencies along x, y, z
    std::string detail;                       // NAME of the [noise.NAME] that erodes; empty: none
    std::array<int, 3> detail_scale{1, 1, 1};
    std::array<double, 2> erosion{};  // strength at the base and at the top
    double wisp_height = 0;           // up to here the erosion turns from wisps to billows
    std::array<Length, 3> extent;     // x, y, height
    Length base_altitude;
    HeightProfile height_profile;
    double coverage = 1;    // 1: as the noise and the profile have it, 0: none
    CloudMap coverage_map;  // multiplies coverage
    CloudMap type_map;      // in place of cloud_type
    double threshold = 0;
    double edge_softness = 0;
    ThresholdAt threshold_at = ThresholdAt::bake;
    std::optional<double> full_at;  // the value whose density is 1; threshold_at = bake
    CloudChannels channels = CloudChannels::density;
    InverseLength extinction_scale;  // extinction of density 1
    std::vector<Tower> towers;       // in the order of the recipe
    TowerScatter scatter;
};

struct CloudVolumeBake : VolumeFiles {
    std::string cloud;               // NAME of a [clouds.NAME]
    std::array<int, 3> size{};       // voxels along x, y and height
    std::array<Length, 3> extent{};  // that they span, x, y, z; 0: the cloud's
};

// The filter that a runtime looks the volume up with.
enum class OccupancyFilter { nearest, trilinear, tricubic };
enum class OccupancyRule { exact, thesis };
enum class OccupancyContent { occupied, leap, minimum, maximum };

struct OccupancyBake : VolumeFiles {
    std::string of;       // NAME of a [bake.NAME] with asset = "cloud_volume"
    std::string channel;  // of that volume; empty: its first
    int cell = 4;         // voxels along each edge of a cell: 1, 2, 4, 8 or 16
    OccupancyFilter filter = OccupancyFilter::trilinear;
    OccupancyRule rule = OccupancyRule::exact;
    std::vector<OccupancyContent> contents;  // the channels, in this order, without duplicates
};

enum class AerialContent { in_scatter_and_transmittance, in_scatter, transmittance };
enum class SliceSpacing { linear, squared };

// Light scattered into view rays of a camera, up to distances along them.
struct AerialPerspectiveBake : VolumeFiles {
    std::array<int, 3> size{};  // voxels across, down and along distance
    AerialContent content = AerialContent::in_scatter_and_transmittance;
    Length altitude;  // of the camera, within the atmosphere
    Angle sun_elevation;
    Angle heading;  // of the view from the sun, to the right
    Angle pitch;    // above the horizontal
    Angle fov;      // vertical
    double aspect = 1;
    Length view_distance;  // where the last slice ends
    SliceSpacing slices = SliceSpacing::squared;
    SkyOrders orders = SkyOrders::all;
    std::vector<std::string> layers;  // single
};

enum class BrunetonTable { transmittance, scattering, single_mie, higher_orders, irradiance };
enum class BrunetonConvention { bruneton, takram };
enum class BrunetonMethod { solved, iterated };

// One table of the precomputed scattering of Bruneton & Neyret 2008, as their implementation of
// 2017 has it.
struct BrunetonBake : VolumeFiles {
    BrunetonTable table = BrunetonTable::scattering;
    // Texels along u, v, w. Tables of scattering: nu and the sun's cosine, the view's cosine,
    // altitude; transmittance: zenith angle, altitude, 1; irradiance: the sun's cosine,
    // altitude, 1.
    std::array<int, 3> size{};
    int nu_size = 0;       // tables of scattering: sub-images along u, which divide size[0]
    bool combined = true;  // scattering: the first order of Mie layers in A, red alone
    int orders = 0;        // of scattering; 0: all
    BrunetonMethod method = BrunetonMethod::solved;
    BrunetonConvention convention = BrunetonConvention::bruneton;
    double sun_cos_zenith_min = 0;         // where the axis of the sun begins
    std::vector<std::string> mie_layers;   // whose single scattering is kept apart
    std::vector<double> solar_irradiance;  // one per channel, multiplies all light
};

enum class OpticalDepthTable { to_top, between, density, phase };
enum class BetweenCoordinates { altitudes, distance };
enum class DepthSampling { exact, equal_attenuation, uniform };

// Column densities, densities and phase functions of up to four kinds of particles, one a channel,
// after Ai et al. 2014.
struct OpticalDepthBake : VolumeFiles {
    OpticalDepthTable table = OpticalDepthTable::to_top;
    std::array<int, 3> size{};  // to_top: angle, altitude, 1; between: three; else texels, 1, 1
    std::vector<std::string> kinds;  // layers of the atmosphere
    BetweenCoordinates coordinates = BetweenCoordinates::altitudes;
    DepthSampling sampling = DepthSampling::exact;
    int shells = 0;       // equal_attenuation, uniform
    Length max_altitude;  // equal_attenuation, uniform: the air above is left out
};

// One [bake.NAME] section.
struct Bake {
    std::string name;
    // `asset = "..."`, default NAME
    std::variant<TransmittanceBake, MultipleScatteringBake, SkyViewBake, AerialPerspectiveBake,
                 IrradianceBake, PhaseBake, BrunetonBake, OpticalDepthBake, NoiseVolumeBake,
                 CloudVolumeBake, OccupancyBake>
        asset;
};

struct Parameters {
    std::vector<Length> wavelengths;  // one per channel: 1 (a luminance table, Y) or 3 (R, G, B)
    Atmosphere atmosphere;            // without radii and layers in a recipe of noises alone
    std::optional<Scene> scene;
    std::vector<Particles> particles;  // by name
    std::vector<Noise> noises;         // by name
    std::vector<Cloud> clouds;         // by name
    std::vector<Bake> bakes;           // in the order of the file
};

}  // namespace skybake::config
