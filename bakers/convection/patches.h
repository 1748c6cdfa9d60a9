// Warm patches of ground, above which air rises.
#pragma once

#include <vector>

#include "bakers/convection/grid.h"
#include "bakers/convection/sounding.h"

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

}  // namespace skybake::convection
