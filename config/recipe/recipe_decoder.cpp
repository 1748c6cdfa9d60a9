#include "config/recipe/recipe_decoder.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/assets/asset_kind.h"
#include "config/diagnostics/toml_source.h"
#include "config/fields/fields.h"
#include "config/fields/wavelength_reader.h"
#include "config/optics/ground_spectra.h"
#include "config/sections/sections.h"
#include "config/sections/spectral_air.h"
#include "config/sweep/sweep.h"
#include "config/text/key_path.h"
#include "config/text/mapped.h"

namespace skybake::config {
namespace {

void check_radii(const DecodedSection& atmosphere, Decoder& decoder) {
    const std::optional<double> low = atmosphere.number("ground_radius");
    const std::optional<double> high = atmosphere.number("top_radius");
    if (!low || !high || *high > *low) return;
    const auto written = [&](std::string_view key) {
        return value_to_string(*atmosphere.at(key).source);
    };
    decoder.report("E0113", atmosphere, "top_radius",
                   fmt::format("is not above ground_radius: {}", written("top_radius")),
                   fmt::format("must be above {}", written("ground_radius")));
}

void decode_layers(const Table& atmosphere, const Parameters& recipe, Atmosphere& result,
                   Decoder& decoder) {
    for (const Entry& entry : subtable(atmosphere, "layers", "atmosphere", decoder)) {
        const Table* table = named_table(entry, "atmosphere.layers", decoder);
        if (!table) continue;
        std::optional<Layer> layer = decode_layer(entry, recipe, decoder);
        if (!layer) continue;
        const Length thickness{result.top_radius.meters - result.ground_radius.meters};
        std::string fault;
        if (thickness.meters > 0) {  // else the radii were reported
            fault = resolve_matter(*layer, thickness, recipe.wavelengths);
        }
        if (!fault.empty() && !decoder.diagnostics.has_errors()) {
            decoder.diagnostics.error(
                "E0145", entry.key_place,
                fmt::format("layer `{}`: {}", join_path("atmosphere.layers", entry.key), fault),
                "choose other wavelengths, another profile or another amount");
        }
        if (!decoder.diagnostics.has_errors()) {
            check_optical_depth(*layer, result, *table, decoder);
        }
        result.layers.push_back(std::move(*layer));
    }
}

// Sets what the ground reflects at each of the recipe's wavelengths, and keeps its spectrum, if it
// has one, for other wavelengths.
void bind_ground(const DecodedField& albedo, std::span<const Length> wavelengths,
                 Atmosphere& result) {
    if (!albedo.value) return;
    if (const auto* numbers = albedo.as<std::vector<double>>()) {
        result.ground_albedo = *numbers;
        return;
    }
    const auto* pairs = albedo.as<std::vector<SpectrumPoint>>();
    result.ground_spectrum = pairs ? *pairs : spectrum_of(*choice_of<Ground>(albedo));
    for (const Length wavelength : wavelengths) {
        result.ground_albedo.push_back(albedo_at(result.ground_spectrum, wavelength));
    }
}

// Decodes [atmosphere]. A recipe without it has an atmosphere of size 0.
Atmosphere decode_atmosphere(const Table& root, const Parameters& recipe, Decoder& decoder) {
    Atmosphere result;
    const Entry* entry = find_entry(root, "atmosphere");
    if (!entry) return result;
    const Table& table = subtable(root, "atmosphere", "", decoder);
    if (!as_table(entry->value)) return result;
    const DecodedSection section = decode_into(result, atmosphere_fields(), "atmosphere",
                                               "atmosphere", entry->key_place, table, decoder);
    check_radii(section, decoder);
    bind_ground(section.at("ground_albedo"), recipe.wavelengths, result);
    decode_layers(table, recipe, result, decoder);
    return result;
}

// Decodes [color], which `wavelengths = "best 4"` implies.
std::optional<Color> decode_color(const Table& root, Decoder& decoder) {
    const Entry* entry = find_entry(root, "color");
    const Entry* wavelengths = find_entry(root, "wavelengths");
    if (!entry && !(wavelengths && asks_for_best_wavelengths(wavelengths->value))) {
        return std::nullopt;
    }
    const Place place = entry ? entry->key_place : wavelengths->key_place;
    Color color;
    decode_into(color, color_fields(), "color", "color", place,
                subtable(root, "color", "", decoder), decoder);
    return color;
}

std::optional<Scene> decode_scene(const Table& root, Decoder& decoder) {
    const Entry* entry = find_entry(root, "scene");
    if (!entry) return std::nullopt;
    Scene scene;
    decode_into(scene, scene_fields(), "scene", "scene", entry->key_place,
                subtable(root, "scene", "", decoder), decoder);
    return scene;
}

// Decodes the entries of [section.NAME] that are tables with decode(entry). Another entry still counts, so
// that others may name it.
template <class Named, class Decode>
std::vector<Named> decode_named(const Table& root, const std::string& section, Decoder& decoder,
                                const Decode& decode) {
    std::vector<Named> all;
    for (const Entry& entry : subtable(root, section, "", decoder)) {
        all.push_back(named_table(entry, section, decoder) ? decode(entry) : Named{});
        all.back().name = entry.key;
    }
    return all;
}

// Reports a missing atmosphere. The assets of the sky need one, and an empty recipe was probably
// meant to be one of a sky.
void check_atmosphere(const Table& root, const Parameters& parameters, const Source& source,
                      Decoder& decoder) {
    if (find_entry(root, "atmosphere") || !decoder.complete) return;
    const bool bakes_sky = std::ranges::any_of(
        parameters.bakes, [](const Bake& bake) { return kind_of(bake).facts.needs_atmosphere; });
    const bool is_empty = parameters.bakes.empty() && parameters.noises.empty() &&
                          parameters.clouds.empty() && parameters.volumes.empty() &&
                          parameters.particles.empty();
    if (!bakes_sky && !is_empty) return;
    decoder.diagnostics.error(
        "E0105", {&source}, "the recipe has no [atmosphere]",
        "start from preset = \"earth\" or give it clouds, or see `skybake init`");
}

// The wavelengths of the spectra that colours are fitted to (bakers/light/sky_spectra.h).
constexpr WavelengthRange visible{{380e-9}, {780e-9}};

// Returns why an asset cannot hold the recipe's wavelengths, or an empty text.
std::string fault_of_wavelengths(const Parameters& recipe, UseOfLight use) {
    if (use != UseOfLight::colors || !holds_colors(recipe)) return "";
    if (recipe.wavelengths.size() == 1) return "cannot make a colour of one wavelength";
    const bool is_visible = std::ranges::all_of(
        recipe.wavelengths, [](Length wavelength) { return visible.contains(wavelength); });
    return is_visible ? "" : "makes colours of wavelengths from 380 nm to 780 nm only";
}

// Reports assets that cannot hold the recipe's wavelengths.
void check_wavelengths(const Table& root, const Parameters& recipe, const Source& source,
                       Decoder& decoder) {
    if (recipe.wavelengths.empty()) return;  // at fault, which has been reported
    const Entry* entry = find_entry(root, "wavelengths");
    for (const Bake& bake : recipe.bakes) {
        const AssetFacts& facts = kind_of(bake).facts;
        const std::string fault = fault_of_wavelengths(recipe, facts.use_of_light);
        if (fault.empty()) continue;
        decoder.diagnostics.error(
            "E0147", entry ? entry->value.place : Place{&source},
            fmt::format("[bake.{}]: {} {}; the recipe has {}", bake.name, facts.name, fault,
                        recipe.wavelengths.size()),
            "give this asset a recipe of its own, or choose other wavelengths");
    }
}

// Decodes the bakes, whose lists of one value per channel are those of tables of light.
std::vector<Bake> decode_bakes_of_channels(const Table& root, const Parameters& parameters,
                                           Decoder& decoder) {
    const std::optional<int> wavelengths = decoder.channels;
    if (holds_colors(parameters)) {
        decoder.channels = static_cast<int>(channels_of_light(parameters));
    }
    std::vector<Bake> bakes = decode_bakes(root, parameters, decoder);
    decoder.channels = wavelengths;
    return bakes;
}

// The functions below make the list of all sections (fields.h): those of config/sections, of the
// assets and of [sweep].
template <class S>
Section make_section(std::string_view path, std::string_view documentation,
                     std::span<const Row<S>> rows) {
    return {path, "", documentation, mapped<Field>(rows, &Row<S>::field)};
}

// Makes a section of keys that do not fill the members of a struct.
Section make_section(std::string_view path, std::string_view documentation,
                     std::span<const Field> table) {
    return {path, "", documentation, {table.begin(), table.end()}};
}

std::vector<Section> make_sections() {
    std::vector<Section> all = {
        make_section("", "the recipe as a whole", root_fields()),
        make_section("color", "the colours in which the sky's tables hold light", color_fields()),
        make_section("atmosphere", "the planet and its air", atmosphere_fields()),
        make_section("atmosphere.layers.*", "one kind of gas or particle, under any name",
                     layer_fields()),
        make_section("scene", "the cameras and suns that the sky's tables are for", scene_fields()),
        make_section("preview", "how pictures show the recipe", preview_fields()),
        make_section("preview.camera", "the camera of pictures of clouds", preview_camera_fields()),
        make_section("particles.*", "spheres of given sizes, under any name", particles_fields()),
        make_section("noise.*", "a tileable noise, under any name", noise_fields()),
        make_section("noise.*.channels.*", "one channel of a noise: R, G, B, A, or Y alone",
                     noise_channel_fields()),
        make_section("volumes.*", "a volume from a file, under any name", volume_fields()),
        make_section("clouds.*", "a cloud or a layer of clouds, under any name", cloud_fields()),
        make_section("clouds.*.height_profile", "how full the cloud is, by height",
                     height_profile_fields()),
        make_section("clouds.*.coverage_map", "a picture over the cloud that thins it out",
                     coverage_map_fields()),
        make_section("clouds.*.type_map", "a picture over the cloud of its cloud_type",
                     type_map_fields()),
        make_section("clouds.*.convection", "the air in which a cloud grows", convection_fields()),
        make_section("clouds.*.towers.*", "a tower that is added to the height profile",
                     tower_fields()),
    };
    for (const AssetKind* kind : asset_kinds()) all.push_back(kind->section);
    all.push_back(make_section(
        "sweep", "what `skybake sweep` varies: other keys are paths, in quotes", sweep_fields()));
    all.push_back(make_section("sweep.*",
                               "a range of values for the key at a path, or a list of them: [1, 2]",
                               sweep_range_fields()));
    return all;
}

}  // namespace

Parameters decode_recipe(const Table& root, const Source& source, Decoder& decoder) {
    Parameters parameters;
    decode_into(parameters, root_fields(), "", "", {&source}, root, decoder);
    if (!parameters.wavelengths.empty()) {
        decoder.channels = static_cast<int>(parameters.wavelengths.size());
    }
    parameters.color = decode_color(root, decoder);
    parameters.particles =
        decode_named<Particles>(root, "particles", decoder, [&](const Entry& entry) {
            return decode_particles(entry, parameters.wavelengths, decoder);
        });
    parameters.atmosphere = decode_atmosphere(root, parameters, decoder);
    parameters.scene = decode_scene(root, decoder);
    parameters.noises = decode_named<Noise>(
        root, "noise", decoder, [&](const Entry& entry) { return decode_noise(entry, decoder); });
    parameters.volumes =
        decode_named<VolumeFile>(root, "volumes", decoder,
                                 [&](const Entry& entry) { return decode_volume(entry, decoder); });
    const CloudSources sources = {parameters.noises, parameters.volumes, root};
    parameters.clouds = decode_named<Cloud>(root, "clouds", decoder, [&](const Entry& entry) {
        return decode_cloud(entry, sources, decoder);
    });
    parameters.bakes = decode_bakes_of_channels(root, parameters, decoder);
    check_atmosphere(root, parameters, source, decoder);
    check_wavelengths(root, parameters, source, decoder);
    return parameters;
}

std::span<const Section> sections() {
    static const std::vector<Section> all = make_sections();
    return all;
}

const Section* find_section(std::string_view path, std::string_view asset) {
    for (const Section& section : sections()) {
        if (section.path == path && section.asset == asset) return &section;
    }
    return nullptr;
}

std::vector<std::string_view> asset_names() {
    std::vector<std::string_view> names;
    for (const Section& section : sections()) {
        if (!section.asset.empty()) names.push_back(section.asset);
    }
    return names;
}

std::vector<std::string_view> subtables(std::string_view path) {
    const std::string prefix = path.empty() ? "" : std::string(path) + '.';
    std::vector<std::string_view> names;
    for (const Section& section : sections()) {
        if (section.path.empty() || section.path.substr(0, prefix.size()) != prefix) continue;
        const std::string_view rest = section.path.substr(prefix.size());
        const std::string_view name = rest.substr(0, rest.find('.'));
        if (!name.empty() && name != "*" && (names.empty() || names.back() != name)) {
            names.push_back(name);
        }
    }
    return names;
}

}  // namespace skybake::config
