// The water of a cloud that has grown, at the voxels of a finer volume.
//
//   density = min(1, (q / full)^(2/3))
//
// for the condensed water q, as extinction is that of a fixed number of droplets, and the water `full` that
// a parcel holds at the inversion without mixing. Between cells q is Catmull and Rom's cubic along x, then y,
// then z, kept within the two cells that it lies between, and what dry air lacks counts below 0: an edge of
// the cloud lies where q passes 0, not where a cell ends. The coverage c of a cloud adds (c - 1) `full` to q: less than
// 1 thins it out, more than 1 lets it spread.
//
// Relief is the shape that is finer than cells. Noise d in [0, 1] moves the edge by r (2 d - 1), outwards
// where that is positive, since q falls by its slope per metre on the way out:
//
//   q + |grad q| r (2 d - 1),   r = R min(1, z / W)
//
// for R, a share of the width W of the noise's first octave along its narrowest axis, and the distance z from
// the base, where clouds are flat, or from the top, which nothing may leave, whichever is nearer. Slopes are
// central differences of cells, smoothed by (1, 2, 1) / 4 along each axis, so that an edge may move by more than a
// cell. Octaves that voxels cannot show are left out.
//
// Cells blur edges, which are some metres wide in nature and white down to their last metre. So water rises s times
// as steeply from an edge inwards, until it is what cells have b deeper within:
//
//   min(s q, q + |grad q| b),   s = 1 + b / v
//
// for the edge b of a cell and v of a voxel, over one of which the edge rises, but for what no cell of those levels
// holds.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "bakers/clouds/resampled_volume.h"
#include "bakers/convection/convection.h"
#include "bakers/field/level.h"
#include "bakers/noise/noise_field.h"
#include "config/sections/noise.h"

namespace skybake::cloud {

struct Relief {
    std::shared_ptr<const noise::NoiseField> noise;  // at the voxels of the volume; null: no relief
    double height_m = 0;                             // R
    double width_m = 1;                              // W
};

class GrownVolume : public VoxelSource {
  public:
    // `cell_m` are the edges of the cells. `size` is at least as large as the cells along each axis.
    GrownVolume(std::shared_ptr<const convection::GrownCloud> cloud,
                const std::array<double, 3>& cell_m, const std::array<int, 3>& size,
                Relief relief = {}, double coverage = 1);

    // Boxes may reach below and above the size, where there is nothing.
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;
    bool is_empty(const VoxelBox& box) const override;

  private:
    // The four cells along an axis that a voxel lies among, from `first` on.
    struct Taps {
        int first = 0;
        std::array<float, 4> weights{};
    };
    // The cells that a run of voxels takes.
    struct Cells {
        int first = 0;
        int count = 0;
    };
    const Taps& taps_at(std::size_t axis, int voxel) const {
        return taps_[axis][static_cast<std::size_t>(voxel)];
    }
    Cells cells_of(std::size_t axis, const VoxelBox& box) const;
    // Makes voxels of q or of its slopes, which are numbers at the centres of cells.
    void interpolate(const std::vector<float>& field, const VoxelBox& box, float* out) const;
    void add_relief(const VoxelBox& box, const std::vector<float>& slopes, float* water) const;
    void sharpen_edges(const VoxelBox& box, const std::vector<float>& slopes, float* water) const;
    // The water of the wettest cell of a level.
    float most_at(int z) const {
        return added_ + most_[static_cast<std::size_t>(std::clamp(z, 0, cloud_->cells[2] - 1))];
    }
    double relief_m(double z) const;  // r at the middle of slice z
    void along_x(const VoxelBox& box, const float* cells, float* out) const;
    // Makes the voxels of an axis from rows or slices of `width` numbers.
    void along(std::size_t axis, const VoxelBox& box, std::size_t width, const float* from,
               float* out) const;

    std::shared_ptr<const convection::GrownCloud> cloud_;
    std::array<int, 3> size_;
    std::array<double, 3> cell_m_;
    std::array<std::vector<Taps>, 3> taps_;
    Relief relief_;
    float added_ = 0;  // (c - 1) full, in g/kg
    std::vector<float> most_;
    float blur_m_ = 0;           // b
    float sharpness_ = 1;        // s
    std::vector<float> slopes_;  // g/kg per metre, at the centres of cells
};

// Returns the volume that a cloud takes its density from, for a bake of a size; `detail` may be null.
CloudVolume volume_of_grown(const std::shared_ptr<const convection::GrownCloud>& grown,
                            const Cloud& cloud, const Noise* detail, const std::array<int, 3>& size,
                            double coverage = 1);

}  // namespace skybake::cloud
