#include "bakers/light/sky_colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <type_traits>
#include <utility>

#include "bakers/color/spectral_color.h"
#include "bakers/math/bake_clock.h"
#include "config/fields/fields.h"
#include "config/sections/layer.h"
#include "config/sections/spectral_air.h"

namespace skybake {

ColorWords words_of(const config::Color& color) {
    const config::Section& section = *config::find_section("color");
    const auto word = [&](std::string_view key, auto value) {
        return std::string(config::choice_name(*config::find_field(section, key), value));
    };
    // Weights without colours are for the space that displays have.
    const config::ColorSpace space =
        color.space == config::ColorSpace::none ? config::ColorSpace::linear_srgb : color.space;
    return {word("space", space), word("white", color.white), word("sun", color.sun),
            word("observer", color.observer)};
}

namespace {

// Elevations of the sun's disc whose colours are measured, not fitted.
constexpr std::array kMeasuredDiscs_deg = {5.0, 1.0, 0.0};
bool is_measured(double elevation_deg) {
    return std::ranges::find(kMeasuredDiscs_deg, elevation_deg) != kMeasuredDiscs_deg.end();
}

// The sun's own light counts as so many views, since it lights all that a runtime draws.
constexpr double kWeightOfDisc = 4;
// It counts as far as it is seen: in haze the sun is lost in the sky long before it sets, and the
// colour of what is left of it is so red that a fit to it would spoil all others. Spread over its
// disc of 6.8e-5 sr, this share of its light is as bright as the sky around a low sun, 0.05 /sr.
constexpr double kFaintestSun = 6.8e-5 * 0.05;

ColorTarget target_of(const config::Color& color) {
    const ColorWords words = words_of(color);
    return *color_target(words.space, words.white, words.sun);
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

    // Returns how much of a disc is seen, from 0 to 1.
    double visibility(std::size_t i) const {
        return luminances_[i] / (luminances_[i] + kFaintestSun);
    }

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

// The light to which weights are fitted: `views` views and the discs.
std::vector<ColorSample> fitted_samples(const Spectra& spectra, std::size_t views,
                                        const std::vector<config::Length>& wavelengths,
                                        const ColorTarget& target) {
    const std::vector<double> all_nm = spectrum_nm();
    const Spectra few = at_wavelengths(spectra, wavelengths);
    const ColorSamples samples(spectra, few, all_nm, target);
    std::vector<ColorSample> fitted;
    for (std::size_t i = 0; i < spectra.size(); ++i) {
        const bool is_disc = i >= views;
        const bool is_used = is_disc ? !is_measured(kSpectrumDiscs_deg[i - views]) : is_fitted(i);
        const double weight = is_disc ? kWeightOfDisc * samples.visibility(i) : 1;
        if (is_used) fitted.push_back(samples.sample(i, weight));
    }
    // The sun outside the air.
    glm::dvec3 white(0);
    for (const glm::dvec3& weight : color_weights(all_nm, target)) white += weight;
    fitted.push_back({std::vector<double>(wavelengths.size(), 1.0), white, kWeightOfDisc});
    return fitted;
}

template <class One, class... Others>
constexpr bool kIsOneOf = (std::is_same_v<One, Others> || ...);

// Appends the values of all members, each with what tells where it ends. A struct has so many members:
// with one more it is not compiled.
template <class Value>
void append(std::string& text, const Value& value) {
    using namespace config;
    const auto all = [&text](const auto&... members) { (append(text, members), ...); };
    if constexpr (!std::is_class_v<Value>) {
        text += fmt::format("{} ", static_cast<double>(value));
    } else if constexpr (std::is_same_v<Value, std::string>) {
        text += fmt::format("{} {} ", value.size(), value);
    } else if constexpr (requires { value.has_value(); }) {
        all(value.has_value());
        if (value) all(*value);
    } else if constexpr (requires { value.begin(); }) {
        all(value.size());
        for (const auto& one : value) all(one);
    } else if constexpr (kIsOneOf<Value, SpectrumPoint, DensityPoint, GasAmount, SphereKind>) {
        const auto& [a, b] = value;
        all(a, b);
    } else if constexpr (kIsOneOf<Value, IndexPoint, ColorRequest>) {
        const auto& [a, b, c] = value;
        all(a, b, c);
    } else if constexpr (kIsOneOf<Value, Color, AerosolLaw>) {
        const auto& [a, b, c, d] = value;
        all(a, b, c, d);
    } else if constexpr (kIsOneOf<Value, Atmosphere, LayerParticles>) {
        const auto& [a, b, c, d, e] = value;
        all(a, b, c, d, e);
    } else if constexpr (kIsOneOf<Value, Particles>) {
        const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = value;
        all(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
    } else if constexpr (kIsOneOf<Value, Layer>) {
        const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q] = value;
        all(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q);
    } else {
        const auto& [number] = value;
        all(number);
    }
}

// Returns the weights and, after them, their error; none after an interruption.
std::vector<glm::dvec3> fit(const ColorRequest& request, const BakeOptions& options) {
    const ColorSkies skies(request.atmosphere, request.wavelengths, options);
    if (options.cancelled()) return {};
    std::vector<glm::dvec3> numbers = skies.fitted_weights(request.wavelengths, request.color);
    const ColorError error = skies.error(request.wavelengths, request.color, numbers);
    numbers.emplace_back(error.median, error.ninth_decile, error.max);
    numbers.emplace_back(error.disc[0], error.disc[1], error.disc[2]);
    numbers.emplace_back(error.skies, 0, 0);
    return numbers;
}

std::shared_ptr<const SkyColors> kept_or_fitted(const ColorRequest& request,
                                                const BakeOptions& options) {
    const std::size_t count = request.wavelengths.size();
    const Intermediates* shared = options.intermediates;
    SkyColors colors;
    colors.weights = kept_or_made<glm::dvec3>(shared ? shared->kept() : nullptr,
                                              {"colours", kColorFitVersion, key_text(request)},
                                              count + 3, [&] { return fit(request, options); });
    if (colors.weights.empty()) return nullptr;
    const glm::dvec3* error = &colors.weights[count];
    colors.error = {error[0].x,
                    error[0].y,
                    error[0].z,
                    {error[1].x, error[1].y, error[1].z},
                    static_cast<int>(error[2].x)};
    colors.weights.resize(count);
    return std::make_shared<const SkyColors>(std::move(colors));
}

constexpr double kSecondsOfFit = 1;

}  // namespace

ColorSkies::ColorSkies(const config::Atmosphere& atmosphere,
                       const std::vector<config::Length>& given, const BakeOptions& options)
    : ColorSkies(sky_spectra(atmosphere, given, spectrum_views(), options)) {}

ColorSkies::ColorSkies(Spectra spectra)
    : views_(spectrum_views().size()), spectra_(std::move(spectra)) {}

ColorError ColorSkies::error(const std::vector<config::Length>& wavelengths,
                             const config::Color& color,
                             const std::vector<glm::dvec3>& weights) const {
    const Spectra few = at_wavelengths(spectra_, wavelengths);
    const ColorSamples samples(spectra_, few, spectrum_nm(), target_of(color));
    ColorError error;
    std::vector<double> errors;
    for (std::size_t i = 0; i < views_; ++i) {
        if (!is_fitted(i)) errors.push_back(samples.error(i, weights));
    }
    std::ranges::sort(errors);
    error.skies = static_cast<int>(errors.size());
    error.median = errors[errors.size() / 2];
    error.ninth_decile = errors[errors.size() * 9 / 10];
    error.max = errors.back();
    for (std::size_t d = 0; d < kMeasuredDiscs_deg.size(); ++d) {
        const auto at = std::ranges::find(kSpectrumDiscs_deg, kMeasuredDiscs_deg[d]);
        error.disc[d] = samples.error(
            views_ + static_cast<std::size_t>(at - kSpectrumDiscs_deg.begin()), weights);
    }
    return error;
}

std::vector<glm::dvec3> ColorSkies::fitted_weights(const std::vector<config::Length>& wavelengths,
                                                   const config::Color& color) const {
    const ColorTarget target = target_of(color);
    return fit_color_weights(in_nm(wavelengths),
                             fitted_samples(spectra_, views_, wavelengths, target), target);
}

std::vector<glm::dvec3> linear_color_weights(const std::vector<config::Length>& wavelengths,
                                             const config::Color& color) {
    return fit_color_weights(in_nm(wavelengths), {}, target_of(color));
}

Need need_of(const ColorRequest& request) {
    return {NeedKey(request), "colours of wavelengths", kSecondsOfFit, 0};
}

std::string key_text(const ColorRequest& request) {
    std::string text;
    append(text, request);
    return text;
}

std::shared_ptr<const SkyColors> colors_of(const ColorRequest& request,
                                           const BakeOptions& options) {
    const BakeTime time(BakePart::colors);
    return shared_or_made<SkyColors>(options.intermediates, NeedKey(request),
                                     [&] { return kept_or_fitted(request, options); });
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
