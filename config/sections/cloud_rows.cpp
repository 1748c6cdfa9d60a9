#include <array>
#include <span>
#include <string_view>

#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

constexpr Range scale_range{1, 1024};
constexpr Range erosion_range{0, 0.95};  // at 1 the remap that erodes would divide by 0
constexpr Range extent_range{1e-3, 1e8};
constexpr Range voxel_range{1, 16384};
constexpr Range base_altitude_range{-1e8, 1e8};
constexpr Range corner_range{-1e9, 1e9};
constexpr Range density_range{0, 1e6};
constexpr Range full_range{1e-6, 1e6};
constexpr Range softness_range{.minimum = 1e-6, .maximum = 1e6, .or_zero = true};
constexpr Range shear_range{-10, 10};
constexpr Range period_range{1, 1e6};
constexpr Range time_range{-1e9, 1e9};
constexpr Range drift_range{-16, 16};  // tiles

constexpr std::string_view schneider_2017 =
    "Schneider 2017, Nubis: Authoring Real-Time Volumetric Cloudscapes with the Decima Engine";

constexpr std::array threshold_at_choices = {
    Choice{ThresholdAt::bake, "bake",
           "the files hold v * smoothstep(threshold, threshold + edge_softness, v)"},
    Choice{ThresholdAt::runtime, "runtime",
           "the files hold v itself; the runtime applies the threshold"},
};
constexpr std::array channels_choices = {
    Choice{CloudChannels::density, "density", "one channel, the density"},
    Choice{CloudChannels::noise, "noise",
           "the channels of the noise: R and G are shaped, B and A are plain"},
};
// This is the place of the threshold for which a key applies.
constexpr std::string_view at_bake[] = {"bake"};

const std::array cloud_table = {
    CloudField{
        {.key = "preset",
         .kind = Kind::text,
         .documentation = "name of a cloud preset to start from, which the section's keys override",
         .only_shown = true},
        {}},
    CloudField{{.key = "noise",
                .kind = Kind::text,
                .required = true,
                .documentation = "NAME of the [noise.NAME] that the cloud is made of",
                .exclusive_group = "source",
                .exclusive_side = "noise"},
               &Cloud::noise},
    CloudField{
        {.key = "volume",
         .kind = Kind::text,
         .documentation = "NAME of the [volumes.NAME] whose density the cloud takes in place "
                          "of noise, height profile and towers",
         .exclusive_group = "source",
         .exclusive_side = "volume"},
        &Cloud::volume},
    CloudField{{.key = "noise_scale",
                .kind = Kind::frequency,
                .range = scale_range,
                .fallback = "[1, 1, 1]",
                .documentation = "repeats of the noise across the cloud (x, y, z)",
                .hint = "it multiplies the noise's frequencies",
                .exclusive_group = "source",
                .exclusive_side = "noise"},
               &Cloud::noise_scale},
    CloudField{
        {.key = "detail",
         .kind = Kind::text,
         .documentation = "NAME of the [noise.NAME] that erodes the edges; without it nothing does",
         .hint = "\"\" removes the preset's",
         .citation = schneider_2015},
        &Cloud::detail},
    CloudField{{.key = "detail_scale",
                .kind = Kind::frequency,
                .range = scale_range,
                .fallback = "[1, 1, 1]",
                .documentation = "repeats of the detail noise across the cloud (x, y, z)",
                .needs = "detail"},
               &Cloud::detail_scale},
    CloudField{{.key = "erosion",
                .kind = Kind::pair,
                .range = erosion_range,
                .fallback = "[0.2, 0.35]",
                .documentation = "how strongly detail erodes, at the base and at the top",
                .citation = schneider_2017,
                .needs = "detail"},
               &Cloud::erosion},
    CloudField{{.key = "wisp_height",
                .kind = Kind::number,
                .range = unit_range,
                .fallback = "0.1",
                .documentation = "height up to which erosion turns from wisps to billows",
                .citation = schneider_2015,
                .needs = "detail"},
               &Cloud::wisp_height},
    CloudField{
        {.key = "extent",
         .kind = Kind::lengths,
         .range = extent_range,
         .documentation = "how far the cloud reaches along x, y and z, which is up; a cloud of "
                          "a volume takes that of the file",
         .hint = "it tiles along x and y"},
        &Cloud::extent},
    CloudField{{.key = "corner",
                .kind = Kind::two_lengths,
                .range = corner_range,
                .documentation = "where the tile begins along x and y in the files' space; 0 by "
                                 "default, and of a volume that of the file"},
               &Cloud::corner},
    CloudField{{.key = "base_altitude",
                .kind = Kind::length,
                .range = base_altitude_range,
                .fallback = R"("0 m")",
                .documentation = "altitude of the cloud's base above the ground; without it, that "
                                 "of a volume's lowest voxel in its file",
                .hint = "cumulus has 0.5 to 2 km"},
               &Cloud::base_altitude},
    CloudField{{.key = "size",
                .kind = Kind::voxels,
                .range = voxel_range,
                .documentation = "voxels along x, y and z of bakes of the cloud that give none",
                .hint = "presets give as many as show all octaves of their noises",
                .only_shown = true},
               {}},
    CloudField{{.key = "coverage",
                .kind = Kind::fraction,
                .range = unit_range,
                .fallback = "1",
                .documentation = "how much cloud the noise leaves: 1 keeps all of it, lower values "
                                 "thin it out; at 0 only towers taller than 1 remain",
                .citation = schneider_2015,
                .exclusive_group = "amount",
                .exclusive_side = "coverage"},
               &Cloud::coverage},
    CloudField{{.key = "cover",
                .kind = Kind::fraction,
                .range = unit_range,
                .documentation = "share of the columns of voxels that hold cloud; the bake finds "
                                 "the coverage that gives it exactly",
                .exclusive_group = "amount",
                .exclusive_side = "cover"},
               {}},
    CloudField{{.key = "threshold",
                .kind = Kind::number,
                .range = density_range,
                .fallback = "0",
                .documentation = "densities at or below this become empty",
                .hint = "the thesis uses 0.35",
                .citation = olajos_2016},
               &Cloud::threshold},
    CloudField{
        {.key = "edge_softness",
         .kind = Kind::number,
         .range = softness_range,
         .fallback = "0.05",
         .documentation = "how far above the threshold the edge reaches; 0 gives a hard edge",
         .hint =
             "the density is v * smoothstep(threshold, threshold + edge_softness, v); a cloud of "
             "a volume has 0 by default",
         .citation = olajos_2016},
        &Cloud::edge_softness},
    CloudField{{.key = "threshold_at",
                .kind = Kind::choice,
                .choices = threshold_at_choices,
                .fallback = R"("bake")",
                .documentation = "where the threshold is applied",
                .citation = olajos_2016},
               &Cloud::threshold_at},
    CloudField{
        {.key = "full_at",
         .kind = Kind::number,
         .range = full_range,
         .documentation = "the value v from which the density is 1; a lower one gives denser "
                          "cores and sharper edges; without it the density is v",
         .hint = "cumulus has 0.1 to 0.3",
         .selector = "threshold_at",
         .selected_by = at_bake},
        &Cloud::full_at},
    CloudField{{.key = "channels",
                .kind = Kind::choice,
                .choices = channels_choices,
                .fallback = R"("density")",
                .documentation = "what the voxels hold",
                .citation = olajos_2016},
               &Cloud::channels},
    CloudField{{.key = "extinction_scale",
                .kind = Kind::coefficient,
                .range = coefficient_range,
                .fallback = R"("40 /km")",
                .documentation = "extinction where the density is 1, for the files' metadata",
                .hint = "water clouds have 10 to 100 /km"},
               &Cloud::extinction_scale},
    CloudField{{.key = "period",
                .kind = Kind::integer,
                .range = period_range,
                .documentation = "frames of the loop in which towers live and drift; without it "
                                 "they stand still",
                .hint = "noises have a period of their own",
                .exclusive_group = "source",
                .exclusive_side = "noise"},
               &Cloud::period},
    CloudField{{.key = "time",
                .kind = Kind::integer,
                .range = time_range,
                .fallback = "0",
                .documentation = "the frame; frames before 0 and from `period` on are repeats",
                .needs = "period"},
               &Cloud::time},
    CloudField{{.key = "drift",
                .kind = Kind::pair,
                .range = drift_range,
                .fallback = "[0, 0]",
                .documentation = "tiles per loop that the wind carries towers along x and y",
                .hint = "whole numbers for towers without `life`; a noise drifts with them if its "
                        "own `drift` is noise_scale times this",
                .needs = "period"},
               &Cloud::drift},
    CloudField{{.key = "shear",
                .kind = Kind::pair,
                .range = shear_range,
                .fallback = "[0, 0]",
                .documentation = "lean along x and y that domes with `life` take on per loop, "
                                 "because the wind is stronger above",
                .needs = "period"},
               &Cloud::shear},
};

}  // namespace

std::span<const CloudField> cloud_fields() { return cloud_table; }

}  // namespace skybake::config
