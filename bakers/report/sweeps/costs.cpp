#include "bakers/report/sweeps/costs.h"

#include <fmt/format.h>

#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <algorithm>
#include <cstddef>

namespace skybake {
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

}  // namespace skybake
