// The numbers that the kernels of hartley.cpp work on.
#pragma once

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

}  // namespace skybake::convection
