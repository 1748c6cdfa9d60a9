#include "bakers/light/solver/first_light.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/light/solver/first_light.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "bakers/air/particles/phase_function-inl.h"
#include "bakers/light/solver/ray_cells-inl.h"
#include "bakers/math/transcendental.h"
#include "config/text/mapped.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// A forward peak of half width 1 - |g| needs azimuths to match. The mean over n of them is exact below
// degree 2 n: for moments of a degree times a phase function of the same, and what sunlight changes.
inline int first_azimuths(const std::vector<SplitPhase>& phases, int degree) {
    if (degree > kLargestDegreeOfBundles) return degree + 8;
    double peak = 0;
    for (const SplitPhase& layer : phases) {
        for (const PhaseFunction& phase : layer.wide.phase.functions) {
            peak = std::max(peak, phase.table ? 1.0 : std::fabs(phase.g));
        }
    }
    return peak < 0.5 ? 8 : peak < 0.85 ? 16 : 32;
}

// phase_function.h, for many cosines.
HWY_INLINE Lanes phase_lanes(const PhaseFunction& phase, Lanes one_minus, Lanes one_plus) {
    if (phase.table) {
        double minus[Lanes::kCount];
        double plus[Lanes::kCount];
        one_minus.store(minus);
        one_plus.store(plus);
        for (std::size_t i = 0; i < Lanes::kCount; ++i) {
            minus[i] = tabulated_phase_value(*phase.table, minus[i], plus[i]);
        }
        return Lanes::load(minus);
    }
    return closed_phase_value(phase.constant, phase.quadratic, phase.g, one_minus, one_plus);
}

// Returns the sum of coefficients[l][channel] P_l(nu) by Clenshaw's recursion.
HWY_INLINE Lanes legendre_sum(const std::vector<Spectrum>& coefficients, std::size_t channel,
                              Lanes nu) {
    Lanes next(0.0);
    Lanes after(0.0);
    for (std::size_t l = coefficients.size(); l-- > 0;) {
        const auto n = static_cast<double>(l);
        const Lanes value = Lanes(coefficients[l][channel]) +
                            Lanes((2 * n + 1) / (n + 1)) * nu * next -
                            Lanes((n + 1) / (n + 2)) * after;
        after = next;
        next = value;
    }
    return next;
}

// Phase functions of one layer for directions with these 1 -+ nu.
HWY_INLINE void phases_of_layer(const SplitPhase& layer, Lanes one_minus, Lanes one_plus,
                                Lanes* phase) {
    if (!layer.series.empty()) {
        const Lanes nu = Lanes(0.5) * (one_plus - one_minus);
        for (std::size_t c = 0; c < kMaxChannels; ++c) phase[c] = legendre_sum(layer.series, c, nu);
        return;
    }
    for (std::size_t c = 0; c < kMaxChannels; ++c) {
        const bool is_new = c == 0 || c < layer.wide.phase.functions.size();
        phase[c] = is_new ? Lanes(layer.wide.share[c]) *
                                phase_lanes(layer.wide.phase.of(c), one_minus, one_plus)
                          : phase[0];
    }
}

// Returns the cosines of azimuths amid equal parts of half a turn.
inline std::vector<double> cosines_of_azimuths(int count) {
    std::vector<double> cosines;
    for (int j = 0; j < count; ++j) cosines.push_back(cosine_of_pi((j + 0.5) / count));
    return cosines;
}

inline std::vector<double> sines_of(const SunAxis& suns) {
    return mapped<double>(suns.cosines, [&](const double cosine) {
        return square_root((1 - cosine) * (1 + cosine));
    });
}

// The state of gather_first_light for one level.
class FirstLightPass {
  public:
    FirstLightPass(const SkyMedium& medium, const std::vector<SplitPhase>& phases,
                   const TransmittanceField& sunlight, const SunAxis& suns, int degree,
                   int azimuths)
        : medium_(medium),
          phases_(phases),
          field_(sunlight),
          axis_(suns),
          degree_(degree),
          suns_(static_cast<std::size_t>(suns.count())),
          layers_(medium.layers.size()),
          azimuths_(azimuths > 0 ? azimuths : first_azimuths(phases, degree)),
          azimuth_cosines_(cosines_of_azimuths(azimuths_)),
          sines_(sines_of(suns)),
          cells_(medium, sunlight, suns.cosines, sines_, azimuth_cosines_),
          moments_(static_cast<std::size_t>(moment_count(degree)) * kMaxChannels * suns_),
          irradiance_(kMaxChannels * suns_) {
        for (int m = 0; m <= degree; ++m) {
            for (int j = 0; j < azimuths_; ++j) {
                const double half_turns = (j + 0.5) * m / azimuths_;
                azimuth_harmonics_.push_back(cosine_of_turns(0.5 * half_turns) / azimuths_);
            }
        }
    }

    void gather(const FirstFans& fans, double* out, double* sky_irradiance);

  private:
    // Gathers the light of the columns from `first` to before `last`, whole vectors of them.
    void gather_columns(const RayFan& fan, std::size_t first, std::size_t last);
    void write(double* out, double* sky_irradiance) const;
    // Finds the light that light from the sun's direction stands for (is_taken_from_sun).
    void set_from_sun(double altitude_km);
    void add_moments(const FanRay& ray);
    const double* from_sun(std::size_t layer, std::size_t channel) const {
        return from_sun_.data() + (layer * kMaxChannels + channel) * suns_;
    }

    const SkyMedium& medium_;
    const std::vector<SplitPhase>& phases_;
    const TransmittanceField& field_;
    const SunAxis& axis_;
    int degree_;
    std::size_t suns_;
    std::size_t first_ = 0;  // the columns at hand
    std::size_t last_ = 0;
    std::size_t layers_;
    int azimuths_;
    std::vector<double> azimuth_cosines_;
    std::vector<double> azimuth_harmonics_;  // [m * azimuths + j]: cos(m phi_j) over their number
    std::vector<double> sines_;
    RayCells cells_;
    std::vector<double> moments_;  // [(lm * channels + c) * suns + sun]
    std::vector<double> irradiance_;
    std::vector<double> from_sun_;  // [(layer * channels + c) * suns + sun]
};

void FirstLightPass::set_from_sun(double altitude_km) {
    from_sun_.assign(layers_ * kMaxChannels * suns_, 0.0);
    for (std::size_t i = 0; i < suns_; ++i) {
        for (std::size_t k = 0; k < layers_; ++k) {
            if (!phases_[k].is_taken_from_sun) continue;
            const Spectrum light =
                forward_light(medium_, medium_.layers[k], altitude_km, axis_.cosines[i]);
            for (std::size_t c = 0; c < kMaxChannels; ++c) {
                from_sun_[(k * kMaxChannels + c) * suns_ + i] = light[c];
            }
        }
    }
}

// Adds the moments of the light along a ray, whose parts are in cells_.
void FirstLightPass::add_moments(const FanRay& ray) {
    std::vector<double> harmonics(static_cast<std::size_t>(moment_count(degree_)));
    zenith_harmonics(degree_, ray.mu, harmonics.data());
    const double solid_angle = 4 * std::numbers::pi * ray.weight;
    // A vector for each m and channel.
    std::vector<double> fourier(static_cast<std::size_t>(degree_ + 1) * kMaxChannels *
                                Lanes::kCount);
    for (std::size_t i = first_; i < last_; i += Lanes::kCount) {
        const Lanes cosine = Lanes::load(axis_.cosines.data() + i);
        const Lanes sine = Lanes::load(sines_.data() + i);
        std::ranges::fill(fourier, 0.0);
        for (int j = 0; j < azimuths_; ++j) {
            const double azimuth_cosine = azimuth_cosines_[static_cast<std::size_t>(j)];
            // 1 -+ nu = |view -+ sun|^2 / 2.
            const double forward = ray.sine * azimuth_cosine;
            const Lanes across(ray.sine * ray.sine * (1 - azimuth_cosine) * (1 + azimuth_cosine));
            const Lanes up_minus = Lanes(ray.mu) - cosine;
            const Lanes up_plus = Lanes(ray.mu) + cosine;
            const Lanes minus = Lanes(forward) - sine;
            const Lanes plus = Lanes(forward) + sine;
            const Lanes one_minus = Lanes(0.5) * (up_minus * up_minus + minus * minus + across);
            const Lanes one_plus = Lanes(0.5) * (up_plus * up_plus + plus * plus + across);
            Lanes light[kMaxChannels];
            cells_.read(static_cast<std::size_t>(j), layers_, i, light);
            for (std::size_t k = 0; k < layers_; ++k) {
                if (!medium_.layers[k].scatters) continue;
                Lanes phase[kMaxChannels];
                phases_of_layer(phases_[k], one_minus, one_plus, phase);
                Lanes sum[kMaxChannels];
                cells_.read(static_cast<std::size_t>(j), k, i, sum);
                for (std::size_t c = 0; c < kMaxChannels; ++c) {
                    if (phases_[k].is_taken_from_sun) {
                        sum[c] = sum[c] - Lanes::load(from_sun(k, c) + i);
                    }
                    light[c] = light[c] + phase[c] * sum[c];
                }
            }
            for (std::size_t m = 0; m <= static_cast<std::size_t>(degree_); ++m) {
                const Lanes weight(
                    azimuth_harmonics_[m * azimuth_cosines_.size() + static_cast<std::size_t>(j)]);
                for (std::size_t c = 0; c < kMaxChannels; ++c) {
                    double* sum = fourier.data() + (m * kMaxChannels + c) * Lanes::kCount;
                    (Lanes::load(sum) + weight * light[c]).store(sum);
                }
            }
        }
        for (int l = 0; l <= degree_; ++l) {
            for (int m = 0; m <= l; ++m) {
                const auto lm = static_cast<std::size_t>(moment_index(l, m));
                const Lanes weight(solid_angle * harmonics[lm]);
                for (std::size_t c = 0; c < kMaxChannels; ++c) {
                    double* to = moments_.data() + (lm * kMaxChannels + c) * suns_ + i;
                    (Lanes::load(to) +
                     weight * Lanes::load(fourier.data() +
                                          (static_cast<std::size_t>(m) * kMaxChannels + c) *
                                              Lanes::kCount))
                        .store(to);
                }
            }
        }
        if (ray.mu > 0) {
            for (std::size_t c = 0; c < kMaxChannels; ++c) {
                double* to = irradiance_.data() + c * suns_ + i;
                (Lanes::load(to) +
                 Lanes(solid_angle * ray.mu) * Lanes::load(fourier.data() + c * Lanes::kCount))
                    .store(to);
            }
        }
    }
}

void FirstLightPass::gather_columns(const RayFan& fan, std::size_t first, std::size_t last) {
    first_ = first;
    last_ = last;
    if (first == last) return;
    const double r = field_.shell().ground_radius_km + fan.altitude_km;
    for (const FanRay& ray : fan.rays) {
        cells_.sum(r, ray, first, last);
        add_moments(ray);
    }
}

void FirstLightPass::gather(const FirstFans& fans, double* out, double* sky_irradiance) {
    set_from_sun(fans.day.altitude_km);
    const auto night = static_cast<std::size_t>(columns_below_horizon(axis_));
    gather_columns(fans.twilight, 0, night);
    gather_columns(fans.day, night, suns_);
    write(out, sky_irradiance);
}

void FirstLightPass::write(double* out, double* sky_irradiance) const {
    for (std::size_t i = 0; i < suns_; ++i) {
        const SinePowers inverse = inverse_powers_of(sines_[i]);
        for (int m = 0; m <= degree_; ++m) {
            const double factor = inverse[static_cast<std::size_t>(sine_power(m))];
            for (int l = m; l <= degree_; ++l) {
                const auto lm = static_cast<std::size_t>(moment_index(l, m));
                double* to = out + (i * static_cast<std::size_t>(moment_count(degree_)) + lm) *
                                       kChannelSlots;
                for (std::size_t c = 0; c < kMaxChannels; ++c) {
                    to[c] = factor * moments_[(lm * kMaxChannels + c) * suns_ + i];
                }
            }
        }
        for (std::size_t c = 0; sky_irradiance && c < kMaxChannels; ++c) {
            sky_irradiance[i * kChannelSlots + c] = irradiance_[c * suns_ + i];
        }
    }
}

void GatherFirstLight(const SkyMedium& medium, const std::vector<SplitPhase>& phases,
                      const FirstFans& fans, const TransmittanceField& sunlight,
                      const SunAxis& suns, int degree, double* out, double* sky_irradiance) {
    FirstLightPass(medium, phases, sunlight, suns, degree, fans.azimuths)
        .gather(fans, out, sky_irradiance);
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(GatherFirstLight);

namespace {

// How many more directions above the horizon, and as many below, twilight has than the day.
constexpr int kMoreTwilightNodes = 4;

}  // namespace

FirstFans make_first_fans(const SkyMedium& medium, const std::vector<double>& levels_km, int level,
                          int zenith_nodes, double tolerance) {
    return {
        make_ray_fan(medium, levels_km, level, zenith_nodes, tolerance),
        make_twilight_fan(medium, levels_km, level, zenith_nodes + kMoreTwilightNodes, tolerance)};
}

void gather_first_light(const SkyMedium& medium, const std::vector<SplitPhase>& phases,
                        const FirstFans& fans, const TransmittanceField& sunlight,
                        const SunAxis& suns, int degree, double* out, double* sky_irradiance) {
    assert(phases.size() == medium.layers.size() && degree >= 0);
    HWY_DYNAMIC_DISPATCH(GatherFirstLight)
    (medium, phases, fans, sunlight, suns, degree, out, sky_irradiance);
    add_forward_peaks(medium, phases, fans.day.altitude_km, suns, degree, out, sky_irradiance);
}

}  // namespace skybake
#endif  // HWY_ONCE
