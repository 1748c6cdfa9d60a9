#include "bakers/assets/cloud_light/light_values.h"

#include <algorithm>
#include <limits>

#include "bakers/assets/cloud_light/depth_reference.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "config/assets/cloud_light.h"

namespace skybake::cloud_light {
namespace {

constexpr int kRowsPerTile = 8;

LightChannels channels_per_sun(const CloudLightBake& bake) {
    LightChannels channels;
    channels.directions = sun_directions(bake);
    const std::size_t suns = channels.directions.size();
    for (std::size_t i = 0; i < suns; ++i) channels.weights.emplace_back(suns, 0.0)[i] = 1;
    return channels;
}

LightChannels channels_of_harmonics(const CloudLightBake& bake, const DirectionCounts& counts) {
    const std::vector<SkyDirection> sky = sky_directions(counts.zenith, counts.around);
    const CoefficientWeights weights = bake.contents == CloudLightContents::sky_visibility
                                           ? projection_weights(sky)
                                           : hemisphere_fit_weights(sky, bake.degree);
    LightChannels channels;
    const auto first = static_cast<std::size_t>(4 * (bake.part - 1));
    for (std::size_t n = 0; n < sky.size(); ++n) {
        channels.directions.push_back(sky[n].direction);
        const double* const part = weights[n].data() + first;
        channels.weights.emplace_back(part, part + config::channels_of(bake));
    }
    return channels;
}

// Adds the values of a row of places to the channels.
class RowSums {
  public:
    RowSums(const LightChannels& channels, std::size_t places)
        : channels_(channels), sums_(channels.count(), std::vector<double>(places)) {}

    void clear() {
        for (std::vector<double>& sum : sums_) std::ranges::fill(sum, 0.0);
    }

    void add(const std::vector<float>& depths, const std::vector<double>& weights) {
        values_.assign(depths.begin(), depths.end());
        if (channels_.is_transmittance) {
            for (double& value : values_) value = -value;
            exponentials(values_.data(), static_cast<int>(values_.size()));
        }
        for (std::size_t c = 0; c < weights.size(); ++c) {
            if (weights[c] == 0) continue;
            for (std::size_t i = 0; i < values_.size(); ++i) sums_[c][i] += weights[c] * values_[i];
        }
    }

    const std::vector<std::vector<double>>& sums() const { return sums_; }

  private:
    const LightChannels& channels_;
    std::vector<std::vector<double>> sums_;
    std::vector<double> values_;
};

}  // namespace

std::array<float, 2> LightChannels::bounds(std::size_t channel) const {
    std::array<double, 2> sums{};
    for (const std::vector<double>& of_direction : weights) {
        sums[of_direction[channel] > 0 ? 1 : 0] += of_direction[channel];
    }
    constexpr double kAny = std::numeric_limits<float>::max();
    const double most = is_transmittance ? 1 : kAny;
    const auto bound = [=](double sum) {
        return static_cast<float>(std::clamp(sum * most, -kAny, kAny));
    };
    return {bound(sums[0]), bound(sums[1])};
}

std::vector<glm::dvec3> sun_directions(const CloudLightBake& bake) {
    std::vector<glm::dvec3> directions;
    for (std::size_t i = 0; i < bake.sun_elevations.size(); ++i) {
        const double azimuth = bake.sun_azimuths.empty() ? 0 : bake.sun_azimuths[i].radians;
        directions.push_back(towards(bake.sun_elevations[i].radians, azimuth));
    }
    return directions;
}

LightChannels light_channels(const CloudLightBake& bake, const DirectionCounts& counts) {
    const bool per_sun = config::is_per_sun(bake.contents);
    LightChannels channels = per_sun ? channels_per_sun(bake) : channels_of_harmonics(bake, counts);
    channels.is_transmittance = bake.contents == CloudLightContents::transmittance ||
                                bake.contents == CloudLightContents::transmittance_harmonics ||
                                bake.contents == CloudLightContents::sky_visibility;
    return channels;
}

std::vector<std::vector<float>> light_values(const CloudLayer& layer, const PlaceGrid& places,
                                             const LightChannels& channels,
                                             const BakeOptions& options) {
    const DepthSweep sweep(layer, places, options.threads);
    std::vector<std::vector<SweepRays>> rays(channels.directions.size());
    for_each_tile(static_cast<int>(rays.size()), options, "rays", [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        rays[at] = sweep.rays(channels.directions[at]);
    });
    const auto length = static_cast<std::size_t>(places.count[0]);
    std::vector<std::vector<float>> values(channels.count());
    for (std::vector<float>& channel : values) {
        channel.resize(length * static_cast<std::size_t>(places.count[1] * places.count[2]));
    }
    const int rows = places.count[1] * places.count[2];
    const int tiles = (rows + kRowsPerTile - 1) / kRowsPerTile;
    for_each_tile(tiles, options, "light", [&](int tile) {
        RowSums sums(channels, length);
        std::vector<float> depths(length);
        const int last = std::min(rows, (tile + 1) * kRowsPerTile);
        for (int row = tile * kRowsPerTile; row < last; ++row) {
            const auto z = static_cast<std::size_t>(row / places.count[1]);
            sums.clear();
            for (std::size_t n = 0; n < rays.size(); ++n) {
                sweep.row(rays[n][z], row % places.count[1], depths.data());
                sums.add(depths, channels.weights[n]);
            }
            for (std::size_t c = 0; c < values.size(); ++c) {
                std::copy(sums.sums()[c].begin(), sums.sums()[c].end(),
                          values[c].begin() + static_cast<std::ptrdiff_t>(row) * places.count[0]);
            }
        }
    });
    return values;
}

std::vector<double> light_reference(const CloudLayer& layer, const glm::dvec3& place,
                                    const LightChannels& channels) {
    std::vector<double> values(channels.count(), 0.0);
    for (std::size_t n = 0; n < channels.directions.size(); ++n) {
        const double depth = optical_depth_reference(layer, place, channels.directions[n]);
        const double value = channels.is_transmittance ? exponential(-depth) : depth;
        for (std::size_t c = 0; c < values.size(); ++c) values[c] += channels.weights[n][c] * value;
    }
    return values;
}

}  // namespace skybake::cloud_light
