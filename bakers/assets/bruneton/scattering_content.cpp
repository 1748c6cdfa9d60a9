#include "bakers/assets/bruneton/scattering_content.h"

#include <algorithm>

#include "bakers/air/particles/phase_function.h"

namespace skybake {
namespace {

// The true phase function, as a runtime has it.
Spectrum true_phase_at(const SkyLayer& layer, double nu) {
    const bool has_peak = !layer.first_phase.functions.empty();
    return phase_values(has_peak ? layer.first_phase : layer.phase, 1 - nu, 1 + nu);
}

double not_negative(double value) { return value > 0 ? value : 0; }

}  // namespace

ScatteringContent::ScatteringContent(const SkyMedium& medium, const BrunetonBake& bake)
    : medium_(medium),
      table_(bake.table),
      combined_(bake.combined && bake.table == BrunetonTable::scattering),
      orders_(bake.orders),
      colours_(static_cast<std::size_t>(medium.air.channels)),
      solar_irradiance_(bake.solar_irradiance) {
    const bool takram = bake.convention == config::BrunetonConvention::takram;
    channels_ = colours_ + (combined_ || takram ? 1 : 0);
    // takram's own textures: 1 of single Mie scattering, 0 of higher orders.
    constant_alpha_ = table_ == BrunetonTable::single_mie ? 1 : 0;
    for (const SkyLayer& layer : medium.layers) {
        is_mie_.push_back(std::ranges::find(bake.mie_layers, layer.name) != bake.mie_layers.end());
    }
    mie_colours_ = mie_colours(coefficients_at_ground(true), coefficients_at_ground(false));
}

Spectrum ScatteringContent::coefficients_at_ground(bool of_mie) const {
    Spectrum sum{};
    for (std::size_t k = 0; k < medium_.layers.size(); ++k) {
        if (!medium_.layers[k].scatters || is_mie_[k] != of_mie) continue;
        sum += scattering_at(medium_.layers[k].alone, 0);
    }
    return sum;
}

std::size_t ScatteringContent::measured_channels() const {
    return table_ == BrunetonTable::scattering ? channels_ : colours_;
}

bool ScatteringContent::wants_single() const { return table_ != BrunetonTable::higher_orders; }

bool ScatteringContent::wants_higher() const {
    return table_ != BrunetonTable::single_mie && orders_ != 1;
}

Spectrum ScatteringContent::mie_phase(double nu) const {
    for (std::size_t k = 0; k < is_mie_.size(); ++k) {
        if (is_mie_[k]) return true_phase_at(medium_.layers[k], nu);
    }
    return {};
}

ScatteringParts ScatteringContent::parts(const ScatteringRow& row, std::size_t sun,
                                         double nu) const {
    ScatteringParts parts;
    const Spectrum first = mie_phase(nu);
    const double rayleigh = rayleigh_phase(nu);
    for (std::size_t k = 0; k < row.single.size(); ++k) {
        if (!medium_.layers[k].scatters) continue;
        const Spectrum own = first_phase_values(medium_.layers[k], 1 - nu, 1 + nu);
        const Spectrum& light = row.single[k][sun];
        if (!is_mie_[k]) parts.air += light * (own / rayleigh);
        for (std::size_t c = 0; c < colours_ && is_mie_[k]; ++c) {
            parts.mie[c] += light[c] * (own[c] == first[c] ? 1 : own[c] / first[c]);
        }
    }
    if (!row.higher.empty()) parts.higher = row.higher[sun] / rayleigh;
    return parts;
}

Spectrum ScatteringContent::light(const ScatteringParts& parts) const {
    Spectrum result{};
    for (std::size_t c = 0; c < colours_; ++c) {
        const double higher = not_negative(parts.higher[c]);
        const double light = table_ == BrunetonTable::single_mie      ? parts.mie[c]
                             : table_ == BrunetonTable::higher_orders ? higher
                                                                      : parts.air[c] + higher;
        result[c] = not_negative(light);
    }
    return result;
}

Spectrum ScatteringContent::mie_light(const ScatteringParts& parts) {
    Spectrum result{};
    for (std::size_t c = 0; c < kMaxChannels; ++c) result[c] = not_negative(parts.mie[c]);
    return result;
}

Texel ScatteringContent::texel(const ScatteringParts& parts) const {
    Texel texel{};
    const Spectrum light = this->light(parts);
    for (std::size_t c = 0; c < colours_; ++c) texel[c] = light[c] * solar_irradiance_[c];
    if (has_alpha()) {
        texel[colours_] =
            holds_mie() ? mie_light(parts)[0] * solar_irradiance_[0] : constant_alpha_;
    }
    return texel;
}

Spectrum ScatteringContent::radiance(const Texel& texel, double nu) const {
    const Spectrum mie = mie_phase(nu);
    const Spectrum phase = table_ == BrunetonTable::single_mie ? mie : Spectrum(rayleigh_phase(nu));
    return RuntimeTexel{colours_, combined_, phase, mie, mie_colours_, solar_irradiance_}.radiance(
        texel);
}

Spectrum mie_colours(const Spectrum& mie, const Spectrum& others) {
    Spectrum colours{};
    for (std::size_t c = 0; c < kMaxChannels; ++c) {
        const double red = mie[0] * others[c];
        colours[c] = red > 0 ? mie[c] * others[0] / red : 0;
    }
    return colours;
}

Spectrum RuntimeTexel::radiance(const Texel& texel) const {
    Spectrum light{};
    for (std::size_t c = 0; c < colours; ++c) {
        const double mie =
            combined && texel[0] > 0 ? texel[colours] * texel[c] / texel[0] * mie_colours[c] : 0;
        light[c] = (texel[c] * phase[c] + mie * mie_phase[c]) / solar_irradiance[c];
    }
    return light;
}

}  // namespace skybake
