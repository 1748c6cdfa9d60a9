// The same loop on std::thread, for ThreadSanitizer: Debian's TBB is not instrumented.
#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "bakers/core/parallel.h"

namespace skybake {

int thread_count(int threads) {
    if (threads > 0) return threads;
    return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

void parallel_for(int count, int threads, const std::function<void(int)>& tile) {
    std::atomic<int> next = 0;
    const auto work = [&] {
        for (int i = next++; i < count; i = next++) tile(i);
    };
    std::vector<std::thread> others;
    const int helpers = std::min(thread_count(threads), count) - 1;
    for (int i = 0; i < helpers; ++i) others.emplace_back(work);
    work();
    for (std::thread& other : others) other.join();
}

}  // namespace skybake
