// What a cloud is to its kernels: noises planned for its voxels, tables over height, constants as
// floats, and the bounds that prove regions empty. Made once per bake, then only read.
//
// At a voxel, with n the base noise, d the detail noise clamped to [0, 1], h the height in [0, 1]:
//
//   b = n (P(h) + T) + (c - 1)             profile, towers, coverage; Olajos 2016 where c = 1
//
//   e = s(h) (d + w(h) (1 - 2 d))          wisps where w = 0, billows where w = 1
//
//   v = max(0, (b - e) / (1 - e))          remap(b, e, 1, 0, 1), Schneider and Vos 2015
//
//   density = min(1, v / full_at) smoothstep(t, t + softness, v)
//
//                                          threshold_at = "bake"; without full_at v in place of the
//                                          minimum; threshold_at = "runtime": v itself
//
// and nothing where b <= t (b <= 0 for threshold_at = "runtime"): erosion takes away.
//
// b - (1 - c) is remap(b, 1 - c, 1, 0, 1) c (Schneider 2017, Nubis) multiplied out: it has no pole
// at c = 0, and leaves nothing there where n (P + T) <= 1. s goes linearly from erosion[0] at the
// base to erosion[1] at the top, w from 0 at the base to 1 at wisp_height.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "bakers/clouds/tower_field.h"
#include "bakers/field/image.h"
#include "bakers/noise/noise_field.h"
#include "config/sections/cloud.h"
#include "config/sections/noise.h"

namespace skybake::cloud {

// Lookups in a map that lies over a cloud's ground plan.
//
//   linear    m(u, v) = (1 - t) ((1 - s) m00 + s m10) + t ((1 - s) m01 + s m11)
//   nearest   m(u, v) = the pixel that (u, v) lies in
//
// u runs along x, from the first column to the last, v along y, from the picture's first row down:
// row 0 begins at v = 0. Pixel (i, j) has its centre at ((i + 1/2) / width, (j + 1/2) / height);
// s and t are the distances to the centres before (u, v), in pixels.
class MapLookup {
  public:
    // `image` has at least one pixel.
    MapLookup(MapImage image, config::MapWrap wrap, config::MapFilter filter);

    // The value at any finite (u, v): never beyond the values of the pixels about it, and just
    // theirs where they are all the same. Outside of [0, 1] the picture repeats, or its edge goes
    // on. Any number of threads may ask.
    double at(double u, double v) const;

  private:
    double pixel(int x, int y) const;

    MapImage image_;
    config::MapWrap wrap_;
    config::MapFilter filter_;
};

// The constants of one slice z, as floats.
struct SliceShape {
    std::array<float, 3> profile{};  // blended by a map: the three classic ones; else profile[0]
    float erosion = 0;               // s
    float billow = 1;                // w
};

struct CloudPlan {
    std::array<int, 3> size{};
    std::shared_ptr<const noise::NoiseField> base;
    std::shared_ptr<const noise::NoiseField> detail;  // null: none
    std::vector<SliceShape> slices;                   // one per z
    TowerField towers;
    double coverage = 1;
    std::optional<MapLookup> coverage_map;
    std::optional<MapLookup> type_map;  // then profiles are blended per column
    float threshold = 0;
    float inverse_softness = 0;  // 0: softness 0
    float inverse_full = 0;      // 1 / full_at; 0: none
    bool threshold_in_file = true;
    int channels = 1;
    int shaped_channels = 1;  // the first so many; others are the noise as it is
    float noise_bound = 0;    // no base noise of a shaped channel, as a float, is greater

    // Where b is not above this, there is nothing.
    float level() const { return threshold_in_file ? threshold : 0; }
};

// Maps that the cloud names, already read.
struct CloudMaps {
    std::optional<MapLookup> coverage;
    std::optional<MapLookup> type;
};

// `base` and `detail` are the noises that the cloud names; detail is null where it names none.
CloudPlan make_cloud_plan(const config::Cloud& cloud, const config::Noise& base,
                          const config::Noise* detail, const std::array<int, 3>& size,
                          CloudMaps maps);

// The noise as a cloud samples it: frequencies times `scale`, at voxel centres; for a cloud of one
// channel only the first.
config::Noise cloud_noise(const config::Noise& noise, const std::array<int, 3>& scale,
                          config::CloudChannels channels);

// How full a cloud is by height: the factor that gives noise a base, a body and a top.

// Profiles of the three classic types at height h, 0 at the base and 1 at the top: stratus,
// stratocumulus, cumulus. Each rises and falls smoothly between four heights (Schneider and Vos
// 2015, "The Real-Time Volumetric Cloudscapes of Horizon: Zero Dawn", draw them; the heights are
// those of the open implementations of it). In [0, 1]; 0 at and beyond the ends.
std::array<double, 3> classic_profiles(double h);

// Weights of the three for a cloud type in [0, 1]: 0 stratus, 1/2 stratocumulus, 1 cumulus.
std::array<double, 3> type_weights(double cloud_type);

// The profile at h in [0, 1] for profiles that do not depend on a map; blended: with its own
// cloud_type. At least 0.
//
//   thesis   (1 - exp(-b h)) exp(-f h), at most 0.751882 for b = 50, f = 4 (Olajos 2016)
double height_profile(const config::HeightProfile& profile, double h);

}  // namespace skybake::cloud
