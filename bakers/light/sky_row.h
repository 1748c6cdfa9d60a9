// The radiance of many rays that begin at one altitude with one zenith angle and so pass through
// the same air, whatever their azimuth. This is sky_radiance.h for one row of a table, many times
// faster.
//
// Nodes, transmittances and densities are computed once for the row, which may serve many suns.
// Sunlight is read from a table for all rays of a node at once, and computed in the skins of abrupt
// layers. Pieces that the edge of the planet's shadow crosses are integrated over their lit
// stretches, ray by ray. The light of higher orders is read at three nodes of a piece. It is a smooth
// function of the azimuth's cosine: with more rays than azimuth_nodes() it is computed at
// that many Chebyshev nodes of the cosine and interpolated (Berrut & Trefethen 2004).
//
// tests/light/sky_rows_test.cpp compares the results with SkyIntegrator's.
#pragma once

#include <functional>
#include <vector>

#include "bakers/air/transmittance_field.h"
#include "bakers/light/ray_pieces.h"
#include "bakers/light/sky_radiance.h"

namespace skybake {

// Returns the ray of a row whose azimuth from the sun has this cosine. Rays of a row differ only in
// the sun, and both r mu_s and the cosine of the angle to the sun are linear in the azimuth's
// cosine.
using RayOfAzimuth = std::function<SkyRay(double azimuth_cosine)>;

// The light of the sun on one ray of a row, in parts that are smooth functions of the azimuth's cosine,
// except where the planet's shadow begins.
struct SplitSunlight {
    std::vector<Spectrum> single;  // of each layer, without its phase function; the sum of their
                                   // products is the light that is scattered once
    Spectrum ground{};
};

class SkyRow {
  public:
    // The arguments except `any` must outlive this object. `any` may be any ray of the row: only
    // what all rays share is used. `sunlight` is a table of the transmittance through medium.air; it
    // may be null for rows that are asked for higher orders alone.
    SkyRow(const SkyIntegrator& integrator, const SkyMedium& medium,
           const HigherOrders* higher_orders, const SkyRay& any,
           const TransmittanceField* sunlight);

    // One thread at a time: higher orders keep what several suns share.
    std::vector<SkyRadiance> radiance(const RayOfAzimuth& ray_at,
                                      const std::vector<double>& azimuth_cosines) const;
    // Returns the radiance of any rays of the row, under any suns, without interpolation.
    std::vector<SkyRadiance> radiance(const std::vector<SkyRay>& rays) const;

    // Returns the same in parts, without higher orders.
    std::vector<SplitSunlight> split(const RayOfAzimuth& ray_at,
                                     const std::vector<double>& azimuth_cosines) const;

    Spectrum transmittance() const { return transmittance_; }

    // Returns the light of higher orders alone, 0 if there is none.
    std::vector<Spectrum> multiple(const RayOfAzimuth& ray_at,
                                   const std::vector<double>& azimuth_cosines) const;
    // Returns the same of any rays of the row, under any suns, without interpolation.
    std::vector<Spectrum> multiple(const std::vector<SkyRay>& rays) const;

  private:
    struct Node {
        double distance_km;
        double altitude_km;
        double horizon_km;  // distance to the horizon there
        Spectrum weight;    // of the quadrature, times the transmittance to it
    };
    struct Piece {
        double from_km;
        double to_km;
        std::size_t first_node;
        bool in_skins;  // of layers that begin or end abruptly (sky_radiance.h)
    };
    void add_piece(const ray_pieces::Piece& piece);
    void add_higher_orders(const Piece& piece);
    const Spectrum& scattering(std::size_t node, std::size_t layer) const {
        return scattering_[node * medium_.layers.size() + layer];
    }
    // Adds light that is scattered once. Sums (sky_row.cpp) collect what a place sends to the eye of
    // a ray, layer by layer, and add it to the ray's light.
    template <class Sums>
    void add_single(const std::vector<SkyRay>& rays, Sums& sums) const;
    template <class Sums>
    void add_lit_piece(const Piece& piece, const std::vector<std::size_t>& lit,
                       const std::vector<SkyRay>& rays, Sums& sums) const;
    template <class Sums>
    void add_lit_stretch(const Piece& piece, double from_km, double to_km, std::size_t index,
                         const SkyRay& ray, Sums& sums) const;
    // Reads the transmittance towards suns from the table, or computes it for a piece in skins.
    void read_sunlight(const Piece& piece, double altitude_km, const std::vector<double>& s_km,
                       double* values) const;
    Spectrum ground_of(const SkyRay& ray) const;
    int azimuth_nodes() const;
    std::vector<SkyRadiance> with_multiple(const std::vector<SkyRay>& rays,
                                           const std::vector<Spectrum>& higher) const;

    const SkyIntegrator& integrator_;
    const SkyMedium& medium_;
    const HigherOrders* higher_orders_;
    Shell shell_;
    SkyRay any_;
    const TransmittanceField* sunlight_;
    std::vector<Node> nodes_;
    std::vector<Spectrum> scattering_;                    // [node * layers + layer], per km
    std::vector<HigherOrders::OfSuns> higher_orders_at_;  // each coarse node, with its weight
    std::vector<Piece> pieces_;
    Spectrum transmittance_{};
};

}  // namespace skybake
