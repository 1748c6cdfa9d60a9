#include "bakers/assets/cloud_light/radiance_solver.h"

#include <utility>

#include "bakers/assets/cloud_light/light_values.h"
#include "bakers/math/transcendental.h"
#include "bakers/occupancy/cell_grid.h"
#include "config/assets/occupancy_filter.h"

namespace skybake::cloud_light {
namespace {

// The filter's taps at `points` even places of each cell of an axis.
std::vector<occupancy::AxisTaps> taps_along(const CloudLayer& layer, const PlaceGrid& places,
                                            std::size_t axis, int points) {
    std::vector<occupancy::AxisTaps> taps;
    for (int cell = 0; cell < places.count[axis]; ++cell) {
        for (int i = 0; i < points; ++i) {
            const double at = (cell + (i + 0.5) / points) * layer.size[axis] / places.count[axis];
            taps.push_back(occupancy::filter_taps(config::OccupancyFilter::trilinear, at,
                                                  layer.size[axis], axis < 2));
        }
    }
    return taps;
}

// Means over the cells, of as many filtered values as a cell has voxels.
LayerCells mean_cells(const CloudLayer& layer, const PlaceGrid& places, double share,
                      const BakeOptions& options) {
    LayerCells cells{CellFields(places.count, 1), {}};
    std::array<int, 3> points{};
    std::array<std::vector<occupancy::AxisTaps>, 3> taps;
    for (std::size_t a = 0; a < 3; ++a) {
        cells.edge_m[a] = layer.voxel_m[a] * layer.size[a] / places.count[a];
        points[a] = (layer.size[a] + places.count[a] - 1) / places.count[a];
        taps[a] = taps_along(layer, places, a, points[a]);
    }
    const auto voxel = [&](int x, int y, int z) { return layer.value(x, y, z); };
    const auto mean = [&](const std::array<int, 3>& cell) {
        double sum = 0;
        std::array<int, 3> i{};
        const auto tap = [&](std::size_t a) {
            return taps[a][static_cast<std::size_t>(cell[a] * points[a] + i[a])];
        };
        for (i[2] = 0; i[2] < points[2]; ++i[2]) {
            for (i[1] = 0; i[1] < points[1]; ++i[1]) {
                for (i[0] = 0; i[0] < points[0]; ++i[0]) {
                    const double value =
                        occupancy::filtered_in_double({tap(0), tap(1), tap(2)}, voxel);
                    sum += layer.optics.extinction_per_m * density(layer.optics, value);
                }
            }
        }
        return share * sum / (points[0] * points[1] * points[2]);
    };
    for_each_plane(cells.extinction, options, [&](int z) {
        for (int y = 0; y < places.count[1]; ++y) {
            float* row = cells.extinction.row(0, z, y);
            for (int x = 0; x < places.count[0]; ++x) row[x] = static_cast<float>(mean({x, y, z}));
        }
    });
    return cells;
}

// J_1, from exact depths towards the sun.
CellFields first_scattering(const PlaceGrid& places, const ScaledScattering& scattering,
                            const LayerSources& sources, const std::vector<float>& depths,
                            const BakeOptions& options) {
    const std::size_t coefficients = scattering.returned.size() * scattering.returned.size();
    CellFields first(places.count, coefficients);
    if (depths.empty()) return first;
    const Harmonics towards_eye = harmonics(-sources.sun_direction);
    for_each_plane(first, options, [&](int z) {
        for_each_row(first, [&](std::size_t c, int y) {
            const double scale =
                sources.sun * scattering.returned[degree_of_harmonic(c)] * towards_eye[c];
            const float* depth = depths.data() + occupancy::index_of(places.count, 0, y, z);
            float* row = first.row(c, z, y);
            for (int x = 0; x < places.count[0]; ++x) {
                row[x] = static_cast<float>(
                    scale * exponential(-scattering.extinction_share * double{depth[x]}));
            }
        });
    });
    return first;
}

}  // namespace

RadianceSolver::RadianceSolver(const CloudLayer& layer, const PlaceGrid& places,
                               const CloudScattering& scattering, int degree,
                               const BakeOptions& options)
    : layer_(layer),
      places_(places),
      scaled_(scaled(scattering, degree)),
      levels_(mean_cells(layer, places, scaled_.extinction_share, options), scaled_.returned,
              options) {}

SolvedRadiance RadianceSolver::solve(const LayerSources& sources, const BakeOptions& options,
                                     double largest_change) const {
    std::vector<float> depths;
    if (sources.sun > 0) {
        depths =
            light_values(layer_, places_, {{sources.sun_direction}, {{1.0}}, false}, options)[0];
    }
    const CellFields first = first_scattering(places_, scaled_, sources, depths, options);
    EnteringLight entering{sources.sky, sources.ground};
    if (sources.sky_shape) {
        entering.sky_shape = ordinate_radiances(sources.sky_shape, levels_.sweep().sky_ordinates());
    }
    ScatteredLight found =
        levels_.solve(first, entering, {.change = largest_change, .is_shown = true}, options);
    return {std::move(found.light), std::move(depths), found.sweeps, found.change};
}

}  // namespace skybake::cloud_light
