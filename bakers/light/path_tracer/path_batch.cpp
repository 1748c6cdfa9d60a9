#include "bakers/light/path_tracer/path_batch.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/light/path_tracer/path_batch.cpp"
#include <hwy/foreach_target.h>

#include "bakers/air/particles/phase_function-inl.h"
#include "bakers/light/path_tracer/path_flights-inl.h"
#include "bakers/light/path_tracer/path_steps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

// The paths of one batch with the events at which light is gathered and scattered. Names are those of
// tests/path_tracer/single_path.h.
class Walk : public PathFlights {
  public:
    using PathFlights::PathFlights;

    void walk() {
        begin();
        for (order_ = 0; count_ > 0; ++order_) {
            if (order_ > 0) begin_flights();
            if (source_.ambient) see_source();
            if (order_ > 0) play_roulette();
            choose_ends();
            if (count_ == 0) return;
            arrive();
            look_around();
            if (!source_.ambient && (order_ > 0 || rules_.counts_first_order)) gather_sunlight();
            choose_angles();
            turn();
        }
    }

  private:
    // Finds the layers' densities and scattering where the paths are.
    void look_around() {
        const auto& scatterers = medium_.scatterers();
        for (std::size_t i = 0; i < count_; ++i) {
            if (is_on_ground(i)) continue;
            Channels sum(0.0);
            for (std::size_t k = 0; k < scatterers.size(); ++k) {
                const double density =
                    density_at(air_, shell_of(i), scatterers[k].layer, columns_.altitude_km[i]);
                density_[k][i] = std::max(density, 0.0);  // rounding
                sum = sum + density_[k][i] * Channels(scatterers[k].scattering_per_km);
            }
            scattering_.store(i, sum);
        }
    }

    // Computes the phase functions at one angle of each path.
    void look_at_angles() {
        const auto& scatterers = medium_.scatterers();
        for (std::size_t k = 0; k < scatterers.size(); ++k) {
            const auto& functions = scatterers[k].phase.functions;
            for (std::size_t c = 0; c < functions.size(); ++c) {
                look_at_angles(functions[c], phase_[k * kChannelSlots + c]);
            }
        }
    }

    void look_at_angles(const PhaseFunction& phase, Column& values) {
        if (phase.table) {
            for (std::size_t i = 0; i < count_; ++i) {
                if (is_on_ground(i)) continue;
                values[i] = phase_value(phase, one_minus_[i], one_plus_[i]);
            }
            return;
        }
        for (std::size_t i = 0; i < count_; i += kLanes) {
            values.store(i, closed_phase_value(phase.constant, phase.quadratic, phase.g,
                                               one_minus_.load(i), one_plus_.load(i)));
        }
    }

    // Sum of sigma_s p over layers.
    Channels towards(std::size_t i) const {
        const auto& scatterers = medium_.scatterers();
        Channels sum(0.0);
        for (std::size_t k = 0; k < scatterers.size(); ++k) {
            const Channels scattering(scatterers[k].scattering_per_km);
            const double density = density_[k].values[i];
            const Column* phase = phase_.data() + k * kChannelSlots;
            if (scatterers[k].phase.is_alike()) {
                sum = sum + density * phase[0].values[i] * scattering;
            } else {
                double values[kChannelSlots] = {};
                for (std::size_t c = 0; c < scatterers[k].phase.functions.size(); ++c) {
                    values[c] = phase[c].values[i];
                }
                sum = sum + density * Channels::load(values) * scattering;
            }
        }
        return sum;
    }

    void gather_sunlight() {
        for (std::size_t i = 0; i < count_; ++i) {
            if (ended_[i]) continue;
            sun_.set(i, sample_sun(source_, numbers_.random(number_of(i))));
        }
        for (std::size_t i = 0; i < count_; i += kLanes) {
            const Direction<Lanes> sun = sun_.load(i);
            const Lanes r = Lanes(air_.planet.ground_radius_km) + columns_.altitude_km.load(i);
            const Lanes cosine = dot(columns_.up.load(i), sun);
            sun_cosine_.store(i, cosine);
            sun_s_km_.store(i, r * cosine);
            const Angle<Lanes> angle = angle_between(sun, columns_.direction.load(i));
            one_minus_.store(i, angle.one_minus);
            one_plus_.store(i, angle.one_plus);
        }
        look_at_angles();
        for (std::size_t i = 0; i < count_; ++i) {
            if (ended_[i] || (is_on_ground(i) && !(sun_cosine_[i] > 0))) continue;
            const Channels light =
                sunlight(air_, columns_.altitude_km[i], sun_s_km_[i], shell_of(i));
            gather(i, is_on_ground(i) ? (sun_cosine_[i] / std::numbers::pi) * worth(i) * light
                                      : worth(i) * light * towards(i));
        }
    }

    void choose_angles() {
        numbers_.go_on();
        for (std::size_t i = 0; i < count_; ++i) {
            if (!is_on_ground(i) && !(scattering_.at(i, hero_of(i)) > 0)) ended_[i] = true;
            if (ended_[i]) continue;
            const double number = numbers_.of(number_of(i));
            if (is_on_ground(i)) {
                set_angle(i, lambert_angle(number));
            } else {
                choose_scatterer(i, number);
            }
        }
        for (std::size_t k = 0; k < medium_.scatterers().size(); ++k) scatter_by(k);
        look_at_angles();
        for (std::size_t i = 0; i < count_; ++i) {
            if (ended_[i] || is_on_ground(i)) continue;
            const Channels value = towards(i);
            const std::size_t hero = hero_of(i);
            value.store(one_packet_);
            const double inverse = scattering_.at(i, hero) / one_packet_[hero];
            packets_.weight.store(i, inverse * packets_.weight.load(i) * value);
            packets_.ratio.store(i, inverse * packets_.ratio.load(i) *
                                        zero_unless_positive(value, scattering_.load(i)));
        }
    }

    void set_angle(std::size_t i, const ScatteringAngle& angle) {
        one_minus_[i] = angle.one_minus;
        one_plus_[i] = angle.one_plus;
    }

    // Chooses what scatters by the first part of a number; what is left of it chooses the angle.
    void choose_scatterer(std::size_t i, double number) {
        const auto& scatterers = medium_.scatterers();
        const std::size_t hero = hero_of(i);
        double left = number * scattering_.at(i, hero);
        std::size_t chosen = 0;
        double part = 0;
        for (;; ++chosen) {
            part = density_[chosen][i] * data(scatterers[chosen].scattering_per_km)[hero];
            if (left < part || chosen + 1 == scatterers.size()) break;
            left -= part;
        }
        // Rounding may reach the end of a part, or its last one where that scatters nothing.
        constexpr double kLast = 1 - 0x1p-53;
        share_[i] = part > 0 ? std::min(left / part, kLast) : kLast;
        chosen_[i] = chosen;
    }

    // Chooses the angles of the paths that one of the scatterers scatters.
    void scatter_by(std::size_t scatterer) {
        const LayerPhase& phase = medium_.scatterers()[scatterer].phase;
        std::size_t paths[PathBatch::kPaths];
        std::size_t count = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            if (!ended_[i] && !is_on_ground(i) && chosen_[i] == scatterer) paths[count++] = i;
        }
        const PhaseFunction& of_all = phase.functions.front();
        if (!is_quadratic(of_all)) {
            for (std::size_t n = 0; n < count; ++n) {
                const std::size_t i = paths[n];
                set_angle(i, sample_phase(phase.of(hero_of(i)), share_[i],
                                          numbers_.random(number_of(i))));
            }
            return;
        }
        Column share{};
        Column cosine_minus, cosine_plus;
        for (std::size_t n = 0; n < count; ++n) share[n] = share_[paths[n]];
        for (std::size_t n = 0; n < count; n += kLanes) {
            const Angle<Lanes> angle =
                sample_quadratic(of_all.constant, of_all.quadratic, share.load(n));
            cosine_minus.store(n, angle.one_minus);
            cosine_plus.store(n, angle.one_plus);
        }
        for (std::size_t n = 0; n < count; ++n) {
            set_angle(paths[n], {cosine_minus[n], cosine_plus[n]});
        }
    }

    void turn() {
        numbers_.go_on();
        for (std::size_t i = 0; i < count_; ++i) {
            if (ended_[i]) continue;
            turns_[i] = numbers_.of(number_of(i));
            if (is_on_ground(i)) {
                columns_.direction.x[i] = columns_.up.x[i];
                columns_.direction.y[i] = columns_.up.y[i];
                columns_.direction.z[i] = columns_.up.z[i];
            }
        }
        for (std::size_t i = 0; i < count_; i += kLanes) {
            columns_.direction.store(
                i, scatter(columns_.direction.load(i), {one_minus_.load(i), one_plus_.load(i)},
                           turns_.load(i)));
        }
        remove_ended();
    }
};

void WalkBatch(const PathMedium& medium, const PathSource& source, const PathRules& rules,
               PathBatch& batch) {
    Walk(medium, source, rules, batch).walk();
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(WalkBatch);

void walk_batch(const PathMedium& medium, const PathSource& source, const PathRules& rules,
                PathBatch& batch) {
    HWY_DYNAMIC_DISPATCH(WalkBatch)(medium, source, rules, batch);
}

}  // namespace skybake
#endif  // HWY_ONCE
