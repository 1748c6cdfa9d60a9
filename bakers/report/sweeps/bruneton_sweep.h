// The variants of a table of Bruneton's, made: their voxels stand in memory.
#pragma once

#include <array>

#include "bakers/report/sweeps/measure_volume_sweep.h"
#include "bakers/report/sweeps/volume_sweep.h"

namespace skybake {

struct BrunetonSweep {
    VolumeSweep sweep;
    ReferenceOfSize reference;  // of tables of two axes; others' variants measure themselves
    std::array<int, 3> size{};  // the largest that was made: what the report is about
    int points = 0;             // that are compared
    int repetitions = 0;        // times are medians of so many
};

// Making a table takes up to seconds.
constexpr int bruneton_repetitions(bool quick) { return quick ? 1 : 3; }

}  // namespace skybake
