#include "config/sections/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "config/fields/section_decoder.h"
#include "config/sections/cloud.h"
#include "config/sections/noise.h"
#include "config/sections/spectral_air.h"

namespace skybake::config {

namespace {

bool moves(const Motion& motion) { return motion.period > 0; }

// Returns the time of a frame, counted from 1.
int time_at(int time, int period, int frame) { return time % period + frame - 1; }

}  // namespace

Parameters at_frame(const Parameters& parameters, int frame) {
    Parameters result = parameters;
    if (frame == 0) return result;
    for (Noise& noise : result.noises) {
        if (noise.period > 0) noise.time = time_at(noise.time, noise.period, frame);
    }
    for (Cloud& cloud : result.clouds) {
        if (cloud.period > 0) cloud.time = time_at(cloud.time, cloud.period, frame);
    }
    return result;
}

Parameters after_frame(const Parameters& parameters, int frame) {
    Parameters result = at_frame(parameters, frame);
    const auto halve = [](int& period, int& time) {
        time = 2 * (time % std::max(period, 1)) + 1;
        period *= 2;
    };
    for (Noise& noise : result.noises) halve(noise.period, noise.time);
    for (Cloud& cloud : result.clouds) halve(cloud.period, cloud.time);
    return result;
}

std::string frame_name(const std::string& sequence, int frame, int frames) {
    const int digits = std::max(4, static_cast<int>(std::to_string(frames).size()));
    return fmt::format("{}_{:0{}}", sequence, frame, digits);
}

std::string sequence_name(const std::string& first_frame) {
    return first_frame.substr(0, first_frame.rfind('_'));
}

Motion motion_of(const Noise& noise) {
    return {fmt::format("noise `{}`", noise.name), noise.period};
}

Motion motion_of(const Cloud& cloud) {
    return {fmt::format("cloud `{}`", cloud.name), cloud_moves(cloud) ? cloud.period : 0};
}

void check_frames(const DecodedSection& bake, std::span<const Motion> motions, Decoder& decoder) {
    const std::string_view key = bake.gives("frames") ? "frames" : "frame";
    if (!bake.gives(key) || !bake.at(key).value) return;
    if (std::ranges::none_of(motions, moves)) {
        decoder.report("E0174", bake, key, ": nothing moves, so that all frames are the same",
                       "give a noise of the asset a `period`, or its cloud a `period` and towers "
                       "with `life` or "
                       "shape convection, or leave this key out");
        return;
    }
    const std::optional<int> count = bake.whole("frames");
    if (!count) return;
    for (const Motion& motion : motions) {
        if (!moves(motion) || *count % motion.period == 0) continue;
        decoder.report(
            "W0219", bake, key,
            fmt::format("is {}, but {} repeats after {}", *count, motion.name, motion.period),
            "the last frame does not lead to the first; give whole loops");
    }
}

int packet_count(const Parameters& parameters) {
    const std::size_t count = parameters.wavelengths.size();
    return static_cast<int>((count + wavelengths_per_packet - 1) / wavelengths_per_packet);
}

PacketRange packet_range(const Parameters& parameters, int packet) {
    const std::size_t all = parameters.wavelengths.size();
    if (packet == 0) return {0, all};
    const std::size_t first = wavelengths_per_packet * static_cast<std::size_t>(packet - 1);
    return {first, std::min(wavelengths_per_packet, all - first)};
}

Parameters packet_of(const Parameters& parameters, int packet) {
    if (packet == 0) return parameters;
    const PacketRange range = packet_range(parameters, packet);
    Parameters part = parameters;
    const auto begin = std::next(parameters.wavelengths.begin(), static_cast<long>(range.first));
    part.wavelengths = {begin, std::next(begin, static_cast<long>(range.count))};
    part.atmosphere = channels_of(parameters.atmosphere, range.first, range.count);
    return part;
}

}  // namespace skybake::config
