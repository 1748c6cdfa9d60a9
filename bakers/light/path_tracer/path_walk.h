// One path of light, walked backwards from the eye.
//
// A path is shared by all channels. One of them, the hero, chosen at random, draws distances and
// directions; the others' contributions are weighed by the balance heuristic over heroes (Wilkie
// et al. 2014, "Hero wavelength spectral sampling"), which stays unbiased however far the channels'
// air differs:
//
//   estimate_c = f_c(path) / (1/n sum_k p_k(path)),   p_k the density with which hero k walks it.
//
// Flights never leave the air: the part 1 - e^-tau of the light that is scattered, or what the
// ground returns of e^-tau, is walked with its weight, and Russian roulette ends paths whose weight
// has fallen below what second orders usually have. Each vertex sees the sun through an exact
// transmittance.
#pragma once

#include <array>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/light/path_tracer/air_shells.h"
#include "bakers/light/path_tracer/phase_sampling.h"
#include "bakers/math/channels.h"
#include "bakers/math/vectors.h"

namespace skybake {

// Orders 1 to 5, and 6 and more.
inline constexpr std::size_t kPathOrders = 6;

// What a path has gathered: light of `direct` came without any event, which only ambient light can.
struct PathLight {
    Channels direct{0.0};
    std::array<Channels, kPathOrders> orders;
    PathLight() { orders.fill(Channels(0.0)); }
};

// Where light comes from: a sun of irradiance 1, or a sky of radiance 1 all around the planet.
struct PathSource {
    bool ambient = false;
    glm::dvec3 sun{};
    double sun_radius = 0;  // in radians, of a disc of even radiance
};

struct PathStart {
    glm::dvec3 up{};
    glm::dvec3 direction{};
    double altitude_km = 0;
};

struct PathRules {
    bool counts_first_order = true;
    bool sees_ground = true;  // by the first flight
    // Weight that a path has when it begins its second flight, per channel, by experience: below it
    // roulette begins. 0 where nothing is known.
    Channels usual_weight{0.0};
};

class PathWalker {
  public:
    // `medium` must outlive it.
    explicit PathWalker(const SkyMedium& medium);

    // The line from a vertex to the ground or to the top, and what happens along it.
    struct Flight {
        double s_km = 0;  // r mu at its start
        bool falls = false;
        bool hits_ground = false;
        int lowest_shell = 0;
        Channels from;       // depth upwards along the line, from where |s| is the start's
        Channels lowest;     // the same from the lowest point, or from the ground
        Channels through;    // its transmittance
        Channels scattered;  // 1 - through
        Channels returned;   // through times what the ground reflects, where it may
    };
    Flight first_flight(const PathStart& start, const PathRules& rules) const;

    // `first` is the start's first flight. Returns the weight with which the path began its second
    // one.
    Channels walk(const PathSource& source, const PathStart& start, const Flight& first,
                  const PathRules& rules, RandomStream& random, PathLight& light) const;

    const SkyMedium& medium() const { return medium_; }
    const AirShells& air() const { return air_; }

  private:
    struct State;
    struct Here;
    Flight begin_flight(const State& state) const;
    State begin(const PathStart& start) const;
    Channels move(const Flight& flight, double depth, State& state) const;
    Here look_around(const State& state) const;
    Channels towards(const Here& here, const ScatteringAngle& angle) const;
    std::size_t choose_scatterer(const Here& here, std::size_t hero, RandomStream& random) const;
    void arrive_in_air(const Flight& flight, State& state, RandomStream& random) const;
    bool collide(const Flight& flight, const PathSource& source, bool counts, State& state,
                 RandomStream& random, PathLight& light) const;
    void arrive_on_ground(const Flight& flight, State& state) const;
    void reflect(const Flight& flight, const PathSource& source, bool counts, State& state,
                 RandomStream& random, PathLight& light) const;

    struct Scatterer {
        int layer;
        LayerPhase phase;
        Channels scattering_per_km;  // at density 1
    };

    const SkyMedium& medium_;
    AirShells air_;
    Channels ground_albedo_;
    std::size_t channels_;
    std::vector<Scatterer> scatterers_;
};

}  // namespace skybake
