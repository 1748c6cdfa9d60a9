#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/occupancy/envelope_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <cstdint>
#include <limits>

#include "bakers/occupancy/cell_grid.h"
#include "bakers/occupancy/envelope_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::occupancy::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

namespace {

using Tag = hn::CappedTag<float, kColumns>;
using IndexTag = hn::RebindToSigned<Tag>;
constexpr Tag kTag;
constexpr IndexTag kIndices;

}  // namespace

// Copies the columns to `rows`, where they lie close together.
ColumnRange gather_rows(const float* in, std::size_t in_stride, std::size_t count, float* rows) {
    auto least = hn::Set(kTag, std::numeric_limits<float>::infinity());
    auto most = hn::Zero(kTag);
    for (std::size_t k = 0; k < count; ++k) {
        for (std::size_t c = 0; c < kColumns; c += hn::Lanes(kTag)) {
            const auto values = hn::LoadU(kTag, in + k * in_stride + c);
            least = hn::Min(least, values);
            most = hn::Max(most, values);
            hn::Store(values, kTag, rows + k * kColumns + c);
        }
    }
    return {hn::GetLane(hn::MinOfLanes(kTag, least)), hn::GetLane(hn::MaxOfLanes(kTag, most))};
}

// Searches the cells first to last for the best of one point, column by column. Columns without any
// cell have no part in what is returned.
BestCells search(const float* rows, const EnvelopeAxis& axis, int point, int first, int last,
                 float* out) {
    const auto infinity = hn::Set(kTag, std::numeric_limits<float>::infinity());
    auto least = hn::Set(kIndices, std::numeric_limits<std::int32_t>::max());
    auto most = hn::Set(kIndices, std::numeric_limits<std::int32_t>::min());
    for (std::size_t c = 0; c < kColumns; c += hn::Lanes(kTag)) {
        auto best = infinity;
        auto cells = hn::Set(kIndices, first);
        int row = axis.repeats() ? wrapped(first, axis.cells()) : first;
        for (int k = first; k <= last; ++k) {
            const auto sum =
                hn::Add(hn::Load(kTag, rows + static_cast<std::size_t>(row) * kColumns + c),
                        hn::Set(kTag, axis.square(point, k)));
            const auto better = hn::Lt(sum, best);
            best = hn::Min(best, sum);
            cells = hn::IfThenElse(hn::RebindMask(kIndices, better), hn::Set(kIndices, k), cells);
            if (++row == axis.cells()) row = 0;
        }
        hn::StoreU(best, kTag, out + c);
        const auto found = hn::RebindMask(kIndices, hn::Lt(best, infinity));
        least = hn::Min(least, hn::IfThenElse(found, cells, least));
        most = hn::Max(most, hn::IfThenElse(found, cells, most));
    }
    return {hn::GetLane(hn::MinOfLanes(kIndices, least)),
            hn::GetLane(hn::MaxOfLanes(kIndices, most))};
}

}  // namespace skybake::occupancy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::occupancy {

HWY_EXPORT(gather_rows);
HWY_EXPORT(search);

EnvelopeAxis::EnvelopeAxis(int voxels, int cell, double voxel_m, bool repeats)
    : cells_(repeats ? voxels : voxels + 1),
      points_((voxels + cell - 1) / cell),
      cell_(cell),
      repeats_(repeats),
      end_(2 * voxels),
      squares_(4 * static_cast<std::size_t>(voxels) + 65) {
    const auto half = static_cast<float>(voxel_m / 2);
    for (std::size_t i = 0; i < squares_.size(); ++i) {
        const float metres = static_cast<float>(i) * half;
        squares_[i] = metres * metres;
    }
}

namespace {

// Searches the points between those that are known, whose best cells bound theirs.
class Envelope {
  public:
    Envelope(const EnvelopeAxis& axis, EnvelopeScratch& scratch, float* out, std::size_t stride)
        : axis_(axis), scratch_(scratch), out_(out), stride_(stride) {}

    void run() {
        const BestCells first = search_first();
        // One round the tile, all is as at the first point, a tile further on.
        last_ = axis_.repeats() ? first.most + axis_.cells() : axis_.cells() - 1;
        int step = 1;
        while (step < axis_.points()) step *= 2;
        for (; step > 1; step /= 2) {
            for (int point = step / 2; point < axis_.points(); point += step) {
                between(point, point - step / 2, point + step / 2);
            }
        }
    }

  private:
    BestCells search_first() {
        if (!axis_.repeats()) return search_point(0, 0, axis_.cells() - 1);
        const int middle = (axis_.centre(0) - 1) / 2;
        const int reach = axis_.cells() / 2 + 1;
        return search_point(0, middle - reach, middle + reach);
    }

    void between(int point, int before, int after) {
        const int first = best(before).least;
        const int last = after < axis_.points() ? best(after).most : last_;
        search_point(point, first, last);
    }

    BestCells search_point(int point, int first, int last) {
        return best(point) =
                   HWY_DYNAMIC_DISPATCH(search)(scratch_.rows.data(), axis_, point, first, last,
                                                out_ + static_cast<std::size_t>(point) * stride_);
    }

    BestCells& best(int point) { return scratch_.best[static_cast<std::size_t>(point)]; }

    const EnvelopeAxis& axis_;
    EnvelopeScratch& scratch_;
    float* out_;
    std::size_t stride_;
    int last_ = 0;
};

}  // namespace

void least_sums(const float* in, std::size_t in_stride, const EnvelopeAxis& axis,
                EnvelopeScratch& scratch, float* out, std::size_t out_stride) {
    const auto [least, most] = HWY_DYNAMIC_DISPATCH(gather_rows)(
        in, in_stride, static_cast<std::size_t>(axis.cells()), scratch.rows.data());
    // Cells everywhere, or none: the sums are 0 or infinite as they are.
    if (most == 0 || least == std::numeric_limits<float>::infinity()) {
        for (std::size_t p = 0; p < static_cast<std::size_t>(axis.points()); ++p) {
            std::fill_n(out + p * out_stride, kColumns, least);
        }
        return;
    }
    Envelope(axis, scratch, out, out_stride).run();
}

}  // namespace skybake::occupancy
#endif  // HWY_ONCE
