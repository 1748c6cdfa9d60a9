// What a bake will take, before it is made.
#pragma once

#include <vector>

#include "config/parameters.h"

namespace skybake {

// Rough: for people and for limits, not for results.
struct Estimate {
    std::vector<int> size;  // 0 x 0 where max_error will choose it
    double seconds = 0;     // on one thread of a machine of 2022
    double memory_mib = 0;
    double disk_mib = 0;
};

Estimate estimate_transmittance(const config::Parameters& parameters, const config::Bake& bake);
Estimate estimate_multiple_scattering(const config::Parameters& parameters,
                                      const config::Bake& bake);
Estimate estimate_sky_view(const config::Parameters& parameters, const config::Bake& bake);
Estimate estimate_aerial_perspective(const config::Parameters& parameters,
                                     const config::Bake& bake);
Estimate estimate_phase(const config::Parameters& parameters, const config::Bake& bake);
Estimate estimate_bruneton(const config::Parameters& parameters, const config::Bake& bake);
Estimate estimate_columns(const config::Parameters& parameters, const config::Bake& bake);
Estimate estimate_irradiance(const config::Parameters& parameters, const config::Bake& bake);
Estimate estimate_noise_volume(const config::Parameters& parameters, const config::Bake& bake);

// As if the cloud filled its box: what of it is empty takes less.
Estimate estimate_cloud_volume(const config::Parameters& parameters, const config::Bake& bake);

Estimate estimate_occupancy(const config::Parameters& parameters, const config::Bake& bake);

}  // namespace skybake
