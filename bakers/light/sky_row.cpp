#include "bakers/light/sky_row.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "bakers/air/optical_depth.h"
#include "bakers/air/ray.h"
#include "bakers/light/multiple_scattering_quadrature.h"
#include "bakers/light/sky_ray.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

// Chebyshev points of the second kind, cos(pi k / (n - 1)), with the weights of the barycentric
// formula: alternating, halved at both ends.
double chebyshev_point(int k, int count) {
    return cosine_of_pi(static_cast<double>(k) / (count - 1));
}

Spectrum interpolate(const std::vector<Spectrum>& values, double x) {
    const auto count = static_cast<int>(values.size());
    Spectrum above{};
    double below = 0;
    for (int k = 0; k < count; ++k) {
        const double gap = x - chebyshev_point(k, count);
        if (gap == 0) return values[static_cast<std::size_t>(k)];
        const double half = k == 0 || k + 1 == count ? 0.5 : 1.0;
        const double weight = (k % 2 == 0 ? half : -half) / gap;
        below += weight;
        above += weight * values[static_cast<std::size_t>(k)];
    }
    return above / below;
}

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
    Spectrum depth{};
    if (any.length_km > 0) {
        const std::vector<RayBreak> cuts = ray_breaks(
            shell_, any.altitude_km, any.s_km, any.length_km, quadrature_altitudes_km(medium.air));
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
            const Spectrum next = depth_km(cuts[i + 1].distance_km);
            add_pieces(cuts[i].distance_km, cuts[i + 1].distance_km, depth, next, 0);
            depth = next;
        }
    }
    transmittance_ = exponential(-depth);
    for (std::size_t n = 0; higher_orders_ != nullptr && n < nodes_.size(); ++n) {
        higher_orders_at_.push_back(higher_orders_->at(
            nodes_[n].altitude_km, view_cosine(nodes_[n]), nodes_[n].scattering));
    }
}

double SkyRow::view_cosine(const Node& node) const {
    return std::clamp((any_.s_km + node.distance_km) / (shell_.ground_radius_km + node.altitude_km),
                      -1.0,
                      1.0);  // rounding
}

Spectrum SkyRow::depth_km(double distance_km) const {
    const double r = shell_.ground_radius_km + any_.altitude_km;
    return optical_depth_along(medium_.air, any_.altitude_km, any_.s_km / r, distance_km);
}

void SkyRow::add_pieces(double from_km, double to_km, const Spectrum& depth_from,
                        const Spectrum& depth_to, int halvings) {
    const auto depth = ray_pieces::lit_depth(depth_from, depth_to, medium_.air.channels);
    if (!depth) return;
    const bool is_long = to_km - from_km > ray_pieces::longest_piece_km(shell_, any_.altitude_km,
                                                                        any_.s_km, from_km, to_km);
    if ((*depth > ray_pieces::kLargestDepth || is_long) && halvings < ray_pieces::kMostHalvings) {
        const double middle = 0.5 * (from_km + to_km);
        const Spectrum depth_middle = depth_km(middle);
        add_pieces(from_km, middle, depth_from, depth_middle, halvings + 1);
        add_pieces(middle, to_km, depth_middle, depth_to, halvings + 1);
        return;
    }
    pieces_.push_back({from_km, to_km, nodes_.size()});
    const double width = to_km - from_km;
    for (std::size_t i = 0; i < ray_pieces::gauss_rule().nodes.size(); ++i) {
        Node node;
        node.distance_km = from_km + width * ray_pieces::gauss_rule().nodes[i];
        node.altitude_km = std::clamp(
            altitude_along_km(shell_, any_.altitude_km, any_.s_km, node.distance_km), 0.0,
            shell_.thickness_km);  // rounding
        node.horizon_km = horizon_distance_km(shell_, node.altitude_km);
        const Spectrum depth_here = depth_km(node.distance_km);
        node.weight = width * ray_pieces::gauss_rule().weights[i] * exponential(-depth_here);
        for (const SkyLayer& layer : medium_.layers) {
            node.scattering.push_back(layer.scatters ? scattering_at(layer.alone, node.altitude_km)
                                                     : Spectrum{});
        }
        nodes_.push_back(std::move(node));
    }
}

// Pieces at whose ends, or between, a ray has and has not the sun.
void SkyRow::add_shadowed_piece(const Piece& piece, const std::vector<SkyRay>& rays,
                                const std::vector<bool>& is_cut,
                                std::vector<SkyRadiance>& sums) const {
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!is_cut[i]) continue;
        const SkyRadiance part = integrator_.between(rays[i], piece.from_km, piece.to_km);
        sums[i].single += part.single;
    }
}

// Of suns above the node's horizon: channel c of sun i is at c * count + i.
void SkyRow::find_sunlight(const Node& node, const std::vector<double>& s_km,
                           std::vector<double>& sunlight) const {
    const auto count = static_cast<int>(s_km.size());
    if (sunlight_ != nullptr) {
        sunlight_->read(node.altitude_km, s_km.data(), count, sunlight.data());
        return;
    }
    optical_depth_to_top(medium_.air, node.altitude_km, s_km.data(), count, sunlight.data());
    for (double& value : sunlight) value = -value;
    exponentials(sunlight.data(), count * medium_.air.channels);
}

void SkyRow::add_single(const std::vector<SkyRay>& rays, std::vector<SkyRadiance>& sums) const {
    const auto channels = static_cast<std::size_t>(medium_.air.channels);
    const std::size_t count = rays.size();
    std::vector<Spectrum> phases(medium_.layers.size() * count);
    for (std::size_t k = 0; k < medium_.layers.size(); ++k) {
        for (std::size_t i = 0; i < count; ++i) {
            phases[k * count + i] = first_phase_values(medium_.layers[k], rays[i].one_minus_cosine,
                                                       rays[i].one_plus_cosine);
        }
    }
    std::vector<double> s(count);
    std::vector<double> sun(count * kMaxChannels);
    std::vector<bool> is_cut(count);
    std::vector<bool> is_hidden(count);
    const auto nodes_per_piece = ray_pieces::gauss_rule().nodes.size();
    for (const Piece& piece : pieces_) {
        // The shadow's edge is where (r mu_s)^2 = r^2 - R^2 with the sun below the horizontal:
        // along a ray, a quadratic, whose lit part between two nodes or ends is lost on neither
        // unless it is shorter than the gap between them.
        const auto lit_at = [&](const SkyRay& ray, double distance_km) {
            const double altitude =
                std::max(altitude_along_km(shell_, any_.altitude_km, any_.s_km, distance_km), 0.0);
            return ray.sun_s_km + distance_km * ray.cosine_to_sun >=
                   -horizon_distance_km(shell_, altitude);
        };
        bool any_cut = false;
        for (std::size_t i = 0; i < count; ++i) {
            const bool first = lit_at(rays[i], piece.from_km);
            bool differs = lit_at(rays[i], piece.to_km) != first;
            for (std::size_t n = 0; n < nodes_per_piece && !differs; ++n) {
                const Node& node = nodes_[piece.first_node + n];
                differs = (rays[i].sun_s_km + node.distance_km * rays[i].cosine_to_sun >=
                           -node.horizon_km) != first;
            }
            is_cut[i] = differs;
            is_hidden[i] = differs || !first;
            any_cut = any_cut || differs;
        }
        if (any_cut) add_shadowed_piece(piece, rays, is_cut, sums);
        if (std::all_of(is_hidden.begin(), is_hidden.end(), [](bool hidden) { return hidden; })) {
            continue;
        }
        for (std::size_t n = 0; n < nodes_per_piece; ++n) {
            const Node& node = nodes_[piece.first_node + n];
            for (std::size_t i = 0; i < count; ++i) {
                // Rays without the sun ask for a place of the table all the same.
                s[i] =
                    is_hidden[i] ? 0 : rays[i].sun_s_km + node.distance_km * rays[i].cosine_to_sun;
            }
            find_sunlight(node, s, sun);
            for (std::size_t c = 0; c < channels; ++c) {
                for (std::size_t i = 0; i < count; ++i) {
                    if (is_hidden[i]) continue;
                    double towards_eye = 0;
                    for (std::size_t k = 0; k < medium_.layers.size(); ++k) {
                        towards_eye += node.scattering[k][c] * phases[k * count + i][c];
                    }
                    sums[i].single[c] += node.weight[c] * towards_eye * sun[c * count + i];
                }
            }
        }
    }
}

std::vector<Spectrum> SkyRow::multiple(const std::vector<SkyRay>& rays) const {
    std::vector<Spectrum> sums(rays.size());
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        const Node& node = nodes_[n];
        const HigherOrders::OfSun& of_sun = higher_orders_at_[n];
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const double s = rays[i].sun_s_km + node.distance_km * rays[i].cosine_to_sun;
            const ScatteringPoint point =
                scattering_point(shell_, rays[i], node.altitude_km, s, node.distance_km);
            sums[i] += node.weight * of_sun(point.sun_cos_zenith, point.azimuth_cosine);
        }
    }
    return sums;
}

// Along a ray the sun moves, so that the light is not quite a polynomial of its degree.
int SkyRow::azimuth_nodes() const { return std::max(higher_orders_->azimuth_degree(), 8) + 8; }

// Of higher orders.
std::vector<Spectrum> SkyRow::multiple(const RayOfAzimuth& ray_at,
                                       const std::vector<double>& azimuth_cosines) const {
    const int count = azimuth_nodes();
    const bool interpolates = azimuth_cosines.size() > static_cast<std::size_t>(count);
    std::vector<SkyRay> rays;
    for (int k = 0; interpolates && k < count; ++k) {
        rays.push_back(ray_at(chebyshev_point(k, count)));
    }
    for (std::size_t i = 0; !interpolates && i < azimuth_cosines.size(); ++i) {
        rays.push_back(ray_at(azimuth_cosines[i]));
    }
    std::vector<Spectrum> values = multiple(rays);
    if (!interpolates) return values;
    std::vector<Spectrum> interpolated;
    for (const double cosine : azimuth_cosines) interpolated.push_back(interpolate(values, cosine));
    return interpolated;
}

std::vector<SkyRadiance> SkyRow::radiance(const RayOfAzimuth& ray_at,
                                          const std::vector<double>& azimuth_cosines) const {
    std::vector<SkyRay> rays;
    for (const double cosine : azimuth_cosines) rays.push_back(ray_at(cosine));
    std::vector<SkyRadiance> sums(rays.size());
    for (SkyRadiance& sum : sums) sum.transmittance = transmittance_;
    add_single(rays, sums);
    if (higher_orders_ != nullptr) {
        const std::vector<Spectrum> values = multiple(ray_at, azimuth_cosines);
        for (std::size_t i = 0; i < rays.size(); ++i) sums[i].multiple = values[i];
    }
    for (std::size_t i = 0; i < rays.size() && any_.meets_ground; ++i) {
        sums[i].ground =
            integrator_.ground_radiance(rays[i].sun_s_km + any_.length_km * rays[i].cosine_to_sun);
        sums[i].ground *= transmittance_;
    }
    return sums;
}

}  // namespace skybake
