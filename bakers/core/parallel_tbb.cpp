#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

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
    oneapi::tbb::task_arena arena(thread_count(threads));
    arena.execute(
        [&] { oneapi::tbb::parallel_for(0, count, tile, oneapi::tbb::simple_partitioner()); });
}

}  // namespace skybake
