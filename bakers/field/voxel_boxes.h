// How a volume is cut into boxes that are made, converted and written one after the other.
#pragma once

#include <array>

#include "bakers/field/baked.h"

namespace skybake {

// The boxes of a volume in the order in which a file's rows want them: groups of `columns` slices
// (the cells of one row of an atlas; 1 for a stack), several groups a box where they are small,
// parts of their rows where they are large. With columns = 1 the voxels of box after box are those
// of the volume in the order x, y, z. A box has at most kFloats values unless one row of a group
// has more. A pure function of its arguments: sums over boxes are the same on every machine.
class BoxSequence {
  public:
    static constexpr std::int64_t kFloats = 1 << 21;  // 8 MiB

    BoxSequence(std::array<int, 3> size, int channels, int columns = 1);

    int count() const { return groups_ * parts_; }
    VoxelBox operator[](int index) const;
    // The most voxels that a box has.
    std::int64_t largest_count() const;

  private:
    std::array<int, 3> size_;
    int depth_ = 1;   // slices of a box
    int rows_ = 1;    // rows of a box
    int groups_ = 1;  // boxes along z
    int parts_ = 1;   // boxes along y
};

// How many boxes may be alive while `threads` threads make them: enough to keep all at work, and
// few enough for memory not to grow with the machine.
int box_slots(int threads);

}  // namespace skybake
