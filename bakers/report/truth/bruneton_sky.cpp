#include "bakers/report/truth/bruneton_sky.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/air/forward_peak.h"
#include "bakers/air/particles/phase_function.h"
#include "bakers/assets/bruneton/bruneton_volume.h"
#include "bakers/assets/bruneton/lookup_fit.h"
#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/light/sky_ray.h"
#include "bakers/light/solver/solve_light.h"
#include "config/assets/bruneton.h"

namespace skybake {

using config::BrunetonBake;
using config::BrunetonTable;

namespace {

bool is_peaked(const SkyLayer& layer) {
    const std::vector<PhaseFunction>& functions = layer.phase.functions;
    return layer.scatters &&
           std::any_of(functions.begin(), functions.end(), [](const PhaseFunction& phase) {
               return phase.g != 0 || phase.table != nullptr;
           });
}

BrunetonBake bake_of(const SkyMedium& medium, const BrunetonSkySize& size, BrunetonTable table,
                     bool combined) {
    BrunetonBake bake;
    bake.table = table;
    bake.size = size.texels;
    bake.nu_size = size.nu_size;
    bake.sun_cos_zenith_min = size.sun_cos_zenith_min;
    bake.combined = combined;
    bake.solar_irradiance.assign(static_cast<std::size_t>(medium.air.channels), 1);
    for (const SkyLayer& layer : medium.layers) {
        if (is_peaked(layer)) bake.mie_layers.push_back(layer.name);
    }
    return bake;
}

// Returns the scattering coefficients at the ground of the Mie layers, or of all other layers.
Spectrum coefficients_at_ground(const SkyMedium& medium, const std::vector<bool>& is_mie,
                                bool wanted) {
    Spectrum sum{};
    for (std::size_t k = 0; k < medium.layers.size(); ++k) {
        if (!medium.layers[k].scatters || is_mie[k] != wanted) continue;
        sum += scattering_at(medium.layers[k].alone, 0);
    }
    return sum;
}

class BrunetonSky {
  public:
    BrunetonSky(const SkyMedium& medium, const BrunetonSkySize& size, bool combined)
        : medium_(without_forward_peaks(medium)),
          scattering_bake_(bake_of(medium, size, BrunetonTable::scattering, combined)),
          mie_bake_(bake_of(medium, size, BrunetonTable::single_mie, false)),
          mapping_(shell_of(medium.air), size.texels, size.nu_size, size.sun_cos_zenith_min),
          content_(medium_, scattering_bake_),
          mie_content_(medium_, mie_bake_) {
        const BakeOptions options{.threads = 1};
        const std::optional<SolverSettings> settings = light_settings(medium_, scattering_bake_);
        const SolvedLight light = solve_light(medium_, *settings, options.threads);
        const TableParts parts = make_parts(medium_, &light, true, content_, mapping_, options);
        scattering_ = make_table(content_, parts, options);
        if (!combined) {
            mie_ = make_table(mie_content_, parts, options);
            return;
        }
        guess_ = coefficients_at_ground(medium_, content_.is_mie(), true);
        const Spectrum others = coefficients_at_ground(medium_, content_.is_mie(), false);
        for (std::size_t c = kMaxChannels; c-- > 0;) {  // red last, because the others need it
            const double red = guess_[0] * others[c];
            guess_[c] = red > 0 ? guess_[c] * others[0] / red : 0;
        }
    }

    Spectrum radiance(double altitude_km, const SunZenith& sun,
                      const SkyDirection& direction) const {
        const SkyRay ray = sky_ray(mapping_.shell(), altitude_km, sun, direction);
        const double nu = std::clamp(direction.cosine_to_sun, -1.0, 1.0);
        const ScatteringCoordinates x = mapping_.coordinates(
            {ray.altitude_km, ray.s_km, ray.length_km, ray.meets_ground}, sun.cosine, nu);
        constexpr auto kType = config::PixelType::float32;
        const Texel light = look_up(*scattering_, mapping_, x, kType);
        const Texel mie = mie_ ? look_up(*mie_, mapping_, x, kType) : guessed(light);
        const Spectrum mie_phase = content_.mie_phase(nu);
        Spectrum sum{};
        for (std::size_t c = 0; c < mie_content_.channels(); ++c) {
            sum[c] = light[c] * rayleigh_phase(nu) + mie[c] * mie_phase[c];
        }
        return sum;
    }

  private:
    std::optional<DenseVolume> make_table(const ScatteringContent& content, const TableParts& parts,
                                          const BakeOptions& options) const {
        DenseVolume table = scattering_texels(content, mapping_, parts);
        fit_lookups(mapping_, content.measured_channels(), options, table);
        return table;
    }

    Texel guessed(const Texel& light) const {
        Texel mie{};
        const std::size_t colours = mie_content_.channels();
        for (std::size_t c = 0; c < colours && light[0] > 0; ++c) {
            mie[c] = light[colours] * light[c] / light[0] * guess_[c];
        }
        return mie;
    }

    SkyMedium medium_;
    BrunetonBake scattering_bake_;
    BrunetonBake mie_bake_;
    ScatteringMapping mapping_;
    ScatteringContent content_;
    ScatteringContent mie_content_;
    std::optional<DenseVolume> scattering_;
    std::optional<DenseVolume> mie_;  // none: combined
    Spectrum guess_{};                // (rayleigh_red / mie_red) (mie_colour / rayleigh_colour)
};

}  // namespace

AirRadiance bruneton_sky(const SkyMedium& medium, const BrunetonSkySize& size, bool combined) {
    const auto sky = std::make_shared<const BrunetonSky>(medium, size, combined);
    return [sky](double altitude_km, const SunZenith& sun, const SkyDirection& direction) {
        return sky->radiance(altitude_km, sun, direction);
    };
}

}  // namespace skybake
