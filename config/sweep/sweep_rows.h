// The rows of [sweep].
#pragma once

#include <span>

#include "config/fields/fields.h"

namespace skybake::config {

enum class SweepScale { linear, log };

std::span<const Field> sweep_fields();        // besides the paths that vary
std::span<const Field> sweep_range_fields();  // of a range in it

}  // namespace skybake::config
