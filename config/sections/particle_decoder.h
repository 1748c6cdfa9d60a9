// One [particles.NAME].
#pragma once

#include <span>
#include <string>

#include "config/fields/section_decoder.h"
#include "config/sections/particles.h"

namespace skybake::config {

// They are whole only if no error was reported; their name is right in any case. E0144: spheres of
// air in air, or water at wavelengths where its index is not known.
Particles decode_particles(const std::string& name, const Place& place, const Table& table,
                           std::span<const Length> wavelengths, Decoder& decoder);

}  // namespace skybake::config
