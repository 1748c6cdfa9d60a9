#include "bakers/color/observer.h"

namespace skybake {

namespace {

struct MatchingRow {
    double x, y, z;
};

constexpr MatchingRow kMatching[kSpectralNodes] = {
#include "bakers/color/color_matching.inc"
};

}  // namespace

glm::dvec3 color_matching(double wavelength_nm) {
    if (!is_visible(wavelength_nm)) return glm::dvec3(0);
    const SpectralPlace place = spectral_place(wavelength_nm);
    const MatchingRow& low = kMatching[place.below];
    const MatchingRow& high = kMatching[place.below + 1];
    return {place.between(low.x, high.x), place.between(low.y, high.y),
            place.between(low.z, high.z)};
}

}  // namespace skybake
