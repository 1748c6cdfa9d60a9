#include "config/sections/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "config/text/key_path.h"

namespace skybake::config {
namespace {

bool moves(const Noise* noise) { return noise != nullptr && noise->period > 0; }

}  // namespace

Parameters at_frame(const Parameters& parameters, int frame) {
    Parameters result = parameters;
    for (Noise& noise : result.noises) {
        if (frame > 0 && noise.period > 0) noise.time = noise.time % noise.period + frame - 1;
    }
    return result;
}

void check_frames(const DecodedSection& bake, std::initializer_list<const Noise*> noises,
                  Decoder& decoder) {
    const DecodedField& frames = bake.at("frames");
    const DecodedField& given = frames.source ? frames : bake.at("frame");
    if (!given.source || !given.value) return;
    const std::string path = join_path(bake.path, given.field->key);
    if (std::none_of(noises.begin(), noises.end(), moves)) {
        decoder.diagnostics.error(
            "E0174", given.source->place,
            fmt::format("`{}`: nothing moves, so that all frames are the same", path),
            "give a noise of the volume a `period`, or leave this key out");
        return;
    }
    if (!frames.value) return;
    const int count = static_cast<int>(std::get<double>(*frames.value));
    for (const Noise* noise : noises) {
        if (!moves(noise) || count % noise->period == 0) continue;
        decoder.diagnostics.warning("W0219", given.source->place,
                                    fmt::format("`{}` is {}, but noise `{}` repeats after {}", path,
                                                count, noise->name, noise->period),
                                    "the last frame does not lead to the first; give whole loops");
    }
}

}  // namespace skybake::config
