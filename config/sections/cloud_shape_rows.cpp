#include <array>
#include <span>
#include <string_view>

#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

constexpr Range profile_range{-1e6, 1e6};
constexpr Range sharpness_range{0, 1e6};

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

// These are the profiles for which a key applies.
constexpr std::string_view thesis[] = {"thesis"};
constexpr std::string_view blended[] = {"blended"};
constexpr std::string_view tabulated_height[] = {"tabulated"};

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
                       .hint = "for example \"R\""},
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

}  // namespace

std::span<const HeightProfileField> height_profile_fields() { return height_profile_table; }

std::span<const CloudMapField> coverage_map_fields() { return coverage_map_table; }

std::span<const CloudMapField> type_map_fields() { return type_map_table; }

}  // namespace skybake::config
