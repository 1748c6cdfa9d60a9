#include "bakers/assets/bruneton/sun_bundle.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/assets/bruneton/sun_bundle.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "bakers/air/transmittance_row-inl.h"
#include "bakers/light/solver/sun_axis-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

// Where suns stand as seen from a node: r mu_s there, which suns that there are not may leave.
struct NodePlace {
    NodePlace(const Shell& shell, const ScatteringView& view, const BundleNode& node)
        : begin_radius_km(shell.ground_radius_km + view.altitude_km),
          radius_km(shell.ground_radius_km + node.altitude_km),
          distance_km(node.distance_km),
          view_cosine(std::clamp((view.s_km + node.distance_km) / radius_km, -1.0, 1.0)) {
    }  // rounding

    HWY_INLINE Lanes sun_s_km(const SunBundle& suns, int i) const {
        return Lanes(begin_radius_km) * Lanes::load(suns.sun_cosines.data() + i) +
               Lanes(distance_km) * Lanes::load(suns.nu.data() + i);
    }

    double begin_radius_km;
    double radius_km;
    double distance_km;
    double view_cosine;
};

void AddSunlight(const TransmittanceField& field, const ScatteringView& view,
                 const BundlePiece& piece, const SunBundle& suns, const std::vector<double>& lit,
                 double* single) {
    const Shell& shell = field.shell();
    const std::size_t layers = piece.nodes[0].weights.size();
    const auto stride = static_cast<std::size_t>(suns.count);
    std::vector<double> row(static_cast<std::size_t>(field.row_size()));
    for (const BundleNode& node : piece.nodes) {
        combine_row<Lanes>(field, node.altitude_km, row.data());
        const NodePlace place(shell, view, node);
        const double horizon = horizon_distance_km(shell, node.altitude_km);
        const SunlightRow sunlight_at = sunlight_row(field, node.altitude_km, row.data());
        for (int i = 0; i < suns.count; i += static_cast<int>(Lanes::kCount)) {
            const Lanes here = Lanes::load(lit.data() + i);
            if (!any(here > Lanes(0.0))) continue;
            const Lanes s =
                minimum(maximum(place.sun_s_km(suns, i), Lanes(-horizon)), Lanes(place.radius_km));
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

// The solved light of one node, as in higher_orders.h, for the suns of a bundle.
class SolvedNode {
  public:
    SolvedNode(const SolvedLight& light, const NodePlace& place, double altitude_km,
               const SunBundle& suns)
        : light_(light),
          place_(place),
          at_level_(light.level_at(altitude_km)),
          suns_(suns),
          orders_(static_cast<std::size_t>(light.degree()) + 1),
          columns_(static_cast<std::size_t>(suns.count)),
          weights_(4 * columns_.size()),
          powers_(orders_ * columns_.size(), 1.0) {}

    void place_suns();
    void gather_rows(const BundleNode& node,
                     const std::vector<std::vector<Spectrum>>& phase_moments);
    void add(double* scattered) const;

  private:
    const SolvedLight& light_;
    const NodePlace& place_;
    LevelPlace at_level_;
    const SunBundle& suns_;
    std::size_t orders_;
    std::vector<std::int64_t> columns_;
    std::vector<double> weights_;
    // [m * count + i]: (sin theta sin theta_s)^sine_power(m) cos(m phi)
    std::vector<double> powers_;
    std::vector<double> rows_;  // [(column * orders + m) * slots]
};

void SolvedNode::place_suns() {
    const SunAxis& axis = light_.suns;
    std::vector<double> means;
    for (int k = 0; k < axis.count(); ++k) means.push_back(light_.mean_of(at_level_, k));
    const Lanes mu(place_.view_cosine);
    const Lanes squared_view_sine = (Lanes(1.0) - mu) * (Lanes(1.0) + mu);
    for (int i = 0; i < suns_.count; i += static_cast<int>(Lanes::kCount)) {
        const Lanes cosine =
            maximum(minimum(place_.sun_s_km(suns_, i) * Lanes(1 / place_.radius_km), Lanes(1.0)),
                    Lanes(-1.0));
        const Lanes there = maximum(cosine, Lanes(axis.darkest));
        place_on_axis(axis, light_.steep, means, there, columns_.data() + i,
                      weights_.data() + 4 * i);
        const Lanes along = Lanes::load(suns_.nu.data() + i) - mu * cosine;
        const Lanes squared_sines =
            squared_view_sine * ((Lanes(1.0) - cosine) * (Lanes(1.0) + cosine));
        const AzimuthRecursion<Lanes> powers(along, squared_sines, orders_);
        const auto of_order = [&](std::size_t m) {
            return powers_.data() + m * columns_.size() + i;
        };
        if (orders_ > 1) along.store(of_order(1));
        for (std::size_t m = 2; m < orders_; ++m) {
            powers
                .next(m, Lanes::load(of_order(m - 1)), Lanes::load(of_order(m - 2)),
                      m < 4 ? Lanes(0.0) : Lanes::load(of_order(m - 4)))
                .store(of_order(m));
        }
    }
}

// The light that the node sends along the ray for each sun of the solution between which the
// bundle's suns lie.
void SolvedNode::gather_rows(const BundleNode& node,
                             const std::vector<std::vector<Spectrum>>& phase_moments) {
    const int degree = light_.degree();
    std::vector<double> harmonics(static_cast<std::size_t>(moment_count(degree)));
    harmonics_over_sines(degree, place_.view_cosine, harmonics.data());
    std::vector<Spectrum> factors(harmonics.size());
    for (int l = 0; l <= degree; ++l) {
        Spectrum sum{};
        for (std::size_t k = 0; k < phase_moments.size(); ++k) {
            sum += node.coarse_weights[k] * phase_moments[k][static_cast<std::size_t>(l)];
        }
        for (int m = 0; m <= l; ++m) {
            const auto lm = static_cast<std::size_t>(moment_index(l, m));
            factors[lm] = sum * harmonics[lm];
        }
    }
    rows_.assign(static_cast<std::size_t>(light_.suns.count()) * orders_ * kChannelSlots, 0.0);
    const auto [first, last] = std::ranges::minmax_element(columns_);
    for (std::int64_t sun = *first; sun < *last + 4; ++sun) {
        send_column(light_, at_level_, static_cast<int>(sun), degree, factors.data(),
                    rows_.data() + static_cast<std::size_t>(sun) * orders_ * kChannelSlots);
    }
}

void SolvedNode::add(double* scattered) const {
    add_columns(
        {rows_.data(), orders_, columns_.data(), weights_.data(), powers_.data(), columns_.size()},
        scattered);
}

void AddSolvedLight(const SolvedLight& light,
                    const std::vector<std::vector<Spectrum>>& phase_moments, const Shell& shell,
                    const ScatteringView& view, const BundlePiece& piece, const SunBundle& suns,
                    double* scattered) {
    for (const BundleNode& node : piece.nodes) {
        if (node.coarse_weights.empty()) continue;
        const NodePlace place(shell, view, node);
        SolvedNode solved(light, place, node.altitude_km, suns);
        solved.place_suns();
        solved.gather_rows(node, phase_moments);
        solved.add(scattered);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(AddSunlight);
HWY_EXPORT(AddSolvedLight);

SunBundle::SunBundle(const std::vector<double>& cosines, const std::vector<double>& cosines_to_sun)
    : wanted(static_cast<int>(cosines.size())),
      count((wanted + kBundleStep - 1) / kBundleStep * kBundleStep),
      sun_cosines(cosines),
      nu(cosines_to_sun) {
    assert(!cosines.empty() && cosines.size() == cosines_to_sun.size());
    sun_cosines.resize(static_cast<std::size_t>(count), cosines.back());
    nu.resize(static_cast<std::size_t>(count), cosines_to_sun.back());
}

void add_sunlight(const TransmittanceField& field, const ScatteringView& view,
                  const BundlePiece& piece, const SunBundle& suns, const std::vector<double>& lit,
                  double* single) {
    HWY_DYNAMIC_DISPATCH(AddSunlight)(field, view, piece, suns, lit, single);
}

void add_solved_light(const SolvedLight& light,
                      const std::vector<std::vector<Spectrum>>& phase_moments, const Shell& shell,
                      const ScatteringView& view, const BundlePiece& piece, const SunBundle& suns,
                      double* scattered) {
    HWY_DYNAMIC_DISPATCH(AddSolvedLight)(light, phase_moments, shell, view, piece, suns, scattered);
}

}  // namespace skybake
#endif  // HWY_ONCE
