#include "bakers/light/solver/solve_light.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <vector>

#include "bakers/air/optical_depth.h"
#include "bakers/air/transmittance_field.h"
#include "bakers/light/solver/accelerated_orders.h"
#include "bakers/light/solver/first_light.h"
#include "bakers/light/solver/transport.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

// Light that falls faster than this from column to column is taken as linear between them.
constexpr double kSteepest = 4;

// Where light of one of the channels falls too fast for cubics, at any level: a column's 1 stands
// for the stencil that begins there.
std::vector<double> steep_columns(const LightField& light, int channels) {
    std::vector<double> steep(static_cast<std::size_t>(light.suns));
    for (int level = 0; level < light.levels; ++level) {
        for (int sun = 0; sun + 3 < light.suns; ++sun) {
            for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
                for (int j = 0; j < 3; ++j) {
                    const double low = light.at(level, sun + j)[c];
                    const double high = light.at(level, sun + j + 1)[c];
                    if (!(std::max(low, high) < kSteepest * std::min(low, high))) {
                        steep[static_cast<std::size_t>(sun)] = 1;
                    }
                }
            }
        }
    }
    return steep;
}

// Of two successive orders in the long run. In a slab of depth t that absorbs nothing the slowest
// mode of diffusion loses pi^2 / 3 t^2 an order, over a white ground a quarter of that; this is
// less.
double slowest_ratio(const Medium& air) {
    const Spectrum depth = optical_depth_to_top(air, 0, air.ground_radius_km);
    double inverse_loss = 0;
    for (std::size_t c = 0; c < kMaxChannels; ++c) {
        inverse_loss =
            std::max(inverse_loss, 2 + (1 + 3 * air.ground_albedo[c]) * depth[c] * depth[c]);
    }
    return 1 - 1 / inverse_loss;
}

}  // namespace

SolverSettings finer(SolverSettings settings) {
    settings.level_scale *= 1.25;
    settings.zenith_nodes = settings.zenith_nodes * 3 / 2;
    settings.ray_tolerance *= 0.7;
    return settings;
}

SolvedLight solve_light(const SkyMedium& medium, const SolverSettings& settings, int threads,
                        Progress* progress) {
    assert(settings.degree >= 2 && settings.suns >= 8 && settings.suns % 8 == 0);
    assert(settings.orders >= 0);
    SolvedLight solved;
    solved.channels = medium.air.channels;
    solved.altitudes_km = solution_levels_km(medium.air, settings.level_scale);
    solved.suns = make_sun_axis(shell_of(medium.air), settings.suns);
    const int levels = static_cast<int>(solved.altitudes_km.size());
    const TransmittanceField sunlight(medium.air, solved.altitudes_km, settings.sunlight, threads);

    LightField first(levels, settings.suns, settings.degree);
    const std::vector<SplitPhase> phases = split_phases(medium, settings.degree);
    std::vector<LevelTransport> transports(static_cast<std::size_t>(levels));
    parallel_for(levels, threads, [&](int level) {
        const RayFan fan = make_ray_fan(medium, solved.altitudes_km, level, settings.zenith_nodes,
                                        settings.ray_tolerance);
        gather_first_light(medium, phases, fan, sunlight, solved.suns, settings.degree,
                           first.at(level, 0), level == 0 ? first.sky_irradiance.data() : nullptr);
        transports[static_cast<std::size_t>(level)] =
            make_level_transport(medium, fan, settings.degree);
    });
    solved.steep = steep_columns(first, solved.channels);
    const auto next = [&](const LightField& light, LightField& image) {
        parallel_for(levels, threads, [&](int level) {
            apply_transport(transports[static_cast<std::size_t>(level)], solved.suns, solved.steep,
                            light, image.at(level, 0),
                            level == 0 ? image.sky_irradiance.data() : nullptr);
        });
    };
    if (settings.orders > 0) {
        OrderSum sum = sum_of_first_orders(first, next, settings.orders, progress);
        solved.light = std::move(sum.light);
        solved.applications = sum.applications;
        return solved;
    }
    OrderSum sum = sum_of_orders(first, next,
                                 {slowest_ratio(medium.air), settings.tolerance,
                                  settings.plain_orders, settings.most_applications},
                                 progress);
    solved.light = std::move(sum.light);
    solved.applications = sum.applications;
    solved.left_out = sum.left_out;
    return solved;
}

namespace {

struct RememberedLight {
    SkyMedium medium;
    SolverSettings settings;
    std::shared_ptr<const SolvedLight> light;
};

}  // namespace

std::shared_ptr<const SolvedLight> remembered_light(const SkyMedium& medium,
                                                    const SolverSettings& settings, int threads,
                                                    Progress* progress) {
    static std::mutex mutex;
    static RememberedLight last;
    {
        const std::lock_guard lock(mutex);
        if (last.light && last.settings == settings && last.medium == medium) return last.light;
    }
    // Not under the lock: solving waits for threads, which may ask for light too.
    auto light =
        std::make_shared<const SolvedLight>(solve_light(medium, settings, threads, progress));
    if (progress && progress->cancelled()) return light;
    const std::lock_guard lock(mutex);
    last = {medium, settings, light};
    return light;
}

namespace {

// Levels per scale height at the ground, and the scale heights over which they thin out by e.
constexpr double kPerScaleHeight = 4;
constexpr double kThinningScaleHeights = 2.5;
constexpr double kOverTheShell = 8;
constexpr double kPerPiece = 3;
constexpr double kPerOpticalDepth = 2;
constexpr double kMostPerOpticalDepth = 80;  // in all
constexpr int kBlockSamples = 64;            // of a block, to place its levels

double levels_per_km(const Medium& medium, double altitude_km) {
    double density = kOverTheShell / medium.thickness_km;
    for (const ExponentialLayer& layer : medium.exponential_layers) {
        const double reach = kThinningScaleHeights * layer.scale_height_km;
        density += kPerScaleHeight / layer.scale_height_km * exponential(-altitude_km / reach);
    }
    for (const PiecewiseLayer& layer : medium.piecewise_layers) {
        for (const LinearPiece& piece : layer.pieces) {
            if (altitude_km > piece.bottom_km && altitude_km < piece.top_km) {
                density += kPerPiece / (piece.top_km - piece.bottom_km);
            }
        }
    }
    return density;
}

double largest_extinction(const Medium& medium, double altitude_km) {
    return largest(extinction_at(medium, altitude_km));
}

}  // namespace

std::vector<double> solution_levels_km(const Medium& medium, double scale) {
    std::vector<double> blocks = kink_altitudes_km(medium);
    blocks.push_back(0);
    blocks.push_back(medium.thickness_km);
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());

    // Samples are closest at each block's bottom, where exponential air is densest.
    const auto sample = [&](std::size_t block, double i) {
        const double y = i / kBlockSamples;
        return blocks[block] + (blocks[block + 1] - blocks[block]) * y * y;
    };
    double depth = 0;
    for (std::size_t b = 0; b + 1 < blocks.size(); ++b) {
        for (int i = 0; i < kBlockSamples; ++i) {
            depth +=
                largest_extinction(medium, sample(b, i + 0.5)) * (sample(b, i + 1) - sample(b, i));
        }
    }
    const double per_depth =
        depth > 0 ? std::min(kPerOpticalDepth, kMostPerOpticalDepth / depth) : 0.0;

    std::vector<double> levels = {0};
    for (std::size_t b = 0; b + 1 < blocks.size(); ++b) {
        std::vector<double> count = {0};  // of levels up to each sample
        for (int i = 0; i < kBlockSamples; ++i) {
            const double middle = sample(b, i + 0.5);
            const double per_km =
                levels_per_km(medium, middle) + per_depth * largest_extinction(medium, middle);
            count.push_back(count.back() + scale * per_km * (sample(b, i + 1) - sample(b, i)));
        }
        const int steps = std::max(1, static_cast<int>(std::ceil(count.back())));
        std::size_t at = 0;
        for (int k = 1; k < steps; ++k) {
            const double wanted = count.back() * k / steps;
            while (count[at + 1] < wanted) ++at;
            const double within = (wanted - count[at]) / (count[at + 1] - count[at]);
            levels.push_back(sample(b, static_cast<double>(at) + within));
        }
        levels.push_back(blocks[b + 1]);
    }
    return levels;
}

}  // namespace skybake
