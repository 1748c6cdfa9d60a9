#include "bakers/io/manifest/metadata.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bakers/io/manifest/release.h"
#include "bakers/math/hash.h"

namespace skybake {
namespace {

std::string details_text(const Facts& details) {
    std::string text;
    for (const auto& [name, value] : details) {
        text += fmt::format("{} = {}\n", name, fact_text(value));
    }
    return text;
}

// One number where all colours have the same.
std::string irradiance_text(const std::vector<double>& irradiance) {
    const bool alike = std::all_of(irradiance.begin(), irradiance.end(),
                                   [&](double value) { return value == irradiance.front(); });
    return alike ? fmt::format("{}", irradiance.front())
                 : fmt::format("{}", fmt::join(irradiance, ", "));
}

std::string statistics_text(const std::vector<std::string>& channels, const ManifestLevel& level) {
    std::string text;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const ValueStatistics& s = level.statistics[c];
        text += fmt::format("{}: min {} max {} mean {} histogram {} to {}: {}\n", channels[c],
                            s.min, s.max, s.mean, s.histogram_range[0], s.histogram_range[1],
                            fmt::join(s.histogram, " "));
    }
    return text;
}

// What the files of tables and of volumes say in the same words.
Attributes shared_attributes(const ManifestAsset& asset) {
    return {
        {"skybake/channels", fmt::format("{}", fmt::join(asset.channels, " "))},
        {"skybake/content", asset.content},
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
    };
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
    asset.axes.assign(table.axes.begin(), table.axes.end());
    if (table.certified) asset.error = table.certificate;
    asset.range = table.range;
    asset.probes = table.probes;
    asset.conventions = table.conventions;
    asset.catches = table.catches;
    asset.details = table.details;
    asset.parameters = table.parameters;
    asset.content_hash = xxh3_hex(stored_bytes(table.image, table.pixel_type));
    asset.release = release();
    return asset;
}

ManifestAsset describe(const BakedVolume& volume) {
    ManifestAsset asset;
    asset.name = volume.name;
    asset.kind = volume.kind;
    asset.content = volume.content;
    asset.channels = volume.channel_names;
    asset.mapping = volume.mapping;
    asset.axes.assign(volume.axes.begin(), volume.axes.end());
    if (volume.certified) asset.error = volume.certificate;
    asset.range = volume.range;
    asset.conventions = volume.conventions;
    asset.details = volume.details;
    asset.parameters = volume.parameters;
    asset.release = release();
    asset.seam_error = volume.seam_error;
    for (const VolumeLevel& level : volume.levels) {
        asset.levels.push_back(
            {level.size, level.content_hash, level.statistics, level.probes, level.catches});
    }
    asset.size.assign(asset.levels[0].size.begin(), asset.levels[0].size.end());
    asset.content_hash = asset.levels[0].content_hash;
    return asset;
}

std::string units_line(const Conventions& conventions) {
    std::vector<std::string> parts;
    if (!conventions.length_unit.empty()) {
        parts.push_back(fmt::format("lengths and altitudes {}", conventions.length_unit));
    }
    if (!conventions.coefficient_unit.empty()) {
        parts.push_back(fmt::format("coefficients {}", conventions.coefficient_unit));
    }
    if (!conventions.angle_unit.empty()) {
        parts.push_back(conventions.angle_unit == "cosine"
                            ? "angles as cosines"
                            : fmt::format("angles {}", conventions.angle_unit));
    }
    if (!conventions.solar_irradiance.empty()) {
        parts.push_back(fmt::format(
            "{} for a solar irradiance E = {}",
            conventions.radiance_unit.empty() ? "values" : "radiance " + conventions.radiance_unit,
            irradiance_text(conventions.solar_irradiance)));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
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
    if (c.sky) {
        line += fmt::format(
            "; sky made with it median {} ninth decile {} max {} ({} values), reference: {}",
            c.sky->median, c.sky->ninth_decile, c.sky->max, c.sky->points, c.sky->reference);
    }
    return line;
}

std::string axis_line(const AxisMapping& axis) {
    return fmt::format("{} from {} to {}, {}: {}", axis.quantity, axis.first, axis.last,
                       axis.convention, axis.formula);
}

Attributes exr_attributes(const ManifestAsset& asset) {
    Attributes attributes = shared_attributes(asset);
    attributes.emplace_back("skybake/content_hash", asset.content_hash);
    attributes.emplace_back("skybake/units", units_line(asset.conventions));
    std::sort(attributes.begin(), attributes.end());
    return attributes;
}

Attributes exr_attributes(const BakedTable& table) { return exr_attributes(describe(table)); }

Attributes volume_attributes(const ManifestAsset& asset, const ManifestFile& file) {
    const ManifestLevel& level = asset.levels[static_cast<std::size_t>(file.level)];
    Attributes attributes = shared_attributes(asset);
    attributes.emplace_back("skybake/content_hash", level.content_hash);
    if (file.layout) {
        attributes.emplace_back("skybake/layout", layout_line(level.size, *file.layout));
    }
    attributes.emplace_back("skybake/level",
                            fmt::format("{} of {}", file.level, asset.levels.size()));
    attributes.emplace_back("skybake/mapping_w", axis_line(asset.axes[2]));
    attributes.emplace_back("skybake/seam_error", fmt::format("{}", asset.seam_error));
    attributes.emplace_back("skybake/size", fmt::format("{}", fmt::join(level.size, " ")));
    attributes.emplace_back("skybake/statistics", statistics_text(asset.channels, level));
    std::sort(attributes.begin(), attributes.end());
    return attributes;
}

}  // namespace skybake
