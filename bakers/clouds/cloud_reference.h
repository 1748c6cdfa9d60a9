// A cloud by its definition (cloud_plan.h) in double precision, point by point: what texel and
// lookup errors are measured against. Towers are summed to e^-40, profiles come from
// the C library; it shares the lattice's random numbers and the maps' pixels with the kernels.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bakers/clouds/cloud_plan.h"
#include "config/sections/cloud.h"
#include "config/sections/noise.h"

namespace skybake::cloud {

// The towers' field at a place of the ground plan, in tiles.
double tower_reference(std::span<const config::Tower> towers, const std::array<double, 2>& place);

double height_profile_reference(const config::HeightProfile& profile, double h);

class CloudReference {
  public:
    // Arguments as of make_cloud_plan; noises as their recipe has them.
    CloudReference(const config::Cloud& cloud, const config::Noise& base,
                   const config::Noise* detail, CloudMaps maps);

    // Whether a point takes more than a millisecond.
    bool is_expensive() const;

    // All channels at a place: x and y in tiles, h in [0, 1].
    std::vector<double> operator()(const std::array<double, 3>& place) const;

  private:
    double shaped(const std::array<double, 3>& place, double base_noise) const;

    config::Cloud cloud_;
    std::vector<config::Tower> towers_;
    config::Noise base_;
    std::optional<config::Noise> detail_;
    CloudMaps maps_;
};

}  // namespace skybake::cloud
