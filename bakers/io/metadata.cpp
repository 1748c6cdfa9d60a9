#include "bakers/io/metadata.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bakers/io/conventions.h"
#include "bakers/io/hash.h"
#include "bakers/io/release.h"

namespace skybake {
namespace {

std::string details_text(const std::vector<std::pair<std::string, std::string>>& details) {
    std::string text;
    for (const auto& [key, value] : details) text += fmt::format("{} = {}\n", key, value);
    return text;
}

}  // namespace

ManifestAsset describe(const BakedTable& table) {
    ManifestAsset asset;
    asset.name = table.name;
    asset.kind = table.kind;
    asset.content = table.content;
    asset.size = {table.image.width, table.image.height};
    asset.channels = table.channel_names;
    asset.compression = table.compression;
    asset.mapping = table.mapping;
    asset.axes = table.axes;
    if (table.certified) asset.error = table.certificate;
    asset.range = table.range;
    asset.probes = table.probes;
    asset.details = table.details;
    asset.parameters = table.parameters;
    asset.content_hash = xxh3_hex(stored_bytes(table.image, table.pixel_type));
    asset.release = release();
    return asset;
}

std::string_view units_line() {
    static const std::string line = fmt::format(
        "lengths and altitudes {}, coefficients {}, angles as cosines, radiance {} for a solar "
        "irradiance E = {}",
        conventions::length_unit, conventions::coefficient_unit, conventions::radiance_unit,
        conventions::solar_irradiance);
    return line;
}

std::string error_line(const std::optional<Certificate>& certificate) {
    if (!certificate) return "not measured";
    const Certificate& c = *certificate;
    std::string line = fmt::format(
        "texel max {} rms {} ({} points); lookup max {} rms {} ({} points); reference: {}; scale: "
        "{}",
        c.texel.max, c.texel.rms, c.texel_points, c.lookup.max, c.lookup.rms, c.lookup_points,
        c.reference, c.scale);
    if (!c.worst.empty()) line += fmt::format("; worst at {}", c.worst);
    return line;
}

std::string axis_line(const AxisMapping& axis) {
    return fmt::format("{} from {} to {}, {}: {}", axis.quantity, axis.first, axis.last,
                       axis.convention, axis.formula);
}

Attributes exr_attributes(const ManifestAsset& asset) {
    return {
        {"skybake/channels", fmt::format("{}", fmt::join(asset.channels, " "))},
        {"skybake/content", asset.content},
        {"skybake/content_hash", asset.content_hash},
        {"skybake/details", details_text(asset.details)},
        {"skybake/error", error_line(asset.error)},
        {"skybake/kind", asset.kind},
        {"skybake/mapping", asset.mapping},
        {"skybake/mapping_u", axis_line(asset.axes[0])},
        {"skybake/mapping_v", axis_line(asset.axes[1])},
        {"skybake/parameters", asset.parameters},
        {"skybake/range", fmt::format("below_normal {}, above_range {}", asset.range.below_normal,
                                      asset.range.above_range)},
        {"skybake/release", asset.release},
        {"skybake/units", std::string(units_line())},
    };
}

Attributes exr_attributes(const BakedTable& table) { return exr_attributes(describe(table)); }

}  // namespace skybake
