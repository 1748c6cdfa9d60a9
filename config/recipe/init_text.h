// This header makes the commented recipes that `skybake init` writes.
#pragma once

#include <string>
#include <string_view>

#include "config/presets/presets.h"

namespace skybake::config {

// No text has more than 80 lines. Each begins with the first paragraph of the preset's comment.

// Writes every value of the preset, with its [bake.*] sections and with what the field tables say
// of each value. Each section lists its defaults in a comment, and keys of files stand once at the
// end. The text reads back as the same parameters.
std::string init_text(const Preset& preset);

// Writes, for a noise preset, a [noise.NAME] that starts from it, the preset's values as comments,
// and a [bake.NAME].
std::string noise_init_text(const Preset& preset);

// Returns the NAME that noise_init_text uses: "shape" for "nubis_shape".
std::string noise_init_name(std::string_view preset);

// Writes, for a cloud preset, a [clouds.NAME] that starts from it, the preset's values as comments,
// but of towers those of the first one only, the [preview] of the preset, and bakes of the cloud and
// of its occupancy. NAME is the preset's name.
std::string cloud_init_text(const Preset& preset);

// Writes, for a preset of particles, a [particles.NAME] that starts from it, the preset's values as
// comments, bakes of its phase function and of the inverse, and, as a comment, a layer of such
// particles.
std::string particle_init_text(const Preset& preset);

}  // namespace skybake::config
