#include "bakers/air/particles/angle_nodes.h"

namespace skybake {

AngleNodes::AngleNodes(int cells) : cells_(cells), missed_(kPilotNodes / 2, kUnknown) {
    for (int i = 0; cells > 0 && i <= cells; ++i) append(i, cells);
    sums_ = no_intensities(offsets_.size());
}

AngleNodes AngleNodes::empty() const {
    AngleNodes result = *this;
    result.sums_ = no_intensities(offsets_.size());
    return result;
}

// 1 - cos at node i of a half of tabulated_phase.h is (i / cells)^4.
void AngleNodes::append(int node, int cells) {
    const double w = static_cast<double>(node) / cells;
    places_.push_back(w);
    offsets_.push_back((w * w) * (w * w));
}

void AngleNodes::add(WeightedSpheres& spheres, std::size_t first) {
    spheres.add_intensities(first, offsets_, sums_);
    scattering_ = spheres.cross_sections().scattering;
    fill();
}

double AngleNodes::most_missed(int from, int to) const {
    return *std::max_element(missed_.begin() + from, missed_.begin() + to + 1);
}

// |S_1|^2 + |S_2|^2 per cross-section, forward and backward: in proportion to the phase function.
PhaseHalves AngleNodes::summed_phase() const {
    PhaseHalves halves;
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
        halves.forward.push_back((sums_.perpendicular[i] + sums_.parallel[i]) / scattering_);
        halves.backward.push_back((sums_.back_perpendicular[i] + sums_.back_parallel[i]) /
                                  scattering_);
    }
    return halves;
}

bool AngleNodes::refine(WeightedSpheres& spheres, int reach,
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

void AngleNodes::fill() {
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
