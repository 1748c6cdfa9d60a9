#include "bakers/plan/stored_sky.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bakers/air/ray.h"
#include "bakers/assets/sky/traced_light.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/math/parallel.h"

namespace skybake {

namespace {

// A part of a ray and its middle.
struct Step {
    double width_km = 0;
    double middle_km = 0;
};

// Returns the parts of a ray of which point `densest_km` is the lowest.
std::vector<Step> steps_of(double length_km, double densest_km, int count) {
    const double begin = -std::sqrt(densest_km);
    const double range = std::sqrt(length_km - densest_km) - begin;
    std::vector<Step> steps;
    double from = begin * std::fabs(begin);
    for (int i = 1; i <= count; ++i) {
        const double y = begin + range * i / count;
        const double to = y * std::fabs(y);
        steps.push_back({to - from, densest_km + (from + to) / 2});
        from = to;
    }
    return steps;
}

class RuntimeMarch {
  public:
    explicit RuntimeMarch(const MarchedTables& tables)
        : tables_(tables),
          shell_{tables.medium.air.ground_radius_km, tables.medium.air.thickness_km} {}

    Spectrum radiance(const SkySample& sample, int steps) const {
        const SkyRay ray =
            camera_ray(shell_, sample.altitude_km, sample.sun, sample.direction).in_air;
        if (!(ray.length_km > 0)) return {};
        const double densest_km = ray.meets_ground ? ray.length_km : std::max(-ray.s_km, 0.0);
        std::vector<Spectrum> phases;
        for (const SkyLayer& layer : tables_.medium.layers) {
            phases.push_back(first_phase_values(layer, ray.one_minus_cosine, ray.one_plus_cosine));
        }
        Spectrum radiance{};
        Spectrum throughput(1.0);
        for (const Step& step : steps_of(ray.length_km, densest_km, steps)) {
            const double altitude_km =
                std::clamp(altitude_along_km(shell_, ray.altitude_km, ray.s_km, step.middle_km),
                           0.0, shell_.thickness_km);
            const Spectrum depth = extinction_at(tables_.medium.air, altitude_km) * step.width_km;
            const Spectrum source = source_at(ray, altitude_km, step.middle_km, phases);
            for (std::size_t c = 0; c < kMaxChannels; ++c) {
                const double lost = -std::expm1(-depth[c]);
                const double mean = depth[c] > 0 ? lost / depth[c] : 1;
                radiance[c] += throughput[c] * source[c] * step.width_km * mean;
                throughput[c] *= 1 - lost;
            }
        }
        return radiance;
    }

  private:
    // Returns what a km of air sends towards the eye.
    Spectrum source_at(const SkyRay& ray, double altitude_km, double distance_km,
                       const std::vector<Spectrum>& phases) const {
        const double sun_s_km = ray.sun_s_km + distance_km * ray.cosine_to_sun;
        const Spectrum sun = sunlight(altitude_km, sun_s_km);
        Spectrum source{};
        std::vector<Spectrum> scattering(tables_.medium.layers.size());
        for (std::size_t k = 0; k < scattering.size(); ++k) {
            if (!tables_.medium.layers[k].scatters) continue;
            scattering[k] = scattering_at(tables_.medium.layers[k].alone, altitude_km);
            source += scattering[k] * phases[k] * sun;
        }
        if (tables_.orders) {
            source += tables_.orders->scattered(
                scattering_point(shell_, ray, altitude_km, sun_s_km, distance_km), scattering);
        }
        return source;
    }

    // Returns the stored transmittance towards the sun; the planet hides what is below its horizon.
    Spectrum sunlight(double altitude_km, double sun_s_km) const {
        if (sun_s_km < -horizon_distance_km(shell_, altitude_km)) return {};
        const double cosine = sun_s_km / (shell_.ground_radius_km + altitude_km);
        const std::vector<double> found =
            look_up_places(tables_.transmittance, tables_.places,
                           {{{"altitude_km", altitude_km}, {"cos_zenith", cosine}}})
                .front();
        Spectrum light{};
        for (std::size_t c = 0; c < std::min<std::size_t>(found.size(), kMaxChannels); ++c) {
            light[c] = found[c];
        }
        return light;
    }

    const MarchedTables& tables_;
    Shell shell_;
};

}  // namespace

std::vector<Spectrum> march_sky(const MarchedTables& tables, const std::vector<SkySample>& samples,
                                int steps, int threads) {
    const RuntimeMarch march(tables);
    std::vector<Spectrum> sky(samples.size());
    parallel_for(static_cast<int>(samples.size()), threads, [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        sky[at] = march.radiance(samples[at], steps);
    });
    return sky;
}

}  // namespace skybake
