#include "bakers/preview/pictures/sky_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "bakers/field/interpolation.h"
#include "bakers/light/shared_light.h"
#include "bakers/plot/chart.h"
#include "bakers/preview/pictures/asset_pictures.h"
#include "bakers/preview/pictures/sky_reference.h"
#include "bakers/render/cloud_view.h"
#include "bakers/render/sky_view.h"

namespace skybake {
namespace {

constexpr double kLowestDegrees = -20;
constexpr double kHighestDegrees = 70;
// The colour around a dome. It is dark, so that the brightness of the horizon is visible.
constexpr std::array<std::uint8_t, 3> kSurround = {22, 24, 28};

// The data that all pictures of a preview share.
struct SkyScene {
    SkyMedium medium;
    SkyTables tables;
    double camera_altitude_km;
    const SkyPreviewOptions& options;
    int threads;
    std::vector<double> daylight{};            // of daylight_shares, for each of the options' suns
    std::unique_ptr<const SkyLight> solved{};  // the reference; null: none is shown
    std::string why_unsolved{};                // a sentence, if it was asked for but is missing
};

SkyView dome_view(const SkyScene& scene, double sun_elevation_degrees, int pixels) {
    return {.projection = SkyProjection::dome,
            .width = pixels,
            .height = pixels,
            .camera_altitude_km = scene.camera_altitude_km,
            .sun_elevation_degrees = sun_elevation_degrees};
}

SkyView panorama_view(const SkyScene& scene, double sun_elevation_degrees) {
    SkyView view = dome_view(scene, sun_elevation_degrees, scene.options.panorama_pixels);
    view.projection = SkyProjection::panorama;
    view.lowest_degrees = kLowestDegrees;
    view.highest_degrees = kHighestDegrees;
    view.height =
        static_cast<int>(std::lround(view.width * (kHighestDegrees - kLowestDegrees) / 360));
    return view;
}

// Returns a sky with the sun and its glare in linear sRGB.
Image2<float> with_sun(const SkyScene& scene, const SkyView& view, Image2<float> radiance) {
    add_sun(scene.medium, scene.tables, view, scene.options.glare, radiance);
    return scene.tables.screen.shown(radiance);
}

// A picture of the tables' sky in linear sRGB, and its exposure, which the sun and its glare do not
// change.
struct ShownSky {
    Image2<float> colors;
    double exposure = 1;
};

ShownSky shown_sky(const SkyScene& scene, const SkyView& view, double daylight) {
    Image2<float> radiance = render_sky(scene.medium, scene.tables, view, scene.threads);
    const std::optional<double> stops = scene.options.exposure_stops;
    const double exposure = stops ? std::exp2(*stops)
                                  : sky_exposure_for(scene.tables.screen.shown(radiance),
                                                     scene.options.tone_curve, daylight);
    return {with_sun(scene, view, std::move(radiance)), exposure};
}

// Enlarges an image; each pixel is a bilinear lookup.
Image2<float> enlarged(const Image2<float>& image, int pixels) {
    Image2<float> result(pixels, pixels, image.channels);
    std::array<double, kMaxChannels> value{};
    for (int y = 0; y < pixels; ++y) {
        for (int x = 0; x < pixels; ++x) {
            bilinear(image, (x + 0.5) / pixels, (y + 0.5) / pixels, value.data());
            for (int c = 0; c < image.channels; ++c) {
                result.texel(x, y)[c] = static_cast<float>(value[static_cast<std::size_t>(c)]);
            }
        }
    }
    return result;
}

// Draws a dome of linear sRGB, tone-mapped, with the circle's edge smoothed against its surround.
Picture dome_picture(const Image2<float>& shown, const SkyView& view, double exposure,
                     ToneCurve curve) {
    Picture picture = tone_mapped(shown, exposure, curve);
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
            const double share = coverage_at(view, x, y);
            if (share == 1) continue;
            std::uint8_t* pixel =
                picture.rgb.data() +
                3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(view.width) +
                     static_cast<std::size_t>(x));
            for (std::size_t c = 0; c < kSurround.size(); ++c) {
                pixel[c] = static_cast<std::uint8_t>(
                    std::lround(share * pixel[c] + (1 - share) * kSurround[c]));
            }
        }
    }
    return picture;
}

ChartAxis dome_axis(const char* title) {
    return {title, [](double t) { return 180 * t - 90; }, AxisTicks::angles};
}

Picture framed_dome(const Picture& dome, const std::string& title) {
    return framed(dome, title, dome_axis("across (deg from the zenith)"),
                  dome_axis("towards the sun (deg from the zenith)"));
}

// Returns the range of the difference's colours: the smallest of 1, 2, 5, 10 ... percent that
// contains 99 of 100 pixels, but at most 100. So pictures show where a table fails, and errors
// above 100 % need not be distinguished.
double percent_shown(const Image2<float>& relative) {
    std::vector<float> sizes;
    for (const float value : relative.texels) sizes.push_back(std::fabs(value));
    const auto rank =
        sizes.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(sizes.size() - 1));
    std::nth_element(sizes.begin(), rank, sizes.end());
    double limit = 0.1;
    for (int i = 0; limit < std::min(100 * double{*rank}, 100.0); ++i) {
        limit *= i % 3 == 1 ? 2.5 : 2;
    }
    return limit;
}

Picture difference_chart(const SkyDifference& difference, int pixels) {
    Image2<float> percent(difference.relative.width, difference.relative.height, 1);
    for (int y = 0; y < percent.height; ++y) {
        for (int x = 0; x < percent.width; ++x) {
            *percent.texel(x, percent.height - 1 - y) = 100 * *difference.relative.texel(x, y);
        }
    }
    const double limit = percent_shown(difference.relative);
    return false_colour_chart(percent, {-limit, limit, false, true, "tables over solved sky (%)"},
                              "difference, mean of the channels",
                              dome_axis("across (deg from the zenith)"),
                              dome_axis("towards the sun (deg from the zenith)"), pixels);
}

std::string degrees_text(double degrees) { return fmt::format("{:g} deg", degrees); }

// Writes a number with three digits and without an exponent of ten.
std::string number_text(double value) {
    return value < 100 ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value);
}
std::string percent_text(double share) { return number_text(100 * share) + " %"; }

std::string_view glare_text(Glare glare) {
    switch (glare) {
        case Glare::none:
            break;
        case Glare::camera:
            return "The sun's glare is what a lens scatters, a hundredth of its light";
        case Glare::eye:
            return "The sun's glare is what an eye scatters (CIE 135/1)";
    }
    return "The sun has no glare";
}

// Returns what every caption of a sky says about light and camera.
std::string how_shown(const SkyScene& scene) {
    return fmt::format(
        "The camera is at {:g} km; each ray is marched in {} steps. Radiance is for a solar "
        "irradiance of 1; {}. {}.",
        scene.camera_altitude_km, kSkySteps, scene.tables.screen.words(),
        glare_text(scene.options.glare));
}

std::string figures_text(const ErrorFigures& figures) {
    return fmt::format("at most {}, RMS {}", percent_text(figures.max), percent_text(figures.rms));
}

// Adds the solved sky, and the difference from it, to a dome from the tables. Returns the end of the
// caption.
std::string compare_with_solved(const SkyScene& scene, const Picture& dome,
                                double sun_elevation_degrees, double exposure,
                                PreviewPicture& result) {
    const int pixels = scene.options.dome_pixels;
    const SkyView view = dome_view(scene, sun_elevation_degrees, pixels);
    const SkyView small = dome_view(scene, sun_elevation_degrees, scene.options.solved_pixels);
    const SkyCost cost = sky_cost(scene.medium, scene.tables, *scene.solved, small, scene.threads);
    const Image2<float> solved = with_sun(scene, view, enlarged(cost.solved, pixels));
    const std::string difference = figures_text(cost.difference.error);
    const std::string marching = figures_text(cost.marching);
    result.picture = contact_sheet(
        {framed_dome(dome, "from the tables"),
         framed_dome(dome_picture(solved, view, exposure, scene.options.tone_curve),
                     "reference: the solved sky"),
         difference_chart(cost.difference, pixels)},
        {fmt::format("sun at {}, {} steps per ray, {}", degrees_text(sun_elevation_degrees),
                     kSkySteps, exposure_text(exposure)),
         fmt::format("all orders of scattering, {0}x{0} pixels, enlarged", small.width),
         fmt::format("tables: {}; of which {} steps: {}", difference, kSkySteps, marching)},
        3);
    result.caption += fmt::format(
        " The middle shows the reference of every method, the solved sky, with the same sun; "
        "without the sun, the tables' light differs from it by {}.",
        difference);
    return fmt::format(
        " The right shows the mean of the channels' differences, each relative to the reference or "
        "to 1e-3 of the channel's largest value, whichever is larger; the colour scale is clipped "
        "at +-{:g} %. The error of marching in {} steps alone, with the same tables, is {}.",
        percent_shown(cost.difference.relative), kSkySteps, marching);
}

PreviewPicture dome_of(const SkyScene& scene, std::size_t sun) {
    const double sun_elevation_degrees = scene.options.sun_elevations_degrees[sun];
    const SkyView view = dome_view(scene, sun_elevation_degrees, scene.options.dome_pixels);
    const auto [colors, exposure] = shown_sky(scene, view, scene.daylight[sun]);

    PreviewPicture result;
    result.name = "sky_" + sun_stem(sun_elevation_degrees);
    result.title = fmt::format("Sky, {}", sun_text(sun_elevation_degrees));
    result.exposure = exposure;
    result.group = "domes";
    result.tab = sun_text(sun_elevation_degrees);
    result.caption = fmt::format(
        "This is a fisheye view of the upper hemisphere with the sun towards the top; {}.",
        tone_text(exposure, scene.options.tone_curve));
    std::string end;
    const Picture dome = dome_picture(colors, view, exposure, scene.options.tone_curve);
    if (scene.solved) {
        end = compare_with_solved(scene, dome, sun_elevation_degrees, exposure, result);
    } else {
        result.picture = framed_dome(dome, "from the tables");
        result.caption += scene.why_unsolved;
    }
    result.caption += "\n" + how_shown(scene) + end;
    return result;
}

PreviewPicture panoramas(const SkyScene& scene) {
    std::vector<Picture> pictures;
    std::vector<std::string> captions;
    for (std::size_t sun = 0; sun < scene.daylight.size(); ++sun) {
        const double elevation = scene.options.sun_elevations_degrees[sun];
        const SkyView view = panorama_view(scene, elevation);
        const auto [colors, exposure] = shown_sky(scene, view, scene.daylight[sun]);
        pictures.push_back(tone_mapped(colors, exposure, scene.options.tone_curve));
        captions.push_back(fmt::format("{}, {}", sun_text(elevation), exposure_text(exposure)));
    }
    PreviewPicture result;
    result.name = "sky_panoramas";
    result.kind = PictureKind::scene;
    result.title = "Sky all around";
    result.caption = fmt::format(
        "The panorama shows the sky from the tables, with azimuths from -180 to 180 deg around the "
        "sun's and elevations from {:g} to {:g} deg; tone curve {}.\n{} The ground is lit by the "
        "sun and, through the table of multiple scattering, by a sky of uniform brightness.",
        kLowestDegrees, kHighestDegrees, tone_curve_name(scene.options.tone_curve),
        how_shown(scene));
    result.picture = contact_sheet(pictures, captions, 1);
    return result;
}

// Solves the light for the reference.
void solve_reference(const config::Atmosphere& atmosphere, SkyScene& scene) {
    const BakeOptions options{.threads = scene.threads,
                              .certification = Certification::off,
                              .progress = scene.options.progress,
                              .intermediates = scene.options.intermediates};
    auto light = std::make_unique<SkyLight>(atmosphere, config::SkyOrders::all,
                                            std::vector<std::string>{}, options);
    const auto problem = light->problem("the sky's reference");
    if (problem) {
        scene.why_unsolved =
            fmt::format(" There is no reference to compare with: {}.", problem->message);
    } else {
        scene.solved = std::move(light);
    }
}

// Reports the next picture. Returns false once the user has interrupted.
bool goes_on(const SkyScene& scene, double sun_elevation_degrees, std::size_t done) {
    Progress* progress = scene.options.progress;
    if (progress == nullptr) return true;
    const std::size_t count = scene.options.sun_elevations_degrees.size() + 1;
    progress->advance(fmt::format("sun {:g} deg", sun_elevation_degrees),
                      static_cast<double>(done) / static_cast<double>(count));
    return !progress->cancelled();
}

}  // namespace

std::vector<Need> needs_of_sky_pictures(const config::Atmosphere& atmosphere) {
    return {need_of(LightRequest{.atmosphere = atmosphere})};
}

SkyPreviewOptions draft_sky_preview() {
    SkyPreviewOptions options;
    options.sun_elevations_degrees = {60, 10, 0};
    options.dome_pixels = 192;
    options.solved_pixels = 0;
    options.panorama_pixels = 360;
    return options;
}

std::vector<PreviewPicture> sky_pictures(const config::Atmosphere& atmosphere,
                                         const PreviewAsset& transmittance,
                                         const PreviewAsset& multiple_scattering,
                                         const SkyPreviewOptions& options, int threads) {
    Outcome<SkyTables> tables = make_sky_tables(transmittance, &multiple_scattering);
    std::vector<PreviewPicture> pictures;
    if (!tables.value) return pictures;
    SkyMedium medium = make_sky_medium(atmosphere);
    if (medium.air.channels != tables.value->transmittance.channels) return pictures;
    const double altitude_km = std::min(options.camera_altitude_km, medium.air.thickness_km);
    SkyScene scene = {std::move(medium), std::move(*tables.value), altitude_km, options, threads};
    scene.tables.screen = daylight_screen({scene.medium, scene.tables}, threads);
    std::vector<SunDirection> suns;
    for (const double elevation : options.sun_elevations_degrees) suns.push_back({elevation, 0});
    scene.daylight = options.exposure_stops
                         ? std::vector<double>(suns.size(), 1.0)
                         : daylight_shares({scene.medium, scene.tables}, suns, threads);
    if (options.solved_pixels > 0) solve_reference(atmosphere, scene);
    // After an interruption the solution must not be used.
    if (is_cancelled(options.progress)) return pictures;
    // Pictures to look at come first, comparisons after them.
    if (options.panorama_pixels > 0 && !options.sun_elevations_degrees.empty()) {
        pictures.push_back(panoramas(scene));
    }
    for (std::size_t sun = 0; sun < options.sun_elevations_degrees.size(); ++sun) {
        if (!goes_on(scene, options.sun_elevations_degrees[sun], pictures.size())) return pictures;
        pictures.push_back(dome_of(scene, sun));
    }
    return pictures;
}

}  // namespace skybake
