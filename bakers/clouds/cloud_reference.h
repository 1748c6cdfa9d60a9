// A cloud by its definition (cloud_plan.h) in double precision, point by point: the reference from
// which the errors of texels and lookups are measured. Towers are summed down to terms of e^-40,
// and profiles use the C library. It shares only the lattice's random numbers and the maps' pixels
// with the kernels.
#pragma once

#include <array>
#include <vector>

#include "bakers/clouds/cloud_plan.h"
#include "config/sections/cloud.h"
#include "config/sections/noise.h"

namespace skybake::cloud {

double height_profile_reference(const config::HeightProfile& profile, double h);

class CloudReference {
  public:
    // The arguments are those of make_cloud_plan, with the noises as the recipe defines them.
    CloudReference(const Cloud& cloud, const Noise& base, const Noise* detail,
                   const std::array<int, 3>& size, CloudMaps maps);

    // Makes the reference of a volume's cloud.
    CloudReference(const Cloud& cloud, const CloudVolume& volume, const Noise* detail,
                   const std::array<int, 3>& size, CloudMaps maps);

    // True if a point takes more than a millisecond.
    bool is_expensive() const;

    // Returns all channels at a place: x and y in tiles, h in [0, 1].
    std::vector<double> operator()(const std::array<double, 3>& place) const;

  private:
    CloudReference(const Cloud& cloud, const Noise* detail, const std::array<int, 3>& size,
                   CloudMaps maps);
    std::array<double, 3> noise_place(const std::array<double, 3>& place) const;
    double profile_at(double x, double y, double h) const;
    double shaped(const std::array<double, 3>& place, double base_noise) const;

    Cloud cloud_;
    std::array<int, 3> size_;
    std::vector<config::Tower> towers_;
    std::optional<Noise> base_;  // none: `volume_` is in its place
    std::optional<VolumeReference> volume_;
    std::shared_ptr<const convection::GrownCloud> flow_;
    std::optional<Noise> detail_;
    CloudMaps maps_;
};

}  // namespace skybake::cloud
