#include "bakers/assets/bruneton/bundle_ray.h"

#include <cstddef>

#include "bakers/light/ray_pieces.h"

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
    std::vector<BundlePiece> pieces;
    for (const ray_pieces::Piece& piece : ray.pieces) {
        pieces.push_back(bundle_piece(medium, piece));
    }
    return pieces;
}

}  // namespace skybake
