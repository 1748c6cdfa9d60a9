#include "bakers/assets/environment/environment_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "bakers/air/ray.h"
#include "bakers/assets/description/asset_label.h"
#include "bakers/assets/environment/environment_sun.h"
#include "bakers/assets/environment/prefilter.h"
#include "bakers/assets/environment/sphere_harmonics.h"
#include "bakers/assets/sky/sky_asset.h"
#include "bakers/field/stored_voxels.h"
#include "bakers/light/sky_ray.h"
#include "config/sections/frames.h"

namespace skybake {

using config::EnvironmentBake;
using config::EnvironmentMapping;
using config::LevelContent;
using config::SunInMap;

namespace {

std::string content_of_environment(const EnvironmentBake& bake) {
    return fmt::format(
        "radiance of the sky{} and of the ground around a camera ({}, {} the sun's disc: {}{}",
        bake.has_clouds() ? ", of clouds" : "",
        bake.solar_irradiance.empty() ? "1/sr) for a solar irradiance of 1"
                                      : "solar_irradiance/sr)",
        bake.sun == SunInMap::disc ? "with" : "without", light_text(bake.orders, bake.layers),
        bake.level_content == LevelContent::ggx ? "; coarser levels as rough surfaces reflect it"
                                                : "");
}

std::array<AxisMapping, 2> axes_of_environment(const EnvironmentBake& bake) {
    std::array<AxisMapping, 2> axes;
    const char* const edges = "end points on texture edges";
    switch (bake.mapping) {
        case EnvironmentMapping::cube:
            axes[0] = {"face_x", "u = coordinate of the face, from its left edge to its right one",
                       edges, 0, 1};
            axes[1] = {"face_y",
                       "v = (face + coordinate downwards) / 6; faces right, left, up, down, ahead, "
                       "behind, as +x, -x, +y, -y, +z, -z of GPUs",
                       edges, 0, 6};
            break;
        case EnvironmentMapping::octahedral:
            axes[0] = {
                "right",
                "u = 1/2 + right / 2 s, s = |right| + |up| + |ahead|; below the horizontal u "
                "= 1/2 + sign(right) (1 - |ahead| / s) / 2",
                edges, -1, 1};
            axes[1] = {"ahead",
                       "v = 1/2 - ahead / 2 s; below the horizontal v = 1/2 - sign(ahead) (1 - "
                       "|right| / s) / 2",
                       edges, 1, -1};
            break;
        case EnvironmentMapping::equal_area:
            axes[0] = {
                "ahead",
                "u = 1/2 + sign(ahead) a / 2, r = sqrt(1 - |up|), b = r (2 / pi) atan(|right| / "
                "|ahead|), a = r - b; below the horizontal u = 1/2 + sign(ahead) (1 - b) / 2",
                edges, -1, 1};
            axes[1] = {"right",
                       "v = 1/2 - sign(right) b / 2; below the horizontal v = 1/2 - sign(right) "
                       "(1 - a) / 2",
                       edges, 1, -1};
            break;
        default:
            axes[0] = {"azimuth_deg",
                       looks_to_the_sun(bake)
                           ? "u = azimuth from the sun / 360 degrees + 1/2"
                           : "u = azimuth to the right of ahead / 360 degrees + 1/2",
                       edges, -180, 180};
            axes[1] = {"elevation_deg", "v = 1/2 - elevation / 180 degrees", edges, 90, -90};
            axes[0].wrap = AxisWrap::repeat;
            axes[0].constants = {{"range_deg", 360.0}};
    }
    for (AxisMapping& axis : axes) axis.end_points = TexelConvention::end_points_on_edges;
    return axes;
}

void describe_environment(const EnvironmentBake& bake, const SkyViewCamera& camera,
                          const Shell& shell, Baked& table) {
    table.kind = "environment";
    table.content = content_of_environment(bake);
    table.mapping = word_of("environment", "mapping", bake.mapping);
    const auto axes = axes_of_environment(bake);
    table.axes.assign(axes.begin(), axes.end());
    table.axes[1].constants = shell_constants(shell);
    Facts numbers = {
        {"dip_deg", camera.dip() * kDegreesPerRadian},
        {"sun_elevation_deg", to_digits(bake.sun_elevation.radians * kDegreesPerRadian, 9)}};
    if (bake.sun_azimuth.radians != 0) {
        numbers.emplace_back("sun_azimuth_deg",
                             to_digits(bake.sun_azimuth.radians * kDegreesPerRadian, 9));
    }
    numbers.emplace_back("camera_altitude_km", to_digits(bake.altitude.kilometers(), 9));
    table.axes[1].constants.insert(table.axes[1].constants.end(), numbers.begin(), numbers.end());
    set_files(bake, table);
    describe_sky_table(table);
    if (!bake.solar_irradiance.empty()) {
        table.conventions.solar_irradiance = solar_irradiance_of(bake);
        table.conventions.radiance_unit = "solar_irradiance/sr";
    }
    if (bake.has_clouds()) {
        table.certificate.reference =
            "means of 64 rays that no texel has, marched with half steps; exact light of the air";
    }
}

AccuracyRequest request_of_environment(const EnvironmentBake& bake,
                                       const EnvironmentLayout& layout) {
    AccuracyRequest request =
        sky_table_request({layout.part_size().columns, layout.part_size().rows});
    // The horizon lies within a row of texels, so more rows must be measured than of sky_view.
    request.quick_search = {64, 36, 8, 6, 64};
    if (bake.has_clouds()) {
        request.quick = {128 / layout.parts(), 1};
        request.quick_search = {16, 16, 4, 2, 16};
        request.full_search = {128, 64, 16, 8, 256};
    }
    return request;
}

// Makes what follows from the texels once they are known: the lights, the sun's disc and rough levels.
class EnvironmentFinish {
  public:
    EnvironmentFinish(const SkyLights& lights, const EnvironmentBake& bake,
                      const EnvironmentModels& models, const BakeOptions& options)
        : lights_(lights), bake_(bake), models_(models), options_(options) {}

    void operator()(Baked& table) const {
        if (!bake_.lights && bake_.sun == SunInMap::none &&
            bake_.level_content == LevelContent::mean) {
            return;
        }
        const std::vector<SunPoint> sun = sun_points(lights_, bake_, models_.clouds());
        if (bake_.lights) add_lights(sun, table);
        std::vector<Image2<double>> rough;
        if (bake_.level_content == LevelContent::ggx) rough = rough_levels(sun, table);
        if (bake_.sun == SunInMap::disc) add_disc(sun, table);
        for (const Image2<double>& level : rough) add_level(level, table);
    }

  private:
    void add_lights(const std::vector<SunPoint>& sun, Baked& table) const {
        const Image2<float>& map = table.image();
        const EnvironmentLights lights = {irradiance_of(sun, LitSurface::facing_sun, map.channels),
                                          irradiance_of(sun, LitSurface::level, map.channels),
                                          level_irradiance(map, models_.layout()),
                                          harmonics_of(map, models_.layout())};
        add_light_facts(lights, bake_, table);
        table.companion = CompanionFile{"json", lights_json(lights, bake_, table)};
    }

    void add_disc(const std::vector<SunPoint>& sun, Baked& table) const {
        Image2<double> map = in_double(table.image());
        add_sun_points(sun, models_.layout(), map);
        table.range = {};
        set_image(store_texels(map, table, table.range), table);
    }

    // Made of a table that does not yet hold the disc, whose light is added in closed form.
    std::vector<Image2<double>> rough_levels(const std::vector<SunPoint>& sun, Baked& table) const {
        const MapPyramid pyramid(bake_.mapping, table.image());
        const std::vector<SunPoint> disc =
            bake_.sun == SunInMap::disc ? merged(sun) : std::vector<SunPoint>{};
        std::vector<Image2<double>> levels;
        std::vector<double> roughness = {0};
        std::array<int, 3> size = table.levels.front().size;
        for (int level = 1; level < table.mips && !options_.cancelled(); ++level) {
            size = next_mip_size(size);
            const EnvironmentLayout layout(bake_.mapping, {size[0], size[1]});
            roughness.push_back(roughness_of_level(level, table.mips));
            levels.push_back(prefiltered(pyramid, layout, roughness.back(), options_));
            add_reflected_sun(disc, layout, roughness.back(), options_, levels.back());
        }
        table.details.emplace_back("roughness_of_levels", to_digits(roughness, 9));
        return levels;
    }

    const SkyLights& lights_;
    const EnvironmentBake& bake_;
    const EnvironmentModels& models_;
    const BakeOptions& options_;
};

}  // namespace

Place environment_place(const EnvironmentLayout& layout, int part, double x, double y) {
    if (layout.mapping() == EnvironmentMapping::longitude_latitude) {
        return {{"azimuth_deg", 360 * (x - 0.5)}, {"elevation_deg", 180 * (0.5 - y)}};
    }
    const MapAngles angles = angles_of(layout.direction(part, x, y));
    return {{"azimuth_deg", angles.azimuth * kDegreesPerRadian},
            {"elevation_deg", angles.elevation * kDegreesPerRadian}};
}

std::vector<double> solar_irradiance_of(const EnvironmentBake& bake) {
    const std::vector<double>& all = bake.solar_irradiance;
    if (bake.packet == 0 || all.empty()) return all;
    const std::size_t first =
        config::wavelengths_per_packet * static_cast<std::size_t>(bake.packet - 1);
    const std::size_t last = std::min(first + config::wavelengths_per_packet, all.size());
    return {all.begin() + static_cast<std::ptrdiff_t>(first),
            all.begin() + static_cast<std::ptrdiff_t>(last)};
}

config::Outcome<Baked> bake_environment(const SkyLights& lights, const EnvironmentBake& bake,
                                        const BakeOptions& options, Baked table,
                                        std::span<const CloudMedium> media) {
    const EnvironmentModels models(lights, bake, media, options);
    if (options.cancelled()) return {};
    describe_environment(bake, models.camera(), lights.first().shell(), table);
    const AccuracyRequest request = request_of_environment(bake, models.layout());
    StackedParts parts;
    for (int part = 0; part < models.layout().parts(); ++part) {
        const auto place_of = [layout = models.layout(), part](double x, double y) {
            return environment_place(layout, part, x, y);
        };
        if (!add_part(make_part(models.of_part(part), request, options, place_of, table), parts)) {
            break;
        }
    }
    return stack_tables(std::move(parts), options,
                        EnvironmentFinish(lights, bake, models, options));
}

}  // namespace skybake
