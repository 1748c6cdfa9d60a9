// The commented recipes that `skybake init` writes.
#pragma once

#include <string>
#include <string_view>

#include "config/presets/presets.h"

namespace skybake::config {

// Every value of the preset, its [bake.*] sections included, with what the field tables say of it;
// keys left at their default stand there as comments. Reads back as the same parameters.
std::string init_text(const Preset& preset);

// For a noise preset: a [noise.NAME] that starts from it, its values as comments, and a
// [bake.NAME].
std::string noise_init_text(const Preset& preset);

// NAME there: "shape" for "nubis_shape".
std::string noise_init_name(std::string_view preset);

// For a cloud preset: the noises that it names, a [clouds.NAME] that starts from it, its values as
// comments, and bakes of the cloud and of its occupancy. NAME is the preset's.
std::string cloud_init_text(const Preset& preset);

// For a preset of particles: a [particles.NAME] that starts from it, its values as comments, bakes
// of its phase function and of the inverse, and a layer of such particles as a comment.
std::string particle_init_text(const Preset& preset);

}  // namespace skybake::config
