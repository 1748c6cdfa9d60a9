// Processor time of the calling thread: what work costs, whatever else the machine does meanwhile.
#pragma once

#include <functional>
#include <vector>

namespace skybake {

double thread_cpu_seconds();

// The median time of each job in seconds. The jobs are run in turn, `repetitions` times round, so
// that a machine that slows down slows them all; `before_each(round, job)` returns false to stop,
// and then the result is empty. repetitions >= 1.
std::vector<double> interleaved_medians(
    const std::vector<std::function<void()>>& jobs, int repetitions,
    const std::function<bool(int round, std::size_t job)>& before_each);

}  // namespace skybake
