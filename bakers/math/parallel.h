// Loops over fixed tiles, each of which writes its own memory: the number of threads never changes
// a result.
#pragma once

#include <atomic>
#include <functional>
#include <string_view>

#include "bakers/math/bake_options.h"

namespace skybake {

// Calls tile(0) ... tile(count - 1), each once, in any order, on up to `threads` threads; returns
// when all are done. 0 threads means as many as the machine has. A tile must not throw.
void parallel_for(int count, int threads, const std::function<void(int)>& tile);

// Calls produce(i, slot) for i = 0 ... count - 1 on up to `threads` threads and consume(i, slot)
// one at a time in the order of i, on any thread, while later ones are being produced. `slot`,
// below `slots`, names the buffer that carries item i from one to the other: no two items that are
// alive have the same. Stops early, having returned from all calls, once consume returns false.
// Neither may throw.
void ordered_pipeline(int count, int threads, int slots,
                      const std::function<void(int index, int slot)>& produce,
                      const std::function<bool(int index, int slot)>& consume);

// What `threads` stands for: itself, or the machine's number of processors for 0.
int thread_count(int threads);

// parallel_for over `count` tiles that tells options.progress of each. After an interruption the
// remaining tiles are skipped: what was made is thrown away by whoever asked for it.
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
