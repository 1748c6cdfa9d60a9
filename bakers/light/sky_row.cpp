#include "bakers/light/sky_row.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

#include "bakers/air/ray.h"
#include "bakers/light/sky_ray.h"
#include "bakers/math/transcendental.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

constexpr std::size_t kMiddleNode = ray_pieces::kNodes / 2;

// Chebyshev points of the second kind, cos(pi k / (n - 1)), with the weights of the barycentric
// formula: alternating, halved at both ends.
double chebyshev_point(int k, int count) {
    return cosine_of_pi(static_cast<double>(k) / (count - 1));
}

std::vector<double> chebyshev_points(int count) {
    std::vector<double> points;
    for (int k = 0; k < count; ++k) points.push_back(chebyshev_point(k, count));
    return points;
}

Spectrum interpolate(const std::vector<Spectrum>& values, const std::vector<double>& points,
                     double x) {
    const auto count = static_cast<int>(values.size());
    Spectrum above{};
    double below = 0;
    for (int k = 0; k < count; ++k) {
        const double gap = x - points[static_cast<std::size_t>(k)];
        if (gap == 0) return values[static_cast<std::size_t>(k)];
        const double half = k == 0 || k + 1 == count ? 0.5 : 1.0;
        const double weight = (k % 2 == 0 ? half : -half) / gap;
        below += weight;
        above += weight * values[static_cast<std::size_t>(k)];
    }
    return above / below;
}

// Sums over layers: each layer's light is multiplied by its phase function.
class SumsOfLayers {
  public:
    SumsOfLayers(const SkyMedium& medium, const std::vector<SkyRay>& rays,
                 std::vector<SkyRadiance>& sums)
        : layers_(medium.layers.size()), sums_(sums) {
        phases_.reserve(rays.size() * layers_);
        for (const SkyRay& ray : rays) {
            for (const SkyLayer& layer : medium.layers) {
                phases_.push_back(
                    first_phase_values(layer, ray.one_minus_cosine, ray.one_plus_cosine));
            }
        }
    }

    // Collects what a layer scatters.
    void collect(std::size_t ray, std::size_t layer, const Spectrum& scattering) {
        sent_ += scattering * phases_[ray * layers_ + layer];
    }

    // Adds what was collected, times a factor and the sunlight there.
    void add(std::size_t ray, const Spectrum& factor, const Spectrum& sun) {
        sums_[ray].single += factor * sent_ * sun;
        sent_ = {};
    }

  private:
    std::size_t layers_;
    std::vector<Spectrum> phases_;  // [ray * layers + layer]
    std::vector<SkyRadiance>& sums_;
    Spectrum sent_{};
};

// A sum for each layer.
class SumsByLayer {
  public:
    SumsByLayer(const SkyMedium& medium, std::vector<SplitSunlight>& sums)
        : sent_(medium.layers.size()), sums_(sums) {
        for (SplitSunlight& sum : sums_) sum.single.resize(sent_.size());
    }

    void collect(std::size_t, std::size_t layer, const Spectrum& scattering) {
        sent_[layer] += scattering;
    }

    void add(std::size_t ray, const Spectrum& factor, const Spectrum& sun) {
        for (std::size_t k = 0; k < sent_.size(); ++k) {
            sums_[ray].single[k] += factor * sent_[k] * sun;
            sent_[k] = {};
        }
    }

  private:
    std::vector<Spectrum> sent_;
    std::vector<SplitSunlight>& sums_;
};

}  // namespace

SkyRow::SkyRow(const SkyIntegrator& integrator, const SkyMedium& medium,
               const HigherOrders* higher_orders, const SkyRay& any,
               const TransmittanceField* sunlight)
    : integrator_(integrator),
      medium_(medium),
      higher_orders_(higher_orders),
      shell_(shell_of(medium.air)),
      any_(any),
      sunlight_(sunlight) {
    const ray_pieces::CutRay ray = ray_pieces::cut(medium.air, any.altitude_km, any.s_km,
                                                   any.length_km, integrator.skins().altitudes_km);
    for (const ray_pieces::Piece& piece : ray.pieces) add_piece(piece);
    transmittance_ = exponential(-ray.depth);
    if (higher_orders_ == nullptr) return;
    for (const Piece& piece : pieces_) add_higher_orders(piece);
}

// Each coarse node stands for what all nodes of the piece send of the light there.
void SkyRow::add_higher_orders(const Piece& piece) {
    for (std::size_t j = 0; j < ray_pieces::kCoarseNodes.size(); ++j) {
        std::vector<Spectrum> sent(medium_.layers.size());
        for (std::size_t i = 0; i < ray_pieces::kNodes; ++i) {
            const Node& node = nodes_[piece.first_node + i];
            const Spectrum weight = ray_pieces::coarse_shares()[j][i] * node.weight;
            for (std::size_t k = 0; k < sent.size(); ++k) {
                sent[k] += weight * scattering(piece.first_node + i, k);
            }
        }
        const Node& at = nodes_[piece.first_node + ray_pieces::kCoarseNodes[j]];
        higher_orders_at_.push_back(higher_orders_->at(
            PointOfRay(shell_, any_.altitude_km, any_.s_km, at.distance_km, at.altitude_km), sent));
    }
}

void SkyRow::add_piece(const ray_pieces::Piece& piece) {
    pieces_.push_back({piece.from_km, piece.to_km, nodes_.size(),
                       integrator_.skins().hold(piece.nodes[kMiddleNode].altitude_km)});
    for (const ray_pieces::Node& at : piece.nodes) {
        Node node;
        node.distance_km = at.distance_km;
        node.altitude_km = at.altitude_km;
        node.horizon_km = horizon_distance_km(shell_, at.altitude_km);
        node.weight = at.width_km * at.transmittance;
        for (const SkyLayer& layer : medium_.layers) {
            scattering_.push_back(layer.scatters ? scattering_at(layer.alone, at.altitude_km)
                                                 : Spectrum{});
        }
        nodes_.push_back(node);
    }
}

// Adds what a ray receives on a lit stretch of a piece through which the shadow's edge runs. What
// the stretch sends to the eye is interpolated between the piece's nodes.
template <class Sums>
void SkyRow::add_lit_stretch(const Piece& piece, double from_km, double to_km, std::size_t index,
                             const SkyRay& ray, Sums& sums) const {
    if (!(from_km < to_km)) return;
    const QuadratureRule& rule = ray_pieces::gauss_rule();
    for (const ray_pieces::StretchNode& at : ray_pieces::stretch(
             shell_, any_.altitude_km, any_.s_km, piece.from_km, piece.to_km, from_km, to_km)) {
        // Rounding may take a place next to the shadow's edge beyond it.
        const double s_km = std::max(ray.sun_s_km + at.distance_km * ray.cosine_to_sun,
                                     -horizon_distance_km(shell_, at.altitude_km));
        for (std::size_t n = 0; n < ray_pieces::kNodes; ++n) {
            const Node& node = nodes_[piece.first_node + n];
            const double per_width =
                at.shares[n] / (rule.weights[n] * (piece.to_km - piece.from_km));
            for (std::size_t k = 0; k < medium_.layers.size(); ++k) {
                sums.collect(index, k,
                             per_width * node.weight * scattering(piece.first_node + n, k));
            }
        }
        Spectrum sun{};
        read_sunlight(piece, at.altitude_km, {s_km}, data(sun));
        sums.add(index, Spectrum(at.width_km), sun);
    }
}

void SkyRow::read_sunlight(const Piece& piece, double altitude_km, const std::vector<double>& s_km,
                           double* values) const {
    if (piece.in_skins) {
        integrator_.sunlight(altitude_km, s_km, values);
    } else {
        sunlight_->read(altitude_km, s_km.data(), static_cast<int>(s_km.size()), values);
    }
}

template <class Sums>
void SkyRow::add_single(const std::vector<SkyRay>& rays, Sums& sums) const {
    assert(sunlight_ != nullptr);
    const std::size_t count = rays.size();
    std::vector<DarkStretch> dark(count);
    for (std::size_t i = 0; i < count; ++i) {
        dark[i] = dark_stretch(shell_, any_.altitude_km, any_.s_km, any_.length_km,
                               rays[i].sun_s_km, rays[i].cosine_to_sun);
    }
    std::vector<std::size_t> lit;
    for (const Piece& piece : pieces_) {
        lit.clear();
        for (std::size_t i = 0; i < count; ++i) {
            const double begin = std::max(dark[i].begin_km, piece.from_km);
            const double end = std::min(dark[i].end_km, piece.to_km);
            if (!(begin < end)) {
                lit.push_back(i);
                continue;
            }
            add_lit_stretch(piece, piece.from_km, begin, i, rays[i], sums);
            add_lit_stretch(piece, end, piece.to_km, i, rays[i], sums);
        }
        if (!lit.empty()) add_lit_piece(piece, lit, rays, sums);
    }
}

// Adds the light of a piece on which the rays `lit` have the sun all along.
template <class Sums>
void SkyRow::add_lit_piece(const Piece& piece, const std::vector<std::size_t>& lit,
                           const std::vector<SkyRay>& rays, Sums& sums) const {
    std::vector<double> s(lit.size());
    std::vector<double> sun(lit.size() * kMaxChannels);
    for (std::size_t n = 0; n < ray_pieces::kNodes; ++n) {
        const Node& node = nodes_[piece.first_node + n];
        for (std::size_t j = 0; j < lit.size(); ++j) {
            const SkyRay& ray = rays[lit[j]];
            // Rounding may take a place next to the shadow's edge beyond it.
            s[j] = std::max(ray.sun_s_km + node.distance_km * ray.cosine_to_sun, -node.horizon_km);
        }
        read_sunlight(piece, node.altitude_km, s, sun.data());
        for (std::size_t j = 0; j < lit.size(); ++j) {
            for (std::size_t k = 0; k < medium_.layers.size(); ++k) {
                sums.collect(lit[j], k, scattering(piece.first_node + n, k));
            }
            Spectrum at_node{};
            for (std::size_t c = 0; c < static_cast<std::size_t>(medium_.air.channels); ++c) {
                at_node[c] = sun[c * lit.size() + j];
            }
            sums.add(lit[j], node.weight, at_node);
        }
    }
}

std::vector<Spectrum> SkyRow::multiple(const std::vector<SkyRay>& rays) const {
    std::vector<Spectrum> sums(rays.size());
    if (rays.empty() || higher_orders_at_.empty()) return sums;
    const double r = shell_.ground_radius_km + any_.altitude_km;
    std::vector<double> sun_cosines;
    std::vector<double> nu;
    for (const SkyRay& ray : rays) {
        sun_cosines.push_back(ray.sun_s_km / r);
        nu.push_back(ray.cosine_to_sun);
    }
    const SunBundle suns(std::move(sun_cosines), std::move(nu));
    for (const HigherOrders::OfSuns& at_node : higher_orders_at_) at_node(suns, data(sums[0]));
    return sums;
}

// Along a ray the sun moves, so that the light is not quite a polynomial of its degree.
int SkyRow::azimuth_nodes() const { return std::max(higher_orders_->azimuth_degree(), 8) + 8; }

// Returns the light of higher orders at each azimuth.
std::vector<Spectrum> SkyRow::multiple(const RayOfAzimuth& ray_at,
                                       const std::vector<double>& azimuth_cosines) const {
    if (higher_orders_ == nullptr) return std::vector<Spectrum>(azimuth_cosines.size());
    const int count = azimuth_nodes();
    const bool interpolates = azimuth_cosines.size() > static_cast<std::size_t>(count);
    const std::vector<double> points = chebyshev_points(interpolates ? count : 0);
    auto rays = mapped<SkyRay>(points, [&](const double point) { return ray_at(point); });
    for (std::size_t i = 0; !interpolates && i < azimuth_cosines.size(); ++i) {
        rays.push_back(ray_at(azimuth_cosines[i]));
    }
    std::vector<Spectrum> values = multiple(rays);
    if (!interpolates) return values;
    return mapped<Spectrum>(
        azimuth_cosines, [&](const double cosine) { return interpolate(values, points, cosine); });
}

Spectrum SkyRow::ground_of(const SkyRay& ray) const {
    if (!any_.meets_ground) return {};
    return integrator_.ground_radiance(ray.sun_s_km + any_.length_km * ray.cosine_to_sun) *
           transmittance_;
}

std::vector<SkyRadiance> SkyRow::with_multiple(const std::vector<SkyRay>& rays,
                                               const std::vector<Spectrum>& higher) const {
    std::vector<SkyRadiance> sums(rays.size());
    SumsOfLayers once(medium_, rays, sums);
    add_single(rays, once);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        sums[i].multiple = higher[i];
        sums[i].ground = ground_of(rays[i]);
        sums[i].transmittance = transmittance_;
    }
    return sums;
}

std::vector<SkyRadiance> SkyRow::radiance(const std::vector<SkyRay>& rays) const {
    return with_multiple(rays, multiple(rays));
}

std::vector<SkyRadiance> SkyRow::radiance(const RayOfAzimuth& ray_at,
                                          const std::vector<double>& azimuth_cosines) const {
    std::vector<SkyRay> rays;
    for (const double cosine : azimuth_cosines) rays.push_back(ray_at(cosine));
    return with_multiple(rays, multiple(ray_at, azimuth_cosines));
}

std::vector<SplitSunlight> SkyRow::split(const RayOfAzimuth& ray_at,
                                         const std::vector<double>& azimuth_cosines) const {
    std::vector<SkyRay> rays;
    for (const double cosine : azimuth_cosines) rays.push_back(ray_at(cosine));
    std::vector<SplitSunlight> sums(rays.size());
    SumsByLayer by_layer(medium_, sums);
    add_single(rays, by_layer);
    for (std::size_t i = 0; i < rays.size(); ++i) sums[i].ground = ground_of(rays[i]);
    return sums;
}

}  // namespace skybake
