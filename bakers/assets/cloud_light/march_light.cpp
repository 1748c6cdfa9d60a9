#include "bakers/assets/cloud_light/march_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bakers/assets/cloud_light/cloud_scattering.h"
#include "bakers/assets/forward_scattering/forward_table.h"
#include "bakers/math/harmonics.h"
#include "bakers/math/wrapped.h"
#include "bakers/occupancy/cell_grid.h"
#include "config/sections/cloud.h"

namespace skybake::cloud_light {
namespace {

// The cloud is scaled alike for all light. Of the sky's and the ground's, which is smooth, degree 1 is kept.
constexpr int kDegree = 3;
constexpr double kAlbedo = 1;
// A code of 255 of a picture is 0.9 % of light.
constexpr double kSeenChange = 2e-3;
constexpr std::array<int, 2> kForwardTexels = {64, 128};  // along the angle and along the depth
constexpr int kForwardSteps = 8;                          // of the integral, between two rows

PlaceGrid places_in(const std::array<int, 3>& voxels, double most_cells) {
    const int longest = *std::ranges::max_element(voxels);
    int cell = 2;
    PlaceGrid places = place_grid(voxels, cell, false);
    while (voxels_of(places.count, 1) > most_cells && cell < longest) {
        ++cell;
        places = place_grid(voxels, cell, false);
    }
    return places;
}

// Copies the medium's voxels into the middle of a layer that is `margin` voxels wider on each side.
CloudLayer layer_of(const CloudMedium& medium, const std::array<int, 3>& margin) {
    CloudLayer layer;
    const PaddedVolume& volume = medium.volume;
    for (std::size_t a = 0; a < 3; ++a) {
        layer.size[a] = volume.size[a] + 2 * margin[a];
        layer.voxel_m[a] = medium.meters_per_voxel(a);
    }
    layer.optics = medium.optics;
    layer.values.resize(occupancy::count_of(layer.size));
    for (int z = 0; z < volume.size[2]; ++z) {
        for (int y = 0; y < volume.size[1]; ++y) {
            const float* from =
                volume.values.data() + (z + 1) * volume.plane() + (y + 1) * volume.row() + 1;
            std::copy_n(
                from, volume.size[0],
                layer.values.data() + occupancy::index_of(layer.size, margin[0], y + margin[1], z));
        }
    }
    return layer;
}

// Computes the integral of F over the depth, by the trapezoidal rule.
Image2<float> make_forward_integrals(config::CloudParticles particles) {
    const forward_scattering::SmallAngles light(scattering_of(cloud_phase(particles), kAlbedo),
                                                kDegree);
    Image2<float> table(kForwardTexels[0], kForwardTexels[1], 1);
    std::vector<ScatteringAngle> angles;
    for (int x = 0; x < table.width; ++x) {
        angles.push_back(forward_scattering::angle_at(double{1} * x / (table.width - 1)));
    }
    std::vector<double> sums(angles.size(), 0.0);
    std::vector<double> before(angles.size(), 1.0);  // F at depth 0
    std::vector<double> here(angles.size());
    double depth = 0;
    for (int row = 1; row < table.height; ++row) {
        for (int i = 1; i <= kForwardSteps; ++i) {
            const double y = (row - 1 + double{1} * i / kForwardSteps) / (table.height - 1);
            const double next = forward_scattering::depth_at(y);
            light.factors(next, angles, here.data());
            for (std::size_t x = 0; x < sums.size(); ++x) {
                sums[x] += (before[x] + here[x]) / 2 * (next - depth);
            }
            std::swap(before, here);
            depth = next;
        }
        std::ranges::transform(sums, table.texel(0, row),
                               [](double sum) { return static_cast<float>(sum); });
    }
    return table;
}

// They are the same for all clouds of the same particles.
const Image2<float>& forward_integrals(config::CloudParticles particles) {
    if (particles == config::CloudParticles::ice) {
        static const Image2<float> ice = make_forward_integrals(particles);
        return ice;
    }
    static const Image2<float> droplets = make_forward_integrals(particles);
    return droplets;
}

// Calls visit(cell, x, y, z) for the padded cells of `light` and the places of the solution that they stand
// for. Beyond its sides a tile repeats, or has the light of its margin; beyond its faces it has that of the
// outermost cells. `upside_down`: the solution is that of the mirrored layer.
template <class Visit>
void for_padded_cells(const SolvedRadiance& solved, const std::array<int, 3>& margin,
                      bool upside_down, const LightInCloud& light, const Visit& visit) {
    const std::array<int, 3>& all = solved.scattered.size();
    std::size_t cell = 0;
    for (int z = -1; z <= light.cells[2]; ++z) {
        const int level = std::clamp(z, 0, all[2] - 1);
        for (int y = -1; y <= light.cells[1]; ++y) {
            for (int x = -1; x <= light.cells[0]; ++x, ++cell) {
                visit(cell, wrapped(x + margin[0], all[0]), wrapped(y + margin[1], all[1]),
                      upside_down ? all[2] - 1 - level : level);
            }
        }
    }
}

// Writes `count` coefficients of cells to `light`, from the coefficient `first` on, times `strength`. Harmonics
// of odd l + m change their sign in a mirror.
void write(const SolvedRadiance& solved, const std::array<int, 3>& margin, std::size_t first,
           std::size_t count, double strength, bool upside_down, LightInCloud& light) {
    std::array<double, LightInCloud::kSun> factors{};
    for (std::size_t c = 0; c < count; ++c) {
        const std::size_t degree = degree_of_harmonic(c);
        const bool is_odd = (c - degree * degree) % 2 != 0;
        factors[c] = upside_down && is_odd ? -strength : strength;
    }
    for_padded_cells(
        solved, margin, upside_down, light, [&](std::size_t cell, int x, int y, int z) {
            for (std::size_t c = 0; c < count; ++c) {
                light.values[cell * LightInCloud::kAll + first + c] =
                    static_cast<float>(factors[c] * double{solved.scattered.row(c, z, y)[x]});
            }
        });
}

// The layer upside down: under a sun below the horizon it is as this one under the mirrored sun.
CloudLayer upside_down(const CloudLayer& layer) {
    CloudLayer turned = layer;
    const std::size_t plane = layer.values.size() / static_cast<std::size_t>(layer.size[2]);
    for (std::size_t from = 0, to = layer.values.size(); from < layer.values.size();
         from += plane) {
        to -= plane;
        std::copy_n(layer.values.data() + from, plane, turned.values.data() + to);
    }
    return turned;
}

}  // namespace

Estimate march_light_estimate(double voxels) {
    constexpr double kSecondsPerCell = 8e-6;  // of sun, sky and ground
    constexpr double kFieldsOfSolver = 5;     // of all coefficients
    const double cells = std::min(voxels / 8, kCellsOfPicture);
    const double fields = (kFieldsOfSolver * kMostHarmonics + LightInCloud::kAll + 1) * cells;
    Estimate result;
    result.seconds = kSecondsPerCell * cells;
    result.memory_mib = sizeof(float) * (voxels + fields) / kMebibyte;
    return result;
}

MarchLight::MarchLight(const CloudMedium& medium, double most_cells, const BakeOptions& options) {
    const std::array<int, 3>& voxels = medium.volume.size;
    PlaceGrid places = places_in(voxels, medium.repeats ? most_cells : most_cells / 4);
    without_sun_.cells = places.count;
    std::array<int, 3> margin{};  // in voxels
    for (std::size_t a = 0; a < 2 && !medium.repeats; ++a) {
        margin_[a] = (places.count[a] + 1) / 2;
        margin[a] = margin_[a] * (voxels[a] / places.count[a]);
        places.count[a] += 2 * margin_[a];
    }
    auto layer = std::make_unique<CloudLayer>(layer_of(medium, margin));
    if (!medium.repeats) layer->reach = {double{1} * voxels[0], double{1} * voxels[1]};
    layer_ = std::move(layer);
    places.voxels = layer_->size;
    places_ = places;
    const config::CloudParticles particles = medium.optics.particles;
    without_sun_.phase = cloud_phase(particles);
    without_sun_.backwards = backward_share(without_sun_.phase);
    solver_ = std::make_unique<const RadianceSolver>(
        *layer_, places, scattering_of(without_sun_.phase, kAlbedo), kDegree, options);
    without_sun_.share = solver_->extinction_share();
    without_sun_.forward = forward_integrals(particles);
    std::array<int, 3> padded = without_sun_.cells;
    for (int& count : padded) count += 2;
    without_sun_.values.resize(occupancy::count_of(padded) * LightInCloud::kAll);
    LayerSources sky;
    sky.sky = 1;
    LayerSources ground;
    ground.ground = 1;
    std::size_t first = LightInCloud::kSun;
    for (const LayerSources& source : {sky, ground}) {
        write(solver_->solve(source, options, kSeenChange), margin_, first,
              LightInCloud::kHemisphere, 1, false, without_sun_);
        first += LightInCloud::kHemisphere;
    }
}

std::optional<LightInCloud> MarchLight::under(const SunDirection& sun,
                                              const BakeOptions& options) const {
    const bool repeats = margin_[0] == 0;
    const bool is_below = sun.elevation_degrees < 0;
    const double height = std::fabs(sun.elevation_degrees);
    const double solved_height = repeats ? std::max(height, kLowestSolvedSun_deg) : height;
    if (solved_height == 0) return std::nullopt;
    LayerSources source;
    source.sun = 1;
    source.sun_direction = direction_of(solved_height, sun.azimuth_degrees);
    std::optional<CloudLayer> turned;
    if (is_below) turned = upside_down(*layer_);
    const SolvedRadiance solved =
        turned ? RadianceSolver(*turned, places_, scattering_of(without_sun_.phase, kAlbedo),
                                kDegree, options)
                     .solve(source, options, kSeenChange)
               : solver_->solve(source, options, kSeenChange);
    if (options.cancelled()) return std::nullopt;
    LightInCloud light = without_sun_;
    const double strength = sine_of_degrees(height) / sine_of_degrees(solved_height);
    write(solved, margin_, 0, LightInCloud::kSun, strength, is_below, light);
    light.depths.resize(light.values.size() / LightInCloud::kAll);
    for_padded_cells(solved, margin_, is_below, light, [&](std::size_t cell, int x, int y, int z) {
        light.depths[cell] =
            solved.sun_depths[occupancy::index_of(solved.scattered.size(), x, y, z)];
    });
    return light;
}

}  // namespace skybake::cloud_light
