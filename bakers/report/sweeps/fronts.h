// Which of several choices are worth their price, and which rows of a report.
#pragma once

#include <functional>
#include <vector>

#include "bakers/report/report.h"

namespace skybake {

struct CostAndError {
    double cost = 0;
    double error = 0;
};

// True for each choice that no other beats: by a smaller error at no greater cost, or by a smaller
// cost at the same error. Costs that are apart by no more than the share `noise` count as the same
// where errors differ. A choice that is not finite is never on the front.
std::vector<bool> pareto_front(const std::vector<CostAndError>& choices, double noise = 0);

// Medians of equal work have been seen to differ by so much.
inline constexpr double kTimingNoise = 0.05;

// Calls mark(row) for each row that takes part and that no other of them beats by `choice`. Costs
// that are apart by no more than the share `noise` count as the same, as in pareto_front.
void mark_front(std::vector<ReportRow>& rows,
                const std::function<bool(const ReportRow&)>& takes_part,
                const std::function<CostAndError(const ReportRow&)>& choice, double noise,
                const std::function<void(ReportRow&)>& mark);

// The fronts of time that every asset has: ReportRow::on_lookup_front and on_texel_front.
// `compared` is what an RMS error counts as.
void mark_time_fronts(std::vector<ReportRow>& rows, double (*compared)(double rms));

}  // namespace skybake
