#include "bakers/light/sky_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <utility>

#include "bakers/color/color_weights_fit.h"
#include "bakers/color/spectral_color.h"
#include "bakers/light/sky_spectra.h"
#include "config/sections/spectral_air.h"

namespace skybake {

namespace {

// Elevations of the sun's disc whose colours are measured, not fitted.
constexpr std::array kMeasuredDiscs_deg = {5.0, 1.0, 0.0};
bool is_measured(double elevation_deg) {
    return std::find(kMeasuredDiscs_deg.begin(), kMeasuredDiscs_deg.end(), elevation_deg) !=
           kMeasuredDiscs_deg.end();
}

// The sun's own light counts as so many views, since it lights all that a runtime draws; but less and
// less where haze leaves less than this share of its luminance, of which nobody sees the colour. (A
// fit to the deep red of such discs would spoil those of the sky.)
constexpr double kWeightOfDisc = 4;
constexpr double kFaintDisc = 1e-4;

ColorTarget target_of(const config::Color& color) {
    ColorTarget target;
    switch (color.space) {
        case config::ColorSpace::linear_srgb:
        case config::ColorSpace::none:
            target.space = ColorSpace::linear_srgb;
            break;
        case config::ColorSpace::rec2020:
            target.space = ColorSpace::rec2020;
            break;
        case config::ColorSpace::acescg:
            target.space = ColorSpace::acescg;
            break;
        case config::ColorSpace::xyz:
            target.space = ColorSpace::xyz;
            break;
    }
    target.white = color.white == config::WhitePoint::sun ? White::sun : White::own;
    target.sunlight =
        color.sun == config::SunSpectrum::measured ? Sunlight::measured : Sunlight::flat;
    return target;
}

std::vector<double> in_nm(const std::vector<config::Length>& wavelengths) {
    std::vector<double> nm;
    for (const config::Length wavelength : wavelengths) nm.push_back(wavelength.meters * 1e9);
    return nm;
}

// Spectra as the fit and its measurement need them.
class ColorSamples {
  public:
    ColorSamples(Spectra spectra, const Spectra& few, const std::vector<double>& nm,
                 const ColorTarget& target)
        : few_(few), weights_(color_weights(nm, target)) {
        ColorTarget luminance = target;
        luminance.space = ColorSpace::xyz;
        luminance.white = White::own;
        const std::vector<glm::dvec3> xyz = color_weights(nm, luminance);
        for (const std::vector<double>& spectrum : spectra) {
            glm::dvec3 color(0);
            double y = 0;
            for (std::size_t i = 0; i < spectrum.size(); ++i) {
                color += spectrum[i] * weights_[i];
                y += spectrum[i] * xyz[i].y;
            }
            colors_.push_back(color);
            luminances_.push_back(y);
        }
    }

    double luminance(std::size_t i) const { return luminances_[i]; }

    // Returns the sample as the fit takes it. Without light it has weight 0.
    ColorSample sample(std::size_t i, double weight) const {
        const double y = luminances_[i];
        return {few_[i], colors_[i], y > 0 ? weight / y : 0};
    }

    // The largest difference of a channel over luminance, or 0 without light.
    double error(std::size_t i, const std::vector<glm::dvec3>& weights) const {
        glm::dvec3 color(0);
        for (std::size_t k = 0; k < weights.size(); ++k) color += few_[i][k] * weights[k];
        const glm::dvec3 apart = glm::abs(color - colors_[i]);
        const double y = luminances_[i];
        return y > 0 ? std::max(std::max(apart.x, apart.y), apart.z) / y : 0;
    }

  private:
    const Spectra& few_;
    std::vector<glm::dvec3> weights_;
    std::vector<glm::dvec3> colors_;
    std::vector<double> luminances_;
};

ColorError error_of(const ColorSamples& samples, std::size_t views,
                    const std::vector<glm::dvec3>& weights) {
    ColorError error;
    std::vector<double> errors;
    for (std::size_t i = 0; i < views; ++i) {
        if (!is_fitted(i)) errors.push_back(samples.error(i, weights));
    }
    std::sort(errors.begin(), errors.end());
    error.skies = static_cast<int>(errors.size());
    error.median = errors[errors.size() / 2];
    error.ninth_decile = errors[errors.size() * 9 / 10];
    error.max = errors.back();
    for (std::size_t d = 0; d < kMeasuredDiscs_deg.size(); ++d) {
        const auto at =
            std::find(kSpectrumDiscs_deg.begin(), kSpectrumDiscs_deg.end(), kMeasuredDiscs_deg[d]);
        error.disc[d] = samples.error(
            views + static_cast<std::size_t>(at - kSpectrumDiscs_deg.begin()), weights);
    }
    return error;
}

SkyColors fit(const ColorRequest& request, const BakeOptions& options) {
    const std::vector<SpectrumView> views = spectrum_views();
    const Spectra spectra = sky_spectra(request.atmosphere, request.wavelengths, views, options);
    if (options.cancelled()) return {};
    const std::vector<double> all_nm = spectrum_nm();
    const Spectra few = at_wavelengths(spectra, request.wavelengths);
    const ColorTarget target = target_of(request.color);
    const ColorSamples samples(spectra, few, all_nm, target);
    std::vector<ColorSample> fitted;
    for (std::size_t i = 0; i < spectra.size(); ++i) {
        const bool is_disc = i >= views.size();
        const bool is_used =
            is_disc ? !is_measured(kSpectrumDiscs_deg[i - views.size()]) : is_fitted(i);
        if (!is_used) continue;
        const double seen = std::min(samples.luminance(i) / kFaintDisc, 1.0);
        fitted.push_back(samples.sample(i, is_disc ? kWeightOfDisc * seen : 1));
    }
    // The sun outside the air.
    glm::dvec3 white(0);
    for (const glm::dvec3& weight : color_weights(all_nm, target)) white += weight;
    fitted.push_back({std::vector<double>(request.wavelengths.size(), 1.0), white, kWeightOfDisc});
    SkyColors colors;
    colors.weights = fit_color_weights(in_nm(request.wavelengths), fitted, target);
    colors.error = error_of(samples, views.size(), colors.weights);
    return colors;
}

constexpr double kSecondsOfFit = 1;

}  // namespace

Need need_of(const ColorRequest& request) {
    return {NeedKey(request), "colours of wavelengths", kSecondsOfFit, 0};
}

std::shared_ptr<const SkyColors> colors_of(const ColorRequest& request,
                                           const BakeOptions& options) {
    return shared_or_made<SkyColors>(
        options.intermediates, NeedKey(request), [&]() -> std::shared_ptr<const SkyColors> {
            auto colors = std::make_shared<const SkyColors>(fit(request, options));
            return options.cancelled() ? nullptr : colors;
        });
}

std::vector<config::Atmosphere> packets_of(const config::Atmosphere& atmosphere) {
    std::vector<config::Atmosphere> packets;
    const std::size_t count = atmosphere.ground_albedo.size();
    for (std::size_t first = 0; first < count; first += kMaxChannels) {
        packets.push_back(config::channels_of(atmosphere, first,
                                              std::min<std::size_t>(count - first, kMaxChannels)));
    }
    return packets;
}

}  // namespace skybake
