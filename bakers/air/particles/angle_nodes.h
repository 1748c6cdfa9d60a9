// The angles at which the light of many spheres is summed: few where the phase function is smooth,
// more where it is not.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "bakers/air/particles/lorenz_mie.h"
#include "bakers/air/particles/size_distribution.h"
#include "bakers/air/particles/tabulated_phase.h"

namespace skybake {

inline double relative_change(double before, double after) {
    return std::fabs(after - before) / after;
}

// The sums over spheres at the nodes of both halves, as far as they were summed. The others are
// interpolated.
class AngleNodes {
  public:
    AngleNodes() : AngleNodes(kPilotNodes) {}

    int cells() const { return cells_; }
    int summed() const { return static_cast<int>(offsets_.size()); }  // pairs of angles

    // Adds the light of the spheres from number `first` on, and interpolates anew.
    void add(WeightedSpheres& spheres, std::size_t first) {
        spheres.add_intensities(first, offsets_, sums_);
        scattering_ = spheres.cross_sections().scattering;
        fill();
    }

    // Returns the same nodes, at which nothing was summed yet.
    AngleNodes empty() const {
        AngleNodes result = *this;
        result.sums_ = no_intensities(offsets_.size());
        return result;
    }

    // The phase function at all nodes, at some scale.
    const PhaseHalves& phase() const { return phase_; }

    // The largest error of interpolation between nodes: by six of them it becomes 2^6 times less
    // when their distance is halved. What the nodes of a halving missed, over 16, bounds it with
    // room.
    double error() const { return std::max(left_, largest(missed_, 0, last_cell())) / 16; }

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

    explicit AngleNodes(int cells) : cells_(cells), missed_(kPilotNodes / 2, kUnknown) {
        for (int i = 0; cells > 0 && i <= cells; ++i) append(i, cells);
        sums_ = no_intensities(offsets_.size());
    }

    // 1 - cos at node i of a half of tabulated_phase.h is (i / cells)^4.
    void append(int node, int cells) {
        const double w = static_cast<double>(node) / cells;
        places_.push_back(w);
        offsets_.push_back((w * w) * (w * w));
    }
    // |S_1|^2 + |S_2|^2 per cross-section, forward and backward: in proportion to the phase
    // function.
    PhaseHalves summed_phase() const {
        PhaseHalves halves;
        for (std::size_t i = 0; i < offsets_.size(); ++i) {
            halves.forward.push_back((sums_.perpendicular[i] + sums_.parallel[i]) / scattering_);
            halves.backward.push_back((sums_.back_perpendicular[i] + sums_.back_parallel[i]) /
                                      scattering_);
        }
        return halves;
    }
    int last_cell() const { return static_cast<int>(missed_.size()) - 1; }
    static double largest(const std::vector<double>& of, int from, int to) {
        return *std::max_element(of.begin() + from, of.begin() + to + 1);
    }
    // What the nodes of the last halving missed about a cell of the next one.
    double missed_about(int cell, int reach) const {
        return largest(missed_, std::max(cell / 2 - reach, 0),
                       std::min(cell / 2 + reach, last_cell()));
    }
    void fill();

    int cells_;
    // Of the nodes that were summed, level by level.
    std::vector<double> places_, offsets_;
    MieIntensities sums_;
    double scattering_ = 1;
    PhaseHalves phase_;
    // By the middle of each cell of the last halving; 0 where it was not summed.
    std::vector<double> missed_;
    double left_ = 0;  // the largest of what was missed about cells whose middle was not summed
};

inline bool AngleNodes::refine(WeightedSpheres& spheres, int reach,
                               const std::function<double(double place)>& accuracy) {
    AngleNodes added(0);
    bool any = false;
    for (int cell = 0; cell < cells_; ++cell) {
        const bool wanted = missed_about(cell, reach) > 16 * accuracy((cell + 0.5) / cells_);
        any = any || wanted;
        if (wanted || cell < kPoleCells) added.append(2 * cell + 1, 2 * cells_);
    }
    if (!any) return false;
    added.sums_ = no_intensities(added.offsets_.size());
    spheres.add_intensities(0, added.offsets_, added.sums_);
    const auto join = [](std::vector<double>& to, const std::vector<double>& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    join(places_, added.places_);
    join(offsets_, added.offsets_);
    join(sums_.perpendicular, added.sums_.perpendicular);
    join(sums_.parallel, added.sums_.parallel);
    join(sums_.back_perpendicular, added.sums_.back_perpendicular);
    join(sums_.back_parallel, added.sums_.back_parallel);
    cells_ *= 2;
    fill();
    return true;
}

inline void AngleNodes::fill() {
    const PhaseHalves summed = summed_phase();
    // The pilots come first.
    constexpr std::size_t kPilots = kPilotNodes + 1;
    phase_ = {{summed.forward.begin(), summed.forward.begin() + kPilots},
              {summed.backward.begin(), summed.backward.begin() + kPilots}};
    std::size_t next = kPilots;
    missed_.assign(kPilotNodes / 2, kUnknown);
    left_ = 0;
    for (int cells = kPilotNodes; cells < cells_; cells *= 2) {
        PhaseHalves middles = interpolated_middles(phase_);
        std::vector<double> missed(static_cast<std::size_t>(cells), 0.0);
        for (int cell = 0; cell < cells; ++cell) {
            const auto i = static_cast<std::size_t>(cell);
            if (next == places_.size() || places_[next] != (cell + 0.5) / cells) {
                left_ = std::max(left_, missed_about(cell, 1));
                continue;
            }
            missed[i] = std::max(relative_change(middles.forward[i], summed.forward[next]),
                                 relative_change(middles.backward[i], summed.backward[next]));
            middles.forward[i] = summed.forward[next];
            middles.backward[i] = summed.backward[next++];
        }
        phase_ = interleaved(phase_, middles);
        missed_ = std::move(missed);
    }
}

}  // namespace skybake
