// The commented recipe that `skybake init` writes.
#pragma once

#include <string>

#include "config/presets.h"

namespace skybake::config {

// Every value of the preset, its [bake.*] sections included, with what the field tables say of it;
// keys left at their default stand there as comments. Reads back as the same parameters.
std::string init_text(const Preset& preset);

}  // namespace skybake::config
