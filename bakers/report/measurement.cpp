#include "bakers/report/measurement.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>

#include <algorithm>
#include <cmath>

namespace skybake {

std::string size_text(std::span<const int> size) {
    return fmt::format("{}", fmt::join(size.begin(), size.end(), "x"));
}

double thread_cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
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
                        std::ranges::none_of(choices, is_better));
    }
    return front;
}

}  // namespace skybake
