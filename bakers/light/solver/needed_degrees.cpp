#include "bakers/light/solver/needed_degrees.h"

#include <algorithm>
#include <cstddef>

#include "bakers/air/forward_peak.h"
#include "bakers/air/optical_depth.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

// Returns a layer's scattering depth towards the zenith, if it were as dense throughout as it is at each
// altitude.
std::vector<Spectrum> depths_at(const SkyLayer& layer, const std::vector<double>& altitudes_km) {
    std::vector<Spectrum> depths(altitudes_km.size());
    if (!layer.scatters) return depths;
    Spectrum densest{};
    for (std::size_t i = 0; i < depths.size(); ++i) {
        depths[i] = scattering_at(layer.alone, altitudes_km[i]);
        densest = maximum(densest, depths[i]);
    }
    const Spectrum whole = scattering_depth(layer, 0, layer.alone.ground_radius_km);
    for (Spectrum& depth : depths) depth = whole * share_of(depth, densest);
    return depths;
}

// Returns the largest of a layer's moments beyond a degree.
Spectrum largest_beyond(const std::vector<Spectrum>& moments, int degree) {
    Spectrum most{};
    for (std::size_t l = static_cast<std::size_t>(degree) + 1; l < moments.size(); ++l) {
        most = maximum(most, maximum(moments[l], -moments[l]));
    }
    return most;
}

// Returns the share of the sun's light beyond a degree that is left at an altitude, under a sun at the
// zenith: of light of degree l, scattering takes away 1 - chi_l.
Spectrum share_left(const SkyMedium& medium, const std::vector<Spectrum>& beyond,
                    double altitude_km) {
    const double s_km = medium.air.ground_radius_km + altitude_km;
    Spectrum lost = optical_depth_to_top(medium.air, altitude_km, s_km);
    for (std::size_t k = 0; k < medium.layers.size(); ++k) {
        const SkyLayer& layer = medium.layers[k];
        if (layer.scatters) lost -= beyond[k] * scattering_depth(layer, altitude_km, s_km);
    }
    return exponential(-lost);
}

// Tells at which altitudes more than a negligible share of the light is scattered beyond a degree. Who
// looks at thick air sees an optical depth of 1, of which this is the share.
std::vector<bool> needs_more(const SkyMedium& medium, const std::vector<double>& altitudes_km,
                             const std::vector<std::vector<Spectrum>>& depths,
                             const std::vector<std::vector<Spectrum>>& moments, int degree) {
    std::vector<Spectrum> beyond;  // of each layer
    for (const std::vector<Spectrum>& of_layer : moments) {
        beyond.push_back(largest_beyond(of_layer, degree));
    }
    std::vector<bool> needs(altitudes_km.size());
    for (std::size_t i = 0; i < needs.size(); ++i) {
        Spectrum sum{};
        for (std::size_t k = 0; k < depths.size(); ++k) sum += beyond[k] * depths[k][i];
        // The ground's edge makes light of low degrees anew, and haze scatters it.
        if (degree >= kDegreeOfHaze) sum *= share_left(medium, beyond, altitudes_km[i]);
        needs[i] = largest(sum) > kNegligibleLight;
    }
    return needs;
}

}  // namespace

std::vector<int> needed_degrees(const SkyMedium& medium, const std::vector<double>& altitudes_km,
                                int degree) {
    const std::size_t count = altitudes_km.size();
    if (degree <= kDegreeOfAir) return std::vector<int>(count, degree);  // as for colours
    std::vector<std::vector<Spectrum>> depths;
    std::vector<std::vector<Spectrum>> moments;
    for (const SkyLayer& layer : medium.layers) {
        depths.push_back(depths_at(layer, altitudes_km));
        moments.push_back(scattered_moments(layer, degree + 1));
    }
    std::vector<int> degrees(count, kDegreeOfAir);
    for (const int enough : {kDegreeOfAir, kDegreeOfHaze}) {
        if (enough >= degree) continue;
        const int next = enough == kDegreeOfAir ? std::min(degree, kDegreeOfHaze) : degree;
        const std::vector<bool> needs = needs_more(medium, altitudes_km, depths, moments, enough);
        for (std::size_t i = 0; i < count; ++i) {
            const bool near = (i > 0 && needs[i - 1]) || (i + 1 < count && needs[i + 1]);
            if (needs[i] || near) degrees[i] = next;
        }
    }
    return degrees;
}

}  // namespace skybake
