#include "bakers/light/solver/peaked_light.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

#include "bakers/air/optical_depth.h"
#include "bakers/air/transmittance_field.h"
#include "bakers/light/solver/first_light.h"
#include "bakers/light/solver/needed_degrees.h"
#include "bakers/light/solver/reading_levels.h"
#include "bakers/light/solver/residual_search.h"
#include "bakers/light/solver/solution_levels.h"
#include "bakers/light/solver/transport.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

constexpr int kLastOrders = 2;

// The numbers of zenith angles that moments of a degree need: for light scattered once, which is
// peaked itself, and for light scattered more often.
int zenith_nodes_of_first(int degree, int least) { return std::max(least, degree * 3 / 4); }
int zenith_nodes_of_last(int degree, int least) { return std::max(least, degree / 2); }

// Light that is scattered once, to a degree.
struct FirstLight {
    FirstLight(const SkyMedium& of, int to)
        : medium(of), degree(to), phases(phases_from_sun(of, to)) {}

    // Writes the moments of a level, and 0 beyond the degree.
    void gather(const FirstFans& fans, const TransmittanceField& sunlight, const SunAxis& suns,
                LightField& field, int level, double* sky_irradiance) const {
        LightField found(1, field.suns, degree);
        gather_first_light(medium, phases, fans, sunlight, suns, degree, found.at(0, 0),
                           sky_irradiance);
        for (int sun = 0; sun < field.suns; ++sun) {
            std::copy_n(found.at(0, sun), found.sun_size(), field.at(level, sun));
        }
    }

    const SkyMedium& medium;
    int degree;
    std::vector<SplitPhase> phases;
};

// Returns the moments that refining begins with: those of the first solution, and beyond its degree
// those of light scattered once.
LightField completed(const LightField& solution, LightField once) {
    copy_moments(solution, once);
    return once;
}

// Where a channel's mean is below 0, which no light is, all its moments become those of `before`.
void keep_where_negative(const LightField& before, LightField& refined) {
    const std::size_t size = refined.sun_size();
    for (std::size_t i = 0; i < refined.moments.size(); i += size) {
        for (std::size_t c = 0; c < kMaxChannels; ++c) {
            if (refined.moments[i + c] >= 0) continue;
            for (std::size_t k = i + c; k < i + size; k += kChannelSlots) {
                refined.moments[k] = before.moments[k];
            }
        }
    }
    for (std::size_t i = 0; i < refined.sky_irradiance.size(); ++i) {
        if (refined.sky_irradiance[i] < 0) refined.sky_irradiance[i] = before.sky_irradiance[i];
    }
}

}  // namespace

void add_forward_light(const SkyMedium& medium, const SkyMedium& scaled, SolvedLight& light) {
    const Shell shell = shell_of(medium.air);
    for (int level = 0; level < light.light.levels; ++level) {
        const double altitude = light.altitudes_km[static_cast<std::size_t>(level)];
        const double r = shell.ground_radius_km + altitude;
        const double horizon_km = horizon_distance_km(shell, altitude);
        for (int sun = 0; sun < light.suns.count(); ++sun) {
            const double mu = light.suns.cosines[static_cast<std::size_t>(sun)];
            if (r * mu < -horizon_km) continue;
            const Spectrum forward =
                exponential(-optical_depth_to_top(scaled.air, altitude, r * mu)) -
                exponential(-optical_depth_to_top(medium.air, altitude, r * mu));
            add_light_about_sun(
                std::vector<Spectrum>(static_cast<std::size_t>(light.degree()) + 1, forward), mu,
                light.light.at(level, sun));
            for (std::size_t c = 0; level == 0 && c < kMaxChannels; ++c) {
                light.light.sky_irradiance[static_cast<std::size_t>(sun) * kChannelSlots + c] +=
                    std::max(mu, 0.0) * forward[c];
            }
        }
    }
}

void refine_light(const SkyMedium& medium, const SolverSettings& settings, int threads,
                  Progress* progress, SolvedLight& light) {
    assert(settings.degree >= light.degree());
    const int levels = light.light.levels;
    const TransmittanceField sunlight =
        tabulated_sunlight(medium.air, light.altitudes_km, settings.sunlight, threads);
    const ReadingLevels reading(medium.air, light.altitudes_km);
    const LayerMoments moments(medium, settings.degree, reading.altitudes_km());
    LightField first(levels, settings.suns, settings.degree);
    const auto irradiance_of = [](LightField& field, int level) {
        return level == 0 ? field.sky_irradiance.data() : nullptr;
    };
    std::vector<RayFan> fans(static_cast<std::size_t>(levels));
    const FirstLight high(medium, settings.degree);
    const FirstLight low(medium, std::min(kDegreeOfHaze, settings.degree));
    parallel_for(levels, threads, [&](int level) {
        if (is_cancelled(progress)) return;
        const int at = reading.index_of(level);
        const int degree = moments.degrees[static_cast<std::size_t>(at)];
        const FirstLight& needed = degree > kDegreeOfHaze ? high : low;
        const int nodes = zenith_nodes_of_last(degree > kDegreeOfAir ? settings.degree : low.degree,
                                               settings.zenith_nodes);
        const int first_nodes = zenith_nodes_of_first(needed.degree, settings.zenith_nodes);
        FirstFans first_fans = make_first_fans(medium, reading.altitudes_km(), at, first_nodes,
                                               settings.ray_tolerance);
        needed.gather(first_fans, sunlight, light.suns, first, level, irradiance_of(first, level));
        fans[static_cast<std::size_t>(level)] =
            first_nodes == nodes
                ? std::move(first_fans.day)
                : make_ray_fan(medium, reading.altitudes_km(), at, nodes, settings.ray_tolerance);
    });
    SteepSuns steep(light.steep);
    steep.follow(reading.read_light(light.light));
    LightField last = completed(light.light, first);
    for (int order = 0; order < kLastOrders; ++order) {
        LightField next(levels, settings.suns, settings.degree);
        const auto before = reading.blocks_of<float>(last, threads);
        parallel_for(levels, threads, [&](int level) {
            if (is_cancelled(progress)) return;
            const RayFan& fan = fans[static_cast<std::size_t>(level)];
            apply_transport(make_level_transport<float>(medium, fan, moments), light.suns, steep,
                            before, next.at(level, 0), irradiance_of(next, level));
        });
        add(first, next);
        last = std::move(next);
        ++light.applications;
    }
    keep_where_negative(completed(light.light, std::move(first)), last);
    light.light = std::move(last);
}

}  // namespace skybake
