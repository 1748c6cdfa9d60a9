#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <cstddef>

#include "bakers/core/parallel.h"

namespace skybake {

int thread_count(int threads) {
    return threads > 0 ? threads : oneapi::tbb::this_task_arena::max_concurrency();
}

void parallel_for(int count, int threads, const std::function<void(int)>& tile) {
    if (thread_count(threads) == 1 || count <= 1) {
        for (int i = 0; i < count; ++i) tile(i);
        return;
    }
    // More threads than processors are the user's to ask for; TBB would warn and run fewer.
    const auto count_of_threads = static_cast<std::size_t>(thread_count(threads));
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                            count_of_threads);
    oneapi::tbb::task_arena arena(thread_count(threads));
    arena.execute(
        [&] { oneapi::tbb::parallel_for(0, count, tile, oneapi::tbb::simple_partitioner()); });
}

}  // namespace skybake
