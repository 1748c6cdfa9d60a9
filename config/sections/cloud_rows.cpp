#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

constexpr Range scale_range{1, 1024};
constexpr Range erosion_range{0, 0.95};  // at 1 the remap that erodes would divide by 0
constexpr Range extent_range{1e-3, 1e8};
constexpr Range base_altitude_range{-1e8, 1e8};
constexpr Range density_range{0, 1e6};
constexpr Range profile_range{-1e6, 1e6};
constexpr Range full_range{1e-6, 1e6};
constexpr Range softness_range{.minimum = 1e-6, .maximum = 1e6, .or_zero = true};
constexpr Range sharpness_range{0, 1e6};
constexpr Range center_range{-16, 16};  // tiles
constexpr Range sigma_range{1e-6, 16};  // tiles
constexpr Range scatter_sigma_range{1e-6, 1};
constexpr Range angle_range{-1e3, 1e3};
constexpr Range correlation_range{-0.999999, 0.999999};
constexpr Range tower_count_range{0, 100000};
constexpr Range tower_aspect_range{1, 10};
constexpr Range dome_size_range{1e-3, 1e8};
constexpr Range lean_range{-10, 10};
constexpr Range lobes_range{0, 1000};
constexpr Range lobe_size_range{0.01, 1};
constexpr Range slenderness_range{0.01, 100};
constexpr Range period_range{1, 1e6};
constexpr Range time_range{-1e9, 1e9};
constexpr Range drift_range{-16, 16};  // tiles

constexpr ValueKind life_kind = list_kind("three numbers, such as [0.4, 0.3, 0.3]", read_triple,
                                          numbers_schema, &Scales::plain, 3, 3);

constexpr std::string_view byers_1949 = "Byers and Braham 1949, The Thunderstorm";
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
constexpr std::array height_profile_choices = {
    Choice{HeightProfileType::thesis, "thesis",
           "(1 - exp(-bottom_sharpness h)) exp(-top_falloff h)"},
    Choice{HeightProfileType::cumulus, "cumulus",
           "full above a flat base, thinning towards the top"},
    Choice{HeightProfileType::stratus, "stratus", "a thin sheet near the base"},
    Choice{HeightProfileType::stratocumulus, "stratocumulus", "between stratus and cumulus"},
    Choice{HeightProfileType::blended, "blended",
           "stratus, stratocumulus and cumulus at cloud_type 0, 0.5 and 1"},
    Choice{HeightProfileType::tabulated, "tabulated",
           "linear between the entries of table, and constant beyond them"},
};
constexpr std::array wrap_choices = {
    Choice{MapWrap::repeat, "repeat", "the picture tiles"},
    Choice{MapWrap::clamp, "clamp", "the picture's border continues outwards"},
};
constexpr std::array filter_choices = {
    Choice{MapFilter::nearest, "nearest", "the pixel in which a point lies"},
    Choice{MapFilter::linear, "linear", "bilinear between the centres of pixels"},
};
constexpr std::array color_space_choices = {
    Choice{MapColorSpace::linear, "linear", "numbers as they are stored"},
    Choice{MapColorSpace::srgb, "srgb", "numbers converted from the sRGB curve to linear light"},
};

constexpr std::array tower_shape_choices = {
    Choice{TowerShape::gaussian, "gaussian", "a Gaussian over the ground plan, at every height"},
    Choice{TowerShape::dome, "dome", "a solid with a round top, in metres"},
};

// These are the profiles, the place of the threshold and the towers for which a key applies.
constexpr std::string_view gaussian[] = {"gaussian"};
constexpr std::string_view dome[] = {"dome"};
constexpr std::string_view at_bake[] = {"bake"};
constexpr std::string_view thesis[] = {"thesis"};
constexpr std::string_view blended[] = {"blended"};
constexpr std::string_view tabulated_height[] = {"tabulated"};

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
    CloudField{{.key = "base_altitude",
                .kind = Kind::length,
                .range = base_altitude_range,
                .fallback = R"("0 m")",
                .documentation = "altitude of the cloud's base above the ground",
                .hint = "cumulus has 0.5 to 2 km"},
               &Cloud::base_altitude},
    CloudField{{.key = "coverage",
                .kind = Kind::fraction,
                .range = unit_range,
                .fallback = "1",
                .documentation = "share of the sky that the noise fills: 1 leaves it as it is, "
                                 "lower values thin it; at "
                                 "0 only towers taller than 1 remain",
                .citation = schneider_2015},
               &Cloud::coverage},
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
                .range = lean_range,
                .fallback = "[0, 0]",
                .documentation = "lean along x and y that domes with `life` take on per loop, "
                                 "because the wind is stronger above",
                .needs = "period"},
               &Cloud::shear},
};

const std::array height_profile_table = {
    HeightProfileField{
        {.key = "type",
         .kind = Kind::choice,
         .choices = height_profile_choices,
         .fallback = R"("cumulus")",
         .documentation = "how full the cloud is at height h, from 0 at the base to 1 at the top",
         .citation = schneider_2015},
        &HeightProfile::type},
    HeightProfileField{{.key = "bottom_sharpness",
                        .kind = Kind::number,
                        .range = sharpness_range,
                        .fallback = "50",
                        .documentation = "how fast the cloud fills above its base",
                        .citation = olajos_2016,
                        .selector = "type",
                        .selected_by = thesis},
                       &HeightProfile::bottom_sharpness},
    HeightProfileField{{.key = "top_falloff",
                        .kind = Kind::number,
                        .range = sharpness_range,
                        .fallback = "4",
                        .documentation = "how fast it thins towards its top",
                        .citation = olajos_2016,
                        .selector = "type",
                        .selected_by = thesis},
                       &HeightProfile::top_falloff},
    HeightProfileField{{.key = "cloud_type",
                        .kind = Kind::number,
                        .range = unit_range,
                        .fallback = "1",
                        .documentation = "0 is stratus, 0.5 stratocumulus and 1 cumulus",
                        .citation = schneider_2015,
                        .selector = "type",
                        .selected_by = blended},
                       &HeightProfile::cloud_type},
    HeightProfileField{
        {.key = "table",
         .kind = Kind::height_table,
         .range = profile_range,
         .required = true,
         .documentation = "pairs [height, value] with increasing heights within [0, 1]; values "
                          "below 0 take from the towers, which fray there",
         .selector = "type",
         .selected_by = tabulated_height},
        &HeightProfile::table},
};

// Both maps have the same keys. They differ in what their numbers mean.
constexpr std::string_view coverage_file = "picture whose numbers multiply coverage";
constexpr std::string_view type_file = "picture whose numbers replace cloud_type";

std::array<CloudMapField, 5> map_table(std::string_view file_documentation) {
    return {
        CloudMapField{{.key = "file",
                       .kind = Kind::text,
                       .required = true,
                       .documentation = file_documentation,
                       .hint = "relative to the folder of the recipe that names it"},
                      &CloudMap::file},
        CloudMapField{{.key = "channel",
                       .kind = Kind::text,
                       .documentation = "channel of the picture; its first by default",
                       .hint = "\"R\""},
                      &CloudMap::channel},
        CloudMapField{{.key = "wrap",
                       .kind = Kind::choice,
                       .choices = wrap_choices,
                       .fallback = R"("repeat")",
                       .documentation = "what lies beyond the picture's border"},
                      &CloudMap::wrap},
        CloudMapField{{.key = "filter",
                       .kind = Kind::choice,
                       .choices = filter_choices,
                       .fallback = R"("linear")",
                       .documentation = "what lies between the picture's pixels"},
                      &CloudMap::filter},
        CloudMapField{{.key = "color_space",
                       .kind = Kind::choice,
                       .choices = color_space_choices,
                       .fallback = R"("linear")",
                       .documentation = "how the picture stores its numbers"},
                      &CloudMap::color_space},
    };
}

const std::array coverage_map_table = map_table(coverage_file);
const std::array type_map_table = map_table(type_file);

// Towers and scatters share the keys of domes.
constexpr Field shape_field{.key = "shape",
                            .kind = Kind::choice,
                            .choices = tower_shape_choices,
                            .fallback = R"("gaussian")",
                            .documentation = "what a tower is"};
constexpr Field widest_field{
    .key = "widest",
    .kind = Kind::number,
    .range = unit_range,
    .fallback = "0",
    .documentation =
        "height of the widest place, as a share of the tower's height; above and "
        "below it the tower narrows as an ellipsoid does",
    .hint = "0 gives a dome on a flat base, 0.5 a ball, and 1 an anvil with a flat top",
    .selector = "shape",
    .selected_by = dome};
constexpr Field lean_field{.key = "lean",
                           .kind = Kind::pair,
                           .range = lean_range,
                           .fallback = "[0, 0]",
                           .documentation =
                               "how far the wind shifts the tower along x and y, per "
                               "height",
                           .selector = "shape",
                           .selected_by = dome};
constexpr Field lobes_field{
    .key = "lobes",
    .kind = Kind::integer,
    .range = lobes_range,
    .fallback = "0",
    .documentation = "number of balls that bulge out of the tower, as on a cauliflower",
    .selector = "shape",
    .selected_by = dome};
constexpr Field lobe_size_field{
    .key = "lobe_size",
    .kind = Kind::bounds,
    .range = lobe_size_range,
    .fallback = "[0.3, 0.55]",
    .documentation = "range of the radius of a lobe, over the lesser radius of its tower",
    .selector = "shape",
    .selected_by = dome};
constexpr Field life_field{
    .key = "life",
    .kind = life_kind,
    .range = unit_range,
    .documentation =
        "how long the tower grows, stays and dissolves, as shares of the cloud's "
        "`period`; without it the tower stands",
    .hint = "[0.4, 0.3, 0.3] is reborn when it is gone",
    .citation = byers_1949};
constexpr Field grows_from_field{
    .key = "grows_from",
    .kind = Kind::number,
    .range = unit_range,
    .fallback = "0.4",
    .documentation =
        "width of a tower that is born, as a share of its full width; its height "
        "grows from 0",
    .needs = "life"};

const std::array tower_table = {
    TowerField{shape_field, &Tower::shape},
    TowerField{{.key = "center",
                .kind = Kind::pair,
                .range = center_range,
                .required = true,
                .documentation = "x and y of the tower's middle, in tiles",
                .hint = "[0.5, 0.5] is the middle of the cloud",
                .citation = olajos_2016,
                .selector = "shape",
                .selected_by = gaussian},
               &Tower::center},
    TowerField{{.key = "sigma",
                .kind = Kind::pair,
                .range = sigma_range,
                .required = true,
                .documentation = "standard deviations along the tower's own axes, in tiles",
                .hint = "[0.03, 0.06]",
                .citation = olajos_2016,
                .selector = "shape",
                .selected_by = gaussian},
               &Tower::sigma},
    TowerField{{.key = "foot",
                .kind = Kind::lengths,
                .range = base_altitude_range,
                .required = true,
                .documentation = "x and y of the tower's middle, and how high above the cloud's "
                                 "base it begins",
                .hint = "a height below 0 cuts its foot off",
                .selector = "shape",
                .selected_by = dome},
               &Tower::foot},
    TowerField{{.key = "size",
                .kind = Kind::lengths,
                .range = dome_size_range,
                .required = true,
                .documentation = "widths along the tower's own axes, and its height",
                .selector = "shape",
                .selected_by = dome},
               &Tower::size},
    TowerField{{.key = "rotation",
                .kind = Kind::angle,
                .range = angle_range,
                .fallback = R"("0 deg")",
                .documentation = "angle of the tower's axes against x and y, counterclockwise"},
               &Tower::rotation},
    TowerField{{.key = "correlation",
                .kind = Kind::number,
                .range = correlation_range,
                .fallback = "0",
                .documentation = "correlation between the tower's own axes, before rotation",
                .selector = "shape",
                .selected_by = gaussian},
               &Tower::correlation},
    TowerField{{.key = "amplitude",
                .kind = Kind::number,
                .range = density_range,
                .required = true,
                .documentation = "what the tower adds to the height profile at its middle",
                .citation = olajos_2016},
               &Tower::amplitude},
    TowerField{widest_field, &Tower::widest},
    TowerField{lean_field, &Tower::lean},
    TowerField{lobes_field, &Tower::lobes},
    TowerField{lobe_size_field, &Tower::lobe_size},
    TowerField{{.key = "seed",
                .kind = Kind::seed,
                .fallback = "0",
                .documentation = "another seed gives other lobes",
                .selector = "shape",
                .selected_by = dome},
               &Tower::seed},
    TowerField{life_field, &Tower::life},
    TowerField{grows_from_field, &Tower::grows_from},
    TowerField{{.key = "born",
                .kind = Kind::number,
                .range = unit_range,
                .fallback = "0",
                .documentation = "when the tower is born, as a share of the cloud's `period`",
                .needs = "life"},
               &Tower::born},
};

const std::array tower_scatter_table = {
    TowerScatterField{shape_field, &TowerScatter::shape},
    TowerScatterField{{.key = "count",
                       .kind = Kind::integer,
                       .range = tower_count_range,
                       .fallback = "0",
                       .documentation = "number of towers"},
                      &TowerScatter::count},
    TowerScatterField{{.key = "seed",
                       .kind = Kind::seed,
                       .fallback = "0",
                       .documentation = "another seed gives other places"},
                      &TowerScatter::seed},
    TowerScatterField{{.key = "sigma",
                       .kind = Kind::bounds,
                       .range = scatter_sigma_range,
                       .fallback = "[0.02, 0.05]",
                       .documentation = "range of the standard deviation along the smaller axis, "
                                        "in tiles; its logarithm is uniform",
                       .selector = "shape",
                       .selected_by = gaussian},
                      &TowerScatter::sigma},
    TowerScatterField{{.key = "width",
                       .kind = Kind::length_bounds,
                       .range = dome_size_range,
                       .fallback = R"(["300 m", "900 m"])",
                       .documentation = "range of the width along the smaller axis; its logarithm "
                                        "is uniform",
                       .selector = "shape",
                       .selected_by = dome},
                      &TowerScatter::width},
    TowerScatterField{{.key = "slenderness",
                       .kind = Kind::bounds,
                       .range = slenderness_range,
                       .fallback = "[0.6, 1]",
                       .documentation = "range of the height over the width of the smaller axis",
                       .selector = "shape",
                       .selected_by = dome},
                      &TowerScatter::slenderness},
    TowerScatterField{{.key = "aspect",
                       .kind = Kind::bounds,
                       .range = tower_aspect_range,
                       .fallback = "[1, 2]",
                       .documentation = "range of the ratio of the larger axis to the smaller one"},
                      &TowerScatter::aspect},
    TowerScatterField{{.key = "amplitude",
                       .kind = Kind::bounds,
                       .range = density_range,
                       .fallback = "[0.2, 0.5]",
                       .documentation = "range of what a tower adds to the height profile"},
                      &TowerScatter::amplitude},
    TowerScatterField{widest_field, &TowerScatter::widest},
    TowerScatterField{lean_field, &TowerScatter::lean},
    TowerScatterField{lobes_field, &TowerScatter::lobes},
    TowerScatterField{lobe_size_field, &TowerScatter::lobe_size},
    TowerScatterField{life_field, &TowerScatter::life},
    TowerScatterField{grows_from_field, &TowerScatter::grows_from},
};

}  // namespace

std::span<const CloudField> cloud_fields() { return cloud_table; }

std::span<const HeightProfileField> height_profile_fields() { return height_profile_table; }

std::span<const CloudMapField> coverage_map_fields() { return coverage_map_table; }

std::span<const CloudMapField> type_map_fields() { return type_map_table; }

std::span<const TowerField> tower_fields() { return tower_table; }

std::span<const TowerScatterField> tower_scatter_fields() { return tower_scatter_table; }

}  // namespace skybake::config
