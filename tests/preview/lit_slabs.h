// Slabs of cloud in hazy air, and the light of both put together from its parts: each is computed along
// the ray itself. Directions have z upwards.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "bakers/light/sky_radiance.h"
#include "bakers/march/cloud_light.h"
#include "tests/preview/clouds.h"
#include "tests/support/air_ray.h"

namespace skybake::test {

// Haze that dims a cloud some kilometres away by a third, over bright ground.
inline const std::vector<std::string> kHaze = {"atmosphere.layers.mie.scattering=\"0.1 /km\"",
                                               "atmosphere.layers.mie.extinction=\"0.105 /km\"",
                                               "atmosphere.ground_albedo=0.5"};

// A slab of 4 x 4 km and 500 m.
struct Slab {
    double base_m;
    double optical_depth;

    CloudMedium medium() const {
        return medium_of({4000, 4000, 500}, base_m, {8, 8, 32},
                         std::vector<float>(8 * 8 * 32, 1.0F), optical_depth / 500, 4);
    }
    // The share of diffuse light that passes it (Bohren 1987).
    double through() const {
        const double g = mean_cosine(droplet_phase(kDropletDiameter_um));
        return 2 / (2 + (1 - g) * optical_depth);
    }
};

// The light of the air along any ray, under a sun.
struct LightOfAir {
    const Shell shell;
    const SkyIntegrator& integrator;
    const glm::dvec3 sun;
    // Sunlight at an altitude where r mu = `s_km` towards the sun, forward peaks as the light has them.
    const std::function<Spectrum(double altitude_km, double s_km)> sun_transmittance;

    // The ray from an altitude along a direction.
    SkyRay ray(double altitude_km, const glm::dvec3& direction) const {
        return air_ray(shell, altitude_km, direction.z, sun.z, glm::dot(direction, sun));
    }

    Spectrum sunlight(double altitude_km) const {
        return sun_transmittance(altitude_km, (shell.ground_radius_km + altitude_km) * sun.z);
    }

    // The mean over directions, spread evenly over a hemisphere along a spiral; or pi times the mean
    // of the radiance times the cosine, which is the irradiance.
    enum class Mean { radiance, irradiance };
    Spectrum of_hemisphere(double altitude_km, bool upper, Mean mean = Mean::radiance) const {
        constexpr int kDirections = 400;
        Spectrum sum{};
        for (int i = 0; i < kDirections; ++i) {
            const double up = (i + 0.5) / kDirections;
            const double level = std::sqrt(1 - up * up);
            const double turn = 2.399963229728653 * i + 0.123;
            const glm::dvec3 direction(level * std::cos(turn), level * std::sin(turn),
                                       upper ? up : -up);
            sum += (mean == Mean::irradiance ? 2 * std::numbers::pi * up : 1.0) *
                   integrator.radiance(ray(altitude_km, direction)).total();
        }
        return sum / double{kDirections};
    }

    // Returns the light on a slab, of those that are listed from the highest down, times what its
    // march finds: a SeenLayer or a ReferenceLayer.
    template <class Layer>
    Spectrum of_slab(const std::vector<Slab>& slabs, std::size_t slab, const Layer& seen) const {
        double above = 1;
        double all = 1;
        for (std::size_t l = 0; l < slabs.size(); ++l) {
            if (l < slab) above *= slabs[l].through();
            all *= slabs[l].through();
        }
        const double base_km = slabs[slab].base_m / 1000;
        return sunlight(base_km) * seen.sun_at_base + sunlight(base_km + 0.5) * seen.sun_at_top +
               above * of_hemisphere(base_km + 0.5, true) * seen.from_sky +
               all * of_hemisphere(base_km, false) * seen.from_ground;
    }

    // Returns the light of all slabs along a ray, through the air before them. The air before a slab
    // sends the share of its light that the slab's opacity has (Hillaire 2016).
    template <class Layer>
    Spectrum of_slabs(const std::vector<Slab>& slabs, const std::vector<Layer>& seen,
                      const SkyRay& along) const {
        Spectrum sum{};
        for (std::size_t l = 0; l < slabs.size(); ++l) {
            const double opacity = seen[l].opacity;
            if (opacity == 0) continue;
            const double distance_km = seen[l].distance_m / opacity / 1000;
            const auto air =
                integrator.up_to(along, {std::min(distance_km, along.length_km), along.length_km});
            const Spectrum share =
                (Spectrum(1.0) - air[0].transmittance) / (Spectrum(1.0) - air[1].transmittance);
            sum += air[0].transmittance * of_slab(slabs, l, seen[l]) +
                   opacity * share * air[1].total();
        }
        return sum;
    }
};

}  // namespace skybake::test
