// Volumes as EXR images, written and read in bounded memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "bakers/field/volume.h"
#include "bakers/io/formats/exr/exr.h"
#include "bakers/io/formats/exr/exr_rows.h"
#include "bakers/io/formats/volume_layout.h"
#include "bakers/math/progress.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Writes volume.levels[level], which has been surveyed, into an existing file as the volume's
// layout says; cells of an atlas without a slice are 0. Boxes are made, converted and compressed in
// parallel; the bytes do not depend on the number of threads. True when the file is complete, false
// once progress->cancelled(). E0301 with the system's reason; E0500: a pixel type that EXR does not
// have, or an image of more than 2^31 - 1 rows or columns.
config::Outcome<bool> write_exr_volume(const BakedVolume& volume, int level,
                                       const Attributes& attributes, int threads,
                                       Progress* progress, const std::filesystem::path& path);

// Takes voxels `first` ... `first + count - 1` in the order x, y, z, channels interleaved; false
// ends the reading.
using VoxelVisitor =
    std::function<bool(std::int64_t first, std::int64_t count, const float* values)>;

// Hands all voxels of an image to `visit`, piece after piece. The image has the size that the
// layout gives. False once visit returned false. E0300, E0304.
config::Outcome<bool> read_exr_volume(ExrRows& image, const std::array<int, 3>& size,
                                      const SliceLayout& layout, const VoxelVisitor& visit);

}  // namespace skybake
