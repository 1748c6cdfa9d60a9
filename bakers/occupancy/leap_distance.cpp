#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/occupancy/leap_distance.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstring>

#include "bakers/math/memory.h"
#include "bakers/occupancy/cell_grid.h"
#include "bakers/occupancy/leap_distance.h"

#ifndef SKYBAKE_BAKERS_OCCUPANCY_LEAP_DISTANCE_ONCE
#define SKYBAKE_BAKERS_OCCUPANCY_LEAP_DISTANCE_ONCE
namespace skybake::occupancy {

using Bytes = std::vector<std::uint8_t, CacheLineAllocator<std::uint8_t>>;

inline constexpr std::uint8_t kFarthest = 255;

// Rows with room between them: for the neighbours across the wrap, which wrap_row keeps up to date,
// and for vectors, which write up to a multiple of kRoom from the beginning of a row.
class PaddedRows {
  public:
    static constexpr std::size_t kRoom = 64;

    explicit PaddedRows(const std::array<int, 3>& size)
        : width_(static_cast<std::size_t>(size[0])),
          stride_((width_ + kRoom - 1) / kRoom * kRoom + kRoom),
          rows_(size[1]),
          bytes_(stride_ * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]) +
                     2 * kRoom,
                 kFarthest) {}

    std::size_t width() const { return width_; }
    std::uint8_t* row(int y, int z) {
        const auto index = static_cast<std::size_t>(z) * static_cast<std::size_t>(rows_) +
                           static_cast<std::size_t>(y);
        return bytes_.data() + kRoom + index * stride_;
    }
    void wrap_row(std::uint8_t* row) const {
        row[-1] = row[width_ - 1];
        row[width_] = row[0];
    }

  private:
    std::size_t width_;
    std::size_t stride_;
    int rows_;
    Bytes bytes_;
};

// Rows to work on, with room for the longest step to either side.
struct StepRows {
    static constexpr std::size_t kReach = 256 + PaddedRows::kRoom;
    explicit StepRows(std::size_t width)
        : from(width + 2 * kReach, kFarthest), to(width + 2 * kReach, kFarthest) {}
    Bytes from;
    Bytes to;
};

}  // namespace skybake::occupancy
#endif

HWY_BEFORE_NAMESPACE();
namespace skybake::occupancy::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

namespace {

using Tag = hn::ScalableTag<std::uint8_t>;
constexpr Tag kTag;
constexpr std::size_t kLanes = hn::MaxLanes(kTag);
static_assert(kLanes <= PaddedRows::kRoom);

}  // namespace

// One row along x, wrapped.
void spread_along_row(std::uint8_t* row, std::size_t width, StepRows& scratch) {
    constexpr std::size_t kReach = StepRows::kReach;
    std::memcpy(scratch.from.data() + kReach, row, width);
    // Half the way around is far enough.
    for (std::size_t step = 1; step <= std::min<std::size_t>(width / 2, kFarthest); step *= 2) {
        std::uint8_t* from = scratch.from.data() + kReach;
        for (std::size_t i = 0; i < step; ++i) {
            from[width + i] = from[i];
            *(from - 1 - i) = from[width - 1 - i];
        }
        const auto cost = hn::Set(kTag, static_cast<std::uint8_t>(step));
        for (std::size_t x = 0; x < width; x += kLanes) {
            const auto beside =
                hn::Min(hn::LoadU(kTag, from + x - step), hn::LoadU(kTag, from + x + step));
            hn::StoreU(hn::Min(hn::LoadU(kTag, from + x), hn::SaturatedAdd(beside, cost)), kTag,
                       scratch.to.data() + kReach + x);
        }
        std::swap(scratch.from, scratch.to);
    }
    std::memcpy(row, scratch.from.data() + kReach, width);
}

// row = min(row, 1 + the least of three of `other`, which has been wrapped); whether that changed
// it.
bool step_from_row(const std::uint8_t* other, std::uint8_t* row, std::size_t width) {
    const auto one = hn::Set(kTag, 1);
    auto changes = hn::Zero(kTag);
    std::size_t x = 0;
    const auto step = [&](std::size_t at) HWY_ATTR {
        const auto beside =
            hn::Min(hn::LoadU(kTag, other + at - 1), hn::LoadU(kTag, other + at + 1));
        const auto before = hn::LoadU(kTag, row + at);
        const auto after =
            hn::Min(before, hn::SaturatedAdd(hn::Min(beside, hn::LoadU(kTag, other + at)), one));
        hn::StoreU(after, kTag, row + at);
        return hn::Xor(before, after);
    };
    for (; x + kLanes <= width; x += kLanes) changes = hn::Or(changes, step(x));
    bool changed = !hn::AllTrue(kTag, hn::Eq(changes, hn::Zero(kTag)));
    if (x < width) {
        // The last vector's results in the room beyond the row are dropped.
        HWY_ALIGN std::uint8_t lanes[kLanes];
        hn::Store(step(x), kTag, lanes);
        for (std::size_t i = 0; i < width - x; ++i) changed = changed || lanes[i] != 0;
    }
    return changed;
}

// The least of three rows, element by element and one beyond at either end.
void least_of_rows(const std::uint8_t* a, const std::uint8_t* b, const std::uint8_t* c,
                   std::size_t width, std::uint8_t* out) {
    for (std::size_t x = 0; x < width + 2; x += kLanes) {
        const auto least = hn::Min(hn::LoadU(kTag, a + x - 1), hn::LoadU(kTag, b + x - 1));
        hn::StoreU(hn::Min(least, hn::LoadU(kTag, c + x - 1)), kTag, out + x - 1);
    }
}

}  // namespace skybake::occupancy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::occupancy {

HWY_EXPORT(spread_along_row);
HWY_EXPORT(step_from_row);
HWY_EXPORT(least_of_rows);

namespace {

class LeapDistance {
  public:
    explicit LeapDistance(const OccupiedCells& cells)
        : cells_(cells), size_(cells.size), rows_(cells.size) {}

    std::vector<std::uint8_t> run() {
        for (int z = 0; z < size_[2]; ++z) {
            for (int y = 0; y < size_[1]; ++y) along_x(y, z);
            for (const int direction : {1, -1}) along_y(z, direction);
        }
        for (int z = 1; z < size_[2]; ++z) along_z(z - 1, z);
        for (int z = size_[2] - 1; z-- > 0;) along_z(z + 1, z);
        return unpadded();
    }

  private:
    std::size_t width() const { return rows_.width(); }

    void along_x(int y, int z) {
        std::uint8_t* row = rows_.row(y, z);
        const std::uint8_t* occupied = &cells_.occupied[index_of(size_, 0, y, z)];
        bool any = false;
        for (std::size_t x = 0; x < width(); ++x) {
            any |= occupied[x] != 0;
            row[x] = occupied[x] != 0 ? 0 : kFarthest;
        }
        if (any) HWY_DYNAMIC_DISPATCH(spread_along_row)(row, width(), steps_);
        rows_.wrap_row(row);
    }

    // At most twice around: a row has no more to say than the first time.
    void along_y(int z, int direction) {
        const int count = size_[1];
        bool changed = true;
        for (int i = 0; i < 2 * count && (changed || i < count); ++i) {
            const int y = direction > 0 ? i % count : count - 1 - i % count;
            std::uint8_t* row = rows_.row(y, z);
            const std::uint8_t* other = rows_.row(wrapped(y - direction, count), z);
            changed = HWY_DYNAMIC_DISPATCH(step_from_row)(other, row, width());
            rows_.wrap_row(row);
        }
    }

    void along_z(int from, int to) {
        for (int y = 0; y < size_[1]; ++y) {
            const auto other = [&](int row) { return rows_.row(wrapped(row, size_[1]), from); };
            std::uint8_t* least = least_.data() + PaddedRows::kRoom;
            HWY_DYNAMIC_DISPATCH(least_of_rows)
            (other(y - 1), other(y), other(y + 1), width(), least);
            std::uint8_t* row = rows_.row(y, to);
            HWY_DYNAMIC_DISPATCH(step_from_row)(least, row, width());
            rows_.wrap_row(row);
        }
    }

    std::vector<std::uint8_t> unpadded() {
        std::vector<std::uint8_t> distances(count_of(size_));
        for (int z = 0; z < size_[2]; ++z) {
            for (int y = 0; y < size_[1]; ++y) {
                std::copy_n(rows_.row(y, z), width(), &distances[index_of(size_, 0, y, z)]);
            }
        }
        return distances;
    }

    const OccupiedCells& cells_;
    const std::array<int, 3> size_;
    PaddedRows rows_;
    StepRows steps_{rows_.width()};
    Bytes least_ = Bytes(rows_.width() + 3 * PaddedRows::kRoom);
};

}  // namespace

std::vector<std::uint8_t> leap_distance(const OccupiedCells& cells) {
    assert(cells.occupied.size() == count_of(cells.size));
    return LeapDistance(cells).run();
}

}  // namespace skybake::occupancy
#endif  // HWY_ONCE
