#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "bakers/light/solver/transport.h"
#include "bakers/math/transcendental.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/light/solver/transport_kernel.cpp"
#include <hwy/foreach_target.h>

#include "bakers/light/solver/sun_axis-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake {
namespace HWY_NAMESPACE {

// What apply_transport works with for one level.
class LevelPass {
  public:
    LevelPass(const SunAxis& suns, const std::vector<double>& steep, const LightField& light)
        : axis_(suns),
          steep_(steep),
          light_(light),
          suns_(static_cast<std::size_t>(suns.count())),
          orders_(static_cast<std::size_t>(light.degree) + 1),
          sines_(suns_),
          rows_(suns_ * orders_ * kChannelSlots),
          columns_(suns_),
          cubic_(4 * suns_),
          powers_(orders_ * suns_, 1.0) {
        for (std::size_t i = 0; i < suns_; ++i) {
            sines_[i] = square_root((1 - suns.cosines[i]) * (1 + suns.cosines[i]));
        }
        for (std::size_t set = 0; set < 2; ++set) {
            const std::size_t azimuths = azimuths_of(set);
            along_[set].resize(azimuths * suns_ * kChannelSlots);
            for (std::size_t j = 0; j < azimuths; ++j) {
                azimuth_cosines_[set].push_back(
                    cosine_of_pi((static_cast<double>(j) + 0.5) / static_cast<double>(azimuths)));
            }
            for (std::size_t m = 0; m < orders_; ++m) {
                for (std::size_t j = 0; j < azimuths; ++j) {
                    const double half_turns = (static_cast<double>(j) + 0.5) *
                                              static_cast<double>(m) /
                                              static_cast<double>(azimuths);
                    fourier_[set].push_back(cosine_of_turns(0.5 * half_turns) /
                                            static_cast<double>(azimuths));
                }
            }
        }
    }

    void apply(const LevelTransport& transport, double* out, double* sky_irradiance);

  private:
    // Those that make_level_transport chooses among.
    std::size_t azimuths_of(std::size_t set) const {
        return std::max<std::size_t>(4, orders_) << set;
    }
    void gather_rows(const TransportNode& node, const double* weights);
    void place_suns(const TransportNode& node, double azimuth_cosine);
    void add_rows(std::size_t orders, double* sum) const;
    void add_node(const LevelTransport& transport, const TransportNode& node);
    void add_ray(const TransportRay& ray, double* out, double* sky_irradiance);

    const SunAxis& axis_;
    const std::vector<double>& steep_;
    const LightField& light_;
    std::size_t suns_;
    std::size_t orders_;  // m = 0 .. degree
    std::vector<double> sines_;
    std::vector<double> rows_;  // [(sun * orders + m) * slots]: what each order sends along
    std::vector<std::int64_t> columns_;  // of the suns as seen from a node
    std::vector<double> cubic_;          // [sun * 4 + i]
    std::vector<double> powers_;         // [m * suns + sun]: sin^m theta_s' cos(m phi')
    std::vector<double> along_[2];       // light along the ray by few and by many azimuths
    bool used_[2] = {};
    std::vector<double> azimuth_cosines_[2];
    std::vector<double> fourier_[2];  // [m * azimuths + j]: cos(m phi_j) over their number
};

// The light that a node sends along the ray, for the suns of the grid at the node.
void LevelPass::gather_rows(const TransportNode& node, const double* weights) {
    if (node.ground) {
        const Channels weight = Channels::load(weights);
        for (std::size_t i = 0; i < suns_; ++i) {
            (weight * Channels::load(light_.sky_irradiance.data() + i * kChannelSlots))
                .store(rows_.data() + i * kChannelSlots);
        }
        return;
    }
    const Channels near = Channels(1 - node.fraction);
    const Channels far = Channels(node.fraction);
    const bool between = node.fraction > 0;
    for (std::size_t i = 0; i < suns_; ++i) {
        const double* low = light_.at(node.level, static_cast<int>(i));
        const double* high = low + (between ? light_.level_size() : 0);
        for (std::size_t m = 0; m < orders_; ++m) {
            Channels sum(0.0);
            for (std::size_t l = m; l < orders_; ++l) {
                const std::size_t lm = (l * (l + 1) / 2 + m) * kChannelSlots;
                Channels value = Channels::load(low + lm);
                if (between) value = near * value + far * Channels::load(high + lm);
                sum = sum + Channels::load(weights + lm) * value;
            }
            sum.store(rows_.data() + (i * orders_ + m) * kChannelSlots);
        }
    }
}

// Where the suns stand as seen from the node, for one azimuth.
void LevelPass::place_suns(const TransportNode& node, double azimuth_cosine) {
    const Lanes turn_cosine(node.turn_cosine);
    const Lanes turn_sine(node.turn_sine);
    for (std::size_t i = 0; i < suns_; i += Lanes::kCount) {
        const Lanes cosine = Lanes::load(axis_.cosines.data() + i);
        const Lanes along = Lanes::load(sines_.data() + i) * Lanes(azimuth_cosine);
        const Lanes there = maximum(minimum(turn_cosine * cosine + turn_sine * along, Lanes(1.0)),
                                    Lanes(axis_.darkest));

        place_on_axis(axis_, steep_, there, columns_.data() + i, cubic_.data() + 4 * i);

        // sin^m theta_s' cos(m phi') by Chebyshev's recursion.
        const Lanes first_power = turn_cosine * along - turn_sine * cosine;
        const Lanes squared_sine = (Lanes(1.0) - there) * (Lanes(1.0) + there);
        Lanes last(1.0);
        Lanes next = first_power;
        for (std::size_t m = 1; m < orders_; ++m) {
            next.store(powers_.data() + m * suns_ + i);
            const Lanes after_next = Lanes(2.0) * first_power * next - squared_sine * last;
            last = next;
            next = after_next;
        }
    }
}

// Adds to sum[sun] the rows at the suns' places.
void LevelPass::add_rows(std::size_t orders, double* sum) const {
    add_columns({rows_.data(), orders, columns_.data(), cubic_.data(), powers_.data(), suns_}, sum);
}

void LevelPass::add_node(const LevelTransport& transport, const TransportNode& node) {
    gather_rows(node, transport.weights.data() + node.weights);
    const std::size_t set = static_cast<std::size_t>(node.azimuths) == azimuths_of(0) ? 0 : 1;
    if (!used_[set]) std::fill(along_[set].begin(), along_[set].end(), 0.0);
    used_[set] = true;
    for (int j = 0; j < node.azimuths; ++j) {
        place_suns(node,
                   fourier_[set][static_cast<std::size_t>(node.azimuths + j)] * node.azimuths);
        add_rows(node.ground ? 1 : orders_,
                 along_[set].data() + static_cast<std::size_t>(j) * suns_ * kChannelSlots);
    }
}

// Adds the moments of the light along a ray.
void LevelPass::add_ray(const TransportRay& ray, double* out, double* sky_irradiance) {
    std::vector<double> harmonics(static_cast<std::size_t>(moment_count(light_.degree)));
    zenith_harmonics(light_.degree, ray.mu, harmonics.data());
    const double solid_angle = 4 * std::numbers::pi * ray.weight;
    for (std::size_t m = 0; m < orders_; ++m) {
        for (std::size_t i = 0; i < suns_; ++i) {
            Channels mean(0.0);
            for (std::size_t set = 0; set < 2; ++set) {
                if (!used_[set]) continue;
                const std::size_t azimuths = azimuths_of(set);
                for (std::size_t j = 0; j < azimuths; ++j) {
                    const Channels weight = Channels(fourier_[set][m * azimuths + j]);
                    mean = mean + weight * Channels::load(along_[set].data() +
                                                          (j * suns_ + i) * kChannelSlots);
                }
            }
            if (m == 0 && sky_irradiance && ray.mu > 0) {
                double* to = sky_irradiance + i * kChannelSlots;
                (Channels::load(to) + Channels(solid_angle * ray.mu) * mean).store(to);
            }
            for (std::size_t l = m; l < orders_; ++l) {
                const std::size_t lm = l * (l + 1) / 2 + m;
                double* to = out + i * light_.sun_size() + lm * kChannelSlots;
                (Channels::load(to) + Channels(solid_angle * harmonics[lm]) * mean).store(to);
            }
        }
    }
}

void LevelPass::apply(const LevelTransport& transport, double* out, double* sky_irradiance) {
    std::fill(out, out + light_.level_size(), 0.0);
    if (sky_irradiance) std::fill(sky_irradiance, sky_irradiance + suns_ * kChannelSlots, 0.0);
    for (const TransportRay& ray : transport.rays) {
        for (bool& used : used_) used = false;
        for (const TransportNode& node : ray.nodes) add_node(transport, node);
        add_ray(ray, out, sky_irradiance);
    }
    // Moments of order m are kept over sin^m theta_s.
    for (std::size_t i = 0; i < suns_; ++i) {
        double factor = 1;
        for (std::size_t m = 1; m < orders_; ++m) {
            factor /= sines_[i];
            for (std::size_t l = m; l < orders_; ++l) {
                double* to = out + i * light_.sun_size() + (l * (l + 1) / 2 + m) * kChannelSlots;
                (Channels::load(to) * Channels(factor)).store(to);
            }
        }
    }
}

void ApplyTransport(const LevelTransport& transport, const SunAxis& suns,
                    const std::vector<double>& steep, const LightField& light, double* out,
                    double* sky_irradiance) {
    LevelPass(suns, steep, light).apply(transport, out, sky_irradiance);
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(ApplyTransport);

void apply_transport(const LevelTransport& transport, const SunAxis& suns,
                     const std::vector<double>& steep, const LightField& light, double* out,
                     double* sky_irradiance) {
    assert(light.suns == suns.count() && steep.size() >= suns.cosines.size() - 3);
    HWY_DYNAMIC_DISPATCH(ApplyTransport)(transport, suns, steep, light, out, sky_irradiance);
}

}  // namespace skybake
#endif  // HWY_ONCE
