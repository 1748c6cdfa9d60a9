#include "config/assets/bake_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string_view>
#include <utility>

#include "config/sections/file_formats.h"
#include "config/sections/frames.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

// Whether the channels of an asset are wavelengths of the recipe.
bool holds_wavelengths(const AssetKind& kind, const Parameters& recipe) {
    const UseOfLight use = kind.facts.use_of_light;
    return use == UseOfLight::factors || use == UseOfLight::channels ||
           (use == UseOfLight::colors && !holds_colors(recipe));
}

// Reports and removes a packet that the recipe does not have, or that an asset of colours cannot
// hold.
void check_packet(OpenBake& bake, const Parameters& recipe, Decoder& decoder) {
    DecodedField& decoded = bake.section.at("packet");
    const int packet = static_cast<int>(std::get<double>(*decoded.value));
    const bool has_wavelengths = holds_wavelengths(*bake.kind, recipe);
    if (has_wavelengths && packet <= packet_count(recipe)) return;
    decoded.value.reset();
    const std::string path = join_path(bake.section.path, "packet");
    decoder.diagnostics.error(
        "E0147", decoded.source->place,
        has_wavelengths
            ? fmt::format("`{}` is {}; the recipe has {} wavelengths", path, packet,
                          recipe.wavelengths.size())
            : fmt::format("`{}`: this asset holds colours made of all wavelengths", path),
        has_wavelengths ? fmt::format("give at most {}", packet_count(recipe))
                        : "leave it out, or set [color] space to \"none\"");
}

OpenBake part_of(const OpenBake& whole, std::string name) {
    OpenBake part = whole;
    part.name = std::move(name);
    part.section.path = join_path("bake", part.name);
    return part;
}

// Returns a bake for each packet of the recipe.
std::vector<OpenBake> divided_by_light(const OpenBake& whole, const Parameters& recipe) {
    std::vector<OpenBake> parts;
    for (int packet = 1; packet <= packet_count(recipe); ++packet) {
        OpenBake part = part_of(whole, fmt::format("{}_{}", whole.name, packet));
        derive(part.section.at("packet"), static_cast<double>(packet));
        parts.push_back(std::move(part));
    }
    return parts;
}

// Sets a value of a part. The key keeps its place in the recipe.
template <class T>
void replace(DecodedField& decoded, T value) {
    decoded.value = std::move(value);
    decoded.derived = true;
}

// Makes a bake forget of how many frames it is one. A frame is the same in a longer sequence.
void forget_sequence(DecodedSection& bake) {
    for (const std::string_view key : {"frames", "frames_per_second"}) {
        if (bake.find(key) == nullptr) continue;
        DecodedField& decoded = bake.at(key);
        decoded.source = nullptr;
        decoded.value.reset();
    }
}

// Whether some file beside the voxels places or plays them: a scene, or a target's own file.
bool has_scene(const DecodedSection& bake) {
    const DecodedField& formats = bake.at("formats");
    if (!formats.value) return false;
    const auto target = choice_of<Target>(bake.at("target"));
    // Scenes of pbrt have no variables, so that each frame has its own.
    const bool plays = target && *target != Target::none && *target != Target::pbrt;
    if (bake.find("frames") && plays) return true;
    const auto& chosen = std::get<std::vector<ChoiceIndex>>(*formats.value);
    return std::ranges::any_of(
        chosen, [](ChoiceIndex choice) { return file_formats[choice.index].only_refers; });
}

// Removes files that place other files: those of the first frame place all frames.
void remove_scene(DecodedSection& bake) {
    auto chosen = std::get<std::vector<ChoiceIndex>>(*bake.at("formats").value);
    chosen.erase(
        std::remove_if(chosen.begin(), chosen.end(),
                       [](ChoiceIndex choice) { return file_formats[choice.index].only_refers; }),
        chosen.end());
    replace(bake.at("formats"), std::move(chosen));
    DecodedField& target = bake.at("target");
    if (target.value) replace(target, FieldValue(config::chosen(*target.field, Target::none)));
}

// Whether a bake is the first frame of a sequence that its files place, as those files carry it.
bool is_carried_first(const OpenBake& bake) {
    const DecodedField& frames = bake.section.at("frames");
    const DecodedField& frame = bake.section.at("frame");
    if (!frames.value || !frame.value || !has_scene(bake.section)) return false;
    const int count = static_cast<int>(std::get<double>(*frames.value));
    return std::get<double>(*frame.value) == 1 &&
           bake.name == frame_name(sequence_name(bake.name), 1, count);
}

// Returns a bake for each frame. An asset that is made from another one is made from its frame.
std::vector<OpenBake> divided_in_time(const OpenBake& whole, int frames) {
    std::vector<OpenBake> parts;
    for (int frame = 1; frame <= frames; ++frame) {
        OpenBake part = part_of(whole, frame_name(whole.name, frame, frames));
        const bool plays_all = frame == 1 && has_scene(part.section);
        if (!plays_all) forget_sequence(part.section);
        if (frame > 1 && has_scene(part.section)) remove_scene(part.section);
        if (part.section.find("frame") != nullptr) {
            derive(part.section.at("frame"), static_cast<double>(frame));
        } else {
            const std::string* of = text_of(part.section.at("of"));
            replace(part.section.at("of"), frame_name(*of, frame, frames));
        }
        parts.push_back(std::move(part));
    }
    return parts;
}

// Reports bakes that have the name of a part of another bake. `part_name` is what a part is
// called, and `which` says which there are.
void check_part_names(const OpenBake& whole, const std::vector<OpenBake>& parts,
                      std::span<const Entry* const> entries, std::string_view code,
                      std::string_view part_name, std::string_view which, Decoder& decoder) {
    for (const Entry* entry : entries) {
        const bool is_taken = std::ranges::any_of(
            parts, [&](const OpenBake& part) { return part.name == entry->key; });
        if (!is_taken) continue;
        decoder.diagnostics.error(
            std::string(code), entry->key_place,
            fmt::format("[bake.{}] has the name of a {} of [bake.{}], {} {} to {}", entry->key,
                        part_name, whole.name, which, parts.front().name, parts.back().name),
            "choose another name");
    }
}

// Returns the number of frames that a bake is to be divided into, or 0. An asset that holds all its
// frames has no key `frame`. `sequences` are the frames of bakes that are divided themselves.
int frames_to_divide(const OpenBake& bake, const std::map<std::string, int>& sequences) {
    const DecodedField* frames = bake.section.find("frames");
    const DecodedField* frame = bake.section.find("frame");
    if (frames && frames->value && frame && !frame->source) {
        return static_cast<int>(std::get<double>(*frames->value));
    }
    if (!bake.kind->facts.of_another_bake || bake.kind->facts.of_all_frames) return 0;
    const DecodedField* of = bake.section.find("of");  // an environment has clouds in its place
    const std::string* name = of ? text_of(*of) : nullptr;
    const auto found = name ? sequences.find(*name) : sequences.end();
    return found == sequences.end() ? 0 : found->second;
}

}  // namespace

std::vector<OpenBake> divided_into_parts(std::vector<OpenBake> open, const Parameters& recipe,
                                         std::span<const Entry* const> entries, Decoder& decoder) {
    std::map<std::string, int> sequences;
    for (const OpenBake& bake : open) {
        if (const int frames = frames_to_divide(bake, {}); frames > 0) {
            sequences.emplace(bake.name, frames);
        }
    }
    std::vector<OpenBake> result;
    for (OpenBake& bake : open) {
        const DecodedField* packet = bake.section.find("packet");
        if (packet && packet->value) check_packet(bake, recipe, decoder);
        const bool is_divided = packet && !packet->source && packet_count(recipe) > 1 &&
                                holds_wavelengths(*bake.kind, recipe);
        std::vector<OpenBake> parts;
        if (const int frames = frames_to_divide(bake, sequences); frames > 0) {
            parts = divided_in_time(bake, frames);
            check_part_names(bake, parts, entries, "E0174", "frame", "whose frames are", decoder);
        } else if (is_divided) {
            parts = divided_by_light(bake, recipe);
            check_part_names(bake, parts, entries, "E0147", "packet",
                             "whose wavelengths are held by", decoder);
        } else {
            const bool is_one_frame = bake.section.find("frame") != nullptr;
            if (is_one_frame && !is_carried_first(bake)) forget_sequence(bake.section);
            parts.push_back(std::move(bake));
        }
        std::ranges::move(parts, std::back_inserter(result));
    }
    return result;
}

}  // namespace skybake::config
