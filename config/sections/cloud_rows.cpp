#include <span>
#include <string_view>
#include <vector>

#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

constexpr Range sharpness_range{0, 1e6};

constexpr Choice height_profile_choices[] = {
    {HeightProfileType::thesis, "thesis", "(1 - exp(-bottom_sharpness h)) exp(-top_falloff h)"},
    {HeightProfileType::cumulus, "cumulus", "full above a flat base, thinning towards the top"},
    {HeightProfileType::stratus, "stratus", "a thin sheet near the base"},
    {HeightProfileType::stratocumulus, "stratocumulus", "between stratus and cumulus"},
    {HeightProfileType::blended, "blended",
     "stratus, stratocumulus and cumulus at cloud_type 0, 0.5 and 1"},
    {HeightProfileType::tabulated, "tabulated",
     "linear between the entries of table, and constant beyond them"},
};
constexpr Choice wrap_choices[] = {
    {MapWrap::repeat, "repeat", "the picture tiles"},
    {MapWrap::clamp, "clamp", "the picture's border continues outwards"},
};
constexpr Choice filter_choices[] = {
    {MapFilter::nearest, "nearest", "the pixel in which a point lies"},
    {MapFilter::linear, "linear", "bilinear between the centres of pixels"},
};
constexpr Choice color_space_choices[] = {
    {MapColorSpace::linear, "linear", "numbers as they are stored"},
    {MapColorSpace::srgb, "srgb", "numbers converted from the sRGB curve to linear light"},
};

const Row<HeightProfile> height_profile_table[] = {
    {"type", Kind::choice, &HeightProfile::type,
     "how full the cloud is at height h, from 0 at the base to 1 at the top",
     height_profile_choices, Default{R"("cumulus")"}, Cited{schneider_2015}},
    {"bottom_sharpness", Kind::number, &HeightProfile::bottom_sharpness,
     "how fast the cloud fills above its base", sharpness_range, Default{"50"},
     When{"type", "thesis"}, Cited{olajos_2016}},
    {"top_falloff", Kind::number, &HeightProfile::top_falloff, "how fast it thins towards its top",
     sharpness_range, Default{"4"}, When{"type", "thesis"}, Cited{olajos_2016}},
    {"cloud_type", Kind::number, &HeightProfile::cloud_type,
     "0 is stratus, 0.5 stratocumulus and 1 cumulus", unit_range, Default{"1"},
     When{"type", "blended"}, Cited{schneider_2015}},
    {"table", Kind::height_table, &HeightProfile::table,
     "pairs [height, value] with increasing heights within [0, 1]; values below 0 take from the "
     "towers, which fray there",
     Range{-1e6, 1e6}, KeyFlag::required, When{"type", "tabulated"}},
};

// Both maps have the same keys. They differ in what their numbers mean.
std::vector<Row<CloudMap>> map_table(std::string_view file_documentation) {
    return {
        {"file", Kind::text, &CloudMap::file, file_documentation, KeyFlag::required,
         Hint{"relative to the folder of the recipe that names it"}},
        {"channel", Kind::text, &CloudMap::channel, "channel of the picture; its first by default",
         Hint{"for example \"R\""}},
        {"wrap", Kind::choice, &CloudMap::wrap, "what lies beyond the picture's border",
         wrap_choices, Default{R"("repeat")"}},
        {"filter", Kind::choice, &CloudMap::filter, "what lies between the picture's pixels",
         filter_choices, Default{R"("linear")"}},
        {"color_space", Kind::choice, &CloudMap::color_space, "how the picture stores its numbers",
         color_space_choices, Default{R"("linear")"}},
        {"factor", Kind::number, &CloudMap::factor,
         "factor from the picture's linear numbers to the map's", Range{1e-9, 1e9}, Default{"1"},
         Hint{"a map's numbers are from 0 to 1"}},
        {"clamp", Kind::flag, &CloudMap::clamp,
         "whether numbers below 0 become 0 and those above 1 become 1", Default{"false"},
         Hint{"without it they are an error"}},
    };
}

const auto coverage_map_table = map_table("picture whose numbers multiply coverage");
const auto type_map_table = map_table("picture whose numbers replace cloud_type");

constexpr Range scale_range{1, 1024};
constexpr Range erosion_range{0, 0.95};  // at 1 the remap that erodes would divide by 0

constexpr Choice threshold_at_choices[] = {
    {ThresholdAt::bake, "bake",
     "the files hold v * smoothstep(threshold, threshold + edge_softness, v)"},
    {ThresholdAt::runtime, "runtime", "the files hold v itself; the runtime applies the threshold"},
};
constexpr Choice water_choices[] = {
    {CloudWater::even, "even", "full cloud is as dense at its base as at its top"},
    {CloudWater::rising, "rising",
     "the density is h^(2/3) times that: the water of air that rises grows with the height, and "
     "its droplets are as many at all heights"},
};
constexpr Choice channels_choices[] = {
    {CloudChannels::density, "density", "one channel, the density"},
    {CloudChannels::noise, "noise",
     "the channels of the noise: R and G are shaped, B and A are plain"},
    {CloudChannels::velocity, "velocity",
     "the density of a cloud that grows, and where it is not 0 the velocity of its flow in m/s "
     "along x, y and z, less the wind that carries the cloud"},
};
constexpr Choice shape_choices[] = {
    {CloudShape::convection, "convection",
     "warm air that rises and condenses: the table convection"},
};

const Row<Cloud> cloud_table[] = {
    {"preset", Kind::text, nullptr,
     "name of a cloud preset to start from, which the section's keys override",
     KeyFlag::only_shown},
    {"noise", Kind::text, &Cloud::noise, "NAME of the [noise.NAME] that the cloud is made of",
     KeyFlag::required, Exclusive{"source", "noise"}},
    {"volume", Kind::text, &Cloud::volume,
     "NAME of the [volumes.NAME] whose density the cloud takes in place of noise, height profile "
     "and towers",
     Exclusive{"source", "volume"}},
    {"shape", Kind::choice, &Cloud::shape,
     "what grows the cloud, in place of noise, height profile and towers", shape_choices,
     Exclusive{"source", "shape"}},
    {"noise_scale", Kind::frequency, &Cloud::noise_scale,
     "repeats of the noise across the cloud (x, y, z)", scale_range, Default{"[1, 1, 1]"},
     Hint{"it multiplies the noise's frequencies"}, Exclusive{"source", "noise"}},
    {"detail", Kind::text, &Cloud::detail,
     "NAME of the [noise.NAME] that shapes the edges, by erosion or as the relief of a cloud that "
     "grows; without it nothing does",
     Hint{"\"\" removes the preset's"}, Cited{schneider_2015}},
    {"detail_scale", Kind::frequency, &Cloud::detail_scale,
     "repeats of the detail noise across the cloud (x, y, z)", scale_range, Default{"[1, 1, 1]"},
     Needs{"detail"}},
    {"streaks", Kind::length, &Cloud::streaks,
     "how far streaks of what falls trail at the base, along x, behind their heads at the top: all "
     "noises are those of the top, drawn out along parabolas",
     Range{0, 1e6}, Default{R"("0 m")"},
     Hint{"ice that falls 3 km at 1 m/s through a shear of 2.2 m/s per km trails by 10 km"},
     Exclusive{"source", "noise"}, Cited{"Marshall 1953, Precipitation trajectories and patterns"}},
    {"erosion", Kind::pair, &Cloud::erosion,
     "how strongly detail erodes, at the base and at the top", erosion_range,
     Default{"[0.2, 0.35]"},
     Hint{"clouds that grow have relief in its place, and [0, 0] by default"}, Needs{"detail"},
     Cited{"Schneider 2017, Nubis: Authoring Real-Time Volumetric Cloudscapes with the Decima "
           "Engine"}},
    {"wisp_height", Kind::number, &Cloud::wisp_height,
     "height up to which erosion turns from wisps to billows", unit_range, Default{"0.1"},
     Needs{"detail"}, Cited{schneider_2015}},
    {"extent", Kind::lengths, &Cloud::extent,
     "how far the cloud reaches along x, y and z, which is up; a cloud of a volume takes that of "
     "the file",
     Range{1e-3, 1e8}, Hint{"it tiles along x and y"}},
    {"corner", Kind::two_lengths, &Cloud::corner,
     "where the tile begins along x and y in the files' space; 0 by default, and of a volume that "
     "of the file",
     Range{-1e9, 1e9}},
    {"base_altitude", Kind::length, &Cloud::base_altitude,
     "altitude of the cloud's base above the ground; without it, that of a volume's lowest voxel "
     "in its file",
     Range{-1e8, 1e8}, Default{R"("0 m")"}, Hint{"cumulus has 0.5 to 2 km"}},
    {"size", Kind::voxels, nullptr, "voxels along x, y and z of bakes of the cloud that give none",
     texel_range, Hint{"presets give as many as show all octaves of their noises"},
     KeyFlag::only_shown},
    {"coverage", Kind::fraction, &Cloud::coverage,
     "how much cloud the noise leaves: 1 keeps all of it, lower values thin it out; at 0 only "
     "noise and towers above 1 remain",
     unit_range, Default{"1"},
     Hint{"a cloud that grows loses the share 1 - coverage of `full_water_g_per_kg` everywhere, "
          "edges first"},
     Exclusive{"amount", "coverage"}, Cited{schneider_2015}},
    {"cover", Kind::fraction, nullptr,
     "share of the columns of voxels that hold cloud; the bake finds the coverage that gives it "
     "exactly",
     unit_range, Exclusive{"amount", "cover"}},
    {"threshold", Kind::number, &Cloud::threshold, "densities at or below this become empty",
     Range{0, 1e6}, Default{"0"}, Hint{"the thesis uses 0.35"}, Cited{olajos_2016}},
    {"edge_softness", Kind::number, &Cloud::edge_softness,
     "how far above the threshold the edge reaches; 0 gives a hard edge",
     Range{.minimum = 1e-6, .maximum = 1e6, .or_zero = true}, Default{"0.05"},
     Hint{"the density is v * smoothstep(threshold, threshold + edge_softness, v); a cloud of a "
          "volume has 0 by default"},
     Cited{olajos_2016}},
    {"threshold_at", Kind::choice, &Cloud::threshold_at, "where the threshold is applied",
     threshold_at_choices, Default{R"("bake")"}, Cited{olajos_2016}},
    {"full_at", Kind::number, &Cloud::full_at,
     "the value v from which the density is 1; a lower one gives denser cores and sharper edges; "
     "without it the density is v",
     Range{1e-6, 1e6}, Hint{"cumulus has 0.1 to 0.3"}, When{"threshold_at", "bake"}},
    {"water", Kind::choice, &Cloud::water, "how dense full cloud is by height", water_choices,
     Default{R"("even")"}, Hint{"layers that rising air makes have soft bases with \"rising\""},
     Exclusive{"source", "noise"}, When{"threshold_at", "bake"},
     Cited{"Brenguier et al. 2000, Radiative Properties of Boundary Layer Clouds: Droplet "
           "Effective Radius versus Number Concentration"}},
    {"channels", Kind::choice, &Cloud::channels, "what the voxels hold", channels_choices,
     Default{R"("density")"}, Cited{olajos_2016}},
    {"extinction_scale", Kind::coefficient, &Cloud::extinction_scale,
     "extinction where the density is 1, for the files' metadata", coefficient_range,
     Default{R"("40 /km")"}, Hint{"water clouds have 10 to 100 /km"}},
    {"particles", Kind::choice, &Cloud::particles,
     "what the cloud consists of, which chooses its phase function", cloud_particles_choices,
     Default{R"("droplets")"}, Hint{"cirrus is of ice"},
     Cited{"Key, Yang, Baum & Nasiri 2002, Parameterization of shortwave ice cloud optical "
           "properties for various particle habits"}},
    {"period", Kind::integer, &Cloud::period,
     "frames of the loop in which towers live and drift, or a cloud that grows flows; without it "
     "they stand still",
     Range{1, 1e6}, Hint{"noises have a period of their own"}},
    {"time", Kind::integer, &Cloud::time,
     "the frame; frames before 0 and from `period` on are repeats", Range{-1e9, 1e9}, Default{"0"},
     Needs{"period"}},
    {"drift", Kind::pair, &Cloud::drift,
     "tiles per loop that the wind carries towers along x and y", Range{-16, 16}, Default{"[0, 0]"},
     Hint{"whole numbers for towers without `life`; a noise drifts with them if its own `drift` is "
          "noise_scale times this"},
     Needs{"period"}},
};

}  // namespace

std::span<const Row<HeightProfile>> height_profile_fields() { return height_profile_table; }

std::span<const Row<CloudMap>> coverage_map_fields() { return coverage_map_table; }

std::span<const Row<CloudMap>> type_map_fields() { return type_map_table; }

std::span<const Row<Cloud>> cloud_fields() { return cloud_table; }

}  // namespace skybake::config
