#include "bakers/assets/bruneton/scattering_row.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "bakers/light/multiple_scattering_quadrature.h"
#include "bakers/light/ray_pieces.h"
#include "bakers/light/sky_ray.h"

namespace skybake {

ScatteringRows::ScatteringRows(const SkyMedium& medium, const SolvedLight* light,
                               std::shared_ptr<const TransmittanceField> sunlight)
    : medium_(medium),
      light_(light),
      shell_(shell_of(medium.air)),
      break_altitudes_km_(quadrature_altitudes_km(medium.air)),
      sunlight_(std::move(sunlight)) {
    if (light_ == nullptr) return;
    for (const SkyLayer& layer : medium.layers) {
        phase_moments_.push_back(scattered_moments(layer, light->degree()));
    }
}

Spectrum ScatteringRows::sunlight(double altitude_km, double s_km) const {
    const double lit_s_km = std::max(s_km, -horizon_distance_km(shell_, altitude_km));
    Spectrum value{};
    sunlight_->read(altitude_km, &lit_s_km, 1, data(value));
    return value;
}

// The lit part of a piece through which the shadow's edge runs.
void ScatteringRows::add_cut_piece(const ScatteringView& view, const BundlePiece& piece,
                                   double from_km, double to_km, double sun_cos_zenith, double nu,
                                   std::vector<Spectrum>& sums) const {
    const double begin_s = (shell_.ground_radius_km + view.altitude_km) * sun_cos_zenith;
    for (const ray_pieces::StretchNode& at : ray_pieces::stretch(
             shell_, view.altitude_km, view.s_km, piece.from_km, piece.to_km, from_km, to_km)) {
        // Suns that there are not may be higher than the zenith.
        const double s =
            std::min(begin_s + at.distance_km * nu, shell_.ground_radius_km + at.altitude_km);
        const Spectrum sun = sunlight(at.altitude_km, s);
        for (std::size_t i = 0; i < at.shares.size(); ++i) {
            for (std::size_t k = 0; k < sums.size(); ++k) {
                sums[k] += at.width_km * at.shares[i] * piece.nodes[i].sent[k] * sun;
            }
        }
    }
}

ScatteringRow ScatteringRows::row(const ScatteringView& view, const SunBundle& suns) const {
    const auto count = static_cast<std::size_t>(suns.count);
    const auto wanted = static_cast<std::size_t>(suns.wanted);
    const std::size_t layers = medium_.layers.size();
    const double r = shell_.ground_radius_km + view.altitude_km;
    std::vector<DarkStretch> dark(count);
    for (std::size_t i = 0; i < count; ++i) {
        dark[i] = dark_stretch(shell_, view.altitude_km, view.s_km, view.length_km,
                               r * suns.sun_cosines[i], suns.nu[i]);
    }
    std::vector<double> lit(count);
    std::vector<double> single(layers * kMaxChannels * count);
    std::vector<double> scattered(light_ == nullptr ? 0 : count * kChannelSlots);
    std::vector<std::vector<Spectrum>> cut(wanted, std::vector<Spectrum>(layers));
    for (const BundlePiece& piece : make_bundle_ray(medium_, break_altitudes_km_, view)) {
        for (std::size_t i = 0; i < count && sunlight_; ++i) {
            const double begin = std::max(dark[i].begin_km, piece.from_km);
            const double end = std::min(dark[i].end_km, piece.to_km);
            lit[i] = begin < end ? 0 : 1;
            if (lit[i] > 0 || i >= wanted) continue;
            if (begin > piece.from_km) {
                add_cut_piece(view, piece, piece.from_km, begin, suns.sun_cosines[i], suns.nu[i],
                              cut[i]);
            }
            if (end < piece.to_km) {
                add_cut_piece(view, piece, end, piece.to_km, suns.sun_cosines[i], suns.nu[i],
                              cut[i]);
            }
        }
        if (sunlight_) add_sunlight(*sunlight_, view, piece, suns, lit, single.data());
        if (light_ != nullptr) {
            add_solved_light(*light_, phase_moments_, shell_, view, piece, suns, scattered.data());
        }
    }
    ScatteringRow result;
    result.single.assign(layers, std::vector<Spectrum>(wanted));
    for (std::size_t k = 0; k < layers; ++k) {
        for (std::size_t i = 0; i < wanted; ++i) {
            for (std::size_t c = 0; c < kMaxChannels; ++c) {
                result.single[k][i][c] = single[(k * kMaxChannels + c) * count + i] + cut[i][k][c];
            }
        }
    }
    if (light_ != nullptr) {
        result.higher.resize(wanted);
        for (std::size_t i = 0; i < wanted; ++i) {
            result.higher[i] = packet_at(scattered.data() + i * kChannelSlots);
        }
    }
    return result;
}

}  // namespace skybake
