#include "bakers/report/sweeps/row_fronts.h"

#include <cstddef>

namespace skybake {

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
