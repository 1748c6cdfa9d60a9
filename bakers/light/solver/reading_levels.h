// The altitudes at which transport reads the light that it scatters again.
//
// Mostly they are those of the solution. Within thick layers that begin abruptly the light of a low
// sun fades between two levels by half. There transport reads it at further altitudes, by cubics
// through the levels: the light itself is computed at the levels alone, so that this costs points of
// rays and no more rays.
#pragma once

#include <array>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/light/solver/order_blocks.h"
#include "bakers/light/solver/solved_light.h"

namespace skybake {

class ReadingLevels {
  public:
    // `levels_km` are those of solution_levels_km.
    ReadingLevels(const Medium& medium, const std::vector<double>& levels_km);

    // Returns the altitudes, ascending, every level among them.
    const std::vector<double>& altitudes_km() const { return altitudes_km_; }
    // Returns the index of a level among them.
    int index_of(int level) const { return index_of_level_[static_cast<std::size_t>(level)]; }
    // Returns a field at these altitudes, from that at the levels. It is linear in the field.
    LightField read(const LightField& field) const;
    // Returns the same for light, which is never less than nothing: where a cubic is, between levels
    // of which one is far brighter, light is taken as linear between the two next to the altitude.
    LightField read_light(const LightField& light) const;
    // Returns the same in blocks.
    template <class Number>
    BlockedLight<Number> blocks_of(const LightField& light, int threads) const {
        if (altitudes_km_.size() == index_of_level_.size()) return {light, threads};
        return {read(light), threads};
    }

  private:
    // The weights of the levels from `first` on, and how far an altitude is from level `below` to the
    // next.
    struct Stencil {
        int first = 0;
        std::array<double, 4> weights{};
        int below = 0;
        double share = 0;
    };

    std::vector<double> altitudes_km_;
    std::vector<int> index_of_level_;
    std::vector<Stencil> stencils_;
};

}  // namespace skybake
