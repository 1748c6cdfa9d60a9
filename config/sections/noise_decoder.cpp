#include "config/sections/sections.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "config/text/key_path.h"

namespace skybake::config {
namespace {

// The names stand in the order of a noise's channels.
constexpr std::array<std::string_view, 5> channel_names = {"R", "G", "B", "A", "Y"};

// These are the sets of channels that a picture can have.
constexpr std::array<std::string_view, 4> channel_sets = {"Y", "R", "RGB", "RGBA"};

std::size_t channel_order(std::string_view name) {
    const auto found = std::ranges::find(channel_names, name);
    return static_cast<std::size_t>(found - channel_names.begin());
}

// Reports keys of a noise that displaces where nothing says how far.
void report_idle_warp(const DecodedSection& section, Decoder& decoder) {
    if (section.gives("warp_strength") || !decoder.complete) return;
    for (const DecodedField& decoded : section.fields) {
        if (!decoded.source || !decoded.field->key.starts_with("warp_")) continue;
        decoder.report("E0111", section, decoded.field->key,
                       fmt::format("belongs to {}, and there is none",
                                   join_path(section.path, "warp_strength")),
                       fmt::format("give warp_strength, or leave {} out", decoded.field->key));
    }
}

// Curly alligator noise is displaced by a quarter of a cell of its first octave, if nothing else is
// said: farther, curls fold into rings.
void derive_warp_strength(DecodedSection& section, const NoiseOctaves& octaves) {
    if (octaves.frequencies.empty()) return;
    const std::array<int, 3>& first = octaves.frequencies.front();
    derive(section.at("warp_strength"), 0.25 / *std::ranges::max_element(first));
}

NoiseOctaves resolve_warp(DecodedSection& section, const NoiseOctaves& octaves, Decoder& decoder) {
    const auto type = choice_of<NoiseType>(section.at("type"));
    if (!type) return {};
    if (*type == NoiseType::curly_alligator) {
        derive_warp_strength(section, octaves);
    } else {
        report_idle_warp(section, decoder);
    }
    if (!section.at("warp_strength").value) return {};
    return resolve_octaves(section, warp_octave_keys, decoder);
}

NoiseChannel decode_channel(const Entry& entry, const std::string& path, Decoder& decoder) {
    DecodedSection section =
        decode_section(*find_section("noise.*.channels.*"), path, entry.key_place,
                       *as_table(entry.value), Absent::filled_in, decoder);
    NoiseChannel channel;
    channel.name = entry.key;
    channel.octaves = resolve_octaves(section, plain_octave_keys, decoder);
    channel.worley_octaves = resolve_octaves(section, worley_octave_keys, decoder);
    channel.warp_octaves = resolve_warp(section, channel.octaves, decoder);
    append_values(section, decoder);
    bind_section(section, noise_channel_fields(), channel);
    return channel;
}

void report_unknown_channel(const Entry& entry, const std::string& path, Decoder& decoder) {
    decoder.diagnostics.error("E0102", entry.key_place,
                              fmt::format("unknown channel `{}` in [{}]", shorten(entry.key), path),
                              "a noise has the channels R, G, B and A, or Y alone");
}

// Returns the entries of [noise.NAME.channels] that are channels, in the order R, G, B, A, Y.
std::vector<const Entry*> channel_entries(const Table& channels, const std::string& path,
                                          Decoder& decoder) {
    std::vector<const Entry*> entries;
    for (const Entry& entry : channels) {
        if (channel_order(entry.key) < channel_names.size()) {
            entries.push_back(&entry);
        } else {
            report_unknown_channel(entry, path, decoder);
        }
    }
    std::ranges::sort(entries, {}, [](const Entry* entry) { return channel_order(entry->key); });
    return entries;
}

std::string set_of(const std::vector<const Entry*>& entries) {
    std::string letters;
    for (const Entry* entry : entries) letters += entry->key;
    return letters;
}

// Returns the place of the channel that was added last. It is not in a preset if any channel is
// outside one.
Place latest_place(const std::vector<const Entry*>& entries) {
    const auto order = [](const Entry* entry) { return reading_order(entry->key_place); };
    return (*std::ranges::max_element(entries, {}, order))->key_place;
}

void report_set(const std::string& set, const std::string& path, const Place& place,
                Decoder& decoder) {
    const bool is_pair = set.size() == 2 && set.find('Y') == std::string::npos;
    decoder.diagnostics.error(
        "E0129", place,
        set.empty() ? fmt::format("[{}] has no channels", path)
                    : fmt::format("[{}] has channels {}", path, fmt::join(set, ", ")),
        is_pair
            ? "expected R, G, B; type = \"constant\" and value = 0 can stand in for the missing one"
            : "expected Y alone, R alone, R, G, B, or R, G, B, A");
}

// Checks that the noise has the channels that the formula of its packing names.
void check_packing(const DecodedSection& section, const std::string& set, Decoder& decoder) {
    const auto packing = choice_of<NoisePacking>(section.at("pack"));
    if (!packing || packing == NoisePacking::none) return;
    const std::string wanted = packing == NoisePacking::shape ? "RGBA" : "RGB";
    if (set == wanted) return;
    decoder.report("E0129", section, "pack",
                   fmt::format("packs channels {}, but the noise has {}", fmt::join(wanted, ", "),
                               fmt::join(set, ", ")),
                   fmt::format("expected {}", fmt::join(wanted, ", ")));
}

std::vector<NoiseChannel> decode_channels(const DecodedSection& section, const Table& table,
                                          Decoder& decoder) {
    const std::string path = join_path(section.path, "channels");
    const Table& channels = subtable(table, "channels", section.path, decoder);
    const auto entries = channel_entries(channels, path, decoder);
    std::vector<NoiseChannel> result;
    for (const Entry* entry : entries) {
        if (!named_table(*entry, path, decoder)) continue;
        result.push_back(decode_channel(*entry, join_path(path, entry->key), decoder));
    }
    const std::string set = set_of(entries);
    const bool is_known = std::ranges::find(channel_sets, set) != channel_sets.end();
    // Channels at fault, or of an unknown preset, might have completed the set. One error is
    // enough.
    const Entry* given = find_entry(table, "channels");
    const bool at_fault = entries.size() != channels.size() || (given && !as_table(given->value));
    if (is_known) {
        check_packing(section, set, decoder);
    } else if (!at_fault && decoder.complete) {
        report_set(set, section.path, entries.empty() ? section.place : latest_place(entries),
                   decoder);
    }
    return result;
}

}  // namespace

Noise decode_noise(const Entry& entry, Decoder& decoder) {
    const std::string path = join_path("noise", entry.key);
    check_name(entry, path, "a noise", decoder);
    const Table& table = *as_table(entry.value);
    Noise noise;
    noise.name = entry.key;
    const DecodedSection section =
        decode_into(noise, noise_fields(), "noise.*", path, entry.key_place, table, decoder);
    noise.channels = decode_channels(section, table, decoder);
    return noise;
}

}  // namespace skybake::config
