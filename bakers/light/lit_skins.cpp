#include "bakers/light/lit_skins.h"

#include <algorithm>

#include "bakers/light/multiple_scattering_quadrature.h"

namespace skybake {

namespace {

// Layers of less depth dim no sunlight that a table would miss (reading_levels.cpp has the same).
constexpr double kThinLayer = 0.02;
constexpr double kGrowth = 4;  // of depths from the edge
// The optical depth to a sun at the horizontal at the first of them.
constexpr double kFirstDepth = 0.3;

// From `edge_km` towards the middle of a layer, whose extinction just inside is `per_km`.
void add_skin(const Medium& medium, double edge_km, double middle_km, double per_km,
              std::vector<double>& altitudes) {
    if (!(per_km > 0)) return;
    const double way_km = kFirstDepth / per_km;
    const double side = middle_km < edge_km ? -1 : 1;
    double depth_km = way_km * way_km / (2 * (medium.ground_radius_km + edge_km));
    for (; depth_km < side * (middle_km - edge_km); depth_km *= kGrowth) {
        altitudes.push_back(edge_km + side * depth_km);
    }
}

}  // namespace

bool LitSkins::hold(double altitude_km) const {
    return std::ranges::any_of(layers, [&](const AltitudeRange& layer) {
        return altitude_km > layer.bottom_km && altitude_km < layer.top_km;
    });
}

LitSkins lit_skins(const Medium& medium) {
    LitSkins skins;
    skins.altitudes_km = quadrature_altitudes_km(medium);
    skins.layers = abrupt_layers_km(medium, kThinLayer);
    for (const AltitudeRange& layer : skins.layers) {
        const double middle_km = 0.5 * (layer.bottom_km + layer.top_km);
        for (const double edge_km : {layer.bottom_km, layer.top_km}) {
            if (edge_km == 0) continue;
            const double inside_km = edge_km + 1e-6 * (middle_km - edge_km);
            add_skin(medium, edge_km, middle_km, largest(extinction_at(medium, inside_km)),
                     skins.altitudes_km);
        }
    }
    std::ranges::sort(skins.altitudes_km);
    return skins;
}

}  // namespace skybake
