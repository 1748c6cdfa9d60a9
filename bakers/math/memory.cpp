#include <malloc.h>

#include "bakers/math/memory.h"

namespace skybake {

void keep_freed_memory() {
#ifdef __GLIBC__
    // The most that glibc takes: half of what it maps for a thread's heap.
    constexpr int kLargestHeapBlock = 32 << 20;
    constexpr int kKeptAtTheTop = 512 << 20;
    mallopt(M_MMAP_THRESHOLD, kLargestHeapBlock);
    mallopt(M_TRIM_THRESHOLD, kKeptAtTheTop);
#endif
}

}  // namespace skybake
