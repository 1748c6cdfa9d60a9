#include "bakers/light/path_tracer/path_walk.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "bakers/light/path_tracer/path_steps-inl.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace kernel = HWY_NAMESPACE;

namespace {

// 1 - e^-depth, to all its digits.
Spectrum scattered_share(const Spectrum& depth, const Spectrum& transmittance) {
    return kernel::scattered_share(kernel::Channels(depth), kernel::Channels(transmittance))
        .spectrum();
}

// The angle between two unit vectors.
ScatteringAngle angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 apart = a - b;
    const glm::dvec3 together = a + b;
    return {0.5 * glm::dot(apart, apart), 0.5 * glm::dot(together, together)};
}

}  // namespace

glm::dvec3 sample_sun(const PathSource& source, RandomStream& random) {
    if (!(source.sun_radius > 0)) return source.sun;
    const double half_sine = cosine_of_pi(0.5 - 0.5 * source.sun_radius / std::numbers::pi);
    const double one_minus = 2 * half_sine * half_sine * random.next();
    return scatter(source.sun, {one_minus, 2 - one_minus}, random.next());
}

// Where a path is, and what it carries. For channel c of a path that hero h walks, the light that
// comes along is worth weight[c] / mean(ratio): weight is f_c / p_h, ratio p_c / p_h.
struct PathWalker::State {
    glm::dvec3 up{};
    glm::dvec3 direction{};
    double altitude_km = 0;
    int shell = 0;
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
struct PathWalker::Here {
    std::vector<double> densities;  // of scatterers
    Spectrum scattering{};
};

PathWalker::PathWalker(const SkyMedium& medium)
    : medium_(medium),
      air_(medium),
      ground_albedo_(medium.air.ground_albedo),
      channels_(static_cast<std::size_t>(medium.air.channels)) {
    for (std::size_t k = 0; k < medium.layers.size(); ++k) {
        const SkyLayer& layer = medium.layers[k];
        if (!layer.scatters) continue;
        const Spectrum& scattering = layer.alone.exponential_layers.empty()
                                         ? layer.alone.piecewise_layers[0].scattering_per_km
                                         : layer.alone.exponential_layers[0].scattering_per_km;
        scatterers_.push_back({static_cast<int>(k), layer.phase, scattering});
    }
}

PathWalker::Flight PathWalker::begin_flight(const State& state) const {
    const Shell& planet = air_.planet();
    Flight flight;
    flight.s_km =
        (planet.ground_radius_km + state.altitude_km) * glm::dot(state.up, state.direction);
    flight.falls = flight.s_km < 0;
    flight.from = air_.depth_to_top({state.altitude_km, std::fabs(flight.s_km), state.shell});
    flight.lowest = flight.from;
    Spectrum depth = flight.from;
    if (flight.falls) {
        const double horizon = horizon_distance_km(planet, state.altitude_km);
        flight.hits_ground = flight.s_km < -horizon;
        AirShells::Point lowest;
        if (flight.hits_ground) {
            lowest.s_km = std::sqrt((-flight.s_km - horizon) * (horizon - flight.s_km));
        } else {
            const double drop = drop_to_nearest_km(planet, state.altitude_km, flight.s_km);
            lowest.altitude_km = std::max(state.altitude_km - drop, 0.0);  // rounding
        }
        lowest.shell = air_.shell_at(lowest.altitude_km);
        flight.lowest_shell = lowest.shell;
        flight.lowest = air_.depth_to_top(lowest);
        depth = flight.lowest - flight.from;
        if (!flight.hits_ground) depth = depth + flight.lowest;
        depth = maximum(depth, Spectrum(0.0));  // rounding
    }
    flight.through = exponential(-depth);
    flight.scattered = scattered_share(depth, flight.through);
    flight.returned = flight.hits_ground ? flight.through * ground_albedo_ : Spectrum(0.0);
    return flight;
}

// The depth from the flight's start to a point of its line.
Spectrum PathWalker::depth_up_to(const Flight& flight, const AirShells::Point& end,
                                 bool still_falls) const {
    const Spectrum above = air_.depth_to_top(end);
    Spectrum way = still_falls ? above - flight.from : flight.from - above;
    if (flight.falls && !still_falls) way = way + 2.0 * (flight.lowest - flight.from);
    return maximum(way, Spectrum(0.0));  // rounding
}

// Ends a flight after `length_km`, if it does not end before. Then it sees no ground.
void PathWalker::cut_flight(const State& start, double length_km, Flight& flight) const {
    const Shell& planet = air_.planet();
    const double whole_km = flight.hits_ground
                                ? distance_to_ground_km(planet, start.altitude_km, flight.s_km)
                                : distance_to_top_km(planet, start.altitude_km, flight.s_km);
    if (length_km >= whole_km) return;
    AirShells::Point end;
    end.altitude_km = altitude_along_km(planet, start.altitude_km, flight.s_km, length_km);
    end.s_km = std::fabs(flight.s_km + length_km);
    end.shell = air_.shell_at(end.altitude_km);
    const Spectrum depth = depth_up_to(flight, end, flight.s_km + length_km < 0);
    flight.through = exponential(-depth);
    flight.scattered = scattered_share(depth, flight.through);
    flight.returned = Spectrum(0.0);
}

// Goes to where the hero's depth from the start is `depth`; returns each channel's.
Spectrum PathWalker::move(const Flight& flight, double depth, State& state) const {
    const std::size_t h = state.hero;
    const AirShells::Point start = {state.altitude_km, std::fabs(flight.s_km), state.shell};
    const double before_lowest = flight.lowest[h] - flight.from[h];
    const bool still_falls = flight.falls && (flight.hits_ground || depth < before_lowest);
    AirShells::Point end;
    if (still_falls) {
        end =
            air_.point_at_depth(start, h, flight.from[h] + depth, flight.lowest_shell, state.shell);
    } else {
        const double upwards = flight.falls ? flight.lowest[h] + before_lowest : flight.from[h];
        end =
            air_.point_at_depth(start, h, std::max(upwards - depth, 0.0),
                                flight.falls ? flight.lowest_shell : state.shell, air_.count() - 1);
    }
    const Spectrum way = depth_up_to(flight, end, still_falls);
    const double radius = air_.planet().ground_radius_km;
    const double distance = (still_falls ? -end.s_km : end.s_km) - flight.s_km;
    state.up = (1 / (radius + end.altitude_km)) *
               ((radius + state.altitude_km) * state.up + distance * state.direction);
    state.altitude_km = end.altitude_km;
    state.shell = end.shell;
    return way;
}

// Finds the layers' densities and scattering where the path is.
PathWalker::Here PathWalker::look_around(const State& state) const {
    Here here;
    for (const Scatterer& scatterer : scatterers_) {
        const double density = air_.density(state.shell, scatterer.layer, state.altitude_km);
        here.densities.push_back(std::max(density, 0.0));  // rounding
        here.scattering = here.scattering + here.densities.back() * scatterer.scattering_per_km;
    }
    return here;
}

// Sum of sigma_s p over layers.
Spectrum PathWalker::towards(const Here& here, const ScatteringAngle& angle) const {
    Spectrum sum(0.0);
    for (std::size_t k = 0; k < scatterers_.size(); ++k) {
        const LayerPhase& phase = scatterers_[k].phase;
        const double density = here.densities[k];
        if (phase.is_alike()) {
            const double value =
                density * phase_value(phase.functions.front(), angle.one_minus, angle.one_plus);
            sum = sum + value * scatterers_[k].scattering_per_km;
        } else {
            const Spectrum values(phase_values(phase, angle.one_minus, angle.one_plus));
            sum = sum + density * values * scatterers_[k].scattering_per_km;
        }
    }
    return sum;
}

// Chooses what scatters by the first part of a number and the angle by what is left of it.
ScatteringAngle PathWalker::choose_angle(const Here& here, std::size_t hero,
                                         PathNumbers& numbers) const {
    double left = numbers.next() * here.scattering[hero];
    std::size_t chosen = 0;
    double part = 0;
    for (;; ++chosen) {
        part = here.densities[chosen] * scatterers_[chosen].scattering_per_km[hero];
        if (left < part || chosen + 1 == scatterers_.size()) break;
        left -= part;
    }
    // Rounding may reach the end of a part, or its last one where that scatters nothing.
    constexpr double kLast = 1 - 0x1p-53;
    const double share = part > 0 ? std::min(left / part, kLast) : kLast;
    return sample_phase(scatterers_[chosen].phase.of(hero), share, numbers.random());
}

// Distance by the hero's density sigma_t T / (1 - T_end + returned).
void PathWalker::arrive_in_air(const Flight& flight, double scattered_share, State& state) const {
    const std::size_t h = state.hero;
    const Spectrum passed = move(flight, kernel::depth_of_share(scattered_share), state);
    ++state.order;
    const Spectrum transmittance = exponential(-passed);
    const Spectrum extinction = air_.extinction(state.shell, state.altitude_km);
    const Spectrum density =
        share_of(extinction * transmittance, flight.scattered + flight.returned);
    // Rounding at the edge of a layer may leave no extinction: then the path ends.
    const double inverse = density[h] > 0 ? 1 / density[h] : 0;
    state.weight = inverse * state.weight * transmittance;
    state.ratio = inverse * state.ratio * density;
}

// An event in the air, where the path has arrived. False where the path ends there.
bool PathWalker::collide(const PathSource& source, bool counts, State& state, PathNumbers& numbers,
                         PathLight& light) const {
    const std::size_t h = state.hero;
    if (!(state.ratio[h] > 0)) return false;
    const Here here = look_around(state);
    if (counts) {
        const glm::dvec3 sun = sample_sun(source, numbers.random());
        const double r = air_.planet().ground_radius_km + state.altitude_km;
        const Spectrum sunlight =
            air_.sunlight(state.altitude_km, r * glm::dot(state.up, sun), state.shell);
        Spectrum& gathered = state.gathered(light);
        gathered = gathered +
                   state.worth() * sunlight * towards(here, angle_between(sun, state.direction));
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
void PathWalker::arrive_on_ground(const Flight& flight, State& state) const {
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
void PathWalker::reflect(const PathSource& source, bool counts, State& state, PathNumbers& numbers,
                         PathLight& light) const {
    if (counts) {
        const double cosine = glm::dot(state.up, sample_sun(source, numbers.random()));
        if (cosine > 0) {
            const Spectrum sunlight = air_.sunlight(0, air_.planet().ground_radius_km * cosine, 0);
            Spectrum& gathered = state.gathered(light);
            gathered = gathered + (cosine / std::numbers::pi) * state.worth() * sunlight;
        }
    }
    const ScatteringAngle angle = lambert_angle(numbers.next());
    state.direction = scatter(state.up, angle, numbers.next());
}

PathWalker::State PathWalker::begin(const PathStart& start) const {
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

PathWalker::Flight PathWalker::first_flight(const PathStart& start, const PathRules& rules) const {
    const State state = begin(start);
    Flight flight = begin_flight(state);
    cut_flight(state, start.length_km, flight);
    if (!rules.sees_ground) flight.returned = Spectrum(0.0);
    return flight;
}

// True where Russian roulette lets a path go on, whose weight is `worth`; it carries more then.
bool PathWalker::survives(const Spectrum& worth, const Spectrum& usual, State& state,
                          PathNumbers& numbers) const {
    const double survival = largest(share_of(worth, usual));
    if (survival >= 1) {
        numbers.skip();
        return true;
    }
    if (numbers.next() >= survival) return false;
    state.weight = (1 / survival) * state.weight;
    return true;
}

Spectrum PathWalker::walk(const PathSource& source, const PathStart& start, const Flight& first,
                          const PathRules& rules, std::size_t hero, PathNumbers& numbers,
                          PathLight& light) const {
    State state = begin(start);
    state.hero = hero;
    Spectrum second_flight(0.0);
    Spectrum usual = rules.usual_weight;
    Flight flight = first;
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
        flight = begin_flight(state);
    }
}

}  // namespace skybake
