// Memory for floats that are written before they are read.
#pragma once

#include <cstddef>
#include <memory>

#include "bakers/math/memory.h"

namespace skybake {

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
