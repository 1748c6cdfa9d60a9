#include "bakers/report/sweeps/pareto_front.h"

#include <algorithm>
#include <cmath>

namespace skybake {

namespace {

// Errors fall along any chain of beats, so the choice of the least error is on the front, if no
// other.
bool beats(const CostAndError& a, const CostAndError& b, double noise) {
    if (a.error == b.error) return a.cost < b.cost;
    return a.error < b.error && a.cost <= b.cost * (1 + noise);
}

}  // namespace

std::vector<bool> pareto_front(const std::vector<CostAndError>& choices, double noise) {
    std::vector<bool> front;
    for (const CostAndError& choice : choices) {
        const auto is_better = [&](const CostAndError& other) {
            return beats(other, choice, noise);
        };
        front.push_back(std::isfinite(choice.cost) && std::isfinite(choice.error) &&
                        std::none_of(choices.begin(), choices.end(), is_better));
    }
    return front;
}

}  // namespace skybake
