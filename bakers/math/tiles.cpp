#include "bakers/math/tiles.h"

#include <atomic>

#include "bakers/math/parallel.h"

namespace skybake {

void for_each_tile(int count, const BakeOptions& options, std::string_view step,
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
