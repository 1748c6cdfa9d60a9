// Parallel loops over fixed tiles. Each tile writes its own memory, so that the number of threads
// never changes a result.
#pragma once

#include <atomic>
#include <functional>
#include <string_view>

#include "bakers/math/bake_options.h"

namespace skybake {

// Calls tile(0) to tile(count - 1) once each, in any order, on up to `threads` threads, and returns
// when all are done. 0 threads stands for as many as the machine has processors. A tile must not
// throw.
void parallel_for(int count, int threads, const std::function<void(int)>& tile);

// Calls produce(i, slot) for i = 0 to count - 1 on up to `threads` threads, and consume(i, slot)
// one at a time in the order of i, on any thread, while later items are being produced. `slot`,
// below `slots`, identifies the buffer that carries item i from one to the other: no two items that
// are in progress share a slot. Stops early once consume returns false, after all running calls
// have returned. Neither function may throw.
void ordered_pipeline(int count, int threads, int slots,
                      const std::function<void(int index, int slot)>& produce,
                      const std::function<bool(int index, int slot)>& consume);

// Returns `threads` itself, or the machine's number of processors for 0.
int thread_count(int threads);

// Runs parallel_for over `count` tiles and reports each finished tile to options.progress. After an
// interruption the remaining tiles are skipped: the caller discards what was made.
inline void for_each_tile(int count, const BakeOptions& options, std::string_view step,
                          const std::function<void(int)>& tile) {
    std::atomic<int> done = 0;
    parallel_for(count, options.threads, [&](int i) {
        if (options.cancelled()) return;
        tile(i);
        if (options.progress != nullptr) {
            options.progress->advance(step, static_cast<double>(++done) / count);
        }
    });
}

}  // namespace skybake
