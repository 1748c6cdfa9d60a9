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
    const int packet = *bake.section.whole("packet");
    const bool has_wavelengths = holds_wavelengths(*bake.kind, recipe);
    if (has_wavelengths && packet <= packet_count(recipe)) return;
    bake.section.at("packet").value.reset();
    decoder.report("E0147", bake.section, "packet",
                   has_wavelengths ? fmt::format("is {}; the recipe has {} wavelengths", packet,
                                                 recipe.wavelengths.size())
                                   : ": this asset holds colours made of all wavelengths",
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

// Makes a bake forget of how many frames it is one. A frame is the same in a longer sequence.
void forget_sequence(DecodedSection& bake) {
    for (const std::string_view key : {"frames", "frames_per_second"}) {
        if (bake.find(key) == nullptr) continue;
        DecodedField& decoded = bake.at(key);
        decoded.source = nullptr;
        decoded.value.reset();
    }
}

bool only_refers(ChoiceIndex format) { return file_formats[format.index].only_refers; }

// Whether some file beside the voxels places or plays them: a scene, or a target's own file.
bool has_scene(const DecodedSection& bake) {
    const auto* formats = bake.value<std::vector<ChoiceIndex>>("formats");
    if (!formats) return false;
    const auto target = choice_of<Target>(bake.at("target"));
    // Scenes of pbrt have no variables, so that each frame has its own.
    const bool plays = target && *target != Target::none && *target != Target::pbrt;
    if (bake.find("frames") && plays) return true;
    return std::ranges::any_of(*formats, only_refers);
}

// Removes files that place other files: those of the first frame place all frames.
void remove_scene(DecodedSection& bake) {
    auto formats = *bake.value<std::vector<ChoiceIndex>>("formats");
    std::erase_if(formats, only_refers);
    replace(bake.at("formats"), std::move(formats));
    DecodedField& target = bake.at("target");
    if (target.value) replace(target, chosen(*target.field, Target::none));
}

// Whether a bake is the first frame of a sequence that its files place, as those files carry it.
bool is_carried_first(const OpenBake& bake) {
    const std::optional<int> frames = bake.section.whole("frames");
    return frames && bake.section.whole("frame") == 1 && has_scene(bake.section) &&
           bake.name == frame_name(sequence_name(bake.name), 1, *frames);
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
            const auto& of = *part.section.value<std::string>("of");
            replace(part.section.at("of"), frame_name(of, frame, frames));
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
    if (frames && frames->value && frame && !frame->source) return *bake.section.whole("frames");
    if (!bake.kind->facts.of_another_bake || bake.kind->facts.of_all_frames) return 0;
    const DecodedField* of = bake.section.find("of");  // an environment has clouds in its place
    const auto* name = of ? of->as<std::string>() : nullptr;
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
