#include "bakers/report/truth/sky_error_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "bakers/math/parallel.h"
#include "bakers/plot/chart.h"
#include "bakers/render/sky_rays.h"

namespace skybake {
namespace {

constexpr int kChartEdge = 320;

SkyView view_of(const SkyErrorPictureOptions& options, double sun_zenith_degrees) {
    SkyView view;
    view.width = options.dome_pixels;
    view.height = options.dome_pixels;
    view.camera_altitude_km = options.camera_altitude_km;
    view.sun_elevation_degrees = 90 - sun_zenith_degrees;
    return view;
}

// Renders the radiance of the air. The ground behind it is the same for all methods, so it is left
// out.
Image2<float> render(const SkyMedium& medium, const MadeSkyMethod& method, const SkyView& view,
                     int threads) {
    const AirRadiance air = air_radiance(medium, method);
    const SunZenith sun = {sun_sine(view), sun_cosine(view)};
    Image2<float> image(view.width, view.height, medium.air.channels);
    parallel_for(view.height, threads, [&](int y) {
        for (int x = 0; x < (view.width + 1) / 2; ++x) {
            const std::optional<SkyDirection> direction = direction_at(view, x, y);
            if (!direction) continue;
            const Spectrum sky = air(view.camera_altitude_km, sun, *direction);
            for (int channel = 0; channel < image.channels; ++channel) {
                const auto value = static_cast<float>(sky[static_cast<std::size_t>(channel)]);
                image.texel(x, y)[channel] = value;
                image.texel(view.width - 1 - x, y)[channel] = value;
            }
        }
    });
    return image;
}

// Returns the difference in percent, with row 0 at the bottom and NaN outside of the dome.
Image2<float> chart_field(const SkyDifference& difference, const SkyView& view) {
    Image2<float> field(view.width, view.height, 1);
    for (int y = 0; y < view.height; ++y) {
        for (int x = 0; x < view.width; ++x) {
            *field.texel(x, view.height - 1 - y) = coverage_at(view, x, y) < 0.5
                                                       ? std::numeric_limits<float>::quiet_NaN()
                                                       : 100 * *difference.relative.texel(x, y);
        }
    }
    return field;
}

// Returns the range of the colour scale: the smallest of 0.1, 0.2, 0.5, 1 ... percent, at most 100,
// that contains 99 of 100 pixels of all domes.
double percent_shown(const std::vector<SkyDifference>& domes) {
    std::vector<float> sizes;
    for (const SkyDifference& dome : domes) {
        for (const float value : dome.relative.texels) sizes.push_back(std::fabs(value));
    }
    if (sizes.empty()) return 100;
    const auto rank =
        sizes.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(sizes.size() - 1));
    std::nth_element(sizes.begin(), rank, sizes.end());
    for (const double percent : {0.1, 0.2, 0.5, 1., 2., 5., 10., 20., 50.}) {
        if (100 * double{*rank} <= percent) return percent;
    }
    return 100;
}

ChartAxis error_dome_axis(const char* title) {
    return {title, [](double t) { return 180 * t - 90; }, AxisTicks::angles};
}

Picture picture_of(const SkyMethod& method, const SkyMethod& reference,
                   const std::vector<SkyDifference>& domes, const SkyErrorPictureOptions& options) {
    const double percent = percent_shown(domes);
    std::vector<Picture> charts;
    std::vector<std::string> captions;
    for (std::size_t i = 0; i < domes.size(); ++i) {
        const double sun = options.sun_zenith_degrees[i];
        charts.push_back(false_colour_chart(
            chart_field(domes[i], view_of(options, sun)),
            {-percent, percent, false, true, "relative error (%)"},
            fmt::format("{}, {}: sun at {:g} deg", method.family, method.name, sun),
            error_dome_axis("across (deg from the zenith)"),
            error_dome_axis("towards the sun (deg from the zenith)"), kChartEdge));
        captions.push_back(fmt::format("at most {:.2g} %, RMS {:.2g} %, against {}, {}",
                                       100 * domes[i].error.max, 100 * domes[i].error.rms,
                                       reference.family, reference.name));
    }
    return contact_sheet(charts, captions, static_cast<int>(charts.size()));
}

}  // namespace

std::string sky_error_picture_name(const SkyMethod& method) {
    return "sky_error_" + method.key + ".png";
}

config::Outcome<std::vector<ReportFile>> sky_error_pictures(
    const SkyMedium& medium, const std::vector<MadeSkyMethod>& methods,
    const SkyErrorPictureOptions& options, int threads, Progress* progress) {
    std::vector<ReportFile> files;
    if (methods.empty() || options.sun_zenith_degrees.empty()) return {files, {}};
    const MadeSkyMethod& reference = methods.back();
    std::vector<Image2<float>> exact;
    for (const double sun : options.sun_zenith_degrees) {
        exact.push_back(render(medium, reference, view_of(options, sun), threads));
    }
    for (std::size_t m = 0; m + 1 < methods.size() && !is_cancelled(progress); ++m) {
        if (progress != nullptr) {
            progress->advance("pictures",
                              static_cast<double>(m) / static_cast<double>(methods.size() - 1));
        }
        std::vector<SkyDifference> domes;
        for (std::size_t i = 0; i < exact.size(); ++i) {
            const SkyView view = view_of(options, options.sun_zenith_degrees[i]);
            domes.push_back(
                sky_difference(render(medium, methods[m], view, threads), exact[i], view));
        }
        auto png = png_bytes(picture_of(methods[m].method, reference.method, domes, options));
        if (!png.value) return {{}, std::move(png.diagnostics)};
        files.push_back({sky_error_picture_name(methods[m].method), std::move(*png.value)});
    }
    return {std::move(files), {}};
}

}  // namespace skybake
