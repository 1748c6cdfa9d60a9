// The rows that the kernels of transport.cpp work on.
#pragma once

#include <array>

namespace skybake::convection {

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
