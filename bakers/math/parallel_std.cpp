// The same loops on std::thread, for ThreadSanitizer: Debian's TBB is not instrumented.
#include <algorithm>
#include <atomic>
#include <cassert>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "bakers/math/parallel.h"
#include "bakers/math/startable_threads.h"

namespace skybake {
namespace {

// Runs `work` on this thread and on `helpers` others.
void run_on_threads(int helpers, const std::function<void()>& work) {
    std::vector<std::thread> others;
    try {
        for (int i = 0; i < helpers; ++i) others.emplace_back(work);
    } catch (const std::system_error&) {  // the system grants no more
    }
    work();
    for (std::thread& other : others) other.join();
}

}  // namespace

void count_threads_again() {}

int thread_count(int threads) {
    if (threads > 0) return threads;
    return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

void parallel_for(int count, int threads, const std::function<void(int)>& tile) {
    std::atomic<int> next = 0;
    const auto work = [&] {
        for (int i = next++; i < count; i = next++) tile(i);
    };
    run_on_threads(std::min(thread_count(threads), count) - 1, work);
}

void ordered_pipeline(int count, int threads, int slots,
                      const std::function<void(int index, int slot)>& produce,
                      const std::function<bool(int index, int slot)>& consume) {
    assert(slots >= 1);
    std::mutex mutex;
    std::condition_variable changed;
    int next = 0;
    int consumed = 0;
    bool stopped = false;
    // There are at most `slots` threads, each with one item until that is consumed.
    const auto work = [&] {
        std::unique_lock lock(mutex);
        while (next < count && !stopped) {
            const int index = next++;
            lock.unlock();
            produce(index, index % slots);
            lock.lock();
            changed.wait(lock, [&] { return stopped || consumed == index; });
            if (stopped) return;
            lock.unlock();
            const bool go_on = consume(index, index % slots);
            lock.lock();
            ++consumed;
            stopped = !go_on;
            changed.notify_all();
        }
    };
    run_on_threads(std::min({thread_count(threads), count, slots}) - 1, work);
}

}  // namespace skybake
