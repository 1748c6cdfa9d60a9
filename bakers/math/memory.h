// Memory as vector loads and repeated bakes like it.
#pragma once

#include <malloc.h>

#include <cstddef>
#include <new>
#include <vector>

namespace skybake {

// Floats at the start of a cache line, as vector loads like them.

template <class T>
struct CacheLineAllocator {
    using value_type = T;
    static constexpr std::align_val_t kAlignment{64};

    CacheLineAllocator() = default;
    template <class U>
    CacheLineAllocator(const CacheLineAllocator<U>&) {}

    T* allocate(std::size_t count) {
        return static_cast<T*>(::operator new(count * sizeof(T), kAlignment));
    }
    void deallocate(T* pointer, std::size_t) { ::operator delete(pointer, kAlignment); }
    friend bool operator==(CacheLineAllocator, CacheLineAllocator) { return true; }
    friend bool operator!=(CacheLineAllocator, CacheLineAllocator) { return false; }
};

using AlignedFloats = std::vector<float, CacheLineAllocator<float>>;

// For programs, at their start.

// Has the process keep the memory that it frees rather than give it back: bakes free and ask for
// the same buffers over and over, and faulting in fresh pages costs as much as octaves of noise do.
// Nothing else depends on it; a no-op where the C library is not glibc.
inline void keep_freed_memory() {
#ifdef __GLIBC__
    // The most that glibc takes: half of what it maps for a thread's heap.
    constexpr int kLargestHeapBlock = 32 << 20;
    constexpr int kKeptAtTheTop = 512 << 20;
    mallopt(M_MMAP_THRESHOLD, kLargestHeapBlock);
    mallopt(M_TRIM_THRESHOLD, kKeptAtTheTop);
#endif
}

}  // namespace skybake
