// Loops over fixed tiles, each of which writes its own memory: the number of threads never changes
// a result.
#pragma once

#include <functional>

namespace skybake {

// Calls tile(0) ... tile(count - 1), each once, in any order, on up to `threads` threads; returns
// when all are done. 0 threads means as many as the machine has. A tile must not throw.
void parallel_for(int count, int threads, const std::function<void(int)>& tile);

// What `threads` stands for: itself, or the machine's number of processors for 0.
int thread_count(int threads);

}  // namespace skybake
