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
#include "bakers/light/shared_light.h"
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
        const TableParts parts =
            make_parts(medium_, &light, make_sunlight(medium_.air, 1), content_, mapping_, options);
        scattering_ = make_table(content_, parts, options);
        if (!combined) mie_ = make_table(mie_content_, parts, options);
    }

    Spectrum radiance(double altitude_km, const SunZenith& sun,
                      const SkyDirection& direction) const {
        const SkyRay ray = sky_ray(mapping_.shell(), altitude_km, sun, direction);
        const double nu = std::clamp(direction.cosine_to_sun, -1.0, 1.0);
        const ScatteringCoordinates x = mapping_.coordinates(
            {ray.altitude_km, ray.s_km, ray.length_km, ray.meets_ground}, sun.cosine, nu);
        constexpr auto kType = config::PixelType::float32;
        const Spectrum light = content_.radiance(look_up(*scattering_, mapping_, x, kType), nu);
        if (!mie_) return light;
        return light + mie_content_.radiance(look_up(*mie_, mapping_, x, kType), nu);
    }

  private:
    std::optional<VoxelArray> make_table(const ScatteringContent& content, const TableParts& parts,
                                         const BakeOptions& options) const {
        VoxelArray table = scattering_texels(content, mapping_, parts);
        fit_lookups(mapping_, content.measured_channels(), options, table);
        return table;
    }

    SkyMedium medium_;
    BrunetonBake scattering_bake_;
    BrunetonBake mie_bake_;
    ScatteringMapping mapping_;
    ScatteringContent content_;
    ScatteringContent mie_content_;
    std::optional<VoxelArray> scattering_;
    std::optional<VoxelArray> mie_;  // none: combined
};

}  // namespace

AirRadiance bruneton_sky(const SkyMedium& medium, const BrunetonSkySize& size, bool combined) {
    const auto sky = std::make_shared<const BrunetonSky>(medium, size, combined);
    return [sky](double altitude_km, const SunZenith& sun, const SkyDirection& direction) {
        return sky->radiance(altitude_km, sun, direction);
    };
}

}  // namespace skybake
