#include <array>
#include <span>
#include <string_view>

#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

constexpr Range profile_range{-1e6, 1e6};
constexpr Range sharpness_range{0, 1e6};
constexpr Range map_factor_range{1e-9, 1e9};

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

// These are the profiles for which a key applies.
constexpr std::string_view thesis[] = {"thesis"};
constexpr std::string_view blended[] = {"blended"};
constexpr std::string_view tabulated_height[] = {"tabulated"};

const HeightProfileField height_profile_table[] = {
    {"type", Kind::choice, &HeightProfile::type,
     "how full the cloud is at height h, from 0 at the base to 1 at the top",
     height_profile_choices, Default{R"("cumulus")"}, Cited{schneider_2015}},
    {"bottom_sharpness", Kind::number, &HeightProfile::bottom_sharpness,
     "how fast the cloud fills above its base", sharpness_range, Default{"50"},
     When{"type", thesis}, Cited{olajos_2016}},
    {"top_falloff", Kind::number, &HeightProfile::top_falloff, "how fast it thins towards its top",
     sharpness_range, Default{"4"}, When{"type", thesis}, Cited{olajos_2016}},
    {"cloud_type", Kind::number, &HeightProfile::cloud_type,
     "0 is stratus, 0.5 stratocumulus and 1 cumulus", unit_range, Default{"1"},
     When{"type", blended}, Cited{schneider_2015}},
    {"table", Kind::height_table, &HeightProfile::table,
     "pairs [height, value] with increasing heights within [0, 1]; values "
     "below 0 take from the towers, which fray there",
     profile_range, KeyFlag::required, When{"type", tabulated_height}},
};

// Both maps have the same keys. They differ in what their numbers mean.
constexpr std::string_view coverage_file = "picture whose numbers multiply coverage";
constexpr std::string_view type_file = "picture whose numbers replace cloud_type";

std::array<CloudMapField, 7> map_table(std::string_view file_documentation) {
    return {
        CloudMapField{"file", Kind::text, &CloudMap::file, file_documentation, KeyFlag::required,
                      Hint{"relative to the folder of the recipe that names it"}},
        CloudMapField{"channel", Kind::text, &CloudMap::channel,
                      "channel of the picture; its first by default", Hint{"for example \"R\""}},
        CloudMapField{"wrap", Kind::choice, &CloudMap::wrap,
                      "what lies beyond the picture's border", wrap_choices,
                      Default{R"("repeat")"}},
        CloudMapField{"filter", Kind::choice, &CloudMap::filter,
                      "what lies between the picture's pixels", filter_choices,
                      Default{R"("linear")"}},
        CloudMapField{"color_space", Kind::choice, &CloudMap::color_space,
                      "how the picture stores its numbers", color_space_choices,
                      Default{R"("linear")"}},
        CloudMapField{"factor", Kind::number, &CloudMap::factor,
                      "factor from the picture's linear numbers to the map's", map_factor_range,
                      Default{"1"}, Hint{"a map's numbers are from 0 to 1"}},
        CloudMapField{"clamp", Kind::flag, &CloudMap::clamp,
                      "whether numbers below 0 become 0 and those above 1 become 1",
                      Default{"false"}, Hint{"without it they are an error"}},
    };
}

const std::array coverage_map_table = map_table(coverage_file);
const std::array type_map_table = map_table(type_file);

}  // namespace

std::span<const HeightProfileField> height_profile_fields() { return height_profile_table; }

std::span<const CloudMapField> coverage_map_fields() { return coverage_map_table; }

std::span<const CloudMapField> type_map_fields() { return type_map_table; }

}  // namespace skybake::config
