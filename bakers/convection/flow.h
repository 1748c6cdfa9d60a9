// Moist convection: the flow in which a cloud grows.
//
//   du/dt = -grad p + b e_z,   div u = 0,   dh/dt = 0,   dq/dt = 0
//
// for incompressible air (Boussinesq) with the liquid-water potential temperature h and the total water q,
// which condensation leaves as they are (Betts 1973, "Non-precipitating cumulus convection and its
// parameterization"). Nothing rains, and nothing freezes. Steps are Runge and Kutta's of third order after
// Wicker and Skamarock, each stage without divergence. A sponge below the lid calms what arrives there.
//
// Warm patches of ground, above which air rises. Once the cloud has grown for its time they come again.
#pragma once

#include <vector>

#include "bakers/convection/grid.h"
#include "bakers/convection/projection.h"
#include "bakers/convection/sounding.h"
#include "bakers/math/bake_options.h"

namespace skybake::convection {

struct Patch {
    std::array<double, 2> centre_m{};
    double radius_m = 0;  // where the warmth has fallen to 1/e
    double strength = 1;
    double begin_s = 0;
    double end_s = 0;
};

std::vector<Patch> make_patches(const Specification& wanted);

// A number in [-1, 1) for a cell and a moment.
float noise_at(std::uint64_t seed, const std::array<int, 3>& cell, int moment);

// Draws the air above patches towards theirs, for a step that begins at a time.
class PatchSource {
  public:
    PatchSource(const Specification& wanted, const Sounding& sounding);
    // Levels that it reaches, from the lowest one on.
    int levels() const { return levels_; }
    void warm(double time_s, double step_s, int z, State& state) const;

  private:
    float share_at(const std::vector<Patch>& patches, int x, int y) const;

    Specification wanted_;
    std::vector<Patch> patches_;
    float heat_ = 0;
    float water_ = 0;
    int levels_ = 0;
};

class Flow {
  public:
    Flow(const Specification& wanted, int threads);

    // One step, of the longest time that the winds allow, but not beyond `end_s`.
    void step(double end_s);
    double time_s() const { return time_s_; }
    State& state() { return now_; }
    // The condensed water of a row in g/kg; below 0 it is what is lacking.
    void condensed_row(int y, int z, float* out) const;
    // The velocity of a row along an axis in m/s, at the centres of cells.
    void velocity_row(std::size_t axis, int y, int z, float* out) const;

  private:
    double longest_step() const;
    void push(float step_s);
    void lift_level(int z, float step_s);

    Specification wanted_;
    int threads_;
    Sounding sounding_;
    PatchSource source_;
    Projection projection_;
    std::vector<float> own_heat_;  // virtual, of the levels
    State before_, now_, next_;
    Field buoyancy_;
    double time_s_ = 0;
};

}  // namespace skybake::convection
