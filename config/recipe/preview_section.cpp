#include "config/recipe/preview_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "config/assets/cloud_volume.h"
#include "config/assets/multiple_scattering.h"
#include "config/assets/transmittance.h"
#include "config/diagnostics/toml_source.h"
#include "config/sections/sections.h"
#include "config/text/units.h"

namespace skybake::config {
namespace {

constexpr const char* preview_path = "preview";
constexpr const char* camera_path = "preview.camera";

// Reports a time without a place, and half of a place.
void check_place(const DecodedSection& preview, Decoder& decoder) {
    const std::array pairs = {std::array{"at", "latitude"}, std::array{"at", "longitude"},
                              std::array{"latitude", "longitude"},
                              std::array{"longitude", "latitude"}};
    for (const auto& [given, needed] : pairs) {
        if (!preview.gives(given) || preview.gives(needed) || !decoder.complete) continue;
        decoder.diagnostics.error(
            "E0105", preview.place_of(given),
            fmt::format("`preview.{}` is missing: `preview.{}` needs it", needed, given),
            "a place has a latitude and a longitude");
    }
}

void check_height(const DecodedSection& camera, Decoder& decoder) {
    const auto* position = camera.value<std::array<double, 3>>("position");
    if (!position || (*position)[2] >= 0) return;
    decoder.report("E0110", camera, "position",
                   fmt::format("is {} below the ground", length_to_string(-(*position)[2])),
                   "the third length is the altitude above the ground");
}

// Returns the values of a section as the table that they were read from.
Table table_of(const Recipe& recipe, std::string_view section) {
    Table table;
    for (const ResolvedValue& value : recipe.values) {
        if (value.section != section) continue;
        auto parsed = parse_toml_value(value.canonical);
        if (!parsed) continue;  // none of a valid recipe
        table.push_back({key_of(value), {}, std::move(*parsed)});
    }
    std::ranges::sort(table, {}, &Entry::key);
    return table;
}

template <class S>
void bind_values(const Recipe& recipe, const char* path, std::span<const Row<S>> rows, S& target) {
    DiagnosticList none_expected;
    std::vector<ResolvedValue> values;
    Decoder decoder{none_expected, values, true, std::nullopt};
    const Table table = table_of(recipe, path);
    bind_section(decode_section(*find_section(path), path, {}, table, Absent::left_out, decoder),
                 rows, target);
}

}  // namespace

PicturesOfLight pictures_of_light(std::span<const Bake> bakes) {
    const auto any = [bakes](auto is) { return std::ranges::any_of(bakes, is); };
    return {any([](const Bake& bake) { return bake.is<TransmittanceBake>(); }) &&
                any([](const Bake& bake) { return bake.is<MultipleScatteringBake>(); }),
            any([](const Bake& bake) { return bake.is<CloudVolumeBake>(); })};
}

void decode_preview(const Table& root, Decoder& decoder) {
    const Entry* entry = find_entry(root, preview_path);
    if (entry == nullptr) return;
    const Table& table = subtable(root, preview_path, "", decoder);
    const DecodedSection preview =
        decode_section(*find_section(preview_path), preview_path, entry->key_place, table,
                       Absent::filled_in, decoder);
    append_values(preview, decoder);
    check_place(preview, decoder);
    const Entry* camera_entry = find_entry(table, "camera");
    if (camera_entry == nullptr) return;
    const DecodedSection camera = decode_section(
        *find_section(camera_path), camera_path, camera_entry->key_place,
        subtable(table, "camera", preview_path, decoder), Absent::filled_in, decoder);
    append_values(camera, decoder);
    check_height(camera, decoder);
}

std::optional<Preview> preview_of(const Recipe& recipe) {
    const bool any = std::ranges::any_of(recipe.values, [](const ResolvedValue& value) {
        return value.section == preview_path || value.section == camera_path;
    });
    if (!any) return std::nullopt;
    Preview preview;
    bind_values(recipe, preview_path, preview_fields(), preview);
    bind_values(recipe, camera_path, preview_camera_fields(), preview.camera);
    return preview;
}

}  // namespace skybake::config
