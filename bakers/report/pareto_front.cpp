#include "bakers/report/pareto_front.h"

#include <algorithm>
#include <cmath>

namespace skybake {

namespace {

bool beats(const CostAndError& a, const CostAndError& b) {
    return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

}  // namespace

std::vector<bool> pareto_front(const std::vector<CostAndError>& choices) {
    std::vector<bool> front;
    for (const CostAndError& choice : choices) {
        const bool finite = std::isfinite(choice.cost) && std::isfinite(choice.error);
        front.push_back(finite && std::none_of(choices.begin(), choices.end(), [&](const auto& other) {
            return beats(other, choice);
        }));
    }
    return front;
}

}  // namespace skybake
