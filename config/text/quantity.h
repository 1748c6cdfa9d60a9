// This header declares physical quantities in SI units. Each has a type of its own, so that a
// length cannot be passed as a coefficient. units.h reads and spells them.
#pragma once

#include <string>

namespace skybake::config {

struct Length {
    double meters = 0;
    constexpr double kilometers() const { return meters / 1000; }
    bool operator==(const Length&) const = default;
};

// This is a coefficient of scattering, absorption or extinction.
struct InverseLength {
    double per_meter = 0;
    constexpr double per_kilometer() const { return per_meter * 1000; }
    bool operator==(const InverseLength&) const = default;
};

// This is a number of particles per volume.
struct NumberDensity {
    double per_cubic_meter = 0;
    bool operator==(const NumberDensity&) const = default;
};

struct Pressure {
    double pascals = 0;
    bool operator==(const Pressure&) const = default;
};

// This is a number of molecules per area, of a gas from the ground to the top of the air.
struct ColumnDensity {
    double per_square_meter = 0;
    bool operator==(const ColumnDensity&) const = default;
};

struct Angle {
    double radians = 0;
    bool operator==(const Angle&) const = default;
};

// This is one entry of a density table: `table = [["0 km", 1.0], ...]`.
struct DensityPoint {
    Length altitude;
    double density = 0;
    bool operator==(const DensityPoint&) const = default;
};

// This is one entry of a table of refractive indices n + i k: `indices = [["550
// nm", 1.5, 0.01], ...]`.
struct IndexPoint {
    Length wavelength;
    double real = 1;       // n
    double imaginary = 0;  // k, which absorbs where it is positive
    bool operator==(const IndexPoint&) const = default;
};

// This is one entry of a spectrum: `ground_albedo = [["450 nm", 0.07], ...]`.
struct SpectrumPoint {
    Length wavelength;
    double value = 0;
    bool operator==(const SpectrumPoint&) const = default;
};

// This is one entry of a list of components: `components = [["soot", "8300
// /cm3"], ...]`.
struct ComponentNumber {
    std::string component;
    NumberDensity number_density;
    bool operator==(const ComponentNumber&) const = default;
};

// This is one entry of a height table: `table = [[0, 0.0], [0.2, 1.0]]`.
struct HeightPoint {
    double height = 0;  // in [0, 1]
    double value = 0;
    bool operator==(const HeightPoint&) const = default;
};

}  // namespace skybake::config
