// The angles at which the light of many spheres is summed: few where the phase function is smooth,
// more where it is not.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include "bakers/air/particles/lorenz_mie.h"
#include "bakers/air/particles/size_distribution.h"
#include "bakers/air/particles/tabulated_phase.h"

namespace skybake {

// The sums over spheres at the nodes of both halves, as far as they were summed. The others are
// interpolated.
class AngleNodes {
  public:
    AngleNodes() : AngleNodes(kPilotNodes) {}

    int cells() const { return cells_; }
    int summed() const { return static_cast<int>(offsets_.size()); }  // pairs of angles

    // Adds the light of the spheres from number `first` on, and interpolates anew.
    void add(WeightedSpheres& spheres, std::size_t first);

    // Returns the same nodes, at which nothing was summed yet.
    AngleNodes empty() const;

    // The phase function at all nodes, at some scale.
    const PhaseHalves& phase() const { return phase_; }

    // The largest error of interpolation between nodes: by six of them it becomes 2^6 times less
    // when their distance is halved. What the nodes of a halving missed, over 16, bounds it with
    // room.
    double error() const { return std::max(left_, most_missed(0, last_cell())) / 16; }

    // Halves the cells. New nodes are summed for all spheres where those of the last halving, `reach`
    // cells away or nearer, missed by more than 16 times the accuracy at their place, which is 0 at
    // the poles and 1 at 90 degrees. Returns whether there are any.
    bool refine(WeightedSpheres& spheres, int reach,
                const std::function<double(double place)>& accuracy);

  private:
    static constexpr int kPilotNodes = 32;
    static constexpr double kUnknown = 1e9;
    // Summed at each halving: so near the pole even the last digits of interpolation would show
    // beside how little the phase function falls.
    static constexpr int kPoleCells = 2;

    explicit AngleNodes(int cells);

    void append(int node, int cells);
    PhaseHalves summed_phase() const;
    int last_cell() const { return static_cast<int>(missed_.size()) - 1; }
    // The largest that was missed in cells `from` to `to` of the last halving.
    double most_missed(int from, int to) const;
    // Returns the largest error of the last halving's nodes about a cell of the next one.
    double missed_about(int cell, int reach) const {
        return most_missed(std::max(cell / 2 - reach, 0), std::min(cell / 2 + reach, last_cell()));
    }
    void fill();

    int cells_;
    // Values at the nodes that were summed, level by level.
    std::vector<double> places_, offsets_;
    MieIntensities sums_;
    double scattering_ = 1;
    PhaseHalves phase_;
    // The error at the middle of each cell of the last halving; 0 where it was not summed.
    std::vector<double> missed_;
    double left_ = 0;  // the largest of what was missed about cells whose middle was not summed
};

}  // namespace skybake
