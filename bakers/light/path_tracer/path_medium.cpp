#include "bakers/light/path_tracer/path_medium.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

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

}  // namespace

glm::dvec3 sample_sun(const PathSource& source, RandomStream& random) {
    if (!(source.sun_radius > 0)) return source.sun;
    const double half_sine = cosine_of_pi(0.5 - 0.5 * source.sun_radius / std::numbers::pi);
    const double one_minus = 2 * half_sine * half_sine * random.next();
    return scatter(source.sun, {one_minus, 2 - one_minus}, random.next());
}

PathMedium::PathMedium(SkyMedium medium) : medium_(std::move(medium)), air_(medium_) {
    for (std::size_t k = 0; k < medium_.layers.size(); ++k) {
        const SkyLayer& layer = medium_.layers[k];
        if (!layer.scatters) continue;
        scatterers_.push_back({k, layer.phase, full_coefficients(layer).scattering_per_km});
    }
}

PathMedium::Flight PathMedium::begin_flight(const PathStart& start) const {
    const auto line = kernel::flight_line<double>(
        air_.planet(), start.altitude_km, {start.up.x, start.up.y, start.up.z},
        {start.direction.x, start.direction.y, start.direction.z});
    Flight flight;
    flight.s_km = line.s_km;
    flight.falls = line.falls;
    flight.hits_ground = line.hits_ground;
    flight.from = air_.depth_to_top(
        {start.altitude_km, std::fabs(flight.s_km), air_.shell_at(start.altitude_km)});
    flight.lowest = flight.from;
    Spectrum depth = flight.from;
    if (flight.falls) {
        flight.lowest_shell = air_.shell_at(line.lowest_altitude_km);
        flight.lowest =
            air_.depth_to_top({line.lowest_altitude_km, line.lowest_s_km, flight.lowest_shell});
        depth = flight.lowest - flight.from;
        if (!flight.hits_ground) depth = depth + flight.lowest;
        depth = maximum(depth, Spectrum(0.0));  // rounding
    }
    flight.through = exponential(-depth);
    flight.scattered = scattered_share(depth, flight.through);
    flight.returned =
        flight.hits_ground ? flight.through * Spectrum(medium_.air.ground_albedo) : Spectrum(0.0);
    return flight;
}

Spectrum PathMedium::depth_up_to(const Flight& flight, const AirShells::Point& end,
                                 bool still_falls) const {
    const Spectrum above = air_.depth_to_top(end);
    Spectrum way = still_falls ? above - flight.from : flight.from - above;
    if (flight.falls && !still_falls) way = way + 2.0 * (flight.lowest - flight.from);
    return maximum(way, Spectrum(0.0));  // rounding
}

// Ends a flight after the length of its start, if it does not end before. Then it sees no ground.
void PathMedium::cut_flight(const PathStart& start, Flight& flight) const {
    const Shell& planet = air_.planet();
    const double whole_km = flight.hits_ground
                                ? distance_to_ground_km(planet, start.altitude_km, flight.s_km)
                                : distance_to_top_km(planet, start.altitude_km, flight.s_km);
    if (start.length_km >= whole_km) return;
    AirShells::Point end;
    end.altitude_km = altitude_along_km(planet, start.altitude_km, flight.s_km, start.length_km);
    end.s_km = std::fabs(flight.s_km + start.length_km);
    end.shell = air_.shell_at(end.altitude_km);
    const Spectrum depth = depth_up_to(flight, end, flight.s_km + start.length_km < 0);
    flight.through = exponential(-depth);
    flight.scattered = scattered_share(depth, flight.through);
    flight.returned = Spectrum(0.0);
}

PathMedium::Flight PathMedium::first_flight(const PathStart& start, const PathRules& rules) const {
    Flight flight = begin_flight(start);
    cut_flight(start, flight);
    if (!rules.sees_ground) flight.returned = Spectrum(0.0);
    return flight;
}

}  // namespace skybake
