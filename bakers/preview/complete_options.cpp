#include "bakers/preview/complete_options.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "bakers/preview/check_options.h"
#include "bakers/render/sun_position.h"
#include "config/recipe/preview_section.h"

namespace skybake {
namespace {

using config::Outcome;

double to_degrees(double radians) { return radians * 180 / std::numbers::pi; }

std::optional<double> to_degrees(const std::optional<double>& radians) {
    return radians ? std::optional(to_degrees(*radians)) : std::nullopt;
}

template <class T>
void take(std::optional<T>& option, const std::optional<T>& of_recipe) {
    if (!option) option = of_recipe;
}

void take_camera(const config::PreviewCamera& camera, PreviewOptions& options) {
    if (!options.camera) options.camera.emplace();
    CameraRequest& request = *options.camera;
    take(request.position_m, camera.position);
    take(request.heading_degrees, to_degrees(camera.heading));
    take(request.pitch_degrees, to_degrees(camera.pitch));
    take(request.field_degrees, to_degrees(camera.fov));
}

// Takes what places the sun. What the command line says about the sun, by a time or by angles,
// replaces all that the recipe says in the other way.
void take_sun(const config::Preview& preview, bool clouds, PreviewOptions& options) {
    const bool by_angles = !options.sun_elevations_deg.empty() || options.sun_azimuth_deg;
    const bool by_time = options.at.has_value();
    if (preview.latitude && preview.longitude && !options.place && !by_angles) {
        options.place = {to_degrees(*preview.latitude), to_degrees(*preview.longitude)};
    }
    if (preview.at && !by_angles && !by_time) options.at = config::parse_moment(*preview.at);
    if (options.at) return;
    if (options.sun_elevations_deg.empty()) {
        for (const config::Angle elevation : preview.sun_elevation) {
            options.sun_elevations_deg.push_back(to_degrees(elevation.radians));
        }
    }
    if (clouds) take(options.sun_azimuth_deg, to_degrees(preview.sun_azimuth));
}

void take_section(const config::Preview& preview, const LitPictures& lit, PreviewOptions& options) {
    if (lit.sky) {
        take(options.altitude_m, preview.altitude);
        take(options.glare, std::optional(preview.glare));
    }
    if (lit.clouds) {
        take_camera(preview.camera, options);
        if (!lit.sweep) take(options.picture_size, preview.size);
        options.single = options.single || preview.single;
    }
    if (!lit.sky && !lit.clouds) return;
    take(options.exposure_stops, preview.exposure);
    take(options.tone_curve, std::optional(preview.tone_curve));
    take_sun(preview, lit.clouds, options);
}

std::string place_text(const EarthPlace& place) {
    return fmt::format("{:g} degrees {}, {:g} degrees {}", std::fabs(place.latitude_degrees),
                       place.latitude_degrees < 0 ? "south" : "north",
                       std::fabs(place.longitude_degrees),
                       place.longitude_degrees < 0 ? "west" : "east");
}

// Places the sun at the time. The position is as exact as its third digit.
void place_sun(bool clouds, PreviewOptions& options) {
    const auto hundredths = [](double angle) { return std::round(100 * angle) / 100; };
    const double utc = config::utc_seconds(*options.at, options.place->longitude_degrees);
    const SunPosition sun = sun_position(utc, *options.place);
    options.sun_elevations_deg = {hundredths(sun.elevation_degrees)};
    if (clouds) options.sun_azimuth_deg = hundredths(90 - sun.azimuth_degrees);
    options.note = fmt::format(
        "At {}, {}, the sun stands at an elevation of {:.2f} degrees, without refraction, and "
        "an azimuth of {:.1f} degrees from north towards east; +y is north and +x is east.",
        config::utc_text(utc), place_text(*options.place), sun.elevation_degrees,
        sun.azimuth_degrees);
    options.at.reset();
    options.place.reset();
}

}  // namespace

Outcome<PreviewOptions> completed(PreviewOptions options, const config::Recipe* recipe,
                                  const LitPictures& lit) {
    const bool by_angles = !options.sun_elevations_deg.empty() || options.sun_azimuth_deg;
    if (options.at && by_angles) {
        return {{},
                {option_fault("--at excludes --sun-elevation and --sun-azimuth",
                              "the time and the place say where the sun stands")}};
    }
    const bool place_is_asked = options.place.has_value();
    const auto preview = recipe != nullptr ? config::preview_of(*recipe) : std::nullopt;
    if (preview) take_section(*preview, lit, options);
    if (options.at && !options.place) {
        return {{},
                {option_fault("--at needs a place",
                              "give --place 47.4,8.5, or latitude and longitude in "
                              "[preview]")}};
    }
    if (place_is_asked && !options.at) {
        return {{}, {option_fault("--place needs a time", "give --at \"2026-06-21 18:30\"")}};
    }
    if (options.at) place_sun(lit.clouds, options);
    return {std::move(options), {}};
}

}  // namespace skybake
