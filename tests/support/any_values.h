// Random values of RapidCheck.
#pragma once

#include <rapidcheck.h>

#include <array>
#include <cstddef>

#include "bakers/field/level.h"

namespace skybake::test {

// Evenly, whatever RapidCheck's size.
inline double any_number(double from, double to) {
    const int share = *rc::gen::resize(100, rc::gen::inRange(0, 1 << 20));
    return from + (to - from) * share / static_cast<double>(1 << 20);
}

// A box within a volume.
inline VoxelBox any_box(const std::array<int, 3>& size) {
    VoxelBox box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.origin[axis] = *rc::gen::inRange(0, size[axis]);
        box.size[axis] = *rc::gen::inRange(1, size[axis] - box.origin[axis] + 1);
    }
    return box;
}

}  // namespace skybake::test
