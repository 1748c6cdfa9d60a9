#include "bakers/convection/convection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "bakers/convection/flow.h"
#include "bakers/math/parallel.h"

namespace skybake::convection {
namespace {

double cells_of(const Specification& wanted) {
    const auto& [x, y, z] = wanted.grid.cells;
    return double{1} * x * y * z;
}

// Names all members: it is not compiled until one that is added is named, too.
std::string text_of(const Specification& wanted) {
    const auto& [grid, mixed, sponge, base, temperature, instability, inversion, humidity, wind,
                 top, patches, width, warmth, seed, growth] = wanted;
    const auto& [cells, edges] = grid;
    return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", fmt::join(cells, " "),
                       fmt::join(edges, " "), mixed, sponge, base, temperature, instability,
                       inversion, humidity, fmt::join(wind, " "), fmt::join(top, " "), patches,
                       fmt::join(width, " "), warmth, seed, growth);
}

// Returns none after an interruption.
std::vector<float> grown_water(const Specification& wanted, int levels,
                               const BakeOptions& options) {
    Flow flow(wanted, options.threads);
    while (flow.time_s() < wanted.growth_s) {
        if (options.cancelled()) return {};
        flow.step(wanted.growth_s);
        if (options.progress == nullptr) continue;
        options.progress->advance("growing the cloud", flow.time_s() / wanted.growth_s);
    }
    const int rows = wanted.grid.cells[1];
    const auto row = static_cast<std::size_t>(wanted.grid.cells[0]);
    const std::size_t plane = row * static_cast<std::size_t>(rows);
    std::vector<float> water(plane * static_cast<std::size_t>(levels));
    parallel_for(levels, options.threads, [&](int level) {
        float* out = water.data() + static_cast<std::size_t>(level) * plane;
        for (int y = 0; y < rows; ++y, out += row) {
            flow.condensed_row(y, level + wanted.mixed_levels, out);
        }
    });
    return water;
}

}  // namespace

Specification specification_of(const Cloud& cloud) {
    const config::Convection& convection = cloud.convection;
    Specification wanted;
    std::array<double, 3> edge_m{};
    for (std::size_t i = 0; i < 3; ++i) {
        edge_m[i] = cloud.extent[i].meters / convection.cells[i];
        wanted.grid.edge_m[i] = static_cast<float>(edge_m[i]);
    }
    wanted.mixed_levels =
        std::max(2, static_cast<int>(std::lround(convection.mixed_layer.meters / edge_m[2])));
    wanted.grid.cells = convection.cells;
    wanted.sponge_levels = std::max(3, convection.cells[2] / 10);
    wanted.grid.cells[2] += wanted.mixed_levels + wanted.sponge_levels;
    wanted.base_altitude_m = cloud.base_altitude.meters;
    wanted.base_temperature_k = convection.temperature;
    wanted.instability_k_per_km = convection.instability;
    wanted.inversion_m = convection.inversion.meters;
    wanted.humidity = convection.humidity;
    wanted.wind_m_per_s = convection.wind;
    wanted.wind_top_m_per_s = convection.wind_above;
    wanted.patches = convection.patches;
    wanted.patch_width_m = {convection.patch_width[0].meters, convection.patch_width[1].meters};
    wanted.patch_warmth_k = convection.warmth;
    wanted.seed = convection.seed;
    wanted.growth_s = 60 * convection.minutes;
    return wanted;
}

std::shared_ptr<const GrownCloud> grow(const Specification& wanted, const BakeOptions& options,
                                       KeptBytes* kept) {
    auto cloud = std::make_shared<GrownCloud>();
    cloud->cells = wanted.grid.cells;
    cloud->cells[2] -= wanted.mixed_levels + wanted.sponge_levels;
    cloud->full_water = make_sounding(wanted).adiabatic_water;
    const auto& [x, y, z] = cloud->cells;
    cloud->water = kept_or_made<float>(
        kept, {"convection", kGrowthVersion, text_of(wanted)},
        static_cast<std::size_t>(x) * static_cast<std::size_t>(y) * static_cast<std::size_t>(z),
        [&] { return grown_water(wanted, cloud->cells[2], options); });
    return cloud->water.empty() ? nullptr : cloud;
}

double seconds_to_grow(const Specification& wanted) {
    constexpr double kSecondsPerCellAndStep = 1.5e-7;
    constexpr double kFastest = 20;  // m/s, over the three axes together
    const double step_s = 1.2 * double{wanted.grid.edge_m[0]} / kFastest;
    return kSecondsPerCellAndStep * cells_of(wanted) * std::max(1.0, wanted.growth_s / step_s);
}

double bytes_to_grow(const Specification& wanted) {
    constexpr double kFields = 18;
    return kFields * sizeof(float) * cells_of(wanted);
}

}  // namespace skybake::convection
