#include "config/sections/cloud.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/fields/field_value.h"
#include "config/fields/section_decoder.h"
#include "config/sections/sections.h"
#include "config/sections/towers.h"
#include "config/text/key_path.h"

namespace skybake::config {

std::span<const NoiseChannel> used_channels(const Noise& noise, CloudChannels channels) {
    const std::span<const NoiseChannel> all = noise.channels;
    const bool takes_all = channels == CloudChannels::noise || noise.pack != NoisePacking::none;
    return takes_all ? all : all.first(std::min<std::size_t>(all.size(), 1));
}

std::vector<std::string> cloud_channel_names(const Noise* noise, CloudChannels channels) {
    if (channels == CloudChannels::velocity) return {"Y", "velocity.x", "velocity.y", "velocity.z"};
    if (noise == nullptr || channels == CloudChannels::density) return {"Y"};
    return channel_names(*noise);
}

namespace {

// This is one cloud while its tables are read.
struct CloudReader {
    const std::string& path;
    const Place& place;
    const Table& table;
    Decoder& decoder;
    Cloud& cloud;

    // Returns the place of a table's name, or of the cloud's name if the table is not given.
    Place place_of(std::string_view key) const {
        const Entry* entry = find_entry(table, key);
        return entry ? entry->key_place : place;
    }

    // Decodes the table of a key of the cloud.
    template <class S>
    DecodedSection read_table(std::string_view key, std::span<const Row<S>> rows, S& target) const {
        return decode_into(target, rows, fmt::format("clouds.*.{}", key), join_path(path, key),
                           place_of(key), subtable(table, key, path, decoder), decoder);
    }

    void read_map(std::string_view key, std::span<const Row<CloudMap>> rows, CloudMap& map) const {
        const Entry* entry = find_entry(table, key);
        if (!entry || !named_table(*entry, path, decoder)) return;
        const DecodedSection section = read_table(key, rows, map);
        map.path = path_of_file(section, "a picture", decoder);
        if (map.path.empty()) return;
        map.file_place = source_range(section.place_of("file"));
        map.channel_place = source_range(section.place_of("channel", "file"));
    }

    void report_cells(const DecodedSection& section, std::string what, std::string label) const {
        decoder.report("E0110", section, "cells", fmt::format("are {}", what), std::move(label));
    }

    void check_cells(const DecodedSection& section) const {
        const auto& [x, y, z] = cloud.convection.cells;
        if (x == 0 || !(cloud.extent[2].meters > 0)) return;  // reported
        const auto is_at_fault = [](int count) {
            if (count % 2 != 0) return true;
            for (const int prime : {2, 3, 5}) {
                while (count % prime == 0) count /= prime;
            }
            return count != 1;
        };
        if (is_at_fault(x) || is_at_fault(y)) {
            return report_cells(
                section, fmt::format("{} along x and {} along y", x, y),
                "give even products of 2, 3 and 5, such as 96, 100, 120, 128, 144 or 160");
        }
        constexpr double kMostCells = 1 << 26;  // take 5 GB
        const double share = 1 + cloud.convection.mixed_layer.meters / cloud.extent[2].meters;
        const double cells = double{1} * x * y * z * share;
        if (cells <= kMostCells) return;
        report_cells(section, fmt::format("{:.0f} with those of the mixed layer", cells),
                     fmt::format("at most {:.0f} are allowed", kMostCells));
    }

    void read_convection() const {
        const Entry* entry = find_entry(table, "convection");
        if (cloud.shape != CloudShape::convection) {
            if (!entry || !decoder.complete) return;  // a preset that is missing may have it
            return decoder.diagnostics.error(
                "E0111", entry->key_place,
                fmt::format("`{}` belongs to shape convection", join_path(path, "convection")),
                "give shape = \"convection\" in place of noise or volume, or leave it out");
        }
        DecodedSection section =
            decode_section(*find_section("clouds.*.convection"), join_path(path, "convection"),
                           place_of("convection"), subtable(table, "convection", path, decoder),
                           Absent::filled_in, decoder);
        derive(section.at("inversion"), 0.7 * cloud.extent[2].meters);
        derive(section.at("loop_minutes"), default_loop_minutes(section));
        append_values(section, decoder);
        bind_section(section, convection_fields(), cloud.convection);
        check_cells(section);
        check_loop(section);
    }

    // At two seconds of the flow for each frame, three voxels of cloud in a hundred change to none or back from one
    // frame to the next (examples/grown_clouds.md), and a film is 48 times as fast as the sky.
    double default_loop_minutes(const DecodedSection& section) const {
        constexpr double kFrame_min = 2.0 / 60;
        return std::min(kFrame_min * cloud.period, section.number("minutes").value_or(0));
    }

    void check_loop(const DecodedSection& section) const {
        const double loop = cloud.convection.loop_minutes;
        if (loop > cloud.convection.minutes) {
            decoder.report("E0110", section, "loop_minutes",
                           fmt::format("is {:g}, longer than the cloud grows", loop),
                           fmt::format("at most `minutes`, {:g}", cloud.convection.minutes));
        }
        if (loop > 0 && cloud.period == 0) {
            decoder.report("E0111", section, "loop_minutes",
                           fmt::format("belongs to {}, and there is none", join_path(path, "period")),
                           "give the cloud a period, or leave loop_minutes out");
        }
    }

    void check_type_map(const DecodedSection& profile) const {
        const DecodedField& type = profile.at("type");
        if (!find_entry(table, "type_map") || !type.value) return;
        if (cloud.height_profile.type == HeightProfileType::blended) return;
        const std::string_view found = choice_name(*type.field, cloud.height_profile.type);
        const std::string said =
            type.source ? origin(type.source->place) : std::string("the default");
        decoder.diagnostics.error(
            "E0111", place_of("type_map"),
            fmt::format("`{}` belongs to height_profile.type blended, but it is {}",
                        join_path(path, "type_map"), found),
            fmt::format("type = \"{}\" comes from {}", found, said));
    }

    void read_towers() const {
        const std::string towers_path = join_path(path, "towers");
        const Table& towers = subtable(table, "towers", path, decoder);
        for (const Entry* entry : towers_in_order(towers)) {
            const Table* keys = named_table(*entry, towers_path, decoder);
            if (!keys) continue;
            Tower tower;
            tower.name = entry->key;
            const DecodedSection section =
                decode_into(tower, tower_fields(), "clouds.*.towers.*",
                            join_path(towers_path, entry->key), entry->key_place, *keys, decoder);
            check_life(section, tower, cloud, decoder);
            cloud.towers.push_back(std::move(tower));
        }
    }
};

// Returns the greatest frequency of the channels along each axis.
std::array<int, 3> greatest_frequency(std::span<const NoiseChannel> channels) {
    std::array<int, 3> greatest{};
    for (const NoiseChannel& channel : channels) {
        for (const NoiseOctaves* octaves :
             {&channel.octaves, &channel.worley_octaves, &channel.warp_octaves}) {
            for (const std::array<int, 3>& frequency : octaves->frequencies) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    greatest[axis] = std::max(greatest[axis], frequency[axis]);
                }
            }
        }
    }
    return greatest;
}

// Checks that scaled frequencies stay in the range of those that a noise may give.
void check_scale(const DecodedSection& section, std::string_view key, const Noise* noise,
                 CloudChannels channels, const std::array<int, 3>& scale, Decoder& decoder) {
    if (!noise) return;
    const Field& allowed = *find_field(*find_section("noise.*.channels.*"), "frequency");
    const auto most = static_cast<int>(allowed.range.maximum);
    const std::array<int, 3> frequency = greatest_frequency(used_channels(*noise, channels));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int product = frequency[axis] * scale[axis];  // at most 2^20 * 2^10
        if (product <= most) continue;
        decoder.report(
            "E0128", section, key,
            fmt::format("times frequency {} of noise `{}` is {}", frequency[axis], noise->name,
                        product),
            fmt::format("at most {} cells per tile are allowed: use a lower scale or fewer octaves",
                        most));
        return;
    }
}

void check_noises(const DecodedSection& section, const Cloud& cloud, std::span<const Noise> noises,
                  Decoder& decoder) {
    const Noise* noise = find_named(section, "noise", noises, noise_reference, decoder);
    check_scale(section, "noise_scale", noise, cloud.channels, cloud.noise_scale, decoder);
    const Noise* detail = find_named(section, "detail", noises, noise_reference, decoder);
    check_scale(section, "detail_scale", detail, CloudChannels::density, cloud.detail_scale,
                decoder);
}

}  // namespace

Cloud decode_cloud(const Entry& entry, const CloudSources& sources, Decoder& decoder) {
    const std::string path = join_path("clouds", entry.key);
    check_name(entry, path, "a cloud", decoder);
    const Table& table = *as_table(entry.value);
    Cloud cloud;
    cloud.name = entry.key;
    DecodedSection section = decode_section(*find_section("clouds.*"), path, entry.key_place, table,
                                            Absent::filled_in, decoder);
    resolve_cloud_source(section, table, sources, decoder);
    append_values(section, decoder);
    bind_section(section, cloud_fields(), cloud);
    check_noises(section, cloud, sources.noises, decoder);
    const CloudReader reader{path, entry.key_place, table, decoder, cloud};
    reader.read_convection();
    if (!cloud.volume.empty() || cloud.shape == CloudShape::convection) {
        reader.read_map("coverage_map", coverage_map_fields(), cloud.coverage_map);
        return cloud;
    }
    const DecodedSection profile =
        reader.read_table("height_profile", height_profile_fields(), cloud.height_profile);
    reader.read_map("coverage_map", coverage_map_fields(), cloud.coverage_map);
    reader.read_map("type_map", type_map_fields(), cloud.type_map);
    reader.check_type_map(profile);
    reader.read_towers();
    return cloud;
}

}  // namespace skybake::config
