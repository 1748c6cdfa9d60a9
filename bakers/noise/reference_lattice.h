// One octave of each kind of noise by its definition, in double precision, for noise_reference.h.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>

#include "bakers/math/vectors.h"
#include "bakers/noise/lattice_hash.h"

namespace skybake::noise::reference {

// One octave's lattice: hashed, with its period.
struct Lattice {
    std::array<int, 3> period{};
    std::uint64_t key = 0;
    int time_period = 1;          // lattice cells along time
    std::optional<double> loops;  // the time; none: the lattice has three dimensions

    glm::dvec3 periods() const { return {period[0], period[1], period[2]}; }
    std::uint32_t wrap(double cell, std::size_t axis) const { return wrapped(cell, period[axis]); }
    glm::dvec3 gradient(const glm::dvec3& at) const {
        const auto [x, y, z] =
            lattice_gradient(row_key(key, wrap(at.y, 1), wrap(at.z, 2)), wrap(at.x, 0));
        return {x, y, z};
    }
    glm::dvec4 gradient(const glm::dvec4& at) const {
        const RowKey row =
            row_key(time_key(key, wrapped(at.w, time_period)), wrap(at.y, 1), wrap(at.z, 2));
        const auto [x, y, z, t] = lattice_gradient_4(row, wrap(at.x, 0));
        return {x, y, z, t};
    }
    CellPoint point(double x, double y, double z) const;

  private:
    static std::uint32_t wrapped(double cell, double p) {
        return static_cast<std::uint32_t>(cell - std::floor(cell / p) * p);
    }
};

// A number with its derivatives along x, y and z.
struct Dual {
    double value = 0;
    glm::dvec3 slope{};
};

// Returns improved noise and its gradient per cell, of four dimensions if the lattice has time:
// Perlin 2002. Places are in tiles here and below.
Dual improved_noise(const Lattice& lattice, const glm::dvec3& place);

// Returns the distances, in cells, to the nearest and second nearest of the points of 125 cells.
std::array<double, 2> nearest_points(const Lattice& lattice, const glm::dvec3& place);

// Returns the difference of the greatest and the second greatest of the bumps of 125 cells.
double alligator(const Lattice& lattice, const glm::dvec3& place);

}  // namespace skybake::noise::reference
