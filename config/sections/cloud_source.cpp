#include <fmt/format.h>

#include <array>
#include <string_view>

#include "config/fields/section_decoder.h"
#include "config/sections/sections.h"
#include "config/text/key_path.h"
#include "config/text/units.h"

namespace skybake::config {
namespace {

// These tables shape noise. A cloud that grows or is of a volume has its shape already.
constexpr std::array<std::string_view, 3> noise_tables = {"height_profile", "type_map", "towers"};

void report_beside(std::string_view source, const Place& place, const std::string& path,
                   Decoder& decoder) {
    const std::string_view made = source == "volume" ? "is made of a volume" : "grows";
    decoder.diagnostics.error("E0111", place,
                              fmt::format("`{}` shapes noise, and this cloud {}", path, made),
                              fmt::format("leave it out, or give noise in place of {}", source));
}

// A cloud of a volume stands still, and the wind does not carry one that grows.
void check_time_keys(DecodedSection& section, std::string_view source, Decoder& decoder) {
    DecodedField& key = section.at(source == "volume" ? "period" : "drift");
    if (!key.source) return key.value.reset();
    report_beside(source, key.source->place, join_path(section.path, key.field->key), decoder);
}

void check_noise_keys(const DecodedSection& section, std::string_view source, const Table& table,
                      Decoder& decoder) {
    for (const std::string_view name : noise_tables) {
        const Entry* entry = find_entry(table, name);
        if (!entry) continue;
        report_beside(source, entry->key_place, join_path(section.path, name), decoder);
    }
    const DecodedField& channels = section.at("channels");
    if (!channels.source || choice_of<CloudChannels>(channels) != CloudChannels::noise) return;
    report_beside(source, channels.source->place, join_path(section.path, "channels"), decoder);
}

void check_velocity(const DecodedSection& section, Decoder& decoder) {
    const DecodedField& channels = section.at("channels");
    if (!channels.source || choice_of<CloudChannels>(channels) != CloudChannels::velocity) return;
    if (section.gives("shape")) return;
    decoder.report("E0111", section, "channels", "is \"velocity\", which a cloud has that grows",
                   "give shape = \"convection\", or leave it out");
}

void derive_extent(DecodedSection& section, const VolumeShape& shape, Decoder& decoder) {
    DecodedField& extent = section.at("extent");
    const Range& range = extent.field->range;
    std::array<double, 3> meters{};
    for (std::size_t i = 0; i < 3; ++i) {
        meters[i] = shape.size[i] * shape.voxel_size_m[i];
        if (meters[i] >= range.minimum && meters[i] <= range.maximum) continue;
        return decoder.diagnostics.error(
            "E0110", section.at("volume").source->place,
            fmt::format("the volume spans {} along {}", length_to_string(meters[i]), "xyz"[i]),
            fmt::format("an extent is {}; give the cloud its own, or the volume a voxel_size",
                        describe_range(*extent.field)));
    }
    derive(extent, meters);
}

// Takes extent and place from the volume's file. A recipe that gives the extent needs no file here.
void read_shape(DecodedSection& section, const VolumeFile& volume, const CloudSources& sources,
                Decoder& decoder) {
    const VolumeProbe probe = volume_probe();
    if (probe == nullptr || decoder.diagnostics.has_errors()) return;
    const Outcome<VolumeShape> shape = probe(volume);
    const bool gives_extent = section.gives("extent");
    const Table& keys = *find_table(*find_table(sources.root, "volumes"), volume.name);
    for (const Diagnostic& diagnostic : shape.diagnostics) {
        if (gives_extent) break;
        decoder.diagnostics.error(diagnostic.code, find_entry(keys, "file")->value.place,
                                  diagnostic.message, diagnostic.label);
    }
    if (!shape.value) return;
    const auto& [x, y, z] = shape.value->corner_m;
    derive(section.at("corner"), std::array{x, y});
    derive(section.at("base_altitude"), z);
    if (!gives_extent) derive_extent(section, *shape.value, decoder);
}

}  // namespace

void resolve_cloud_source(DecodedSection& section, const Table& table, const CloudSources& sources,
                          Decoder& decoder) {
    const VolumeFile* volume =
        find_named(section, "volume", sources.volumes, volume_reference, decoder);
    const bool is_of_volume = section.gives("volume");
    const auto* name = section.value<std::string>("volume");
    if (name && name->empty()) {
        decoder.report("E0110", section, "volume", "is empty",
                       "give the NAME of a [volumes.NAME], or leave it out");
    }
    if (is_of_volume || section.gives("shape")) {
        const std::string_view source = is_of_volume ? "volume" : "shape";
        check_noise_keys(section, source, table, decoder);
        check_time_keys(section, source, decoder);
        DecodedField& erosion = section.at("erosion");
        if (!is_of_volume && erosion.value) derive(erosion, std::array{0.0, 0.0});
        derive(section.at("edge_softness"), 0.0);
    }
    check_velocity(section, decoder);
    const DecodedField& extent = section.at("extent");
    const bool says_all =
        section.gives("extent") && section.gives("corner") && section.gives("base_altitude");
    if (volume && !says_all) read_shape(section, *volume, sources, decoder);
    const bool is_at_fault = is_of_volume && decoder.diagnostics.has_errors();
    if (extent.source || extent.value || is_at_fault || !decoder.complete) return;
    decoder.report("E0105", section, "extent", "is missing",
                   fmt::format("give {}", extent.field->kind.words));
}

}  // namespace skybake::config
