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

#include "bakers/clouds/map_lookup.h"
#include "bakers/clouds/tower_field.h"
#include "bakers/noise/noise_field.h"
#include "config/sections/cloud.h"
#include "config/sections/noise.h"

namespace skybake::cloud {

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

}  // namespace skybake::cloud
