// Where things lie in NanoVDB files, as the library's headers define it.
#pragma once

#include <nanovdb/NanoVDB.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace skybake {

// Files and grids of OpenVDB 12 and later begin with other numbers: `NanoVDB2` and `NanoVDB1`. What
// follows is the same for all releases of major version 32.
inline constexpr std::uint64_t nvdb_magic = NANOVDB_MAGIC_NUMBER;  // `NanoVDB0`
inline constexpr std::uint64_t nvdb_new_grid_magic = nvdb_magic + (std::uint64_t{1} << 56);
inline constexpr std::uint64_t nvdb_new_file_magic = nvdb_magic + (std::uint64_t{2} << 56);

// The head of a segment, and of each of its grids, after which its name follows.
struct NvdbSegment {
    std::uint64_t magic = NANOVDB_MAGIC_NUMBER;
    nanovdb::Version version;
    std::uint16_t grids = 0;
    std::uint16_t codec = 0;  // none
};
static_assert(sizeof(NvdbSegment) == 16);

struct NvdbGridHead {
    std::uint64_t grid_size = 0;  // bytes
    std::uint64_t file_size = 0;  // the same, without a codec
    std::uint64_t name_key = 0;
    std::uint64_t active_voxels = 0;
    nanovdb::GridType type = nanovdb::GridType::Float;
    nanovdb::GridClass grid_class = nanovdb::GridClass::FogVolume;
    nanovdb::BBox<nanovdb::Vec3d> world_bounds;
    nanovdb::CoordBBox bounds;
    std::array<double, 3> voxel_size{};
    std::uint32_t name_size = 0;                        // with the 0 at its end
    std::array<std::uint32_t, 4> nodes = {0, 0, 0, 1};  // leaves, lower, upper, root
    std::array<std::uint32_t, 3> tiles{};
    std::uint16_t codec = 0;
    std::uint16_t padding = 0;
    nanovdb::Version version;
};
static_assert(sizeof(NvdbGridHead) == 176);

using NvdbRoot = nanovdb::NanoRoot<float>::DataType;
using NvdbUpper = nanovdb::NanoUpper<float>::DataType;
using NvdbLower = nanovdb::NanoLower<float>::DataType;
template <class Build>
using NvdbLeaf = typename nanovdb::NanoLeaf<Build>::DataType;

// Inner nodes do not depend on how leaves store their values.
static_assert(sizeof(NvdbRoot) == sizeof(nanovdb::NanoRoot<nanovdb::Fp8>::DataType));
static_assert(sizeof(NvdbUpper) == sizeof(nanovdb::NanoUpper<nanovdb::Fp8>::DataType));
static_assert(sizeof(NvdbLower) == sizeof(nanovdb::NanoLower<nanovdb::Fp8>::DataType));

inline constexpr int nvdb_leaf_edge = 8;  // voxels
inline constexpr std::size_t nvdb_leaf_voxels = 512;
inline constexpr int nvdb_lower_edge = 128;
inline constexpr int nvdb_upper_edge = 4096;

// The first bytes of a grid are GridData, TreeData, RootData and the root's tiles.
inline constexpr std::size_t nvdb_tree_at = sizeof(nanovdb::GridData);
inline constexpr std::size_t nvdb_root_at = nvdb_tree_at + sizeof(nanovdb::TreeData<3>);
inline constexpr std::size_t nvdb_tiles_at = nvdb_root_at + sizeof(NvdbRoot);

// The number of the root's tiles lies behind its bounds.
inline constexpr std::size_t nvdb_root_tiles = sizeof(nanovdb::CoordBBox);

// Memory for nodes, aligned as they are.
struct alignas(32) NvdbUnit {
    std::array<char, 32> bytes;
};

constexpr std::uint64_t nvdb_aligned(std::uint64_t bytes) { return (bytes + 31) / 32 * 32; }

// Returns the bytes of a leaf of a grid type, or 0 if skybake does not use the type.
constexpr std::size_t nvdb_leaf_bytes(nanovdb::GridType type) {
    switch (type) {
        case nanovdb::GridType::Float:
            return sizeof(NvdbLeaf<float>);
        case nanovdb::GridType::Fp8:
            return sizeof(NvdbLeaf<nanovdb::Fp8>);
        case nanovdb::GridType::Fp16:
            return sizeof(NvdbLeaf<nanovdb::Fp16>);
        default:
            return 0;
    }
}

}  // namespace skybake
