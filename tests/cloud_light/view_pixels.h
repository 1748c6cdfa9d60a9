// Pixels of pictures of a layer of clouds from four sides, marched and by paths, and how far they differ.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/ext/vector_double3.hpp>
#include <limits>
#include <vector>

#include "bakers/assets/cloud_light/cloud_light_volume.h"
#include "bakers/assets/cloud_light/radiance_solver.h"
#include "bakers/assets/cloud_light/radiance_volume.h"
#include "bakers/assets/cloud_light/texel_fit.h"
#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/sources/source_volume.h"
#include "bakers/field/baked.h"
#include "bakers/field/certify.h"
#include "bakers/field/pixel_type.h"
#include "bakers/math/parallel.h"
#include "config/assets/cloud_volume.h"
#include "tests/cloud_light/radiance_view.h"

namespace skybake::test {

constexpr int kDegree = 3;
constexpr int kColumns = 8;  // of a picture
constexpr int kRows = 6;
constexpr int kPathsOfPixel = 1024;
constexpr int kThreads = 2;
constexpr double kSunAzimuth = 0.3;
constexpr std::uint32_t kTowardsSunFromBelow = 2;  // a view

inline BakeOptions with_threads() { return {.threads = kThreads}; }

// The layer of the recipe's first asset.
inline cloud_light::CloudLayer layer_of(const config::Parameters& parameters) {
    const auto& of = parameters.bakes[0].as<config::CloudVolumeBake>();
    Facts facts;
    const BakeOptions options = with_threads();
    const auto held = hold_source_volume(parameters, "v", options, facts);
    return cloud_light::make_layer(*held.value, 0, spanned_cloud(parameters, of), options);
}

inline cloud_light::TexelFit fit_of(const cloud_light::CloudLayer& layer,
                                    const cloud_light::PlaceGrid& places,
                                    const std::array<int, 3>& size) {
    return {places.count, size, density_around(layer, places, kThreads), kThreads};
}

// As files hold them.
inline std::vector<float> texels_of(const cloud_light::TexelFit& fit,
                                    const std::vector<float>& values, cloud_light::ShownAs shown) {
    constexpr float kAny = std::numeric_limits<float>::max();
    const float least = shown == cloud_light::ShownAs::sunlight ? 0 : -kAny;
    std::vector<float> texels = fit.fit(values, shown, {least, kAny});
    round_values(texels.data(), texels.size(), config::PixelType::half);
    return texels;
}

// The coefficients of one source's light, as the baker makes them.
inline std::vector<std::vector<float>> radiance_texels(const cloud_light::CloudLayer& layer,
                                                       const config::CloudLightBake& bake,
                                                       const cloud_light::LayerSources& sources) {
    const auto cells = cloud_light::place_grid(layer.size, cloud_light_spacing(bake), false);
    const auto solved = cloud_light::solve_radiance(
        layer, cells, cloud_light::scattering_of(layer, bake), kDegree, sources, with_threads());
    const cloud_light::TexelFit fit = fit_of(layer, cells, cloud_light_size(layer.size, bake));
    std::vector<std::vector<float>> texels;
    for (std::size_t c = 0; c < solved.scattered.count(); ++c) {
        texels.push_back(texels_of(fit, cloud_light::values_of(solved.scattered, c),
                                   cloud_light::ShownAs::itself));
    }
    return texels;
}

struct Pixel {
    glm::dvec3 place{};
    glm::dvec3 look{};
    std::uint32_t number = 0;
    double marched = 0;
    cloud_light::TracedRadiance traced;
    double passed = 1;
};

// Four views: from above and from below, near the sun's side and near the other one.
inline Pixel pixel_of(const cloud_light::CloudLayer& layer, int i) {
    constexpr std::array<double, 4> kElevations = {-0.6, -0.6, 0.6, 0.6};
    constexpr std::array<double, 4> kFromSun = {0.8, 2.4, 0.8, 2.4};
    const auto view = static_cast<std::size_t>(i / (kColumns * kRows));
    const int row = i / kColumns % kRows;
    Pixel pixel;
    pixel.number = static_cast<std::uint32_t>(i);
    pixel.look = cloud_light::towards(kElevations[view], kSunAzimuth + kFromSun[view]);
    pixel.place = {(i % kColumns + 0.5) / kColumns * layer.size[0],
                   (row + 0.5) / kRows * layer.size[1], pixel.look.z < 0 ? layer.size[2] : 0};
    return pixel;
}

// The pixels that the cloud covers, marched.
inline std::vector<Pixel> covered_pixels(const cloud_light::CloudLayer& layer,
                                         const LightTextures& textures,
                                         const cloud_light::CloudScattering& scattering,
                                         const cloud_light::LayerSources& sources) {
    std::vector<Pixel> pixels(4 * kColumns * kRows);
    parallel_for(static_cast<int>(pixels.size()), kThreads, [&](int i) {
        Pixel& pixel = pixels[static_cast<std::size_t>(i)];
        pixel = pixel_of(layer, i);
        pixel.marched = marched(layer, textures, scattering, sources, kDegree, pixel.place,
                                pixel.look, 0.5, pixel.passed);
    });
    const auto is_clear = [](const Pixel& pixel) { return pixel.passed > 0.99; };
    pixels.erase(std::remove_if(pixels.begin(), pixels.end(), is_clear), pixels.end());
    return pixels;
}

inline void trace(const cloud_light::CloudLayer& layer,
                  const cloud_light::CloudScattering& scattering,
                  const cloud_light::LayerSources& sources, int paths_of_pixel,
                  std::vector<Pixel>& pixels) {
    const cloud_light::CloudPaths paths(layer, scattering, sources, kThreads);
    parallel_for(static_cast<int>(pixels.size()), kThreads, [&](int i) {
        Pixel& pixel = pixels[static_cast<std::size_t>(i)];
        pixel.traced = paths.trace(pixel.place, pixel.look, paths_of_pixel, 7, pixel.number);
    });
}

// Shares of the mean radiance.
struct Figures {
    int pixels = 0;
    double rms = 0;          // without the noise of the paths
    double noise = 0;        // root mean square of the standard errors
    double p99 = 0;          // with noise
    double most = 0;         // with noise
    double single = 0;       // RMS of single scattering alone
    double towards_sun = 0;  // RMS of the view from below, with noise
    double other_views = 0;  // and of the other three
};

// With noise.
inline double rms_of(const std::vector<Pixel>& pixels, bool towards_sun) {
    ErrorStatistics errors;
    for (const Pixel& pixel : pixels) {
        const bool is_towards_sun = pixel.number / (kColumns * kRows) == kTowardsSunFromBelow;
        if (is_towards_sun == towards_sun) errors.add(pixel.marched - pixel.traced.sum());
    }
    return errors.figures().rms;
}

inline Figures figures_of(const std::vector<Pixel>& pixels) {
    std::vector<double> errors;
    double mean = 0;
    Figures figures;
    for (const Pixel& pixel : pixels) {
        mean += pixel.traced.sum();
        errors.push_back(std::fabs(pixel.marched - pixel.traced.sum()));
        figures.rms += errors.back() * errors.back();
        figures.noise += pixel.traced.standard_error * pixel.traced.standard_error;
        figures.single += pixel.traced.higher * pixel.traced.higher;
    }
    const auto count = static_cast<double>(errors.size());
    mean /= count;
    figures.towards_sun = rms_of(pixels, true) / mean;
    figures.other_views = rms_of(pixels, false) / mean;
    std::sort(errors.begin(), errors.end());
    figures.pixels = static_cast<int>(errors.size());
    figures.p99 = errors[static_cast<std::size_t>(0.99 * (count - 1))] / mean;
    figures.most = errors.back() / mean;
    figures.rms = std::sqrt(std::max(figures.rms - figures.noise, 0.0) / count) / mean;
    figures.noise = std::sqrt(figures.noise / count) / mean;
    figures.single = std::sqrt(figures.single / count) / mean;
    return figures;
}

}  // namespace skybake::test
