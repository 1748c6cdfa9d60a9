#include "bakers/color/spectral_color.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "bakers/color/observer.h"

namespace skybake {

namespace {

constexpr double kSolar[kSpectralNodes] = {
#include "bakers/color/solar_spectrum.inc"
};

}  // namespace

double solar_irradiance_W_per_m2_nm(double wavelength_nm) {
    if (!is_visible(wavelength_nm)) return 0;
    const SpectralPlace place = spectral_place(wavelength_nm);
    return place.between(kSolar[place.below], kSolar[place.below + 1]);
}

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

namespace {

// The weight, in the mean square over samples, of differences from the weights of color_weights: so
// little that it decides only between weights which give the same colours to a thousandth.
constexpr double kRestraint = 1e-3;

// A symmetric, positive matrix by rows, and its solution by Cholesky's method.
class NormalEquations {
  public:
    explicit NormalEquations(std::size_t size) : size_(size), matrix_(size * size), right_(size) {}

    double& at(std::size_t row, std::size_t column) { return matrix_[row * size_ + column]; }
    glm::dvec3& right(std::size_t row) { return right_[row]; }

    std::vector<glm::dvec3> solve() {
        for (std::size_t j = 0; j < size_; ++j) {
            for (std::size_t k = 0; k < j; ++k) at(j, j) -= at(j, k) * at(j, k);
            assert(at(j, j) > 0);
            at(j, j) = std::sqrt(at(j, j));
            for (std::size_t i = j + 1; i < size_; ++i) {
                for (std::size_t k = 0; k < j; ++k) at(i, j) -= at(i, k) * at(j, k);
                at(i, j) /= at(j, j);
            }
        }
        std::vector<glm::dvec3> x = right_;
        for (std::size_t i = 0; i < size_; ++i) {
            for (std::size_t k = 0; k < i; ++k) x[i] -= at(i, k) * x[k];
            x[i] /= at(i, i);
        }
        for (std::size_t i = size_; i-- > 0;) {
            for (std::size_t k = i + 1; k < size_; ++k) x[i] -= at(k, i) * x[k];
            x[i] /= at(i, i);
        }
        return x;
    }

  private:
    std::size_t size_;
    std::vector<double> matrix_;
    std::vector<glm::dvec3> right_;
};

// color_weights of wavelengths in any order. Equal wavelengths share their weight.
std::vector<glm::dvec3> weights_of_lines(std::span<const double> wavelengths_nm,
                                         const ColorTarget& target) {
    std::vector<double> ascending(wavelengths_nm.begin(), wavelengths_nm.end());
    std::ranges::sort(ascending);
    ascending.erase(std::unique(ascending.begin(), ascending.end()), ascending.end());
    const std::vector<glm::dvec3> sorted = color_weights(ascending, target);
    std::vector<glm::dvec3> weights;
    for (const double nm : wavelengths_nm) {
        const auto at = std::ranges::lower_bound(ascending, nm);
        const auto alike = std::ranges::count(wavelengths_nm, nm);
        weights.push_back(sorted[static_cast<std::size_t>(at - ascending.begin())] /
                          static_cast<double>(alike));
    }
    return weights;
}

}  // namespace

std::vector<glm::dvec3> fit_color_weights(std::span<const double> wavelengths_nm,
                                          const std::vector<ColorSample>& samples,
                                          const ColorTarget& target) {
    const std::size_t count = wavelengths_nm.size();
    std::vector<glm::dvec3> weights = weights_of_lines(wavelengths_nm, target);
    // The unknowns are what is added to these weights.
    NormalEquations equations(count);
    double squares = 0;
    for (const ColorSample& sample : samples) {
        glm::dvec3 missing = sample.color;
        for (std::size_t i = 0; i < count; ++i) missing -= sample.light[i] * weights[i];
        const double square = sample.weight * sample.weight;
        for (std::size_t i = 0; i < count; ++i) {
            const double light = square * sample.light[i];
            equations.right(i) += light * missing;
            for (std::size_t j = 0; j <= i; ++j) equations.at(i, j) += light * sample.light[j];
            squares += light * sample.light[i];
        }
    }
    if (!(squares > 0)) return weights;
    const double restraint = kRestraint * kRestraint * squares / static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i) equations.at(i, i) += restraint;
    const std::vector<glm::dvec3> added = equations.solve();
    for (std::size_t i = 0; i < count; ++i) weights[i] += added[i];
    return weights;
}

}  // namespace skybake
