#include "bakers/report/sweeps/sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>

#include <algorithm>
#include <cmath>

namespace skybake {

namespace {

template <std::size_t Axes>
std::int64_t texel_count(const std::array<int, Axes>& size) {
    std::int64_t count = 1;
    for (const int along_axis : size) count *= along_axis;
    return count;
}

}  // namespace

template <std::size_t Axes>
std::vector<std::array<int, Axes>> sizes_around(
    std::array<int, Axes> size, const std::vector<std::array<double, Axes>>& factors,
    std::int64_t max_texels) {
    std::vector<std::array<int, Axes>> sizes;
    for (const std::array<double, Axes>& factor : factors) {
        std::array<int, Axes> candidate;
        for (std::size_t axis = 0; axis < Axes; ++axis) {
            candidate[axis] = std::max(std::min(size[axis], 2),
                                       static_cast<int>(std::lround(size[axis] * factor[axis])));
        }
        if (texel_count(candidate) > max_texels) continue;
        if (std::find(sizes.begin(), sizes.end(), candidate) == sizes.end()) {
            sizes.push_back(candidate);
        }
    }
    return sizes;
}

template <std::size_t Axes>
std::array<int, Axes> size_within(std::array<int, Axes> size, std::int64_t max_texels) {
    while (texel_count(size) > max_texels) {
        for (int& count : size) count = std::max(std::min(count, 2), count / 2);
    }
    return size;
}

template std::vector<std::array<int, 2>> sizes_around(std::array<int, 2>,
                                                      const std::vector<std::array<double, 2>>&,
                                                      std::int64_t);
template std::vector<std::array<int, 3>> sizes_around(std::array<int, 3>,
                                                      const std::vector<std::array<double, 3>>&,
                                                      std::int64_t);
template std::array<int, 2> size_within(std::array<int, 2>, std::int64_t);
template std::array<int, 3> size_within(std::array<int, 3>, std::int64_t);

std::string size_text(std::span<const int> size) {
    return fmt::format("{}", fmt::join(size.begin(), size.end(), "x"));
}

namespace {

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

}  // namespace

double thread_cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<double> interleaved_medians(
    const std::vector<std::function<void()>>& jobs, int repetitions,
    const std::function<bool(int round, std::size_t job)>& before_each) {
    std::vector<std::vector<double>> seconds(jobs.size());
    for (int round = 0; round < repetitions; ++round) {
        for (std::size_t job = 0; job < jobs.size(); ++job) {
            if (!before_each(round, job)) return {};
            const double start = thread_cpu_seconds();
            jobs[job]();
            seconds[job].push_back(thread_cpu_seconds() - start);
        }
    }
    std::vector<double> medians;
    for (std::vector<double>& times : seconds) medians.push_back(median(std::move(times)));
    return medians;
}

MemoryFile::MemoryFile() : file_(::memfd_create("skybake-report", MFD_CLOEXEC)) {}

std::filesystem::path MemoryFile::path() const {
    return fmt::format("/proc/self/fd/{}", file_.get());
}

std::uint64_t MemoryFile::bytes() const {
    struct stat status {};
    if (!file_.valid() || ::fstat(file_.get(), &status) != 0) return 0;
    return static_cast<std::uint64_t>(status.st_size);
}

namespace {

// Whether choice a beats choice b. A choice always has a smaller error than the one that it beats,
// or a smaller cost at the same error, so the choice of the least error is always on the front.
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
