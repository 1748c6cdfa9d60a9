#include "bakers/assets/environment/sphere_harmonics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>

#include "bakers/assets/environment/environment_mapping.h"
#include "bakers/color/color_space.h"
#include "bakers/color/spectral_color.h"
#include "bakers/field/baked.h"
#include "bakers/light/sky_ray.h"

namespace skybake {

namespace {

// Calls visit(direction, solid angle, texel) for each texel of a map, row by row, or for parts of texels, of which
// so many lie across and down.
template <class Visit>
void for_each_texel(const Image2<float>& map, const EnvironmentLayout& layout, int parts,
                    const Visit& visit) {
    const auto [columns, rows] = layout.part_size();
    const EnvironmentLayout finer(layout.mapping(),
                                  {parts * columns, parts * rows * layout.parts()});
    for (int part = 0; part < layout.parts(); ++part) {
        for (int y = 0; y < parts * rows; ++y) {
            for (int x = 0; x < parts * columns; ++x) {
                visit(finer.direction(part, (x + 0.5) / (parts * columns),
                                      (y + 0.5) / (parts * rows)),
                      finer.solid_angle(part, x, y), map.texel(x / parts, part * rows + y / parts));
            }
        }
    }
}

constexpr int kLightDigits = 9;

// A list of JSON.
template <class Numbers>
std::string list_of(const Numbers& numbers) {
    std::vector<double> rounded(numbers.begin(), numbers.end());
    return fmt::format("[{}]", fmt::join(to_digits(std::move(rounded), kLightDigits), ", "));
}

std::string lux_member(const Baked& table, const char* name, const std::vector<double>& channels) {
    // Another solar irradiance may be in any unit.
    const bool is_of_one = table.conventions.radiance_unit == "1/sr";
    if (!table.conventions.color || !is_of_one) return "";
    const std::optional<double> lux = lux_of(*table.conventions.color, channels);
    return lux ? fmt::format(",\n    \"{}_lux\": {}", name, to_digits(*lux, kLightDigits)) : "";
}

glm::dvec3 sun_direction(const config::EnvironmentBake& bake) {
    return direction_of_angles({bake.sun_azimuth.radians, bake.sun_elevation.radians});
}

std::string sun_json(const EnvironmentLights& lights, const config::EnvironmentBake& bake,
                     const Baked& table) {
    const glm::dvec3 sun = sun_direction(bake);
    const auto degrees = [](config::Angle angle) {
        return to_digits(angle.radians * kDegreesPerRadian, kLightDigits);
    };
    return fmt::format(
        "  \"sun\": {{\n"
        "    \"direction\": {},\n"
        "    \"azimuth_deg\": {},\n"
        "    \"elevation_deg\": {},\n"
        "    \"disc_in_map\": {},\n"
        "    \"irradiance\": {},\n"
        "    \"irradiance_of_level_surface\": {}{}{}\n"
        "  }}",
        list_of(std::array{sun.x, sun.y, sun.z}), degrees(bake.sun_azimuth),
        degrees(bake.sun_elevation), bake.sun == config::SunInMap::disc, list_of(lights.sun_facing),
        list_of(lights.sun_level), lux_member(table, "illuminance", lights.sun_facing),
        lux_member(table, "illuminance_of_level_surface", lights.sun_level));
}

std::string harmonics_json(const EnvironmentLights& lights) {
    std::string text;
    for (const auto& channel : lights.harmonics) {
        text += fmt::format("{}      {}", text.empty() ? "" : ",\n", list_of(channel));
    }
    return fmt::format(
        "  \"spherical_harmonics\": {{\n"
        "    \"degree\": {},\n"
        "    \"basis\": \"real, orthonormal, without the Condon-Shortley phase, of x = right, y = "
        "ahead, z = up\",\n"
        "    \"order\": \"l (l + 1) + m\",\n"
        "    \"coefficients\": [\n{}\n    ]\n"
        "  }}",
        kHarmonicDegree, text);
}

}  // namespace

std::array<double, kHarmonics> harmonics_at(const glm::dvec3& direction) {
    const double x = direction.x;
    const double y = direction.z;
    const double z = direction.y;
    const double x2 = x * x, y2 = y * y, z2 = z * z;
    constexpr double kPi = std::numbers::pi;
    const double of_1 = std::sqrt(3 / (4 * kPi));
    const double of_2 = std::sqrt(15 / (4 * kPi));
    const double of_3 = std::sqrt(7 / (16 * kPi));
    const double of_3_1 = std::sqrt(21 / (32 * kPi));
    const double of_3_2 = std::sqrt(105 / (4 * kPi));
    const double of_3_3 = std::sqrt(35 / (32 * kPi));
    const double of_4 = 3 * std::sqrt(1 / (256 * kPi));
    const double of_4_1 = 3 * std::sqrt(5 / (32 * kPi));
    const double of_4_2 = 3 * std::sqrt(5 / (64 * kPi));
    const double of_4_3 = 3 * std::sqrt(35 / (32 * kPi));
    const double of_4_4 = 3 * std::sqrt(35 / (256 * kPi));
    return {std::sqrt(1 / (4 * kPi)),
            of_1 * y,
            of_1 * z,
            of_1 * x,
            of_2 * x * y,
            of_2 * y * z,
            std::sqrt(5 / (16 * kPi)) * (3 * z2 - 1),
            of_2 * x * z,
            0.5 * of_2 * (x2 - y2),
            of_3_3 * y * (3 * x2 - y2),
            of_3_2 * x * y * z,
            of_3_1 * y * (5 * z2 - 1),
            of_3 * z * (5 * z2 - 3),
            of_3_1 * x * (5 * z2 - 1),
            0.5 * of_3_2 * z * (x2 - y2),
            of_3_3 * x * (x2 - 3 * y2),
            4 * of_4_4 * x * y * (x2 - y2),
            of_4_3 * y * z * (3 * x2 - y2),
            2 * of_4_2 * x * y * (7 * z2 - 1),
            of_4_1 * y * z * (7 * z2 - 3),
            of_4 * (35 * z2 * z2 - 30 * z2 + 3),
            of_4_1 * x * z * (7 * z2 - 3),
            of_4_2 * (x2 - y2) * (7 * z2 - 1),
            of_4_3 * x * z * (x2 - 3 * y2),
            of_4_4 * (x2 * x2 - 6 * x2 * y2 + y2 * y2)};
}

std::vector<std::array<double, kHarmonics>> harmonics_of(const Image2<float>& map,
                                                         const EnvironmentLayout& layout) {
    std::vector<std::array<double, kHarmonics>> sums(static_cast<std::size_t>(map.channels));
    for_each_texel(map, layout, 1,
                   [&](const glm::dvec3& direction, double solid_angle, const float* light) {
                       const std::array<double, kHarmonics> values = harmonics_at(direction);
                       for (std::array<double, kHarmonics>& sum : sums) {
                           const double weight = solid_angle * double{*light++};
                           for (std::size_t i = 0; i < kHarmonics; ++i) {
                               sum[i] += weight * values[i];
                           }
                       }
                   });
    return sums;
}

std::vector<double> level_irradiance(const Image2<float>& map, const EnvironmentLayout& layout) {
    // The horizon passes through texels. Those of small maps are parted.
    constexpr int kFineRows = 128;
    const int parts = std::max(kFineRows / layout.part_size().rows, 1);
    std::vector<double> sums(static_cast<std::size_t>(map.channels));
    for_each_texel(map, layout, parts,
                   [&](const glm::dvec3& direction, double solid_angle, const float* light) {
                       if (direction.y <= 0) return;
                       for (double& sum : sums) sum += solid_angle * direction.y * double{*light++};
                   });
    return sums;
}

std::optional<double> lux_of(const ColorConvention& color, const std::vector<double>& channels) {
    const std::optional<ColorTarget> target = color_target(color.space, color.white, color.sun);
    if (!color.is_applied || !target || target->sunlight != Sunlight::measured) return std::nullopt;
    const glm::dmat3 to_xyz =
        glm::inverse(from_xyz(target->space, target->white, sun_xyz(target->sunlight)));
    const glm::dvec3 xyz = to_xyz * glm::dvec3(channels[0], channels[1], channels[2]);
    return solar_illuminance_lux() * xyz.y;
}

std::string lights_json(const EnvironmentLights& lights, const config::EnvironmentBake& bake,
                        const Baked& table) {
    std::vector<std::string> names;
    for (const std::string& name : table.channel_names) names.push_back('"' + name + '"');
    return fmt::format(
        "{{\n"
        "  \"unit\": \"irradiance and radiance in {}\",\n"
        "  \"axes\": \"right, up, ahead\",\n"
        "  \"channels\": [{}],\n"
        "{},\n"
        "  \"sky\": {{\n"
        "    \"irradiance_of_level_surface\": {}{}\n"
        "  }},\n"
        "{}\n"
        "}}\n",
        bake.solar_irradiance.empty() ? "1/sr, for a solar irradiance of 1"
                                      : "solar_irradiance/sr, for that of the bake",
        fmt::join(names, ", "), sun_json(lights, bake, table), list_of(lights.sky_level),
        lux_member(table, "illuminance_of_level_surface", lights.sky_level),
        harmonics_json(lights));
}

void add_light_facts(const EnvironmentLights& lights, const config::EnvironmentBake& bake,
                     Baked& table) {
    const glm::dvec3 sun = sun_direction(bake);
    if (bake.sun == config::SunInMap::none) {
        table.details.emplace_back("sun_direction",
                                   to_digits(std::vector{sun.x, sun.y, sun.z}, kLightDigits));
    }
    table.details.emplace_back("sun_irradiance", to_digits(lights.sun_facing, kLightDigits));
    table.details.emplace_back("sky_irradiance_of_level_surface",
                               to_digits(lights.sky_level, kLightDigits));
    for (std::size_t c = 0; c < lights.harmonics.size(); ++c) {
        const auto& channel = lights.harmonics[c];
        table.details.emplace_back(
            fmt::format("spherical_harmonics_{}", table.channel_names[c]),
            to_digits(std::vector<double>(channel.begin(), channel.end()), kLightDigits));
    }
}

}  // namespace skybake
