// One [noise.NAME] and its channels.
#pragma once

#include <string>

#include "config/fields/section_decoder.h"
#include "config/sections/noise.h"

namespace skybake::config {

// The noise is whole only if no error was reported; its name is right in any case.
Noise decode_noise(const std::string& name, const Place& place, const Table& table,
                   Decoder& decoder);

}  // namespace skybake::config
