// The random numbers of the lattice, one hash per lattice point, which is a pure function of the
// octave's key and the point's three coordinates; and the planes of lattice points that a box of
// voxels needs. This header defines the numbers; lattice_hash-inl.h computes the same for vectors.
//
// No linear index is ever formed, so that lattices of any size keep all their bits: a 64-bit key is
// mixed with z, then with y, and its two halves are mixed with x by a 32-bit finaliser of full
// avalanche.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "bakers/field/level.h"
#include "bakers/math/memory.h"
#include "bakers/math/mix64.h"
#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

// The function lowbias32 of Wellons's hash-prospector, whose bias is 0.17.
inline std::uint32_t mix32(std::uint32_t h) {
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return h ^ (h >> 16);
}

inline constexpr std::uint32_t kGolden32 = 0x9e3779b9u;

// The key of an octave's random numbers. Octaves of the same purpose, frequency and seed are the
// same field wherever they occur, so that channels which share cellular octaves share their work. A
// frequency that occurs again within one sum is a different field each time, by `repetition`.
enum class Purpose : std::uint32_t {
    gradient,
    cells,
    potential_x,
    potential_y,
    potential_z,
    alligator,
    warp_x,
    warp_y,
    warp_z
};
// The three of a curl's potential, and of a warp.
inline constexpr std::array kPotentials = {Purpose::potential_x, Purpose::potential_y,
                                           Purpose::potential_z};
inline constexpr std::array kWarps = {Purpose::warp_x, Purpose::warp_y, Purpose::warp_z};

inline std::uint64_t octave_key(std::uint64_t noise_seed, std::uint64_t channel_seed,
                                Purpose purpose, const std::array<int, 3>& frequency,
                                int repetition = 0) {
    std::uint64_t key = mix64(noise_seed + kGolden64);
    key = mix64(key ^ mix64(channel_seed + 2 * kGolden64));
    key = mix64(key + static_cast<std::uint64_t>(purpose) + 1);
    for (const int f : frequency) key = mix64(key * kGolden64 + static_cast<std::uint64_t>(f));
    for (int i = 0; i < repetition; ++i) key = mix64(key + kGolden64);
    return key;
}

// The key of the lattice of three dimensions at a point of the fourth axis.
inline std::uint64_t time_key(std::uint64_t octave_key, std::uint32_t time_cell) {
    return mix64((octave_key ^ kGolden64) + time_cell * kGolden64);
}

// The part of the hash that the points of one lattice row (y and z fixed) share.
struct RowKey {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
};

inline RowKey row_key(std::uint64_t octave_key, std::uint32_t y, std::uint32_t z) {
    const std::uint64_t slice = mix64(octave_key ^ (z * kGolden64));
    const std::uint64_t row = mix64(slice + (std::uint64_t{y} + 1) * kGolden64);
    return {static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(row >> 32)};
}

inline std::uint32_t lattice_hash(RowKey row, std::uint32_t x) {
    return mix32(mix32(x * kGolden32 + row.low) ^ row.high);
}

// One of the twelve gradients of improved noise: (0, ±1, ±1) and its permutations (Perlin 2002).
struct Gradient {
    float x = 0;
    float y = 0;
    float z = 0;
};

inline Gradient lattice_gradient(RowKey row, std::uint32_t x) {
    const std::uint32_t h = lattice_hash(row, x);
    const std::uint32_t zero_axis = ((h >> 16) * 3) >> 16;
    const float first = (h & 1) != 0 ? -1.0f : 1.0f;
    const float second = (h & 2) != 0 ? -1.0f : 1.0f;
    if (zero_axis == 0) return {0, first, second};
    if (zero_axis == 1) return {first, 0, second};
    return {first, second, 0};
}

// One of the thirty-two gradients of four dimensions: (0, ±1, ±1, ±1) and its permutations (Perlin
// 2002, whose code for four dimensions has them).
struct Gradient4 {
    float x = 0;
    float y = 0;
    float z = 0;
    float t = 0;
};

inline Gradient4 lattice_gradient_4(RowKey row, std::uint32_t x) {
    const std::uint32_t h = lattice_hash(row, x);
    const std::uint32_t zero_axis = h >> 30;
    const auto along = [&](std::uint32_t axis) {
        if (axis == zero_axis) return 0.0f;
        return (h >> axis & 1) != 0 ? -1.0f : 1.0f;
    };
    return {along(0), along(1), along(2), along(3)};
}

// A cell's one point: its place in the cell, three offsets of 24 bits in [0, 1), and the height of
// its bump, which alligator noise has.
struct CellPoint {
    float x = 0;
    float y = 0;
    float z = 0;
    float height = 0;
};

inline float unit_float(std::uint32_t h) { return static_cast<float>(h >> 8) * 0x1p-24f; }

// A point's offset along one axis, on a path of 2^25 steps. It moves to and fro between the faces of
// its cell at constant speed, slow or fast, one way first or the other, so that its offset is
// equally distributed at every time, and it is where it was after the whole path.
inline constexpr std::uint32_t kPathSteps = 1u << 25;

inline float moved_float(std::uint32_t h, PathShift shift) {
    const std::uint32_t forwards = (h & 2) != 0 ? shift.fast : shift.slow;
    const std::uint32_t steps = (h & 1) != 0 ? kPathSteps - forwards : forwards;
    const std::uint32_t phase = ((h >> 8) + steps) & (kPathSteps - 1);
    return unit_float(std::min(phase, kPathSteps - 1 - phase) << 8);
}

inline CellPoint cell_point(RowKey row, std::uint32_t x, PathShift shift = {}) {
    const std::uint32_t a = mix32(mix32(x * kGolden32 + row.low) ^ row.high);
    const std::uint32_t b = mix32(mix32(x * kGolden32 + row.high) ^ row.low);
    const std::uint32_t c = mix32((a + kGolden32) ^ (b << 1));
    const std::uint32_t d = mix32((b + kGolden32) ^ (c << 1));
    return {moved_float(a, shift), moved_float(b, shift), moved_float(c, shift), unit_float(d)};
}

// A ring of lattice planes, [slot][y][x], with the random vectors of the lattice points that a box
// of voxels needs. It is kept from chunk to chunk while a box is filled, by one thread at a time.
// lattice_planes-inl.h fills it, a plane at a time.
struct LatticePlanes {
    std::array<int, 3> frequency{};
    std::uint64_t key = 0;
    std::array<std::int64_t, 3> first{};  // lattice coordinates of the first point along x and y
    std::array<int, 3> count{};           // points along x and y; planes held along z
    std::size_t stride = 0;               // floats from row to row, with a vector to spare
    std::vector<std::uint32_t> scaled_x;  // of each point along x, wrapped, for its hash
    AlignedFloats x, y, z;
    AlignedFloats rest;  // empty but for gradients that change in time (gradient_kernel.cpp)
    std::vector<std::int64_t> plane_of_slot;

    std::size_t row(std::size_t slot, std::size_t line) const {
        return (slot * static_cast<std::size_t>(count[1]) + line) * stride;
    }
};

// Makes the planes for chunks within `box` of at most `chunk_depth` slices: the points of their
// cells, `before` more on the lower side and `after` more on the upper side.
LatticePlanes make_lattice_planes(const std::array<int, 3>& frequency, std::uint64_t key,
                                  const std::array<AxisCells, 3>& cells, const VoxelBox& box,
                                  int chunk_depth, int before, int after);

}  // namespace skybake::noise
