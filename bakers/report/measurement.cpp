#include "bakers/report/measurement.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>

#include <algorithm>
#include <cmath>

namespace skybake {

std::array<int, 3> size_within(std::array<int, 3> size, std::int64_t most_voxels) {
    const auto count = [&] { return std::int64_t{size[0]} * size[1] * size[2]; };
    while (count() > most_voxels) {
        for (int& along_axis : size) along_axis = std::max(std::min(along_axis, 2), along_axis / 2);
    }
    return size;
}

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

}  // namespace skybake
