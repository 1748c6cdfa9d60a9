// One path of light, the specification of batches of paths: its events one after the other.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "bakers/light/path_tracer/path_medium.h"
#include "bakers/light/path_tracer/path_steps-inl.h"

namespace skybake::test {

namespace kernel = HWY_NAMESPACE;

// The numbers of one path: a batch of one.
class PathNumbers : public BatchNumbers {
  public:
    explicit PathNumbers(const RandomStream& random) : BatchNumbers(std::vector{random}) {}
    PathNumbers(const ScrambledPoints& points, std::uint32_t point, const RandomStream& random)
        : BatchNumbers(points, point, {random}) {}

    // Returns the next number, in (0, 1).
    double next() {
        go_on();
        return of(0);
    }
};

// The angle between two unit vectors.
inline ScatteringAngle angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 apart = a - b;
    const glm::dvec3 together = a + b;
    return {0.5 * glm::dot(apart, apart), 0.5 * glm::dot(together, together)};
}

class SinglePath {
    using Flight = PathMedium::Flight;
    using Scatterer = PathMedium::Scatterer;

  public:
    explicit SinglePath(const PathMedium& medium) : medium_(medium) {}

    // `hero` is the channel that draws, which all channels must be equally likely to be. Returns the
    // weight with which the path began its second flight.
    Spectrum walk(const PathSource& source, const PathStart& start, const PathRules& rules,
                  std::size_t hero, PathNumbers& numbers, PathLight& light) const {
        State state = begin(start);
        state.hero = hero;
        Spectrum second_flight(0.0);
        Spectrum usual = rules.usual_weight;
        Flight flight = medium_.first_flight(start, rules);
        for (;;) {
            if (source.ambient && !flight.hits_ground) {
                Spectrum& gathered = state.order == 0 ? light.direct : state.gathered(light);
                gathered = gathered + state.worth() * flight.through;
            }
            const Spectrum goes_on = flight.scattered + flight.returned;
            if (state.order > 0) {
                const Spectrum worth = state.worth() * goes_on;
                if (state.order == 1) {
                    second_flight = worth;
                    for (std::size_t c = 0; c < channels_; ++c) {
                        if (!(usual[c] > 0)) usual[c] = worth[c];
                    }
                }
                if (!survives(worth, usual, state, numbers)) return second_flight;
            }
            if (!(goes_on[hero] > 0)) return second_flight;
            ++light.flights;
            const bool counts = !source.ambient && (state.order > 0 || rules.counts_first_order);
            // The ground lies behind all air.
            const double scattered_share = numbers.next() * goes_on[hero];
            if (flight.returned[hero] > 0 && scattered_share >= flight.scattered[hero]) {
                arrive_on_ground(flight, state);
                reflect(source, counts, state, numbers, light);
            } else {
                arrive_in_air(flight, scattered_share, state);
                if (!collide(source, counts, state, numbers, light)) return second_flight;
            }
            flight = medium_.first_flight({state.up, state.direction, state.altitude_km}, {});
        }
    }

  private:
    // Where a path is, and what it carries. For channel c of a path that hero h walks, the light that
    // comes along is worth weight[c] / mean(ratio): weight is f_c / p_h, ratio p_c / p_h.
    struct State {
        glm::dvec3 up{};
        glm::dvec3 direction{};
        double altitude_km = 0;
        std::size_t shell = 0;
        int order = 0;
        std::size_t hero = 0;
        std::size_t channels = 0;
        Spectrum weight{0.0};
        Spectrum ratio{0.0};

        Spectrum worth() const {
            double sum = 0;
            for (std::size_t c = 0; c < channels; ++c) sum += ratio[c];
            return (static_cast<double>(channels) / sum) * weight;
        }
        Spectrum& gathered(PathLight& light) const {
            return light.orders[std::min(static_cast<std::size_t>(order), kPathOrders) - 1];
        }
    };

    // The air at a vertex.
    struct Here {
        std::vector<double> densities;  // of scatterers
        Spectrum scattering{};
    };

    State begin(const PathStart& start) const {
        State state;
        state.up = start.up;
        state.direction = start.direction;
        state.altitude_km = start.altitude_km;
        state.shell = air_.shell_at(start.altitude_km);
        state.channels = channels_;
        for (std::size_t c = 0; c < channels_; ++c) {
            state.weight[c] = 1;
            state.ratio[c] = 1;
        }
        return state;
    }

    // Goes to where the hero's depth from the start is `depth`; returns each channel's.
    Spectrum move(const Flight& flight, double depth, State& state) const {
        const std::size_t h = state.hero;
        const double before_lowest = flight.lowest[h] - flight.from[h];
        const bool still_falls = flight.falls && (flight.hits_ground || depth < before_lowest);
        const double upwards = flight.falls ? flight.lowest[h] + before_lowest : flight.from[h];
        const auto found = kernel::point_at_depth<double>(
            air_.tables(),
            {state.altitude_km, std::fabs(flight.s_km), static_cast<double>(state.shell)},
            flight.from[h], static_cast<double>(h),
            still_falls ? flight.from[h] + depth : std::max(upwards - depth, 0.0),
            static_cast<double>(flight.falls ? flight.lowest_shell : state.shell),
            static_cast<double>(still_falls ? state.shell : air_.count() - 1));
        const AirShells::Point end = {found.altitude_km, found.s_km,
                                      static_cast<std::size_t>(found.shell)};
        const Spectrum way = medium_.depth_up_to(flight, end, still_falls);
        const double radius = air_.planet().ground_radius_km;
        const double distance = (still_falls ? -end.s_km : end.s_km) - flight.s_km;
        state.up = (1 / (radius + end.altitude_km)) *
                   ((radius + state.altitude_km) * state.up + distance * state.direction);
        state.altitude_km = end.altitude_km;
        state.shell = end.shell;
        return way;
    }

    // Finds the layers' densities and scattering where the path is.
    Here look_around(const State& state) const {
        Here here;
        for (const Scatterer& scatterer : medium_.scatterers()) {
            const double density =
                kernel::density_at(air_.tables(), state.shell, scatterer.layer, state.altitude_km);
            here.densities.push_back(std::max(density, 0.0));  // rounding
            here.scattering = here.scattering + here.densities.back() * scatterer.scattering_per_km;
        }
        return here;
    }

    // Sum of sigma_s p over layers.
    Spectrum towards(const Here& here, const ScatteringAngle& angle) const {
        Spectrum sum(0.0);
        for (std::size_t k = 0; k < medium_.scatterers().size(); ++k) {
            const LayerPhase& phase = medium_.scatterers()[k].phase;
            const double density = here.densities[k];
            if (phase.is_alike()) {
                const double value =
                    density * phase_value(phase.functions.front(), angle.one_minus, angle.one_plus);
                sum = sum + value * medium_.scatterers()[k].scattering_per_km;
            } else {
                const Spectrum values(phase_values(phase, angle.one_minus, angle.one_plus));
                sum = sum + density * values * medium_.scatterers()[k].scattering_per_km;
            }
        }
        return sum;
    }

    // Chooses what scatters by the first part of a number and the angle by what is left of it.
    ScatteringAngle choose_angle(const Here& here, std::size_t hero, PathNumbers& numbers) const {
        double left = numbers.next() * here.scattering[hero];
        std::size_t chosen = 0;
        double part = 0;
        for (;; ++chosen) {
            part = here.densities[chosen] * medium_.scatterers()[chosen].scattering_per_km[hero];
            if (left < part || chosen + 1 == medium_.scatterers().size()) break;
            left -= part;
        }
        // Rounding may reach the end of a part, or its last one where that scatters nothing.
        constexpr double kLast = 1 - 0x1p-53;
        const double share = part > 0 ? std::min(left / part, kLast) : kLast;
        return sample_phase(medium_.scatterers()[chosen].phase.of(hero), share, numbers.random(0));
    }

    // Distance by the hero's density sigma_t T / (1 - T_end + returned).
    void arrive_in_air(const Flight& flight, double scattered_share, State& state) const {
        const std::size_t h = state.hero;
        const Spectrum passed = move(flight, kernel::depth_of_share(scattered_share), state);
        ++state.order;
        const Spectrum transmittance = exponential(-passed);
        const Spectrum extinction =
            kernel::extinction_at(air_.tables(), state.shell, state.altitude_km).spectrum();
        const Spectrum density =
            share_of(extinction * transmittance, flight.scattered + flight.returned);
        // Rounding at the edge of a layer may leave no extinction: then the path ends.
        const double inverse = density[h] > 0 ? 1 / density[h] : 0;
        state.weight = inverse * state.weight * transmittance;
        state.ratio = inverse * state.ratio * density;
    }

    // An event in the air, where the path has arrived. False where the path ends there.
    bool collide(const PathSource& source, bool counts, State& state, PathNumbers& numbers,
                 PathLight& light) const {
        const std::size_t h = state.hero;
        if (!(state.ratio[h] > 0)) return false;
        const Here here = look_around(state);
        if (counts) {
            const glm::dvec3 sun = sample_sun(source, numbers.random(0));
            const double r = air_.planet().ground_radius_km + state.altitude_km;
            const Spectrum sunlight =
                air_.sunlight(state.altitude_km, r * glm::dot(state.up, sun), state.shell);
            Spectrum& gathered = state.gathered(light);
            gathered = gathered + state.worth() * sunlight *
                                      towards(here, angle_between(sun, state.direction));
        }
        if (!(here.scattering[h] > 0)) return false;
        const ScatteringAngle angle = choose_angle(here, h, numbers);
        const Spectrum value = towards(here, angle);
        const double inverse = here.scattering[h] / value[h];
        state.weight = inverse * state.weight * value;
        state.ratio = inverse * state.ratio * share_of(value, here.scattering);
        state.direction = scatter(state.direction, angle, numbers.next());
        return true;
    }

    // Chosen with probability returned / (1 - T_end + returned).
    void arrive_on_ground(const Flight& flight, State& state) const {
        const Shell& planet = air_.planet();
        const double distance = distance_to_ground_km(planet, state.altitude_km, flight.s_km);
        state.up =
            (1 / planet.ground_radius_km) *
            ((planet.ground_radius_km + state.altitude_km) * state.up + distance * state.direction);
        state.altitude_km = 0;
        state.shell = 0;
        ++state.order;
        const Spectrum probability = share_of(flight.returned, flight.scattered + flight.returned);
        const double inverse = 1 / probability[state.hero];
        state.weight = inverse * state.weight * flight.returned;
        state.ratio = inverse * state.ratio * probability;
    }

    // An event on the ground, where the path has arrived: Lambert's law, its cosine sampled.
    void reflect(const PathSource& source, bool counts, State& state, PathNumbers& numbers,
                 PathLight& light) const {
        if (counts) {
            const double cosine = glm::dot(state.up, sample_sun(source, numbers.random(0)));
            if (cosine > 0) {
                const Spectrum sunlight =
                    air_.sunlight(0, air_.planet().ground_radius_km * cosine, 0);
                Spectrum& gathered = state.gathered(light);
                gathered = gathered + (cosine / std::numbers::pi) * state.worth() * sunlight;
            }
        }
        const ScatteringAngle angle = lambert_angle(numbers.next());
        state.direction = scatter(state.up, angle, numbers.next());
    }

    // True where Russian roulette lets a path go on, whose weight is `worth`; it carries more then.
    bool survives(const Spectrum& worth, const Spectrum& usual, State& state,
                  PathNumbers& numbers) const {
        const double survival = largest(share_of(worth, usual));
        if (survival >= 1) {
            numbers.go_on();
            return true;
        }
        if (numbers.next() >= survival) return false;
        state.weight = (1 / survival) * state.weight;
        return true;
    }

    const PathMedium& medium_;
    const AirShells& air_ = medium_.air();
    const std::size_t channels_ = static_cast<std::size_t>(medium_.sky().air.channels);
};

}  // namespace skybake::test
