// This header makes the commented recipes that `skybake init` writes.
#pragma once

#include <string>
#include <string_view>

#include "config/presets/presets.h"

namespace skybake::config {

// Writes every value of the preset, with its [bake.*] sections and with what the field tables say
// of each value. Keys that keep their default stand there as comments. The text reads back as the
// same parameters.
std::string init_text(const Preset& preset);

// Writes, for a noise preset, a [noise.NAME] that starts from it, the preset's values as comments,
// and a [bake.NAME].
std::string noise_init_text(const Preset& preset);

// Returns the NAME that noise_init_text uses: "shape" for "nubis_shape".
std::string noise_init_name(std::string_view preset);

// Writes, for a cloud preset, the noises that it names, a [clouds.NAME] that starts from it, the
// preset's values as comments, and bakes of the cloud and of its occupancy. NAME is the preset's
// name.
std::string cloud_init_text(const Preset& preset);

// Writes, for a preset of particles, a [particles.NAME] that starts from it, the preset's values as
// comments, bakes of its phase function and of the inverse, and, as a comment, a layer of such
// particles.
std::string particle_init_text(const Preset& preset);

}  // namespace skybake::config
