// The numbers that the kernels of hartley.cpp and transport.cpp work on.
#pragma once

#include <array>

namespace skybake::convection {

// One block of a stage: output k begins at k count, and input j at j step.
struct HartleyBlock {
    const float* real = nullptr;
    const float* imaginary = nullptr;
    float* to_real = nullptr;
    float* to_imaginary = nullptr;
    int step = 0;
    int count = 0;
    const float* cosine = nullptr;  // of the turns of its outputs
    const float* sine = nullptr;
};

// Complex numbers at a frequency and at its opposite, and where the real sequences that they carry go.
struct HartleyPair {
    const float* real = nullptr;
    const float* imaginary = nullptr;
    const float* opposite_real = nullptr;
    const float* opposite_imaginary = nullptr;
    int count = 0;
    float* first = nullptr;
    float* second = nullptr;
};

// The faces between the third and the fourth of six rows of cells, and the wind through them: the mean of
// two rows.
struct FaceRow {
    std::array<const float*, 6> cells{};
    const float* wind = nullptr;
    const float* wind_before = nullptr;
};

// The fluxes through all faces of a row of cells, and the factors of their differences.
struct FluxRow {
    const float* x = nullptr;
    const float* south = nullptr;
    const float* north = nullptr;
    const float* below = nullptr;
    const float* above = nullptr;
    const float* base = nullptr;
    std::array<float, 3> scale{};
};

}  // namespace skybake::convection
