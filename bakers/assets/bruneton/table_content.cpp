#include "bakers/assets/bruneton/table_content.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "bakers/air/particles/phase_function.h"
#include "bakers/light/ray_pieces.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

// Beyond this, texels are too far apart for the light between them to be known from them alone.
constexpr double kMostScaling = 0.25;
// Positive numbers below it are not normal ones, of which there is no logarithm.
constexpr double kLeastLight = 1e-37;
// Below this share of a line's brightest texel, light is what is left of rays where they are given up:
// how much, or whether it is 0, depends on the wavelengths that are baked together.
const double kLeastShare = exponential(-ray_pieces::kLastLight);

// Light half way between texels i and i + 1 over their mean; 1 where it is not known.
double middle_share(const std::vector<double>& logarithms, const std::vector<bool>& is_lit,
                    const std::vector<double>& line, std::size_t i) {
    const std::size_t last = line.size() - 1;
    if (!is_lit[i] || !is_lit[i + 1]) return 1;
    const bool before = i > 0 && is_lit[i - 1];
    const bool after = i + 1 < last && is_lit[i + 2];
    const double near = logarithms[i];
    const double next = logarithms[i + 1];
    double middle = 0;
    if (before && after) {
        middle = (9 * (near + next) - logarithms[i - 1] - logarithms[i + 2]) / 16;
    } else if (before) {
        middle = (6 * near + 3 * next - logarithms[i - 1]) / 8;
    } else if (after) {
        middle = (3 * near + 6 * next - logarithms[i + 2]) / 8;
    } else {
        middle = (near + next) / 2;
    }
    // Light that rises and falls again within two texels is not that of a smooth line.
    middle = std::clamp(middle, std::min(near, next), std::max(near, next));
    return exponential(middle) / (0.5 * (line[i] + line[i + 1]));
}

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

std::vector<double> lookup_scales(const std::vector<double>& line) {
    assert(std::ranges::all_of(line, [](double value) { return value >= 0; }));
    const std::size_t count = line.size();
    std::vector<double> scales(count, 1.0);
    std::vector<double> logarithms(count);
    std::vector<bool> is_lit(count);
    const double brightest = *std::ranges::max_element(line);
    const double least = std::max(kLeastLight, kLeastShare * brightest);
    for (std::size_t i = 0; i < count; ++i) {
        is_lit[i] = line[i] > least;
        if (is_lit[i]) logarithms[i] = logarithm(line[i]);
    }
    // A system of three diagonals, diagonally dominant, eliminated downwards and solved upwards.
    std::vector<double> diagonal(count, 1.0);
    std::vector<double> upper(count, 0.0);
    std::vector<double> right(count, 1.0);
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const double sum = line[i] + line[i + 1];
        if (!is_lit[i] || !is_lit[i + 1]) continue;
        const double a = line[i] / sum;
        const double b = line[i + 1] / sum;
        const double t = middle_share(logarithms, is_lit, line, i);
        diagonal[i] += a * a;
        diagonal[i + 1] += b * b;
        upper[i] = a * b;
        right[i] += a * t;
        right[i + 1] += b * t;
    }
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const double factor = upper[i] / diagonal[i];
        diagonal[i + 1] -= factor * upper[i];
        right[i + 1] -= factor * right[i];
    }
    for (std::size_t i = count; i-- > 0;) {
        const double next = i + 1 < count ? upper[i] * scales[i + 1] : 0;
        scales[i] = (right[i] - next) / diagonal[i];
    }
    for (double& scale : scales) scale = std::clamp(scale, 1 - kMostScaling, 1 + kMostScaling);
    return scales;
}

void fit_lookups(const ScatteringMapping& mapping, std::size_t channels, const BakeOptions& options,
                 VoxelArray& table) {
    const std::array<int, 3>& size = mapping.size();
    const auto suns = static_cast<std::size_t>(mapping.sun_size());
    const auto width = static_cast<std::size_t>(size[0]);
    for (std::size_t c = 0; c < channels; ++c) {
        const std::vector<float> exact = table.channel(c);
        std::vector<float>& fitted = table.channel(c);
        const auto fit = [&](std::size_t first, std::size_t stride, int count) {
            std::vector<double> line(static_cast<std::size_t>(count));
            for (std::size_t i = 0; i < line.size(); ++i) line[i] = exact[first + i * stride];
            const std::vector<double> scales = lookup_scales(line);
            for (std::size_t i = 0; i < line.size(); ++i) {
                float& texel = fitted[first + i * stride];
                texel = static_cast<float>(double{texel} * scales[i]);
            }
        };
        for_each_tile(size[1] * size[2], options, "fit", [&](int tile) {
            const std::size_t row = static_cast<std::size_t>(tile) * width;
            for (int nu = 0; nu < mapping.nu_size(); ++nu) {
                fit(row + static_cast<std::size_t>(nu) * suns, 1, mapping.sun_size());
            }
            for (std::size_t sun = 0; sun < suns; ++sun) fit(row + sun, suns, mapping.nu_size());
        });
    }
}

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
                        std::span<const TableParts> parts, const BakeOptions& options) {
    const std::vector<const ScatteringContent*>& packets = content.packets();
    if (!content.is_colored()) {
        VoxelArray table = scattering_texels(*packets.front(), mapping, parts.front());
        fit_lookups(mapping, packets.front()->measured_channels(), options, table);
        return table;
    }
    std::vector<VoxelArray> light;
    for (std::size_t p = 0; p < packets.size(); ++p) {
        light.push_back(packet_texels(*packets[p], mapping, parts[p]));
        fit_lookups(mapping, light[p].channels(), options, light[p]);
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
