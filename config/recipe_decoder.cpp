#include "config/recipe_decoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "config/bake_decoder.h"
#include "config/key_path.h"
#include "config/layer_decoder.h"
#include "config/noise_decoder.h"
#include "config/toml_source.h"
#include "config/units.h"

namespace skybake::config {
namespace {

void check_radii(const DecodedSection& atmosphere, Decoder& decoder) {
    const DecodedField& ground = atmosphere.at("ground_radius");
    const DecodedField& top = atmosphere.at("top_radius");
    if (!ground.value || !top.value) return;
    const double low = std::get<double>(*ground.value);
    const double high = std::get<double>(*top.value);
    if (high > low) return;
    decoder.diagnostics.error(
        "E0113", top.source->place,
        fmt::format("`atmosphere.top_radius` is not above ground_radius: {}", spell_length(high)),
        fmt::format("must be above {}", spell_length(low)));
}

void decode_layers(const Table& atmosphere, Atmosphere& result, Decoder& decoder) {
    for (const Entry& entry : subtable(atmosphere, "layers", "atmosphere", decoder)) {
        const Table* table = named_table(entry, "atmosphere.layers", decoder);
        if (!table) continue;
        std::optional<Layer> layer = decode_layer(entry.key, entry.key_place, *table, decoder);
        if (!layer) continue;
        if (!decoder.diagnostics.has_errors()) {
            check_optical_depth(*layer, result, *table, decoder);
        }
        result.layers.push_back(std::move(*layer));
    }
}

// A recipe without one has an atmosphere of no size.
Atmosphere decode_atmosphere(const Table& root, Decoder& decoder) {
    Atmosphere result;
    const Entry* entry = find_entry(root, "atmosphere");
    if (!entry) return result;
    const Table& table = subtable(root, "atmosphere", "", decoder);
    if (!as_table(entry->value)) return result;
    const DecodedSection section =
        decode_section(*find_section("atmosphere"), "atmosphere", entry->key_place, table,
                       Absent::filled_in, decoder);
    check_radii(section, decoder);
    append_values(section, decoder);
    bind(section, atmosphere_fields(), result);
    decode_layers(table, result, decoder);
    return result;
}

auto file_order(const Place& place) {
    return std::make_tuple(place.source ? place.source->order : -1, place.line, place.column);
}

std::vector<Noise> decode_noises(const Table& root, Decoder& decoder) {
    std::vector<Noise> noises;
    for (const Entry& entry : subtable(root, "noise", "", decoder)) {
        const Table* table = named_table(entry, "noise", decoder);
        // One that is no table is a noise all the same, so that bakes may name it.
        Noise named;
        named.name = entry.key;
        noises.push_back(table ? decode_noise(entry.key, entry.key_place, *table, decoder) : named);
    }
    return noises;
}

std::vector<Bake> decode_bakes(const Table& root, std::span<const Noise> noises, Decoder& decoder) {
    std::vector<const Entry*> entries;
    for (const Entry& entry : subtable(root, "bake", "", decoder)) entries.push_back(&entry);
    std::stable_sort(entries.begin(), entries.end(), [](const Entry* a, const Entry* b) {
        return file_order(a->key_place) < file_order(b->key_place);
    });
    std::vector<Bake> bakes;
    for (const Entry* entry : entries) {
        const Table* table = named_table(*entry, "bake", decoder);
        if (!table) continue;
        std::optional<Bake> bake =
            decode_bake(entry->key, entry->key_place, *table, noises, decoder);
        if (bake) bakes.push_back(std::move(*bake));
    }
    return bakes;
}

// The sky's assets need an atmosphere; a recipe of nothing at all was to be one of a sky.
void check_atmosphere(const Table& root, const Parameters& parameters, const Source& source,
                      Decoder& decoder) {
    if (find_entry(root, "atmosphere") || !decoder.complete) return;
    const bool bakes_sky = std::any_of(
        parameters.bakes.begin(), parameters.bakes.end(),
        [](const Bake& bake) { return !std::holds_alternative<NoiseVolumeBake>(bake.asset); });
    if (!bakes_sky && !(parameters.bakes.empty() && parameters.noises.empty())) return;
    decoder.diagnostics.error("E0105", {&source}, "the recipe has no [atmosphere]",
                              "start from preset = \"earth\", or see `skybake init`");
}

}  // namespace

Parameters decode_recipe(const Table& root, const Source& source, Decoder& decoder) {
    Parameters parameters;
    const DecodedSection section =
        decode_section(*find_section(""), "", {&source}, root, Absent::filled_in, decoder);
    append_values(section, decoder);
    bind(section, root_fields(), parameters);
    if (!parameters.wavelengths.empty()) {
        decoder.channels = static_cast<int>(parameters.wavelengths.size());
    }
    parameters.atmosphere = decode_atmosphere(root, decoder);
    parameters.noises = decode_noises(root, decoder);
    parameters.bakes = decode_bakes(root, parameters.noises, decoder);
    check_atmosphere(root, parameters, source, decoder);
    return parameters;
}

}  // namespace skybake::config
