// Physical quantities as a recipe states them, in SI, each with a type of its own so that a length
// cannot be handed over as a coefficient. Parsing and spelling them is units.h's business.
#pragma once

namespace skybake::config {

struct Length {
    double meters = 0;
    constexpr double kilometers() const { return meters / 1000; }
};

// Scattering, absorption and extinction coefficients.
struct InverseLength {
    double per_meter = 0;
    constexpr double per_kilometer() const { return per_meter * 1000; }
};

// Particles per volume.
struct NumberDensity {
    double per_cubic_meter = 0;
};

struct Angle {
    double radians = 0;
};

// Entries of tables of numbers.

// One entry of `table = [["0 km", 1.0], ...]`.
struct DensityPoint {
    Length altitude;
    double density = 0;
};

// One entry of `table = [[0, 0.0], [0.2, 1.0]]`.
struct HeightPoint {
    double height = 0;  // in [0, 1]
    double value = 0;
};

}  // namespace skybake::config
