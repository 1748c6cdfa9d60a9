#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstddef>
#include <limits>
#include <list>
#include <mutex>

#include "bakers/math/parallel.h"
#include "bakers/math/startable_threads.h"

namespace skybake {
namespace {

using oneapi::tbb::global_control;

// More threads than processors are the user's to ask for; TBB would warn and run fewer.
void run_with_threads(int threads, const std::function<void()>& work) {
    const global_control limit(global_control::max_allowed_parallelism,
                               static_cast<std::size_t>(threads));
    oneapi::tbb::task_arena arena(threads);
    arena.execute(work);
}

std::mutex asking;
int asked = 1;  // the most threads that were found to be granted

// Returns `threads`, or how many the system grants if these are fewer. TBB ends the process when a
// thread of it cannot begin, so it never asks for more than were granted, whoever uses it. One thread
// is left to whoever tells how far the work is.
int granted(int threads) {
    static int most = std::numeric_limits<int>::max();
    const std::lock_guard lock(asking);
    if (threads > asked && threads <= most) {
        asked = threads;
        const int startable = startable_threads(threads);
        if (startable < threads) {
            most = std::max(startable, 1);
            static std::list<global_control> limits;  // of which the least holds
            limits.emplace_back(global_control::max_allowed_parallelism,
                                static_cast<std::size_t>(most));
        }
    }
    return std::min(threads, most);
}

}  // namespace

void count_threads_again() {
    const std::lock_guard lock(asking);
    asked = 1;
}

int thread_count(int threads) {
    return granted(threads > 0 ? threads : oneapi::tbb::this_task_arena::max_concurrency());
}

void parallel_for(int count, int threads, const std::function<void(int)>& tile) {
    const int own = count <= 1 ? 1 : thread_count(threads);
    if (own == 1) {
        for (int i = 0; i < count; ++i) tile(i);
        return;
    }
    run_with_threads(
        own, [&] { oneapi::tbb::parallel_for(0, count, tile, oneapi::tbb::simple_partitioner()); });
}

void ordered_pipeline(int count, int threads, int slots,
                      const std::function<void(int index, int slot)>& produce,
                      const std::function<bool(int index, int slot)>& consume) {
    assert(slots >= 1);
    const int own = slots == 1 || count <= 1 ? 1 : thread_count(threads);
    if (own == 1) {
        for (int i = 0; i < count; ++i) {
            produce(i, 0);
            if (!consume(i, 0)) return;
        }
        return;
    }
    using oneapi::tbb::filter_mode;
    using oneapi::tbb::make_filter;
    int next = 0;
    std::atomic<bool> stopped = false;
    // At most `slots` items are alive and they leave in order, so that those alive are consecutive
    // and index % slots is a different one for each.
    const auto take = make_filter<void, int>(filter_mode::serial_in_order,
                                             [&](oneapi::tbb::flow_control& control) {
                                                 if (next >= count || stopped) {
                                                     control.stop();
                                                     return 0;
                                                 }
                                                 return next++;
                                             });
    const auto make = make_filter<int, int>(filter_mode::parallel, [&](int index) {
        if (!stopped) produce(index, index % slots);
        return index;
    });
    const auto give = make_filter<int, void>(filter_mode::serial_in_order, [&](int index) {
        if (!stopped && !consume(index, index % slots)) stopped = true;
    });
    run_with_threads(own, [&] {
        oneapi::tbb::parallel_pipeline(static_cast<std::size_t>(slots), take & make & give);
    });
}

}  // namespace skybake
