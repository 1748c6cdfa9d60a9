#include "config/recipe/preview_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "config/assets/cloud_volume.h"
#include "config/assets/multiple_scattering.h"
#include "config/assets/transmittance.h"
#include "config/sections/sections.h"
#include "config/text/units.h"

namespace skybake::config {
namespace {

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

}  // namespace

PicturesOfLight pictures_of_light(std::span<const Bake> bakes) {
    const auto any = [bakes](auto is) { return std::ranges::any_of(bakes, is); };
    return {any([](const Bake& bake) { return bake.is<TransmittanceBake>(); }) &&
                any([](const Bake& bake) { return bake.is<MultipleScatteringBake>(); }),
            any([](const Bake& bake) { return bake.is<CloudVolumeBake>(); })};
}

std::optional<Preview> decode_preview(const Table& root, Decoder& decoder) {
    const Entry* entry = find_entry(root, "preview");
    if (!entry) return std::nullopt;
    const std::size_t before = decoder.values.size();
    const Table& table = subtable(root, "preview", "", decoder);
    Preview preview;
    const DecodedSection section = decode_into(preview, preview_fields(), "preview", "preview",
                                               entry->key_place, table, decoder);
    check_place(section, decoder);
    if (const Entry* camera = find_entry(table, "camera")) {
        const DecodedSection of_camera =
            decode_into(preview.camera, preview_camera_fields(), "preview.camera", "preview.camera",
                        camera->key_place, subtable(table, "camera", "preview", decoder), decoder);
        check_height(of_camera, decoder);
    }
    return decoder.values.size() > before ? std::optional(preview) : std::nullopt;
}

}  // namespace skybake::config
