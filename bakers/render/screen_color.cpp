#include "bakers/render/screen_color.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <glm/ext/matrix_double3x3.hpp>
#include <glm/matrix.hpp>
#include <numeric>
#include <optional>
#include <utility>

#include "bakers/color/color_space.h"
#include "bakers/color/spectral_color.h"

namespace skybake {

namespace {

// Returns the matrix from the colours of a file to linear sRGB under the same convention of white;
// none if this release does not know the space.
std::optional<glm::dmat3> to_linear_srgb(const ColorConvention& color) {
    const auto target = color_target(color.space, color.white, color.sun);
    if (!target) return std::nullopt;
    const glm::dvec3 sun = sun_xyz(target->sunlight);
    return from_xyz(ColorSpace::linear_srgb, target->white, sun) *
           glm::inverse(from_xyz(target->space, target->white, sun));
}

// Returns the columns of the matrix: the weights of channels that are colours.
std::vector<glm::dvec3> columns_of(const glm::dmat3& matrix) {
    return {matrix[0], matrix[1], matrix[2]};
}

std::vector<glm::dvec3> fitted_weights(const std::vector<double>& weights,
                                       const glm::dmat3& matrix) {
    std::vector<glm::dvec3> result;
    for (std::size_t i = 0; i + 2 < weights.size(); i += 3) {
        result.push_back(matrix * glm::dvec3(weights[i], weights[i + 1], weights[i + 2]));
    }
    return result;
}

// Returns the weights for spectra that are linear between wavelengths of any order.
std::vector<glm::dvec3> linear_weights(const std::vector<double>& wavelengths_nm) {
    std::vector<std::size_t> order(wavelengths_nm.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(
        order, [&](std::size_t a, std::size_t b) { return wavelengths_nm[a] < wavelengths_nm[b]; });
    std::vector<double> ascending;
    for (const std::size_t i : order) ascending.push_back(wavelengths_nm[i]);
    const std::vector<glm::dvec3> weights = color_weights(ascending, ColorTarget{});
    std::vector<glm::dvec3> result(weights.size());
    for (std::size_t i = 0; i < order.size(); ++i) result[order[i]] = weights[i];
    return result;
}

}  // namespace

ScreenColor::ScreenColor(const Conventions& conventions, int channels) {
    const auto count = static_cast<std::size_t>(channels);
    const std::vector<double>& wavelengths_nm = conventions.wavelengths_nm;
    const std::string from = fmt::format("{:.5g} nm", fmt::join(wavelengths_nm, ", "));
    if (const auto& color = conventions.color) {
        const std::optional<glm::dmat3> matrix = to_linear_srgb(*color);
        if (color->white != "sun") white_ = "D65";
        if (matrix && color->is_applied && count == 3) {
            if (color->space != "linear_srgb") weights_ = columns_of(*matrix);
            from_ = fmt::format("colours are made of {}, and shown as linear sRGB", from);
            return;
        }
        if (matrix && !color->is_applied && color->weights.size() == 3 * count) {
            weights_ = fitted_weights(color->weights, *matrix);
            from_ = fmt::format("{} become linear sRGB by the file's weights", from);
            return;
        }
    }
    if (count == 1 || count == 3 || wavelengths_nm.size() != count) return;
    weights_ = linear_weights(wavelengths_nm);
    from_ = fmt::format("{} become linear sRGB as a spectrum that is linear between them", from);
}

Image2<float> ScreenColor::shown(const Image2<float>& light) const {
    if (weights_.empty()) return light;
    Image2<float> colors(light.width, light.height, 3);
    for (int y = 0; y < light.height; ++y) {
        for (int x = 0; x < light.width; ++x) {
            const float* from = light.texel(x, y);
            glm::dvec3 sum(0);
            for (std::size_t c = 0; c < weights_.size(); ++c) sum += double{from[c]} * weights_[c];
            float* to = colors.texel(x, y);
            to[0] = static_cast<float>(sum.x);
            to[1] = static_cast<float>(sum.y);
            to[2] = static_cast<float>(sum.z);
        }
    }
    return colors;
}

ScreenColor ScreenColor::with_white(const Image2<float>& light, std::string name) const {
    const Image2<float> color = shown(light);
    if (color.channels != 3) return *this;
    const glm::dmat3 to_xyz_of_srgb = to_xyz(ColorSpace::linear_srgb);
    const glm::dvec3 white =
        to_xyz_of_srgb * glm::dvec3(color.texels[0], color.texels[1], color.texels[2]);
    if (!(white.y > 0)) return *this;
    const glm::dmat3 adapted = from_xyz(ColorSpace::linear_srgb) *
                               bradford(white / white.y, to_xyz_of_srgb * glm::dvec3(1)) *
                               to_xyz_of_srgb;
    ScreenColor result = *this;
    if (result.weights_.empty()) result.weights_ = columns_of(glm::dmat3(1));
    for (glm::dvec3& weight : result.weights_) weight = adapted * weight;
    result.white_ = std::move(name);
    return result;
}

std::string ScreenColor::words() const {
    return fmt::format("{}, in which {} is white", from_, white_);
}

}  // namespace skybake
