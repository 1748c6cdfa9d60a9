// The voxels of a volume from a file, at the size of a cloud.
//
// Along each axis, N voxels become n. Voxel i of the result is centred at (i + 1/2) N / n in voxels of
// the source, whose voxel k reaches from k to k + 1:
//
//   n >= N   v(i) = (1 - f) s(k) + f s(k + 1),   k + f = (i + 1/2) N / n - 1/2
//   n < N    v(i) = the mean of s over i N / n ... (i + 1) N / n
//
// The first is linear interpolation between centres; for n = N it is s itself, bit for bit. The second
// keeps the mean of the volume and is a low-pass filter, so that what is finer than a voxel of the
// result does not alias into it. Weights are quotients of integers; sums are in double precision, over
// x, then y, then z, in ascending order, so a voxel does not depend on the box that it is asked for in.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "bakers/convection/convection.h"
#include "bakers/field/level.h"
#include "bakers/field/source_voxels.h"
#include "config/sections/volume.h"

namespace skybake::cloud {

// The volume that a cloud takes its density from.
struct CloudVolume {
    SourceVoxels source;
    config::VolumeWrap wrap = config::VolumeWrap::empty;  // along x and y; along z it is empty
    std::shared_ptr<const convection::GrownCloud> flow = {};  // null: it tells no velocity
};

// The voxels of the source that one voxel of the result takes along an axis, from `first` on.
struct AxisTaps {
    int first = 0;                // from -1 to N
    std::vector<double> weights;  // above 0; their sum is 1
};

// Returns the taps of all voxels of an axis: `to` voxels made of `from`.
std::vector<AxisTaps> axis_taps(int from, int to);

class ResampledVolume : public VoxelSource {
  public:
    ResampledVolume(CloudVolume volume, const std::array<int, 3>& size);

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;
    bool is_empty(const VoxelBox& box) const override;

    // No value is above it.
    float largest() const { return volume_.source.largest; }

  private:
    VoxelBox taken(const VoxelBox& box) const;
    bool source_is_empty(VoxelBox box) const;
    void read_source(const VoxelBox& box, float* values) const;

    CloudVolume volume_;
    std::array<int, 3> size_;
    std::array<std::vector<AxisTaps>, 3> taps_;
};

// The same by definition, in double precision and at any place: the reference from which errors are
// measured. It shares only the source's voxels with the class above. Where n < N it returns the mean
// over a box of the size of a voxel around the place.
class VolumeReference {
  public:
    VolumeReference(CloudVolume volume, const std::array<int, 3>& size);

    // True if a point takes more than a millisecond.
    bool is_expensive() const;
    // Returns the value at a place: x and y in tiles, the height in [0, 1].
    double operator()(const std::array<double, 3>& place) const;

  private:
    CloudVolume volume_;
    std::array<int, 3> size_;
};

}  // namespace skybake::cloud
