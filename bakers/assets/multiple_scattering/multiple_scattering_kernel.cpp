#include "bakers/assets/multiple_scattering/multiple_scattering_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/assets/multiple_scattering/multiple_scattering_kernel.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>
#include <cassert>

#include "bakers/air/quadrature_rules.h"
#include "bakers/air/transmittance_row-inl.h"
#include "bakers/math/transcendental-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// A point that the sun shines on, and what reading its transmittance takes.
struct LitPoint {
    double r_km;
    double dark_below_km;    // the sun is down for r mu_s below this
    bool horizontal_ground;  // weight sunlight by its cosine
    SunlightRow sunlight;    // transmittance at this altitude
};

HWY_INLINE LitPoint lit_point(const TransmittanceField& field, double altitude_km,
                              const double* row) {
    const Shell& shell = field.shell();
    return {shell.ground_radius_km + altitude_km, -horizon_distance_km(shell, altitude_km), false,
            sunlight_row(field, altitude_km, row)};
}

// Adds weight * sunlight to `sum` for a sun at r mu_s = s.
template <class Real>
HWY_INLINE void add_sunlight(const LitPoint& point, Real s, Real weight, int channels, Real* sum) {
    Real value[kMaxChannels];
    sunlight_towards(point.sunlight, distance_to_top(point.sunlight, s), value);
    if (point.horizontal_ground) weight = weight * maximum(s, Real(0.0)) * Real(1.0 / point.r_km);
    for (int c = 0; c < channels; ++c) sum[c] = sum[c] + weight * value[c];
}

// The mean over azimuths of the sunlight at a point where r mu_s = a + b cos(azimuth) and the sun
// is up for all of them.
HWY_INLINE void mean_over_circle(const LitPoint& point, int azimuths, Lanes a, Lanes b,
                                 int channels, Lanes* mean) {
    for (int c = 0; c < channels; ++c) mean[c] = Lanes(0.0);
    const AzimuthRule& rule = full_circle_rule(azimuths);
    for (int i = 0; i < rule.count; ++i) {
        add_sunlight(point, a + b * Lanes(rule.nodes[i]), Lanes(rule.weights[i]), channels, mean);
    }
}

// The same where the sun is up only for azimuths below arccos((edge - a) / b), b > 0. Few suns are
// near the terminator of a point, so these are taken one by one.
HWY_INLINE void mean_over_lit_part(const LitPoint& point, int azimuths, double a, double b,
                                   int channels, double* mean) {
    const double cosine = minimum(maximum((point.dark_below_km - a) / b, -1.0), 1.0);
    const double lit_share = arc_cosine(cosine) * (1.0 / std::numbers::pi);
    const AzimuthRule& rule = lit_part_rule(azimuths);
    for (int c = 0; c < channels; ++c) mean[c] = 0;
    for (int i = 0; i < rule.count; ++i) {
        const double azimuth = cosine_of_pi(lit_share * rule.nodes[i]);
        add_sunlight(point, a + b * azimuth, lit_share * rule.weights[i], channels, mean);
    }
}

// The mean over all azimuths, b >= 0.
HWY_INLINE void mean_sunlight(const LitPoint& point, int azimuths, Lanes a, Lanes b, int channels,
                              Lanes* mean) {
    const Lanes edge(point.dark_below_km);
    const auto up_everywhere = a - b >= edge;
    if (any(up_everywhere)) {
        mean_over_circle(point, azimuths, a, b, channels, mean);
        if (all(up_everywhere)) return;
    }
    double as[Lanes::kCount];
    double bs[Lanes::kCount];
    double means[kMaxChannels][Lanes::kCount] = {};
    a.store(as);
    b.store(bs);
    for (int c = 0; any(up_everywhere) && c < channels; ++c) mean[c].store(means[c]);
    for (std::size_t lane = 0; lane < Lanes::kCount; ++lane) {
        if (as[lane] - bs[lane] >= point.dark_below_km) continue;
        double part[kMaxChannels] = {};
        if (as[lane] + bs[lane] >= point.dark_below_km) {
            mean_over_lit_part(point, azimuths, as[lane], bs[lane], channels, part);
        }
        for (int c = 0; c < channels; ++c) means[c][lane] = part[c];
    }
    for (int c = 0; c < channels; ++c) mean[c] = Lanes::load(means[c]);
}

constexpr int kStep = static_cast<int>(Lanes::kCount);

// The suns of a row, padded to whole vectors.
struct Suns {
    std::vector<double> cosine;
    std::vector<double> sine;
    int padded;
};

// Adds to sum[c * padded + i], for each sun, weight[c] times the mean sunlight at a point of the
// ray.
HWY_INLINE void add_point(const LitPoint& point, int azimuths, double along_km, double across_km,
                          const Spectrum& weight, int channels, const Suns& suns, double* sum) {
    for (int i = 0; i < suns.padded; i += kStep) {
        const Lanes a = Lanes::load(suns.cosine.data() + i) * Lanes(along_km);
        const Lanes b = Lanes::load(suns.sine.data() + i) * Lanes(across_km);
        if (!any(a + b >= Lanes(point.dark_below_km))) continue;
        Lanes mean[kMaxChannels];
        mean_sunlight(point, azimuths, a, b, channels, mean);
        for (int c = 0; c < channels; ++c) {
            double* to = sum + c * suns.padded + i;
            const Lanes part = Lanes(weight[static_cast<std::size_t>(c)]) * mean[c];
            (Lanes::load(to) + part).store(to);
        }
    }
}

void IntegrateRow(const Medium& medium, const Sunlight& sunlight, const RowQuadrature& quadrature,
                  const double* sun_cos_zenith, int count, double* psi) {
    const int channels = medium.channels;
    Suns suns;
    suns.padded = (count + kStep - 1) / kStep * kStep;
    for (int i = 0; i < suns.padded; ++i) {
        const double cosine = sun_cos_zenith[std::min(i, count - 1)];
        suns.cosine.push_back(cosine);
        suns.sine.push_back(square_root(maximum((1 - cosine) * (1 + cosine), 0.0)));
    }
    std::vector<double> sum(static_cast<std::size_t>(channels * suns.padded));
    std::vector<double> row(static_cast<std::size_t>(sunlight.field().row_size()));
    LitPoint ground = lit_point(sunlight.field(), 0, sunlight.row(0));
    ground.dark_below_km = 0;
    ground.horizontal_ground = true;

    std::vector<double> start_row(row.size());  // every ray starts at this altitude
    combine_row<Lanes>(sunlight.field(), quadrature.altitude_km, start_row.data());
    const double r = medium.ground_radius_km + quadrature.altitude_km;
    for (const WeightedRay& ray : quadrature.rays) {
        const double sine = square_root(maximum((1 - ray.mu) * (1 + ray.mu), 0.0));
        for (std::size_t k = 0; k < ray.nodes.size(); ++k) {
            const RayNode& node = ray.nodes[k];
            const Spectrum weight = ray.weight * node.weight * (0.25 / std::numbers::pi);
            if (largest(weight) == 0) continue;
            const double* values = k == 0 ? start_row.data() : row.data();
            if (node.level >= 0) {
                values = sunlight.row(node.level);
            } else if (k > 0) {
                combine_row<Lanes>(sunlight.field(), node.altitude_km, row.data());
            }
            add_point(lit_point(sunlight.field(), node.altitude_km, values), ray.azimuths[k],
                      r + node.distance_km * ray.mu, node.distance_km * sine, weight, channels,
                      suns, sum.data());
        }
        if (!ray.hits_ground) continue;
        Spectrum weight{};
        weight = ray.weight * ray.end_transmittance * medium.ground_albedo / std::numbers::pi;
        add_point(ground, ray.ground_azimuths, r + ray.length_km * ray.mu, ray.length_km * sine,
                  weight, channels, suns, sum.data());
    }
    for (int c = 0; c < channels; ++c) {
        const double escape = quadrature.escape[static_cast<std::size_t>(c)];
        for (int i = 0; i < count; ++i)
            psi[c * count + i] = sum[static_cast<std::size_t>(c * suns.padded + i)] / escape;
    }
}

void CombineRow(const TransmittanceField& field, double altitude_km, double* row) {
    combine_row<Lanes>(field, altitude_km, row);
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(CombineRow);

Sunlight::Sunlight(const Medium& medium, const std::vector<double>& altitudes_km,
                   TransmittanceField::Size size, int threads)
    : field_(medium, altitudes_km, size, threads),
      row_size_(static_cast<std::size_t>(field_.row_size())),
      rows_(row_size_ * altitudes_km.size()) {
    for (std::size_t i = 0; i < altitudes_km.size(); ++i) {
        HWY_DYNAMIC_DISPATCH(CombineRow)(field_, altitudes_km[i], rows_.data() + i * row_size_);
    }
}

HWY_EXPORT(IntegrateRow);

void integrate_row(const Medium& medium, const Sunlight& sunlight, const RowQuadrature& row,
                   const double* sun_cos_zenith, int count, double* psi) {
    assert(count >= 0);
    HWY_DYNAMIC_DISPATCH(IntegrateRow)(medium, sunlight, row, sun_cos_zenith, count, psi);
}

}  // namespace skybake
#endif  // HWY_ONCE
