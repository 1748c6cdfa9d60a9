#include "bakers/color/spectral_color.h"

#include <algorithm>
#include <cassert>

#include "bakers/color/observer.h"
#include "bakers/color/solar_spectrum.h"
#include "bakers/color/spectral_nodes.h"

namespace skybake {

namespace {

double irradiance(Sunlight sunlight, double wavelength_nm) {
    return sunlight == Sunlight::flat ? 1 : solar_irradiance_W_per_m2_nm(wavelength_nm);
}

// Calls at(wavelength, weight) at the points of a quadrature from a to b that is exact for
// polynomials up to degree 3: Simpson's rule.
template <class At>
void simpson(double a, double b, const At& at) {
    at(a, (b - a) / 6);
    at((a + b) / 2, (b - a) * 4 / 6);
    at(b, (b - a) / 6);
}

// The visible wavelengths where observer, sun or a spectrum known at `wavelengths_nm` may have a
// kink.
std::vector<double> kinks(std::span<const double> wavelengths_nm) {
    std::vector<double> all;
    for (std::size_t node = 0; node < kSpectralNodes; ++node) all.push_back(spectral_node_nm(node));
    for (const double nm : wavelengths_nm)
        if (is_visible(nm)) all.push_back(nm);
    std::ranges::sort(all);
    return all;
}

// XYZ, without a norm, of the hat functions of the wavelengths: each is 1 at one of them and 0 at
// the others, linear between them and constant beyond the ends.
std::vector<glm::dvec3> hat_xyz(std::span<const double> wavelengths_nm, Sunlight sunlight) {
    std::vector<glm::dvec3> hats(wavelengths_nm.size(), glm::dvec3(0));
    const auto add = [&](double nm, double weight) {
        const glm::dvec3 light = color_matching(nm) * irradiance(sunlight, nm) * weight;
        const auto above = std::ranges::upper_bound(wavelengths_nm, nm);
        const auto high = static_cast<std::size_t>(above - wavelengths_nm.begin());
        if (high == 0 || high == wavelengths_nm.size()) {
            hats[high == 0 ? 0 : high - 1] += light;
            return;
        }
        const double first = wavelengths_nm[high - 1], second = wavelengths_nm[high];
        const double fraction = (nm - first) / (second - first);
        hats[high - 1] += light * (1 - fraction);
        hats[high] += light * fraction;
    };
    const std::vector<double> pieces = kinks(wavelengths_nm);
    for (std::size_t i = 1; i < pieces.size(); ++i) simpson(pieces[i - 1], pieces[i], add);
    return hats;
}

// XYZ of light of the sun's own spectrum: the observer's answer to W / (m^2 nm), or to 1 per nm.
glm::dvec3 unscaled_sun_xyz(Sunlight sunlight) {
    constexpr double kAny_nm = 555;
    return hat_xyz(std::span(&kAny_nm, 1), sunlight).front();
}

}  // namespace

glm::dvec3 sun_xyz(Sunlight sunlight) {
    const glm::dvec3 xyz = unscaled_sun_xyz(sunlight);
    return xyz / xyz.y;
}

std::optional<ColorTarget> color_target(std::string_view space, std::string_view white,
                                        std::string_view sun) {
    const std::optional<ColorSpace> found = color_space_named(space);
    if (!found) return std::nullopt;
    return ColorTarget{*found, white == "sun" ? White::sun : White::own,
                       sun == "flat" ? Sunlight::flat : Sunlight::measured};
}

double solar_illuminance_lux() {
    return kLuminousEfficacy_lm_per_W * unscaled_sun_xyz(Sunlight::measured).y;
}

std::vector<glm::dvec3> color_weights(std::span<const double> wavelengths_nm,
                                      const ColorTarget& target) {
    assert(!wavelengths_nm.empty());
    assert(std::ranges::is_sorted(wavelengths_nm));
    const glm::dvec3 sun = unscaled_sun_xyz(target.sunlight);
    const glm::dmat3 matrix = from_xyz(target.space, target.white, sun / sun.y);
    std::vector<glm::dvec3> weights = hat_xyz(wavelengths_nm, target.sunlight);
    for (glm::dvec3& weight : weights) weight = matrix * (weight / sun.y);
    return weights;
}

glm::dvec3 color_of(std::span<const double> wavelengths_nm, std::span<const double> radiances,
                    const ColorTarget& target) {
    assert(radiances.size() == wavelengths_nm.size());
    const std::vector<glm::dvec3> weights = color_weights(wavelengths_nm, target);
    glm::dvec3 color(0);
    for (std::size_t i = 0; i < weights.size(); ++i) color += weights[i] * radiances[i];
    return color;
}

}  // namespace skybake
