// Paths of light, walked backwards from the eye: how they are weighted, and where they may begin.
//
// All channels share a path. One channel, the hero, which is chosen at random, draws distances and
// directions; the other channels' contributions are weighted by the balance heuristic over heroes
// (Wilkie et al. 2014, "Hero wavelength spectral sampling"), which stays unbiased however much the
// air of the channels differs:
//
//   estimate_c = f_c(path) / (1/n sum_k p_k(path)),
//
// where p_k is the density with which hero k walks the path.
//
// Flights never leave the air: a path follows the part 1 - e^-tau of the light that is scattered,
// or the part of e^-tau that the ground returns, and carries that part as its weight. Russian
// roulette ends paths whose weight has fallen below what second orders usually have. Each vertex
// sees the sun through an exact transmittance.
//
// A flight takes four numbers: one for roulette, which the first flight does not play, one for where
// it ends, in the air or on the ground behind it, one for what scatters there and at which angle,
// and one for the azimuth. All are inverted, so that neighbouring numbers make neighbouring paths.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/light/path_tracer/air_shells.h"
#include "bakers/light/path_tracer/path_numbers.h"
#include "bakers/light/path_tracer/phase_sampling.h"
#include "bakers/math/vectors.h"

namespace skybake {

// The stored orders: 1 to 5, and one for 6 and more.
inline constexpr std::size_t kPathOrders = 6;

// The light that a path has gathered. `direct` is light that came without any event, which only
// ambient light can.
struct PathLight {
    Spectrum direct{};
    std::int64_t flights = 0;  // straight ways of the path, each to its next event
    std::array<Spectrum, kPathOrders> orders{};
};

// The source of light: a sun of irradiance 1, or a sky of radiance 1 all around the planet.
struct PathSource {
    bool ambient = false;
    glm::dvec3 sun{};
    double sun_radius = 0;  // in radians; the disc has uniform radiance
};

struct PathStart {
    glm::dvec3 up{};
    glm::dvec3 direction{};
    double altitude_km = 0;
    double length_km = std::numeric_limits<double>::infinity();  // of the first flight, at most
};

struct PathRules {
    bool counts_first_order = true;
    bool sees_ground = true;  // if the first flight meets it
    // The weight that a path usually has when it begins its second flight, per channel, found by
    // experience: Russian roulette begins below it. 0 if it is not known.
    Spectrum usual_weight{};
};

// Returns a direction towards the sun: its disc is uniform in solid angle, 1 - cosine in [0, 1 - cos
// radius].
glm::dvec3 sample_sun(const PathSource& source, RandomStream& random);

// The air and the ground, as paths meet them.
class PathMedium {
  public:
    explicit PathMedium(SkyMedium medium);

    struct Scatterer {
        std::size_t layer;
        LayerPhase phase;
        Spectrum scattering_per_km;  // at density 1
    };

    // The line from a vertex to the ground or to the top, and what happens along it.
    struct Flight {
        double s_km = 0;  // r mu at its start
        bool falls = false;
        bool hits_ground = false;
        std::size_t lowest_shell = 0;
        Spectrum from;       // depth to the top, along the line, from |s_km|
        Spectrum lowest;     // the same from the lowest point, or from the ground
        Spectrum through;    // its transmittance
        Spectrum scattered;  // 1 - through
        Spectrum returned;   // through times what the ground reflects, if it is seen
    };
    Flight first_flight(const PathStart& start, const PathRules& rules) const;

    // Returns the depth from the flight's start to a point of its line.
    Spectrum depth_up_to(const Flight& flight, const AirShells::Point& end, bool still_falls) const;

    const SkyMedium& sky() const { return medium_; }
    const AirShells& air() const { return air_; }
    const std::vector<Scatterer>& scatterers() const { return scatterers_; }

  private:
    Flight begin_flight(const PathStart& start) const;
    void cut_flight(const PathStart& start, Flight& flight) const;

    SkyMedium medium_;
    AirShells air_;
    std::vector<Scatterer> scatterers_;
};

}  // namespace skybake
