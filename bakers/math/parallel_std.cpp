// The same loops on std::thread, for ThreadSanitizer: Debian's TBB is not instrumented.
#include <algorithm>
#include <atomic>
#include <cassert>
#include <condition_variable>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>
#include <vector>

#include "bakers/math/parallel.h"
#include "bakers/math/startable_threads.h"

namespace skybake {
namespace {

// Hands out the indices of a pipeline in order and lets the thread that completes the oldest one
// consume it, and those behind it that are ready.
class Pipeline {
  public:
    Pipeline(int count, int slots, const std::function<void(int, int)>& produce,
             const std::function<bool(int, int)>& consume)
        : count_(count), slots_(slots), produce_(produce), consume_(consume) {}

    void work() {
        for (int index = next(); index < count_; index = next()) {
            produce_(index, index % slots_);
            finish(index);
        }
    }

  private:
    // The next index to produce, waiting for its slot; count_ where there is none.
    int next() {
        std::unique_lock lock(mutex_);
        if (next_ >= count_) return count_;
        const int index = next_++;
        changed_.wait(lock, [&] { return stopped_ || index - consumed_ < slots_; });
        return stopped_ ? count_ : index;
    }

    void finish(int index) {
        std::unique_lock lock(mutex_);
        ready_.insert(index);
        if (consuming_) return;  // whoever consumes now will come to it
        consuming_ = true;
        while (!stopped_ && ready_.erase(consumed_) > 0) {
            const int oldest = consumed_;
            lock.unlock();
            const bool go_on = consume_(oldest, oldest % slots_);
            lock.lock();
            ++consumed_;
            stopped_ = !go_on;
            changed_.notify_all();
        }
        consuming_ = false;
    }

    const int count_;
    const int slots_;
    const std::function<void(int, int)>& produce_;
    const std::function<bool(int, int)>& consume_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::set<int> ready_;  // produced and not yet consumed
    int next_ = 0;
    int consumed_ = 0;
    bool consuming_ = false;
    bool stopped_ = false;
};

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
    Pipeline pipeline(count, slots, produce, consume);
    run_on_threads(std::min({thread_count(threads), count, slots}) - 1, [&] { pipeline.work(); });
}

}  // namespace skybake
