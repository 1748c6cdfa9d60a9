// The list of all sections (fields.h): those of config/sections, of the assets and of [sweep].
#include <string>

#include "config/assets/asset_kind.h"
#include "config/fields/fields.h"
#include "config/sections/section_rows.h"
#include "config/sweep/sweep_rows.h"

namespace skybake::config {
namespace {

template <class S>
Section make_section(std::string_view path, std::string_view documentation,
                     std::span<const Row<S>> rows) {
    Section section{path, "", documentation, {}};
    for (const Row<S>& row : rows) section.fields.push_back(row.field);
    return section;
}

// Of keys that fill no struct's members.
Section make_section(std::string_view path, std::string_view documentation,
                     std::span<const Field> table) {
    return {path, "", documentation, {table.begin(), table.end()}};
}

std::vector<Section> make_sections() {
    std::vector<Section> all = {
        make_section("", "the recipe as a whole", root_fields()),
        make_section("atmosphere", "the planet and its air", atmosphere_fields()),
        make_section("atmosphere.layers.*", "one kind of gas or particle, under any name",
                     layer_fields()),
        make_section("scene", "the cameras and suns that the sky's tables are for", scene_fields()),
        make_section("particles.*", "spheres of given sizes, under any name", particles_fields()),
        make_section("noise.*", "a tileable noise, under any name", noise_fields()),
        make_section("noise.*.channels.*", "one channel of a noise: R, G, B, A, or Y alone",
                     noise_channel_fields()),
        make_section("clouds.*", "a cloud or a layer of clouds, under any name", cloud_fields()),
        make_section("clouds.*.height_profile", "how full the cloud is, by height",
                     height_profile_fields()),
        make_section("clouds.*.coverage_map", "a picture over the cloud that thins it out",
                     coverage_map_fields()),
        make_section("clouds.*.type_map", "a picture over the cloud of its cloud_type",
                     type_map_fields()),
        make_section("clouds.*.scatter", "towers at random places", tower_scatter_fields()),
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
