// Memory allocation for vector loads and for repeated bakes.
//
// Memory for floats that are written before they are read.
#pragma once

#include <malloc.h>

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

namespace skybake {

// Allocates memory that starts at a cache line, which makes vector loads fastest.
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

// Makes the process keep the memory that it frees instead of returning it to the system. Programs
// call this at their start: bakes free and request the same buffers repeatedly, and faulting in
// fresh pages costs as much as octaves of noise do. No result depends on it. It does nothing where
// the C library is not glibc.
inline void keep_freed_memory() {
#ifdef __GLIBC__
    // The largest value that glibc accepts: half of what it maps for a thread's heap.
    constexpr int kLargestHeapBlock = 32 << 20;
    constexpr int kKeptAtTheTop = 512 << 20;
    mallopt(M_MMAP_THRESHOLD, kLargestHeapBlock);
    mallopt(M_TRIM_THRESHOLD, kKeptAtTheTop);
#endif
}

// Returns to the system what the process has kept so far.
inline void return_freed_memory() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

// Vectors fill what they add with zeros, which costs as much as a cheap noise does.
class ScratchFloats {
  public:
    // Holds at least `count` floats from now on. Their values are lost if it held fewer.
    void reserve(std::size_t count) {
        if (count <= count_) return;
        floats_.reset(CacheLineAllocator<float>().allocate(count));
        count_ = count;
    }
    bool empty() const { return count_ == 0; }
    float* data() { return floats_.get(); }

  private:
    struct Free {
        void operator()(float* floats) const { CacheLineAllocator<float>().deallocate(floats, 0); }
    };
    std::unique_ptr<float[], Free> floats_;
    std::size_t count_ = 0;
};

}  // namespace skybake
