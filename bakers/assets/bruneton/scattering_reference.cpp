#include "bakers/assets/bruneton/scattering_reference.h"

#include <cstddef>

namespace skybake {

namespace {

SkyMedium scattering_where(SkyMedium medium, const std::vector<bool>& is_mie, bool wanted) {
    for (std::size_t k = 0; k < medium.layers.size(); ++k) {
        if (is_mie[k] != wanted) medium.layers[k].scatters = false;
    }
    return medium;
}

}  // namespace

ScatteringReference::ScatteringReference(const SkyMedium& medium, const ScatteringContent& content,
                                         const HigherOrders* higher)
    : content_(content),
      air_(scattering_where(medium, content.is_mie(), false)),
      mie_(scattering_where(medium, content.is_mie(), true)),
      all_(medium, higher),
      air_alone_(air_, nullptr),
      mie_alone_(mie_, nullptr) {}

ScatteringParts ScatteringReference::parts(const ScatteringView& view, double sun_cos_zenith,
                                           double nu) const {
    const Shell shell = shell_of(air_.air);
    SkyRay ray;
    ray.altitude_km = view.altitude_km;
    ray.s_km = view.s_km;
    ray.length_km = view.length_km;
    ray.meets_ground = view.meets_ground;
    ray.sun_s_km = (shell.ground_radius_km + view.altitude_km) * sun_cos_zenith;
    ray.cosine_to_sun = nu;
    ray.one_minus_cosine = 1 - nu;
    ray.one_plus_cosine = 1 + nu;
    ScatteringParts parts;
    const Spectrum mie_phase = content_.mie_phase(nu);
    if (content_.wants_single()) {
        parts.air = air_alone_.up_to(ray, {ray.length_km}).front().single;
        parts.mie = mie_alone_.up_to(ray, {ray.length_km}).front().single;
    }
    if (content_.wants_higher()) parts.higher = all_.up_to(ray, {ray.length_km}).front().multiple;
    parts.air /= rayleigh_phase(nu);
    parts.higher /= rayleigh_phase(nu);
    for (std::size_t c = 0; c < kMaxChannels; ++c) {
        if (parts.mie[c] > 0) parts.mie[c] /= mie_phase[c];
    }
    return parts;
}

}  // namespace skybake
