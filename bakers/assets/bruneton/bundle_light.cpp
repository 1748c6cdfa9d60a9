#include "bakers/assets/bruneton/bundle_light.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/assets/bruneton/bundle_light.cpp"
#include <hwy/foreach_target.h>

#include <cstddef>

#include "bakers/air/transmittance_row-inl.h"
#include "bakers/light/nearby_suns.h"
#include "bakers/light/ray_pieces.h"
#include "bakers/math/lanes-inl.h"
#include "config/text/mapped.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// r mu_s at a point, which suns that there are not may leave.
HWY_INLINE Lanes sun_s_km(const PointOfRay& point, const SunBundle& suns, int i) {
    return Lanes(point.begin_radius_km) * Lanes::load(suns.sun_cosines.data() + i) +
           Lanes(point.distance_km) * Lanes::load(suns.nu.data() + i);
}

void AddSunlight(const TransmittanceField& field, const ScatteringView& view,
                 const BundlePiece& piece, const SunBundle& suns, const std::vector<double>& lit,
                 double* single) {
    const Shell& shell = field.shell();
    const std::size_t layers = piece.nodes[0].weights.size();
    const auto stride = static_cast<std::size_t>(suns.count);
    std::vector<double> row(static_cast<std::size_t>(field.row_size()));
    for (const BundleNode& node : piece.nodes) {
        combine_row<Lanes>(field, node.altitude_km, row.data());
        const PointOfRay place(shell, view.altitude_km, view.s_km, node.distance_km,
                               node.altitude_km);
        const double horizon = horizon_distance_km(shell, node.altitude_km);
        const SunlightRow sunlight_at = sunlight_row(field, node.altitude_km, row.data());
        for (int i = 0; i < suns.count; i += static_cast<int>(Lanes::kCount)) {
            const Lanes here = Lanes::load(lit.data() + i);
            if (!any(here > Lanes(0.0))) continue;
            const Lanes s =
                minimum(maximum(sun_s_km(place, suns, i), Lanes(-horizon)), Lanes(place.radius_km));
            // distance_to_top_km of ray.h.
            const Lanes root = square_root(s * s + Lanes(sunlight_at.q));
            const Lanes distance =
                select(s > Lanes(0.0), Lanes(sunlight_at.q) / (root + absolute(s)), root - s);
            Lanes value[kMaxChannels];
            sunlight_towards(sunlight_at, distance, value);
            for (int c = 0; c < field.channels(); ++c) {
                const auto channel = static_cast<std::size_t>(c);
                const Lanes sunlight = value[c] * here;
                for (std::size_t k = 0; k < layers; ++k) {
                    const double weight = data(node.weights[k])[channel];
                    if (weight == 0) continue;
                    double* to = single + (k * kMaxChannels + channel) * stride + i;
                    (Lanes::load(to) + Lanes(weight) * sunlight).store(to);
                }
            }
        }
    }
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

namespace {

constexpr std::size_t kRayNodes = kBundleNodes;
static_assert(kRayNodes == ray_pieces::kNodes);

BundlePiece bundle_piece(const SkyMedium& medium, const ray_pieces::Piece& piece) {
    BundlePiece result;
    result.from_km = piece.from_km;
    result.to_km = piece.to_km;
    for (std::size_t i = 0; i < kRayNodes; ++i) {
        const ray_pieces::Node& at = piece.nodes[i];
        BundleNode& node = result.nodes[i];
        node.distance_km = at.distance_km;
        node.altitude_km = at.altitude_km;
        for (const SkyLayer& layer : medium.layers) {
            Spectrum sent{};
            if (layer.scatters) {
                sent = scattering_at(layer.alone, at.altitude_km) * at.transmittance;
            }
            node.sent.push_back(sent);
            node.weights.push_back(at.width_km * sent);
        }
    }
    for (std::size_t j = 0; j < ray_pieces::kCoarseNodes.size(); ++j) {
        std::vector<Spectrum>& weights = result.nodes[ray_pieces::kCoarseNodes[j]].coarse_weights;
        weights.resize(medium.layers.size());
        for (std::size_t i = 0; i < kRayNodes; ++i) {
            for (std::size_t k = 0; k < weights.size(); ++k) {
                weights[k] += ray_pieces::coarse_shares()[j][i] * result.nodes[i].weights[k];
            }
        }
    }
    return result;
}

}  // namespace

std::vector<BundlePiece> make_bundle_ray(const SkyMedium& medium,
                                         const std::vector<double>& break_altitudes_km,
                                         const ScatteringView& view) {
    const ray_pieces::CutRay ray = ray_pieces::cut(medium.air, view.altitude_km, view.s_km,
                                                   view.length_km, break_altitudes_km);
    return mapped<BundlePiece>(
        ray.pieces, [&](const ray_pieces::Piece& piece) { return bundle_piece(medium, piece); });
}

HWY_EXPORT(AddSunlight);

void add_sunlight(const TransmittanceField& field, const ScatteringView& view,
                  const BundlePiece& piece, const SunBundle& suns, const std::vector<double>& lit,
                  double* single) {
    HWY_DYNAMIC_DISPATCH(AddSunlight)(field, view, piece, suns, lit, single);
}

void add_solved_light(const SolvedLight& light,
                      const std::vector<std::vector<Spectrum>>& phase_moments, const Shell& shell,
                      const ScatteringView& view, const BundlePiece& piece, const SunBundle& suns,
                      double* scattered) {
    for (const BundleNode& node : piece.nodes) {
        if (node.coarse_weights.empty()) continue;
        const PointOfRay point(shell, view.altitude_km, view.s_km, node.distance_km,
                               node.altitude_km);
        NearbySuns(light, point, node.coarse_weights, phase_moments, light.degree())
            .add(suns, scattered);
    }
}

}  // namespace skybake
#endif  // HWY_ONCE
