// This header declares clouds: [clouds.NAME] and the tables within.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/diagnostics/diagnostic.h"
#include "config/sections/forward.h"
#include "config/text/quantity.h"

namespace skybake::config {

// This says how full a cloud is at height h, which is 0 at its base and 1 at its top.
enum class HeightProfileType { thesis, cumulus, stratus, stratocumulus, blended, tabulated };

struct HeightProfile {
    HeightProfileType type = HeightProfileType::cumulus;
    double bottom_sharpness = 50;    // thesis: (1 - exp(-bottom_sharpness h)) exp(-top_falloff h)
    double top_falloff = 4;          // thesis
    double cloud_type = 1;           // blended: 0 stratus, 0.5 stratocumulus, 1 cumulus
    std::vector<HeightPoint> table;  // tabulated: linear between entries, constant beyond the ends

    bool operator==(const HeightProfile&) const = default;
};

enum class MapWrap { repeat, clamp };
enum class MapFilter { nearest, linear };
enum class MapColorSpace { linear, srgb };

// This is a picture that is laid over a cloud's extent. Its x axis points right, and its y axis
// down from the first row.
struct CloudMap {
    std::string file;            // as the recipe spells it; empty: no map
    std::filesystem::path path;  // `file` in the folder of the recipe that names it
    std::string channel;         // "R", "Y", "coverage"; empty: the first channel
    MapWrap wrap = MapWrap::repeat;
    MapFilter filter = MapFilter::linear;
    MapColorSpace color_space = MapColorSpace::linear;
    double factor = 1;          // of linear numbers
    bool clamp = false;         // what is then outside of [0, 1] becomes 0 or 1
    SourceRange file_place;     // of `file` in the recipe
    SourceRange channel_place;  // of `channel`, or of `file` if the recipe names no channel

    bool operator==(const CloudMap&) const = default;
};

// How a tower lives and dies within the loop of its cloud (bakers/clouds/tower_field.h).
struct TowerLife {
    std::array<double, 3> life{};  // how long it grows, stays and dissolves, in loops; 0: it stands
    double grows_from = 0.4;       // its width when it is born, over its full width

    bool lives() const { return life[0] > 0; }
    bool operator==(const TowerLife&) const = default;
};

// A Gaussian over the ground plan, in units of tiles, that is added to the height profile with its periodic
// images.
struct Tower : TowerLife {
    std::array<double, 2> center{};  // x, y
    std::array<double, 2> sigma{};   // along its own axes
    Angle rotation;                  // of its axes from x and y, counterclockwise
    double correlation = 0;          // between its axes, in (-1, 1)
    double amplitude = 0;
    std::string name = {};  // what the recipe calls it: "0", "1" ... in a list
    double born = 0;        // when it is born, in loops

    bool operator==(const Tower&) const = default;
};

// The source of a cloud's density where it is neither noise nor a volume of the recipe.
enum class CloudShape { convection, given };

// This is the air in which a cloud grows (bakers/convection/sounding.h). Its condensation level is the
// cloud's base.
struct Convection {
    std::array<int, 3> cells{};    // over the cloud's extent; 0: the cloud does not grow
    Length mixed_layer;            // its depth below the base
    Length inversion;              // its height above the base
    double instability = 0;        // K/km by which the air cools faster than what rises in cloud
    double temperature = 0;        // K, at the base
    double humidity = 0;           // relative, above the base
    std::array<double, 2> wind{};  // m/s along x and y, up to the base
    std::array<double, 2> wind_above{};  // m/s, at the inversion
    int patches = 0;                     // of warm ground
    std::array<Length, 2> patch_width;
    double warmth = 0;  // K
    std::uint64_t seed = 0;
    double minutes = 0;       // for which the cloud grows
    double loop_minutes = 0;  // of the flow that a loop of `period` frames shows
    double relief = 0;        // of its detail noise, as a share of the width of its largest billows

    bool operator==(const Convection&) const = default;
};

// The particles that a cloud consists of, which choose its phase function (bakers/air/cloud_phase.h).
enum class CloudParticles { droplets, ice };

// How much water full cloud has by height.
enum class CloudWater { even, rising };

enum class ThresholdAt { bake, runtime };
enum class CloudChannels { density, noise, velocity };

// This is one [clouds.NAME].
struct Cloud {
    std::string name;
    std::string noise;                     // NAME of the [noise.NAME] that gives the base shape; or
    std::string volume;                    // NAME of the [volumes.NAME] that does; or
    CloudShape shape = CloudShape::given;  // what grows it
    Convection convection;
    std::array<int, 3> noise_scale{1, 1, 1};  // multiplies the frequencies along x, y, z
    std::string detail;                       // NAME of the [noise.NAME] that erodes; empty: none
    std::array<int, 3> detail_scale{1, 1, 1};
    Length streaks;  // how far what falls has trailed at the base, along x; 0: nothing falls
    std::array<double, 2> erosion{};  // strength at the base and at the top
    double wisp_height = 0;           // below this height the erosion turns from wisps to billows
    std::array<Length, 3> extent;     // along x, y and height
    std::array<Length, 2> corner;     // where the tile begins along x and y
    Length base_altitude;
    HeightProfile height_profile;
    double coverage = 1;    // 1: as noise and profile give it, 0: no cloud
    CloudMap coverage_map;  // multiplies coverage
    CloudMap type_map;      // replaces cloud_type
    double threshold = 0;
    double edge_softness = 0;
    ThresholdAt threshold_at = ThresholdAt::bake;
    std::optional<double> full_at;  // the value that becomes density 1; for threshold_at = bake
    CloudWater water = CloudWater::even;  // for threshold_at = bake
    CloudChannels channels = CloudChannels::density;
    InverseLength extinction_scale;  // extinction of density 1
    CloudParticles particles = CloudParticles::droplets;
    std::vector<Tower> towers;  // in the order of the recipe
    int period =
        0;         // frames of the loop in which towers live or the cloud flows; 0: it stands still
    int time = 0;  // the frame; any integer, as frames repeat
    std::array<double, 2> drift{};  // tiles per loop that the wind carries towers along x and y

    bool operator==(const Cloud&) const = default;
};

// Whether the cloud, apart from its noises, changes with its time.
bool cloud_moves(const Cloud& cloud);

// Returns the channels of the noise that the cloud needs computed. These are all channels if the
// noise packs or `channels` is noise, else the first one.
std::span<const NoiseChannel> used_channels(const Noise& noise, CloudChannels channels);

// Returns the names of a cloud volume's channels: {"Y"} for one channel, with velocity those of its three
// axes too, else the names of the noise's channels. A cloud of a volume has no noise, and one channel.
std::vector<std::string> cloud_channel_names(const Noise* noise, CloudChannels channels);

}  // namespace skybake::config
