#include "bakers/report/sweeps/fronts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

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

void mark_front(std::vector<ReportRow>& rows,
                const std::function<bool(const ReportRow&)>& takes_part,
                const std::function<CostAndError(const ReportRow&)>& choice, double noise,
                const std::function<void(ReportRow&)>& mark) {
    std::vector<CostAndError> choices;
    std::vector<ReportRow*> taking_part;
    for (ReportRow& row : rows) {
        if (!takes_part(row)) continue;
        choices.push_back(choice(row));
        taking_part.push_back(&row);
    }
    const std::vector<bool> front = pareto_front(choices, noise);
    for (std::size_t i = 0; i < front.size(); ++i) {
        if (front[i]) mark(*taking_part[i]);
    }
}

void mark_time_fronts(std::vector<ReportRow>& rows, double (*compared)(double rms)) {
    mark_front(
        rows, [](const ReportRow&) { return true; },
        [compared](const ReportRow& row) {
            return CostAndError{row.time_ms, compared(row.lookup.rms)};
        },
        kTimingNoise, [](ReportRow& row) { row.on_lookup_front = true; });
    mark_front(
        rows, [](const ReportRow& row) { return row.in_quadrature_sweep; },
        [compared](const ReportRow& row) {
            return CostAndError{row.time_ms, compared(row.texel.rms)};
        },
        kTimingNoise, [](ReportRow& row) { row.on_texel_front = true; });
}

}  // namespace skybake
