#include "bakers/assets/bruneton/table_content.h"

#include <array>
#include <cassert>
#include <utility>

#include "bakers/air/particles/phase_function.h"
#include "bakers/assets/bruneton/lookup_fit.h"
#include "bakers/math/parallel.h"

namespace skybake {

using config::BrunetonTable;

namespace {

// Whether the phase functions of the first Mie layer differ between wavelengths.
bool has_spectral_phase(const std::vector<const ScatteringContent*>& packets) {
    for (const double nu : {-1.0, 0.3, 1.0}) {
        const double first = packets.front()->mie_phase(nu)[0];
        for (const ScatteringContent* packet : packets) {
            const Spectrum phase = packet->mie_phase(nu);
            for (std::size_t c = 0; c < packet->wavelengths(); ++c) {
                if (phase[c] != first) return true;
            }
        }
    }
    return false;
}

// The light of a packet's wavelengths in all texels, and after it, in combined tables, the Mie
// layers'.
VoxelArray packet_texels(const ScatteringContent& content, const ScatteringMapping& mapping,
                         const TableParts& parts) {
    const std::size_t count = content.wavelengths();
    VoxelArray texels(mapping.size(), content.holds_mie() ? 2 * count : count);
    for (std::size_t i = 0; i < texels.channel(0).size(); ++i) {
        const ScatteringParts at = parts.at(i);
        const Spectrum light = content.light(at);
        const Spectrum mie = ScatteringContent::mie_light(at);
        for (std::size_t c = 0; c < texels.channels(); ++c) {
            texels.channel(c)[i] = static_cast<float>(c < count ? light[c] : mie[c - count]);
        }
    }
    return texels;
}

PacketOfTexel packet_at(const VoxelArray& texels, std::size_t count, std::size_t texel) {
    PacketOfTexel packet;
    for (std::size_t c = 0; c < texels.channels(); ++c) {
        (c < count ? packet.light[c] : packet.mie[c - count]) = texels.channel(c)[texel];
    }
    return packet;
}

}  // namespace

TableContent::TableContent(std::vector<const ScatteringContent*> packets,
                           std::vector<glm::dvec3> weights, std::vector<double> solar_irradiance)
    : packets_(std::move(packets)),
      weights_(std::move(weights)),
      solar_irradiance_(std::move(solar_irradiance)) {
    if (!is_colored()) return;
    assert(solar_irradiance_.size() == kColors);
    has_spectral_phase_ = has_spectral_phase(packets_);
    std::vector<Spectrum> mie;
    std::vector<Spectrum> others;
    for (const ScatteringContent* packet : packets_) {
        mie.push_back(packet->coefficients_at_ground(true));
        others.push_back(packet->coefficients_at_ground(false));
    }
    white_ = color_of(std::vector<Spectrum>(packets_.size(), Spectrum(1)));
    mie_colours_ = mie_colours(color_of(mie), color_of(others));
}

std::size_t TableContent::channels() const {
    return is_colored() ? kColors + (first().has_alpha() ? 1 : 0) : first().channels();
}

Spectrum TableContent::color_of(const std::vector<Spectrum>& packets) const {
    glm::dvec3 sum(0);
    const glm::dvec3* weight = weights_.data();
    for (std::size_t p = 0; p < packets.size(); ++p) {
        for (std::size_t c = 0; c < packets_[p]->wavelengths(); ++c) {
            sum += packets[p][c] * *weight++;
        }
    }
    return Spectrum(sum, 0);
}

Spectrum TableContent::mie_phase(double nu) const {
    if (!is_colored() || !has_spectral_phase_) return Spectrum(first().mie_phase(nu));
    std::vector<Spectrum> phases;
    for (const ScatteringContent* packet : packets_) phases.push_back(packet->mie_phase(nu));
    Spectrum phase = color_of(phases);
    for (std::size_t c = 0; c < kColors; ++c) phase[c] /= white_[c];
    return phase;
}

Texel TableContent::texel(std::span<const ScatteringParts> parts, double nu) const {
    if (!is_colored()) return first().texel(parts.front());
    std::vector<PacketOfTexel> packets;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        packets.push_back({packets_[p]->light(parts[p]), ScatteringContent::mie_light(parts[p])});
    }
    return color(packets, nu);
}

Texel TableContent::color(std::span<const PacketOfTexel> packets, double nu) const {
    const Spectrum runtime_phase = has_spectral_phase_ ? mie_phase(nu) : Spectrum(1);
    const bool is_of_mie = first().table() == BrunetonTable::single_mie;
    glm::dvec3 light(0);
    double mie = 0;
    const glm::dvec3* weight = weights_.data();
    for (std::size_t p = 0; p < packets.size(); ++p) {
        const Spectrum own_phase = has_spectral_phase_ ? packets_[p]->mie_phase(nu) : Spectrum(1);
        for (std::size_t c = 0; c < packets_[p]->wavelengths(); ++c, ++weight) {
            const glm::dvec3 of_mie = *weight * own_phase[c] / glm::dvec3(runtime_phase);
            light += packets[p].light[c] * (is_of_mie ? of_mie : *weight);
            mie += packets[p].mie[c] * of_mie.x;
        }
    }
    Texel texel{};
    for (std::size_t c = 0; c < kColors; ++c) {
        texel[c] = light[static_cast<glm::length_t>(c)] * solar_irradiance_[c];
    }
    if (first().has_alpha()) {
        texel[kColors] =
            first().holds_mie() ? mie * solar_irradiance_[0] : first().constant_alpha();
    }
    return texel;
}

Spectrum TableContent::radiance(const Texel& texel, double nu) const {
    if (!is_colored()) return first().radiance(texel, nu);
    const Spectrum mie = mie_phase(nu);
    const Spectrum phase =
        first().table() == BrunetonTable::single_mie ? mie : Spectrum(rayleigh_phase(nu));
    return RuntimeTexel{kColors, first().is_combined(), phase, mie, mie_colours_, solar_irradiance_}
        .radiance(texel);
}

VoxelArray table_texels(const TableContent& content, const ScatteringMapping& mapping,
                        std::span<const TableParts> parts, bool fits, const BakeOptions& options) {
    const std::vector<const ScatteringContent*>& packets = content.packets();
    if (!content.is_colored()) {
        VoxelArray table = scattering_texels(*packets.front(), mapping, parts.front());
        if (fits) fit_lookups(mapping, packets.front()->measured_channels(), options, table);
        return table;
    }
    std::vector<VoxelArray> light;
    for (std::size_t p = 0; p < packets.size(); ++p) {
        light.push_back(packet_texels(*packets[p], mapping, parts[p]));
        if (fits) fit_lookups(mapping, light[p].channels(), options, light[p]);
    }
    VoxelArray table(mapping.size(), content.channels());
    const std::array<int, 3>& size = mapping.size();
    for_each_tile(size[1] * size[2], options, "colours", [&](int tile) {
        const ScatteringView view = mapping.view_of_texel(tile % size[1], tile / size[1]);
        std::vector<PacketOfTexel> at(packets.size());
        for (int u = 0; u < size[0]; ++u) {
            const std::size_t i = table.offset(u, tile % size[1], tile / size[1]);
            for (std::size_t p = 0; p < packets.size(); ++p) {
                at[p] = packet_at(light[p], packets[p]->wavelengths(), i);
            }
            const double nu = continued_nu(view, mapping.shell(), mapping.sun_of_texel(u),
                                           mapping.nu_of_texel(u));
            const Texel texel = content.color(at, nu);
            for (std::size_t c = 0; c < table.channels(); ++c) {
                table.channel(c)[i] = static_cast<float>(texel[c]);
            }
        }
    });
    return table;
}

}  // namespace skybake
