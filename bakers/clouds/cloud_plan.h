// A cloud prepared for its kernels: noises planned for its voxels, tables over height, constants as
// floats, and the bounds that prove regions empty. A plan is made once per bake and then only read.
// Maps over the ground plan and height profiles are here too.
//
// At a voxel, n is the base noise or, in a cloud of a volume, the volume's density, for which P is 1; d the detail noise clamped to [0, 1], and h the height in [0,
// 1]:
//
//   With streaks n and d are those of the topmost slice at (x + fall(h), y), the fall being streaks (1 - h)^2
//   in whole voxels: the way of what falls evenly through wind that grows with height (Marshall 1953).
//
//   b = n max(0, P(h) + T) + (c - 1)       profile, Gaussian towers, coverage; Olajos 2016
//                                          where c = 1
//
//   e = s(h) (d + w(h) (1 - 2 d))          wisps where w = 0, billows where w = 1
//
//   v = max(0, (b - e) / (1 - e))          remap(b, e, 1, 0, 1), Schneider and Vos 2015
//
//   density = min(1, v / full_at) smoothstep(t, t + softness, v), times h^(2/3) with water = "rising"
//
//                                          threshold_at = "bake"; without full_at v in place of the
//                                          minimum; threshold_at = "runtime": v itself
//
// The density is 0 where b <= t (b <= 0 for threshold_at = "runtime"): erosion only removes. Velocities are
// those of flow_field.h where it is not 0, and 0 elsewhere.
//
// b is remap(x, 1 - c, 1, 0, 1) c with x = n (P + T) (Schneider 2017, Nubis), multiplied out: it
// has no pole at c = 0, and leaves nothing there where x <= 1. s goes linearly from erosion[0] at
// the base to erosion[1] at the top, w from 0 at the base to 1 at wisp_height.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "bakers/clouds/flow_field.h"
#include "bakers/clouds/resampled_volume.h"
#include "bakers/clouds/tower_field.h"
#include "bakers/field/image.h"
#include "bakers/noise/noise_field.h"
#include "config/sections/cloud.h"
#include "config/sections/noise.h"

namespace skybake::cloud {

// Looks up a map that covers a cloud's ground plan.
//
//   linear    m(u, v) = (1 - t) ((1 - s) m00 + s m10) + t ((1 - s) m01 + s m11)
//   nearest   m(u, v) = the pixel that (u, v) lies in
//
// u runs along x, from the first column to the last; v runs along y, from the picture's first row
// down, so that row 0 begins at v = 0. The centre of pixel (i, j) is ((i + 1/2) / width, (j + 1/2)
// / height). s and t are the distances in pixels from the nearest centres before (u, v).
class MapLookup {
  public:
    // `image` must have at least one pixel.
    MapLookup(MapImage image, config::MapWrap wrap, config::MapFilter filter);

    // Returns the value at any finite (u, v). It is within the range of the surrounding pixels, and
    // exactly their value where they are all equal. Outside [0, 1] the picture repeats or its edge
    // continues, according to `wrap`. May be called from any thread.
    double at(double u, double v) const;

  private:
    double pixel(int x, int y) const;

    std::shared_ptr<const MapImage> image_;  // copies share it
    config::MapWrap wrap_;
    config::MapFilter filter_;
};

// The constants of one slice z, as floats.
struct SliceShape {
    std::array<float, 3> profile{};  // with a type map the three classic ones; else profile[0]
    float erosion = 0;               // s
    float billow = 1;                // w
    float water = 1;                 // factor of the density
};

struct CloudPlan {
    std::array<int, 3> size{};
    std::shared_ptr<const noise::NoiseField> base;  // null: `volume` is in its place
    std::shared_ptr<const ResampledVolume> volume;
    std::shared_ptr<const FlowField>
        flow;  // of the plain channels of a cloud that grows; null: none
    std::shared_ptr<const noise::NoiseField> detail;  // null: none
    std::vector<SliceShape> slices;                   // one per z
    std::vector<int> fall;  // of each slice, in voxels along x; empty: nothing falls
    TowerField towers;
    double coverage = 1;
    std::optional<MapLookup> coverage_map;
    std::optional<MapLookup> type_map;  // if set, profiles are blended per column
    float threshold = 0;
    float inverse_softness = 0;  // 0: softness 0
    float inverse_full = 0;      // 1 / full_at; 0: none
    bool threshold_in_file = true;
    int channels = 1;
    int shaped_channels = 1;  // how many first channels are shaped; the others are plain noise
    float noise_bound = 0;    // upper bound of the base noise of shaped channels, as a float

    // Fills a box with n, in all its channels, and with d.
    void fill_shape(const VoxelBox& box, const std::vector<float*>& values) const;
    void fill_detail(const VoxelBox& box, float* values) const;
    // Returns true only if the cloud is known to be empty in a box, besides what noise_bound says.
    bool is_empty(const VoxelBox& box) const { return volume && volume->is_empty(box); }

    // The density is 0 where b is not above this level.
    float level() const { return threshold_in_file ? threshold : 0; }
};

// The maps that the cloud names, already read.
struct CloudMaps {
    std::optional<MapLookup> coverage;
    std::optional<MapLookup> type;
};

// Makes the plan. `base` and `detail` are the noises that the cloud names; `detail` is null if it
// names none.
CloudPlan make_cloud_plan(const Cloud& cloud, const Noise& base, const Noise* detail,
                          const std::array<int, 3>& size, CloudMaps maps);

// Makes the plan of a cloud of a volume.
CloudPlan make_cloud_plan(const Cloud& cloud, const CloudVolume& volume, const Noise* detail,
                          const std::array<int, 3>& size, CloudMaps maps);

// Returns the noise as a cloud samples it: with frequencies multiplied by `scale`, at voxel
// centres, and only the first channel for a cloud of one channel.
Noise cloud_noise(const Noise& noise, const std::array<int, 3>& scale,
                  config::CloudChannels channels);

// The height profile is the factor that gives the noise a base, a body and a top.

// Returns the profiles of the three classic types, stratus, stratocumulus and cumulus, at height h,
// 0 at the base and 1 at the top. Each rises and falls smoothly between four heights (Schneider and
// Vos 2015, "The Real-Time Volumetric Cloudscapes of Horizon: Zero Dawn", show them in figures; the
// heights are those of its open implementations). Values are in [0, 1], and 0 at and beyond the
// ends.
std::array<double, 3> classic_profiles(double h);

// Returns the weights of the three types for a cloud type in [0, 1]: 0 is stratus, 1/2
// stratocumulus and 1 cumulus.
std::array<double, 3> type_weights(double cloud_type);

// Returns the profile at h in [0, 1] for profiles that do not depend on a map; a blended profile uses
// its own cloud_type. Only a table can make it negative.
//
//   thesis   (1 - exp(-b h)) exp(-f h), at most 0.751882 for b = 50, f = 4 (Olajos 2016)
double height_profile(const config::HeightProfile& profile, double h);

}  // namespace skybake::cloud
