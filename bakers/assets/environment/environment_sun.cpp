#include "bakers/assets/environment/environment_sun.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "bakers/assets/environment/prefilter.h"
#include "bakers/light/sky_ray.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "config/assets/environment.h"

namespace skybake {

namespace {

constexpr int kSunRings = 48;
constexpr int kSunSpokes = 64;

// Directions spread evenly over the disc, ring after ring. Left and right are mirror images to the bit,
// and none lies on the line between them.
std::vector<glm::dvec3> disc_directions(const MapAngles& sun) {
    const glm::dvec3 middle = direction_of_angles(sun);
    const glm::dvec3 right = direction_of_angles({sun.azimuth + std::numbers::pi / 2, 0});
    const glm::dvec3 up = direction_of_angles({sun.azimuth, sun.elevation + std::numbers::pi / 2});
    std::vector<glm::dvec3> directions;
    for (int ring = 0; ring < kSunRings; ++ring) {
        const double radius =
            kSunRadius_deg / kDegreesPerRadian * std::sqrt((ring + 0.5) / kSunRings);
        const SineCosine away = sine_and_cosine(radius);
        for (int spoke = 0; spoke < kSunSpokes; ++spoke) {
            const int mirrored = std::min(spoke, kSunSpokes - 1 - spoke);
            const SineCosine turn =
                sine_and_cosine(2 * std::numbers::pi * (mirrored + 0.5) / kSunSpokes);
            const double aside = mirrored == spoke ? turn.sine : -turn.sine;
            directions.push_back(away.cosine * middle +
                                 away.sine * (turn.cosine * up + aside * right));
        }
    }
    return directions;
}

// The transmittance of the air from a camera to space along a direction of this elevation's sine.
Spectrum transmittance_to_space(const SkyLight& light, double altitude_km, double sine) {
    SkyDirection direction;
    direction.mu = std::clamp(sine, -1.0, 1.0);
    const CameraRay ray = camera_ray(light.shell(), altitude_km, SunZenith{}, direction);
    if (ray.in_air.meets_ground) return {};
    if (ray.in_air.length_km == 0 && altitude_km >= light.shell().thickness_km) return Spectrum(1);
    return light.sun_transmittance(ray.in_air.altitude_km, ray.in_air.s_km);
}

}  // namespace

std::vector<SunPoint> sun_points(const SkyLights& lights, const config::EnvironmentBake& bake,
                                 const CloudsAround* clouds) {
    const std::vector<glm::dvec3> directions =
        disc_directions({bake.sun_azimuth.radians, bake.sun_elevation.radians});
    const auto channels = static_cast<std::size_t>(lights.channels());
    std::vector<double> values(directions.size() * channels);
    lights.write_channels(
        directions.size(),
        [&](const SkyLight& light, double* out) {
            for (const glm::dvec3& direction : directions) {
                const Spectrum through =
                    transmittance_to_space(light, bake.altitude.kilometers(), direction.y);
                out = std::copy_n(data(through), light.medium().air.channels, out);
            }
        },
        values.data());
    std::vector<SunPoint> points;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const double share = (clouds ? clouds->transmittance(directions[i]) : 1) /
                             static_cast<double>(directions.size());
        SunPoint point{directions[i], {}};
        for (std::size_t c = 0; c < channels; ++c) {
            point.light.push_back(share * values[i * channels + c]);
        }
        points.push_back(std::move(point));
    }
    return points;
}

std::vector<double> irradiance_of(const std::vector<SunPoint>& points, LitSurface surface,
                                  int channels) {
    std::vector<double> sums(static_cast<std::size_t>(channels));
    for (const SunPoint& point : points) {
        const double cosine = surface == LitSurface::level ? std::max(point.direction.y, 0.0) : 1.0;
        for (std::size_t c = 0; c < sums.size(); ++c) sums[c] += cosine * point.light[c];
    }
    return sums;
}

void add_sun_points(const std::vector<SunPoint>& points, const EnvironmentLayout& layout,
                    Image2<double>& map) {
    const auto [columns, rows] = layout.part_size();
    const auto texel_at = [](double coordinate, int count) {
        return std::clamp(static_cast<int>(coordinate * count), 0, count - 1);
    };
    for (const SunPoint& point : points) {
        const EnvironmentLayout::At at = layout.at(point.direction);
        const int column = texel_at(at.x, columns);
        const int row = texel_at(at.y, rows);
        const double solid_angle = layout.solid_angle(at.part, column, row);
        double* texel = map.texel(column, at.part * rows + row);
        for (const double light : point.light) *texel++ += light / solid_angle;
    }
}

std::vector<SunPoint> merged(const std::vector<SunPoint>& points) {
    constexpr int kRings = 8;  // so many become one
    constexpr int kSpokes = 4;
    constexpr int kInRing = kSunSpokes / kSpokes;
    std::vector<SunPoint> sums(points.size() / (kRings * kSpokes));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t group = i / (kRings * kSunSpokes) * kInRing + i % kSunSpokes / kSpokes;
        SunPoint& sum = sums[group];
        sum.light.resize(points[i].light.size());
        for (std::size_t c = 0; c < sum.light.size(); ++c) sum.light[c] += points[i].light[c];
        sum.direction += points[i].direction;
    }
    for (SunPoint& sum : sums) sum.direction = glm::normalize(sum.direction);
    return sums;
}

void add_reflected_sun(const std::vector<SunPoint>& points, const EnvironmentLayout& layout,
                       double roughness, const BakeOptions& options, Image2<double>& level) {
    const auto size = layout.part_size();
    const ReflectedLobe lobe(roughness);
    for_each_tile(level.height, options, "roughness", [&](int line) {
        const int part = line / size.rows;
        for (int x = 0; x < size.columns; ++x) {
            double* texel = level.texel(x, line);
            const double width = std::sqrt(layout.solid_angle(part, x, line % size.rows));
            const int samples = std::clamp(static_cast<int>(width / lobe.width()) + 1, 1, 8);
            for (int i = 0; i < samples * samples; ++i) {
                const double along = (i % samples + 0.5) / samples;
                const double down = (i / samples + 0.5) / samples;
                const glm::dvec3 normal = layout.direction(part, (x + along) / size.columns,
                                                           (line % size.rows + down) / size.rows);
                for (const SunPoint& point : points) {
                    const double share =
                        lobe.density(glm::dot(normal, point.direction)) / (samples * samples);
                    for (std::size_t c = 0; c < point.light.size(); ++c) {
                        texel[c] += share * point.light[c];
                    }
                }
            }
        }
    });
}

}  // namespace skybake
