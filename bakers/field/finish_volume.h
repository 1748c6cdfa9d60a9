// The steps that all volume bakers share once the voxels can be made: adding levels of detail,
// statistics, range counts, hashes, probes and a certificate.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bakers/field/certify.h"
#include "bakers/field/choose_probes.h"
#include "bakers/field/conventions.h"
#include "bakers/field/level.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/pixel_types.h"

namespace skybake {

struct Baked;

// Has the voxels of level 0 held in memory by the first pass over them, as far as
// options.held_voxel_bytes allows it. Call it before levels are added. Voxels that nobody reads but who
// stores them may be held as the file has them, in half of the memory.
void hold_voxels(const BakeOptions& options, Baked& volume, bool as_stored = false);

// Adds the voxels as a level, whose axes repeat as those of the volume do.
void add_voxels(const std::array<int, 3>& size, std::shared_ptr<const VoxelSource> voxels,
                Baked& volume);

// Adds levels of detail, each the box mean of the one before, until there are `count` levels.
void add_mip_levels(int count, const BakeOptions& options, Baked& volume);

// The same, with the means of each slice by itself.
void add_slice_levels(int count, const BakeOptions& options, Baked& volume);

// Fills all channels of what lies a tile's length from a voxel along an axis.
using FillBeyond = std::function<void(std::size_t axis, const VoxelBox& voxel,
                                      const std::vector<float*>& channels)>;

// Returns the largest difference between voxels on the lower faces of the first `axes` axes and those a
// tile's length away, at some points of each face.
double seam_error(const VoxelSource& voxels, const std::array<int, 3>& size, std::size_t channels,
                  std::size_t axes, const FillBeyond& beyond);

struct VolumeFinish {
    std::vector<std::array<double, 2>> histogram_ranges;  // one per channel
    VolumeReference reference = {};                       // empty: no certificate
    std::string reference_name = {};
    bool expensive = false;  // the reference is expensive: --certify=quick takes fewer points
    // Approximates an expensive reference. It is searched for the largest errors in its place.
    VolumeReference estimate = {};
    VolumeComparison comparison = {};
    // The values to which texels were fitted, on a grid of their own. They are measured in place of the
    // texels, which are no values of any place.
    std::optional<Level> sampled = {};
    // Replaces the reference for volumes that a runtime does not look up between the eight nearest
    // voxels.
    std::function<Certificate(const Baked& volume, const BakeOptions& options)> measure = {};
    // Returns the physical place for texture coordinates of a level. The coordinates are moved to
    // the nearest ones that a runtime looks up.
    std::function<ProbePlace(const std::array<double, 3>& uvw, int level)> probe_place = {};
    // Adds covered_columns to the details: the share of columns with a stored value above this.
    std::optional<float> covered_above = {};
};

// The name of that share, in [0, 1], among the details of a volume.
inline constexpr const char* covered_columns = "covered_columns";

// The number of points at which --certify=quick measures lookups of a volume that repeats.
int quick_lookup_points(bool is_expensive);

// Surveys all levels, makes their probes, and measures level 0 against the reference unless
// options.certification is off. E0401 or E0402 if the pixel type cannot hold a voxel; E0407 if the
// probes cannot detect a wrong file. After an interruption there is neither a value nor a
// diagnostic.
Outcome<Baked> finish_volume(Baked volume, const VolumeFinish& finish, const BakeOptions& options);

// Fills in the probes and catches of a level that has been surveyed. A file of two `dimensions` is
// looked up by two coordinates, so that none can be mistaken for a third. `place` returns the physical
// place for texture coordinates; if it is empty, only texture coordinates are known. Candidate
// places lie all over the volume, at its seams, at the level's peaks and on the slopes around them.
// E0407 names `asset`.
[[nodiscard]] std::optional<Diagnostic> add_volume_probes(const std::string& asset, int dimensions,
                                                          const ProbePlaces& place, PixelType type,
                                                          const BakeOptions& options, Level& level);

}  // namespace skybake
