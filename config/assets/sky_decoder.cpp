#include "config/assets/sky_decoder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "config/assets/volume_files_decoder.h"
#include "config/fields/field_reader.h"
#include "config/text/key_path.h"
#include "config/text/suggest.h"

namespace skybake::config {
namespace {

using Names = std::vector<std::string>;

const DecodedField* find_decoded(const DecodedSection& section, std::string_view key) {
    const auto found =
        std::find_if(section.fields.begin(), section.fields.end(),
                     [&](const DecodedField& decoded) { return decoded.field->key == key; });
    return found == section.fields.end() ? nullptr : &*found;
}

// Whether the recipe has a layer of that name, at fault or switched off though it may be.
bool is_in_recipe(const Table& root, const std::string& name) {
    const Entry* atmosphere = find_entry(root, "atmosphere");
    const Table* table = atmosphere ? as_table(atmosphere->value) : nullptr;
    const Entry* layers = table ? find_entry(*table, "layers") : nullptr;
    const Table* named = layers ? as_table(layers->value) : nullptr;
    return named && find_entry(*named, name);
}

std::string what_there_is(const std::string& name, const Atmosphere& atmosphere) {
    std::vector<std::string_view> names;
    for (const Layer& layer : atmosphere.layers) names.push_back(layer.name);
    if (names.empty()) return "the atmosphere has no layers";
    std::string label = did_you_mean(name, names);
    return label.empty() ? fmt::format("this recipe has {}", fmt::join(names, ", ")) : label;
}

Length default_view_distance() {
    const Field& field = *find_field(*find_section("scene"), "view_distance");
    return {std::get<double>(*default_value(field, std::nullopt))};
}

void check_channels(const DecodedSection& bake, Decoder& decoder) {
    const DecodedField& content = bake.at("content");
    if (!content.value || decoder.channels != 1) return;
    const auto chosen = static_cast<AerialContent>(std::get<ChoiceIndex>(*content.value).index);
    if (chosen != AerialContent::in_scatter_and_transmittance) return;
    decoder.diagnostics.error(
        "E0129", content.source ? content.source->place : bake.place,
        fmt::format("`{}` has two channels with one wavelength", join_path(bake.path, "content")),
        "bake content = \"in_scatter\" and content = \"transmittance\" as two assets");
}

}  // namespace

void check_layer_names(const DecodedSection& bake, std::string_view key, const Table& root,
                       const Atmosphere& atmosphere, Decoder& decoder) {
    const DecodedField* decoded = find_decoded(bake, key);
    if (!decoded || !decoded->value || !decoded->source || !decoder.complete) return;
    const auto& names = std::get<Names>(*decoded->value);
    for (auto name = names.begin(); name != names.end(); ++name) {
        const bool known = std::any_of(atmosphere.layers.begin(), atmosphere.layers.end(),
                                       [&](const Layer& layer) { return layer.name == *name; });
        const bool again = std::find(names.begin(), name, *name) != name;
        // A layer that is there and could not be read has been reported.
        const bool is_off = !known && is_in_recipe(root, *name);
        if ((known && !again) || (is_off && decoder.diagnostics.has_errors())) continue;
        const std::string path = join_path(bake.path, key);
        const std::string_view problem = again ? "names a layer twice"
                                         : is_off
                                             ? "names a layer that is switched off"
                                             : "names a layer that the atmosphere does not have";
        decoder.diagnostics.error("E0138", decoded->source->place,
                                  fmt::format("`{}` {}: `{}`", path, problem, shorten(*name)),
                                  again ? "name it once" : what_there_is(*name, atmosphere));
    }
}

void resolve_aerial_perspective(DecodedSection& bake, const std::optional<Scene>& scene,
                                Decoder& decoder) {
    DecodedField& distance = bake.at("view_distance");
    if (!distance.source) {
        distance.value = scene ? scene->view_distance.meters : default_view_distance().meters;
        distance.derived = true;
    }
    check_channels(bake, decoder);
    check_pixel_type(bake, decoder);
    const DecodedField& size = bake.at("size");
    if (!size.value) return;
    const auto voxels = std::get<VoxelCounts>(*size.value);
    resolve_volume_files(bake, voxels, Halving::down, decoder);
    check_voxel_count(bake, voxels, 4, size.source ? size.source->place : bake.place, decoder);
}

}  // namespace skybake::config
