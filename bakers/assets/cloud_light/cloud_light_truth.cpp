#include "bakers/assets/cloud_light/cloud_light_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "bakers/assets/cloud_light/light_values.h"
#include "bakers/assets/cloud_light/radiance_volume.h"
#include "bakers/occupancy/cell_grid.h"
#include "bakers/occupancy/cell_range.h"
#include "bakers/occupancy/occupied_cells.h"
#include "config/assets/occupancy_filter.h"

namespace skybake {

namespace {

using cloud_light::CloudLayer;
using cloud_light::LightChannels;
using config::CloudLightBake;
using config::CloudLightContents;

// The cells of the volume in which errors count: all that have cloud, or all if none has.
struct OccupiedPlaces {
    std::array<int, 3> cells{};
    std::vector<std::size_t> occupied;
};

OccupiedPlaces occupied_places(const CloudLayer& layer, int threads) {
    constexpr int kCell = 4;
    const occupancy::CellGrid grid{layer.size, kCell};
    const auto ranges = occupancy::cell_ranges(layer.values.data(), grid,
                                               config::OccupancyFilter::trilinear, threads);
    const auto cells = occupancy::occupied_cells(ranges, layer.threshold());
    OccupiedPlaces places{cells.size, {}};
    for (std::size_t i = 0; i < cells.occupied.size(); ++i) {
        if (cells.occupied[i] != 0) places.occupied.push_back(i);
    }
    return places;
}

// Moves points that are even in the unit cube to points that are even in the occupied cells.
std::array<double, 3> occupied_place(const OccupiedPlaces& places,
                                     const std::array<double, 3>& uvw) {
    if (places.occupied.empty()) return uvw;
    const double position = uvw[0] * static_cast<double>(places.occupied.size());
    const auto number = std::min(static_cast<std::size_t>(position), places.occupied.size() - 1);
    std::size_t cell = places.occupied[number];
    std::array<double, 3> within = {position - static_cast<double>(number), uvw[1], uvw[2]};
    for (std::size_t a = 0; a < 3; ++a) {
        const auto count = static_cast<std::size_t>(places.cells[a]);
        within[a] = (static_cast<double>(cell % count) + within[a]) / static_cast<double>(count);
        cell /= count;
    }
    return within;
}

// Where there is little cloud, little light is scattered, and its range is small beside the light that a
// runtime adds to it. So errors are shares of the source's own light.
CloudLightTruth radiance_truth(const CloudLayer& layer, const CloudLightBake& bake, int threads) {
    CloudLightTruth truth;
    truth.reference = cloud_light::radiance_reference(layer, bake, threads);
    truth.name = fmt::format("{} paths of light from each point", cloud_light::kReferencePaths);
    truth.comparison.scale = "coefficient 0 of the source's light at a point that no cloud shades";
    truth.comparison.errors = [scale = cloud_light::unshaded_coefficient(bake)](
                                  const std::array<double, 3>&, const std::vector<double>& found,
                                  const std::vector<double>& wanted) {
        std::vector<double> errors;
        for (std::size_t c = 0; c < wanted.size(); ++c) {
            errors.push_back((found[c] - wanted[c]) / scale);
        }
        return errors;
    };
    return truth;
}

CloudLightTruth truth_of_depths(const CloudLayer& layer, const CloudLightBake& bake) {
    CloudLightTruth truth;
    const bool is_map = bake.contents == CloudLightContents::shadow;
    const auto channels = std::make_shared<const LightChannels>(
        cloud_light::light_channels(bake, cloud_light::kReferenceDirections));
    truth.reference = [&layer, channels, is_map](const std::array<double, 3>& uvw) {
        const double z = is_map ? 0 : uvw[2] * layer.size[2];
        return cloud_light::light_reference(
            layer, {uvw[0] * layer.size[0], uvw[1] * layer.size[1], z}, *channels);
    };
    truth.name = config::is_per_sun(bake.contents)
                     ? "the integral along each ray through the filtered volume"
                     : "integrals along rays through the filtered volume in 128 directions";
    return truth;
}

}  // namespace

CloudLightTruth cloud_light_truth(const CloudLayer& layer, const CloudLightBake& bake,
                                  int threads) {
    CloudLightTruth truth = config::is_radiance(bake.contents)
                                ? radiance_truth(layer, bake, threads)
                                : truth_of_depths(layer, bake);
    if (bake.contents == CloudLightContents::shadow) return truth;
    truth.name += ", in cells with cloud";
    truth.comparison.lookup_place =
        [places = occupied_places(layer, threads)](const std::array<double, 3>& uvw) {
            return occupied_place(places, uvw);
        };
    return truth;
}

}  // namespace skybake
