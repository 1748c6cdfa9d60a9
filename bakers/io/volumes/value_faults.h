// Values of a volume that are no densities, counted while the volume is read.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

namespace skybake {

struct ValueFaults {
    struct Kind {
        std::int64_t count = 0;               // voxels
        std::array<std::int64_t, 3> index{};  // of the first one
        float value = 0;                      // there
        float least = 0;                      // of all; NaN does not count
        void add(float found, const std::array<std::int64_t, 3>& at, std::int64_t voxels) {
            if (count == 0) {
                index = at;
                value = found;
            }
            count += voxels;
            if (found < least) least = found;
        }
    };
    Kind not_finite;
    Kind negative;

    static bool is_fault(float value) { return !(value >= 0) || std::isinf(value); }
    void add(float value, const std::array<std::int64_t, 3>& index, std::int64_t voxels = 1) {
        if (!std::isfinite(value)) {
            not_finite.add(value, index, voxels);
        } else if (value < 0) {
            negative.add(value, index, voxels);
        }
    }
};

// "its voxel (3, 0, 5) is nan, the first of 12 that are not finite". Indices are the file's own.
std::string words_of_fault(const ValueFaults::Kind& kind, const char* what);

// The same for values that are not finite, with the key that takes the background for them.
std::string refusal_of(const ValueFaults& faults);

}  // namespace skybake
