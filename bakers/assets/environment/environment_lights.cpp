#include "bakers/assets/environment/environment_lights.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "bakers/assets/environment/environment_mapping.h"
#include "bakers/color/color_space.h"
#include "bakers/color/spectral_color.h"
#include "bakers/field/baked.h"
#include "bakers/light/sky_ray.h"

namespace skybake {

namespace {

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
