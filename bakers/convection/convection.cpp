#include "bakers/convection/convection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

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
                 top, patches, width, warmth, seed, growth, loop, velocity] = wanted;
    const auto& [cells, edges] = grid;
    return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}",
                       fmt::join(cells, " "), fmt::join(edges, " "), mixed, sponge, base,
                       temperature, instability, inversion, humidity, fmt::join(wind, " "),
                       fmt::join(top, " "), patches, fmt::join(width, " "), warmth, seed, growth,
                       loop, velocity);
}

// The moments of a loop are so close that air at this speed passes no more than a cell from one to the next.
constexpr double kSpeed_m_per_s = 7;

int moments_of(const Specification& wanted) {
    const auto& [x, y, z] = wanted.grid.edge_m;
    const double apart_s = double{std::min({x, y, z})} / kSpeed_m_per_s;
    return std::max(1, static_cast<int>(std::ceil(wanted.loop_s / apart_s)));
}

std::size_t cloudy_cells(const Specification& wanted) {
    const auto& [x, y, z] = wanted.grid.cells;
    return static_cast<std::size_t>(x) * static_cast<std::size_t>(y) *
           static_cast<std::size_t>(z - wanted.mixed_levels - wanted.sponge_levels);
}

// Numbers of a cell that are kept: its water, and the velocity along three axes.
std::size_t kept_fields(const Specification& wanted) { return wanted.keeps_velocity ? 4 : 1; }

// The water of a flow as it goes on, with its velocity.
class Growth {
  public:
    Growth(const Specification& wanted, const BakeOptions& options)
        : wanted_(wanted), options_(options), flow_(wanted, options.threads) {
        if (wanted.loop_s > 0) now_ = fields();
    }

    // Goes on until `until_s` is reached, by steps that may pass it, but not `end_s`. Returns false after an
    // interruption.
    bool advance(double until_s, double end_s) {
        while (flow_.time_s() < until_s) {
            if (options_.cancelled()) return false;
            before_s_ = flow_.time_s();
            flow_.step(end_s);
            std::swap(before_, now_);
            if (wanted_.loop_s > 0 || flow_.time_s() >= end_s) now_ = fields();
            if (options_.progress == nullptr) continue;
            options_.progress->advance("growing the cloud",
                                       flow_.time_s() / (wanted_.growth_s + wanted_.loop_s));
        }
        return true;
    }

    // Adds the share `weight` of the fields at a time within the last step.
    void add_to(float* out, double time_s, float weight) const {
        const double share = (time_s - before_s_) / (flow_.time_s() - before_s_);
        const auto later = static_cast<float>(share);
        for (std::size_t i = 0; i < now_.size(); ++i) {
            const float then = later == 1 ? now_[i] : before_[i] + later * (now_[i] - before_[i]);
            out[i] += weight * then;
        }
    }

  private:
    std::vector<float> fields() const {
        const int rows = wanted_.grid.cells[1];
        const auto row = static_cast<std::size_t>(wanted_.grid.cells[0]);
        const std::size_t plane = row * static_cast<std::size_t>(rows);
        const std::size_t cells = cloudy_cells(wanted_);
        std::vector<float> made(kept_fields(wanted_) * cells);
        parallel_for(static_cast<int>(cells / plane), options_.threads, [&](int level) {
            const int z = level + wanted_.mixed_levels;
            float* out = made.data() + static_cast<std::size_t>(level) * plane;
            for (int y = 0; y < rows; ++y, out += row) {
                flow_.condensed_row(y, z, out);
                for (std::size_t field = 1; field < kept_fields(wanted_); ++field) {
                    flow_.velocity_row(field - 1, y, z, out + field * cells);
                }
            }
        });
        return made;
    }

    Specification wanted_;
    const BakeOptions& options_;
    Flow flow_;
    std::vector<float> before_, now_;
    double before_s_ = 0;
};

// Returns the moments of the loop, one after the other; none after an interruption.
std::vector<float> grown_fields(const Specification& wanted, const BakeOptions& options) {
    const int moments = moments_of(wanted);
    const std::size_t size = kept_fields(wanted) * cloudy_cells(wanted);
    std::vector<float> fields(static_cast<std::size_t>(moments) * size);
    Growth growth(wanted, options);
    // The times of the loop before come first: of all moments but the first one, which takes nothing of it.
    for (int i = 1 - moments; i < moments; ++i) {
        const double time_s = wanted.growth_s + wanted.loop_s * i / moments;
        // What grew is the same to the bit as that of a cloud that stands still.
        if (!growth.advance(time_s, wanted.growth_s + (i <= 0 ? 0 : wanted.loop_s))) return {};
        const int moment = i < 0 ? i + moments : i;
        const double share = double{1} * moment / moments;
        const double before = share * share * (3 - 2 * share);
        growth.add_to(fields.data() + static_cast<std::size_t>(moment) * size, time_s,
                      static_cast<float>(i < 0 ? before : 1 - before));
    }
    return fields;
}

// Parts the moments of all fields.
void take_fields(std::vector<float> fields, std::size_t cells, GrownCloud& cloud) {
    if (fields.size() == cells * static_cast<std::size_t>(cloud.moments)) {
        cloud.water = std::move(fields);
        return;
    }
    const auto size = static_cast<std::ptrdiff_t>(fields.size()) / cloud.moments;
    for (auto moment = fields.begin(); moment != fields.end(); moment += size) {
        const auto velocity = moment + static_cast<std::ptrdiff_t>(cells);
        cloud.water.insert(cloud.water.end(), moment, velocity);
        cloud.velocity.insert(cloud.velocity.end(), velocity, moment + size);
    }
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
    wanted.loop_s = config::cloud_moves(cloud) ? 60 * convection.loop_minutes : 0;
    wanted.keeps_velocity = cloud.channels == config::CloudChannels::velocity;
    return wanted;
}

std::shared_ptr<const GrownCloud> grow(const Specification& wanted, const BakeOptions& options,
                                       KeptBytes* kept) {
    auto cloud = std::make_shared<GrownCloud>();
    cloud->cells = wanted.grid.cells;
    cloud->cells[2] -= wanted.mixed_levels + wanted.sponge_levels;
    cloud->full_water = make_sounding(wanted).adiabatic_water;
    cloud->moments = moments_of(wanted);
    const std::size_t cells = cloudy_cells(wanted);
    take_fields(
        kept_or_made<float>(kept, {"convection", kGrowthVersion, text_of(wanted)},
                            kept_fields(wanted) * cells * static_cast<std::size_t>(cloud->moments),
                            [&] { return grown_fields(wanted, options); }),
        cells, *cloud);
    return cloud->water.empty() ? nullptr : cloud;
}

std::shared_ptr<const GrownCloud> at_share(const std::shared_ptr<const GrownCloud>& cloud,
                                           double share) {
    if (cloud->moments == 1) return cloud;
    auto made =
        std::make_shared<GrownCloud>(GrownCloud{cloud->cells, 1, {}, {}, cloud->full_water});
    const double at = (share - std::floor(share)) * cloud->moments;
    const int moment = std::min(static_cast<int>(at), cloud->moments - 1);
    const auto later = static_cast<float>(at - moment);
    const auto between = [&](const std::vector<float>& moments) {
        const auto size = static_cast<std::ptrdiff_t>(moments.size()) / cloud->moments;
        const auto from = moments.begin() + moment * size;
        const auto to = moments.begin() + (moment + 1) % cloud->moments * size;
        std::vector<float> values;
        std::transform(from, from + size, to, std::back_inserter(values),
                       [later](float a, float b) { return a + later * (b - a); });
        return values;
    };
    made->water = between(cloud->water);
    made->velocity = between(cloud->velocity);
    return made;
}

double seconds_to_grow(const Specification& wanted) {
    constexpr double kSecondsPerCellAndStep = 1.5e-7;
    constexpr double kFastest = 20;  // m/s, over the three axes together
    const double step_s = 1.2 * double{wanted.grid.edge_m[0]} / kFastest;
    return kSecondsPerCellAndStep * cells_of(wanted) *
           std::max(1.0, (wanted.growth_s + wanted.loop_s) / step_s);
}

double bytes_of_grown(const Specification& wanted) {
    return sizeof(float) * static_cast<double>(kept_fields(wanted) * cloudy_cells(wanted)) *
           moments_of(wanted);
}

double bytes_to_grow(const Specification& wanted) {
    constexpr double kFields = 18;
    return kFields * sizeof(float) * cells_of(wanted) + bytes_of_grown(wanted);
}

}  // namespace skybake::convection
