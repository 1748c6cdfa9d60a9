// The members of all that a manifest holds, each named once, in the order of the file. The writer and
// the reader follow these lists. A form is one JSON object that is written or read:
//
//   form("name", member, …)         members that are always there
//   form.extent, path, format, uv   members that are always there, with bounds of their own
//   form.plain("name", numbers)     written if not empty, whole numbers without a decimal point
//   form.or_null("name", member)    an optional member that may be null
//   form.when(there, "name", m)     written if `there`, read if the object has it
//   form.where(there, wanted, …)    written if `there`, read if `wanted`
//   form.object("name", members)    members that are an object in the file and none in memory
//   form.each("name", n, members)   an array of n objects
//   form.of_volume                  whether the asset has three axes
#pragma once

#include <array>
#include <concepts>
#include <string>
#include <type_traits>

#include "bakers/io/manifest/manifest.h"
#include "config/sections/file_formats.h"

namespace skybake {

// The writer's structs are constant, and the reader's are not.
template <class T, class Struct>
concept Is = std::same_as<std::remove_const_t<T>, Struct>;

void members(auto& form, Is<SheetGrid> auto& grid) {
    form("kind", grid.kind);
    form.extent("columns", grid.columns);
    form.extent("rows", grid.rows);
    form.when(grid.flipped, "flipped", grid.flipped);
}

void members(auto& form, Is<ManifestFile> auto& file) {
    form.path("path", file.path);
    form.format("format", file.format);
    form("pixel_type", file.pixel_type, "bytes", file.bytes, "xxh3", file.xxh3, "level",
         file.level);
    if (form.holds("levels", file.levels > 1)) form.extent("levels", file.levels);
    form("compression", file.compression);
    const Format* format = find_format(file.format);
    const bool is_image = format != nullptr && config::facts_of(format->format).is_image;
    const bool has_grids = format != nullptr && format->grids != nullptr;
    form.where(file.layout.has_value(), is_image, "layout", file.layout);
    form.where(!file.grids.empty(), has_grids, "grids", file.grids);
    form.when(file.texture != TextureParts::none, "texture", file.texture);
}

void members(auto& form, Is<ManifestInput> auto& input) {
    form("file", input.file, "xxh3", input.xxh3);
}

void members(auto& form, Is<config::Diagnostic> auto& warning) {
    form("code", warning.code, "message", warning.message, "advice", warning.label, "key",
         warning.key);
}

void members(auto& form, Is<RetiredFile> auto& file) {
    form.path("path", file.path);
    form("xxh3", file.xxh3);
}

void members(auto& form, Is<AxisMapping> auto& axis) {
    form("quantity", axis.quantity, "formula", axis.formula, "convention", axis.convention, "first",
         axis.first, "last", axis.last, "end_points", axis.end_points, "wrap", axis.wrap, "filter",
         axis.filter, "constants", axis.constants);
}

void members(auto& form, Is<ColorConvention> auto& color) {
    form("space", color.space, "white", color.white, "sun", color.sun, "observer", color.observer,
         "is_applied", color.is_applied, "weights", color.weights);
}

// Members that do not apply to the asset are left out.
void members(auto& form, Is<Conventions> auto& conventions) {
    const auto unless_empty = [&form](const char* name, auto& member) {
        form.when(!member.empty(), name, member);
    };
    unless_empty("length_unit", conventions.length_unit);
    unless_empty("coefficient_unit", conventions.coefficient_unit);
    unless_empty("angle_unit", conventions.angle_unit);
    unless_empty("radiance_unit", conventions.radiance_unit);
    form.plain("solar_irradiance", conventions.solar_irradiance);
    form.plain("wavelengths_nm", conventions.wavelengths_nm);
    form.when(conventions.color.has_value(), "color", conventions.color);
    unless_empty("up_axis", conventions.up_axis);
    std::string origin =
        form.of_volume ? "first voxel u = 0, v = 0, w = 0" : "first column u = 0, first row v = 0";
    form("texel_origin", origin);
}

void members(auto& form, Is<ErrorFigures> auto& figures) {
    form("max", figures.max, "rms", figures.rms);
}

void members(auto& form, Is<SkyError> auto& error) {
    form("median", error.median, "ninth_decile", error.ninth_decile, "max", error.max,
         "standard_error", error.standard_error, "points", error.points, "left_out", error.left_out,
         "reference", error.reference, "worst", error.worst);
    form.when(error.worst_sun_deg.has_value(), "worst_sun_elevation_deg", error.worst_sun_deg);
    form.when(!error.better.empty(), "better", error.better);
}

void members(auto& form, Is<ColorError> auto& error) {
    form("median", error.median, "ninth_decile", error.ninth_decile, "max", error.max,
         "disc_at_5_1_0_deg", error.disc, "skies", error.skies);
}

void members(auto& form, Is<Certificate> auto& certificate) {
    form("texel", certificate.texel, "lookup", certificate.lookup, "reference",
         certificate.reference, "points", certificate.lookup_points, "texel_points",
         certificate.texel_points, "scale", certificate.scale, "worst", certificate.worst, "advice",
         certificate.advice);
    form.when(certificate.sky.has_value(), "sky", certificate.sky);
    form.when(certificate.color.has_value(), "color", certificate.color);
}

void members(auto& form, Is<Timing> auto& timing) {
    form("light_s", timing.bake.light, "colors_s", timing.bake.colors, "texels_s",
         timing.bake.texels, "certificate_s", timing.bake.certificate, "write_s", timing.write_s,
         "threads", timing.threads);
}

void members(auto& form, Is<RangeCounts> auto& range) {
    form("below_normal", range.below_normal, "above_range", range.above_range);
}

void members(auto& form, Is<BlendedLookup> auto& blend) {
    form("uvw", blend.uvw, "share", blend.share);
}

void members(auto& form, Is<Probe> auto& probe) {
    form("at", probe.at);
    if (form.of_volume) {
        form("uvw", probe.uvw);
    } else {
        form.uv("uv", probe.uvw);
    }
    form.when(probe.blend.has_value(), "blend", probe.blend);
    form("value", probe.value, "tolerance", probe.tolerance);
    form.when(!probe.column_km.empty(), "column_km", probe.column_km);
}

void members(auto& form, Is<ValueStatistics> auto& statistics) {
    form("min", statistics.min, "max", statistics.max, "mean", statistics.mean);
    form.object("histogram", [&](auto& histogram) {
        histogram("range", statistics.histogram_range, "counts", statistics.histogram);
    });
}

void members(auto& form, Is<LookupCost> auto& cost) {
    form("library", cost.library, "fetches", cost.fetches, "operations", cost.operations,
         "divisions", cost.divisions, "special_functions", cost.special_functions);
}

void members(auto& form, Is<ManifestLevel> auto& level) {
    form("size", level.size, "statistics", level.statistics, "probes", level.probes, "catches",
         level.catches, "content_hash", level.content_hash);
}

// Level 0 is the asset itself. A reader has as many axes and levels as the file.
void members(auto& form, Is<ManifestAsset> auto& asset) {
    form("name", asset.name, "kind", asset.kind, "content", asset.content, "files", asset.files,
         "size", asset.levels[0].size, "channels", asset.channels, "conventions",
         asset.conventions);
    form.object("mapping", [&](auto& mapping) {
        constexpr std::array names = {"u", "v", "w"};
        mapping("name", asset.mapping);
        for (std::size_t i = 0; i < asset.axes.size(); ++i) mapping(names[i], asset.axes[i]);
    });
    form("timing", asset.timing);
    form.or_null("error", asset.error);
    form("range", asset.range, "probes", asset.levels[0].probes, "catches", asset.levels[0].catches,
         "statistics", asset.levels[0].statistics);
    if (form.of_volume) form("seam_error", asset.seam_error);
    form.each("mips", asset.levels.size() - 1,
              [&](auto& mip, std::size_t i) { members(mip, asset.levels[i + 1]); });
    form("details", asset.details);
    form.when(asset.lookup_cost.has_value(), "lookup_cost", asset.lookup_cost);
    form("parameters", asset.parameters, "content_hash", asset.content_hash, "release",
         asset.release);
    if (!form.holds("key", !asset.key.empty())) return;
    form("key", asset.key, "certification", asset.certification, "inputs", asset.inputs);
    form.when(!asset.warnings.empty(), "warnings", asset.warnings);
}

}  // namespace skybake
