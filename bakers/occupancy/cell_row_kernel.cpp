#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/occupancy/cell_row_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "bakers/occupancy/cell_row_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::occupancy {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

namespace {

using Floats = hn::ScalableTag<float>;
constexpr Floats kFloats;
constexpr std::size_t kLanes = hn::MaxLanes(kFloats);

using Doubles = hn::ScalableTag<double>;
constexpr Doubles kDoubles;
using DoubleVector = hn::Vec<Doubles>;
constexpr std::size_t kDoubleLanes = hn::MaxLanes(kDoubles);
constexpr hn::Rebind<float, Doubles> kFewFloats;

HWY_INLINE DoubleVector load_at(const float* row, std::size_t x) {
    return hn::PromoteTo(kDoubles, hn::LoadU(kFewFloats, row + x));
}
HWY_INLINE DoubleVector load_at(const double* row, std::size_t x) {
    return hn::LoadU(kDoubles, row + x);
}

// The sum of kRows rows from x on: the one half of them plus the other.
template <int kRows, class Value>
HWY_INLINE DoubleVector sum_at(const Value* const* rows, std::size_t x) {
    if constexpr (kRows == 1) {
        return load_at(rows[0], x);
    } else {
        return hn::Add(sum_at<kRows / 2>(rows, x), sum_at<kRows / 2>(rows + kRows / 2, x));
    }
}

// The same of one element.
template <int kRows, class Value>
HWY_INLINE double element_sum(const Value* const* rows, std::size_t x) {
    if constexpr (kRows == 1) {
        return double{rows[0][x]};
    } else {
        return element_sum<kRows / 2>(rows, x) + element_sum<kRows / 2>(rows + kRows / 2, x);
    }
}

// Takes the means of kRows rows each into the extremes, or begins with them. Two vectors at a time,
// so that an extreme need not wait for the one before.
template <int kRows, class Value>
HWY_INLINE void take_means_of(const std::vector<const Value*>& rows, std::size_t length, bool begin,
                              Extremes<double>& extremes) {
    const Value* const* const first = rows.data();
    const Value* const* const end = first + rows.size();
    const DoubleVector share = hn::Set(kDoubles, 1.0 / kRows);
    double* least = extremes.least.data();
    double* most = extremes.most.data();
    std::size_t x = 0;
    for (; x + 2 * kDoubleLanes <= length; x += 2 * kDoubleLanes) {
        const std::size_t next = x + kDoubleLanes;
        DoubleVector low = sum_at<kRows>(first, x);
        DoubleVector next_low = sum_at<kRows>(first, next);
        DoubleVector high = low;
        DoubleVector next_high = next_low;
        for (const Value* const* node = first + kRows; node != end; node += kRows) {
            const DoubleVector sum = sum_at<kRows>(node, x);
            const DoubleVector next_sum = sum_at<kRows>(node, next);
            low = hn::Min(low, sum);
            high = hn::Max(high, sum);
            next_low = hn::Min(next_low, next_sum);
            next_high = hn::Max(next_high, next_sum);
        }
        low = hn::Mul(low, share);
        high = hn::Mul(high, share);
        next_low = hn::Mul(next_low, share);
        next_high = hn::Mul(next_high, share);
        if (!begin) {
            low = hn::Min(low, hn::LoadU(kDoubles, least + x));
            high = hn::Max(high, hn::LoadU(kDoubles, most + x));
            next_low = hn::Min(next_low, hn::LoadU(kDoubles, least + next));
            next_high = hn::Max(next_high, hn::LoadU(kDoubles, most + next));
        }
        hn::StoreU(low, kDoubles, least + x);
        hn::StoreU(high, kDoubles, most + x);
        hn::StoreU(next_low, kDoubles, least + next);
        hn::StoreU(next_high, kDoubles, most + next);
    }
    for (; x < length; ++x) {
        if (begin) least[x] = most[x] = element_sum<kRows>(first, x) * (1.0 / kRows);
        for (const Value* const* node = first; node != end; node += kRows) {
            const double mean = element_sum<kRows>(node, x) * (1.0 / kRows);
            least[x] = std::min(least[x], mean);
            most[x] = std::max(most[x], mean);
        }
    }
}

}  // namespace

void take_voxel_means(int rows_a_node, const std::vector<const float*>& rows, std::size_t length,
                      Extremes<double>& extremes) {
    if (rows_a_node == 2) return take_means_of<2>(rows, length, false, extremes);
    take_means_of<4>(rows, length, false, extremes);
}

void take_face_means(int rows_a_node, const std::vector<const double*>& rows, std::size_t length,
                     Extremes<double>& extremes) {
    if (rows_a_node == 1) return take_means_of<1>(rows, length, true, extremes);
    if (rows_a_node == 2) return take_means_of<2>(rows, length, false, extremes);
    take_means_of<4>(rows, length, false, extremes);
}

// Of rows, element by element.
void row_extremes(const std::vector<const float*>& rows, std::size_t length, float* least,
                  float* most) {
    const float* const* const end = rows.data() + rows.size();
    std::size_t x = 0;
    for (; x + 2 * kLanes <= length; x += 2 * kLanes) {
        auto low = hn::LoadU(kFloats, rows[0] + x);
        auto next_low = hn::LoadU(kFloats, rows[0] + x + kLanes);
        auto high = low;
        auto next_high = next_low;
        for (const float* const* row = rows.data() + 1; row != end; ++row) {
            const auto values = hn::LoadU(kFloats, *row + x);
            const auto next = hn::LoadU(kFloats, *row + x + kLanes);
            low = hn::Min(low, values);
            high = hn::Max(high, values);
            next_low = hn::Min(next_low, next);
            next_high = hn::Max(next_high, next);
        }
        hn::StoreU(low, kFloats, least + x);
        hn::StoreU(high, kFloats, most + x);
        hn::StoreU(next_low, kFloats, least + x + kLanes);
        hn::StoreU(next_high, kFloats, most + x + kLanes);
    }
    for (; x < length; ++x) {
        least[x] = most[x] = rows[0][x];
        for (const float* row : rows) {
            least[x] = std::min(least[x], row[x]);
            most[x] = std::max(most[x], row[x]);
        }
    }
}

void promote(const float* values, std::size_t length, double* out) {
    std::size_t x = 0;
    for (; x + kDoubleLanes <= length; x += kDoubleLanes) {
        hn::StoreU(load_at(values, x), kDoubles, out + x);
    }
    for (; x < length; ++x) out[x] = double{values[x]};
}

// From voxels to windows of `cell` voxels, each at the place of its first, by doubling their width.
// The arrays hold a vector and `cell` elements more than `length`.
void widen_windows(std::size_t length, int cell, Extremes<double>& extremes) {
    double* least = extremes.least.data();
    double* most = extremes.most.data();
    for (std::size_t reach = 1; reach < static_cast<std::size_t>(cell); reach *= 2) {
        for (std::size_t x = 0; x < length; x += kDoubleLanes) {
            hn::StoreU(
                hn::Min(hn::LoadU(kDoubles, least + x), hn::LoadU(kDoubles, least + x + reach)),
                kDoubles, least + x);
            hn::StoreU(
                hn::Max(hn::LoadU(kDoubles, most + x), hn::LoadU(kDoubles, most + x + reach)),
                kDoubles, most + x);
        }
    }
}

// face_means of cells of four voxels, but for the first face and those after the last whole vector,
// the first of which is returned. The two voxels beside a face are taken for one 64-bit lane.
std::size_t face_means_of_fours(const float* voxels, std::size_t length, double* means) {
#if HWY_TARGET == HWY_SCALAR  // has no lanes to choose from
    static_cast<void>(voxels), static_cast<void>(length), static_cast<void>(means);
    return 1;
#else
    const DoubleVector half = hn::Set(kDoubles, 0.5);
    std::size_t k = 1;
    for (; 4 * (k + kDoubleLanes) - 1 <= length; k += kDoubleLanes) {
        const float* before = voxels + 4 * k - 1;
        const auto first = hn::BitCast(kDoubles, hn::LoadU(kFloats, before));
        const auto second = hn::BitCast(kDoubles, hn::LoadU(kFloats, before + kLanes));
        const auto pairs = hn::BitCast(kFloats, hn::ConcatEven(kDoubles, second, first));
        const DoubleVector lower = hn::PromoteTo(kDoubles, hn::LowerHalf(kFewFloats, pairs));
        const DoubleVector upper = hn::PromoteTo(kDoubles, hn::UpperHalf(kFewFloats, pairs));
        const DoubleVector sum =
            hn::Add(hn::ConcatEven(kDoubles, upper, lower), hn::ConcatOdd(kDoubles, upper, lower));
        hn::StoreU(hn::Mul(sum, half), kDoubles, means + k);
    }
    return k;
#endif
}

// The extremes of each cell: at its voxels and at its faces. `faces` has the first one once more
// at its end.
void join(const Extremes<double>& along, const Extremes<double>& faces, std::size_t count,
          std::size_t cell, Extremes<double>& cells) {
    double* least = cells.least.data();
    double* most = cells.most.data();
    for (std::size_t k = 0; k < count; ++k) {
        least[k] = along.least[k * cell];
        most[k] = along.most[k * cell];
    }
    for (std::size_t k = 0; k < count; k += kDoubleLanes) {
        const auto low =
            hn::Min(hn::LoadU(kDoubles, &faces.least[k]), hn::LoadU(kDoubles, &faces.least[k + 1]));
        const auto high =
            hn::Max(hn::LoadU(kDoubles, &faces.most[k]), hn::LoadU(kDoubles, &faces.most[k + 1]));
        hn::StoreU(hn::Min(hn::LoadU(kDoubles, least + k), low), kDoubles, least + k);
        hn::StoreU(hn::Max(hn::LoadU(kDoubles, most + k), high), kDoubles, most + k);
    }
}

Magnitudes magnitudes(const float* values, std::size_t count) {
    const hn::ScalableTag<std::uint32_t> d;
    const auto one = hn::Set(d, 1);
    const auto no_sign = hn::Set(d, 0x7fffffffU);
    // Less one, 0 is the greatest of all.
    auto smallest = hn::Set(d, ~0U);
    auto largest = hn::Zero(d);
    auto next_smallest = smallest;
    auto next_largest = largest;
    const auto bits_at = [&](std::size_t at) HWY_ATTR {
        return hn::And(hn::BitCast(d, hn::LoadU(kFloats, values + at)), no_sign);
    };
    std::size_t i = 0;
    for (; i + 2 * kLanes <= count; i += 2 * kLanes) {
        const auto bits = bits_at(i);
        const auto next = bits_at(i + kLanes);
        smallest = hn::Min(smallest, hn::Sub(bits, one));
        next_smallest = hn::Min(next_smallest, hn::Sub(next, one));
        largest = hn::Max(largest, bits);
        next_largest = hn::Max(next_largest, next);
    }
    smallest = hn::Min(smallest, next_smallest);
    largest = hn::Max(largest, next_largest);
    std::uint32_t least = ~0U;
    std::uint32_t most = 0;
    HWY_ALIGN std::array<std::uint32_t, kLanes> lanes;
    hn::Store(smallest, d, lanes.data());
    for (const std::uint32_t lane : lanes) least = std::min(least, lane);
    hn::Store(largest, d, lanes.data());
    for (const std::uint32_t lane : lanes) most = std::max(most, lane);
    for (; i < count; ++i) {
        const std::uint32_t bits = std::bit_cast<std::uint32_t>(values[i]) & 0x7fffffffU;
        least = std::min(least, bits - 1);
        most = std::max(most, bits);
    }
    return {least == ~0U ? least : least + 1, most};
}

}  // namespace HWY_NAMESPACE
}  // namespace skybake::occupancy
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::occupancy {

HWY_EXPORT(take_voxel_means);
HWY_EXPORT(take_face_means);
HWY_EXPORT(row_extremes);
HWY_EXPORT(promote);
HWY_EXPORT(widen_windows);
HWY_EXPORT(face_means_of_fours);
HWY_EXPORT(join);
HWY_EXPORT(magnitudes);

namespace {

// What vectors may reach over beyond the end of a row.
constexpr std::size_t kVectorRoom = 64 / sizeof(double);

// The nodes along one axis of a bundle: the rows about them, the same twice for voxels.
std::vector<std::array<int, 2>> axis_nodes(int count) {
    std::vector<std::array<int, 2>> nodes = {{0, 1}, {count - 2, count - 1}};
    for (int i = 1; i < count - 1; ++i) nodes.push_back({i, i});
    return nodes;
}

void find_node_rows(const RowBundle& bundle, RowScratch& scratch) {
    if (scratch.height == bundle.height && scratch.depth == bundle.depth) return;
    scratch.height = bundle.height;
    scratch.depth = bundle.depth;
    for (std::vector<std::size_t>& rows : scratch.node_rows) rows.clear();
    for (const auto& z : axis_nodes(bundle.depth)) {
        for (const auto& y : axis_nodes(bundle.height)) {
            const std::size_t y_face = y[0] != y[1] ? 1 : 0;
            const std::size_t z_face = z[0] != z[1] ? 1 : 0;
            std::vector<std::size_t>& rows = scratch.node_rows[y_face + z_face];
            for (std::size_t k = 0; k <= z_face; ++k) {
                for (std::size_t j = 0; j <= y_face; ++j) {
                    rows.push_back(static_cast<std::size_t>(z[k] * bundle.height + y[j]));
                }
            }
        }
    }
}

}  // namespace

void Magnitudes::add(const Magnitudes& other) {
    smallest = std::min(smallest, other.smallest);
    largest = std::max(largest, other.largest);
}

Magnitudes magnitudes_of(const float* values, std::size_t count) {
    return HWY_DYNAMIC_DISPATCH(magnitudes)(values, count);
}

bool means_are_exact(const Magnitudes& magnitudes) {
    if (magnitudes.all_zero()) return true;
    // Denormals are multiples of what the smallest normal's last bit is.
    const auto exponent = [](std::uint32_t bits) { return std::max(bits >> 23, 1U); };
    return exponent(magnitudes.largest) - exponent(magnitudes.smallest) <= 26;
}

void face_means(const float* voxels, std::size_t length, int cell, double* means) {
    const auto edge = static_cast<std::size_t>(cell);
    means[0] = (double{voxels[length - 1]} + double{voxels[0]}) * 0.5;
    std::size_t k = 1;
    if (cell == 4) k = HWY_DYNAMIC_DISPATCH(face_means_of_fours)(voxels, length, means);
    for (; k * edge < length; ++k) {
        means[k] = (double{voxels[k * edge - 1]} + double{voxels[k * edge]}) * 0.5;
    }
}

void trilinear_row(const RowBundle& bundle, RowScratch& scratch, Extremes<double>& cells) {
    const std::size_t length = bundle.length;
    const std::size_t count = bundle.cells();
    const auto edge = static_cast<std::size_t>(bundle.cell);
    find_node_rows(bundle, scratch);
    scratch.voxels.resize(length);
    scratch.along.resize(length + kVectorRoom + edge);
    scratch.faces.resize(count + 1 + kVectorRoom);
    cells.resize(count + kVectorRoom);
    for (const std::size_t faces : {0U, 1U, 2U}) {
        scratch.voxel_rows.clear();
        scratch.face_rows.clear();
        for (const std::size_t row : scratch.node_rows[faces]) {
            scratch.voxel_rows.push_back(bundle.rows[row].voxels);
            scratch.face_rows.push_back(bundle.rows[row].faces);
        }
        if (faces == 0) {
            HWY_DYNAMIC_DISPATCH(row_extremes)
            (scratch.voxel_rows, length, scratch.voxels.least.data(), scratch.voxels.most.data());
            HWY_DYNAMIC_DISPATCH(promote)
            (scratch.voxels.least.data(), length, scratch.along.least.data());
            HWY_DYNAMIC_DISPATCH(promote)
            (scratch.voxels.most.data(), length, scratch.along.most.data());
        } else {
            HWY_DYNAMIC_DISPATCH(take_voxel_means)
            (1 << faces, scratch.voxel_rows, length, scratch.along);
        }
        HWY_DYNAMIC_DISPATCH(take_face_means)(1 << faces, scratch.face_rows, count, scratch.faces);
    }
    // Windows of the last voxels see nothing beyond the row.
    std::fill(scratch.along.least.begin() + static_cast<std::ptrdiff_t>(length),
              scratch.along.least.end(), std::numeric_limits<double>::infinity());
    std::fill(scratch.along.most.begin() + static_cast<std::ptrdiff_t>(length),
              scratch.along.most.end(), -std::numeric_limits<double>::infinity());
    HWY_DYNAMIC_DISPATCH(widen_windows)(length, bundle.cell, scratch.along);
    scratch.faces.least[count] = scratch.faces.least[0];
    scratch.faces.most[count] = scratch.faces.most[0];
    HWY_DYNAMIC_DISPATCH(join)(scratch.along, scratch.faces, count, edge, cells);
}

void footprint_row(const RowBundle& bundle, int halo, RowScratch& scratch, float* least,
                   float* most) {
    const std::size_t length = bundle.length;
    const auto beyond = static_cast<std::size_t>(halo);
    const auto edge = static_cast<std::size_t>(bundle.cell);
    scratch.voxel_rows.clear();
    for (const VoxelRow& row : bundle.rows) scratch.voxel_rows.push_back(row.voxels);
    scratch.voxels.resize(length + 2 * beyond);  // with the halo before and after the row
    float* low = scratch.voxels.least.data() + beyond;
    float* high = scratch.voxels.most.data() + beyond;
    HWY_DYNAMIC_DISPATCH(row_extremes)(scratch.voxel_rows, length, low, high);
    for (float* values : {low, high}) {
        for (std::size_t i = 0; i < beyond; ++i) {
            values[length + i] = values[i % length];
            *(values - 1 - i) = values[length - 1 - i % length];
        }
    }
    for (std::size_t first = 0; first < length; first += edge) {
        const std::size_t width = std::min(edge, length - first) + 2 * beyond;
        const float* from_low = scratch.voxels.least.data() + first;
        const float* from_high = scratch.voxels.most.data() + first;
        *least = from_low[0];
        *most = from_high[0];
        for (std::size_t i = 1; i < width; ++i) {
            *least = std::min(*least, from_low[i]);
            *most = std::max(*most, from_high[i]);
        }
        ++least;
        ++most;
    }
}

}  // namespace skybake::occupancy
#endif  // HWY_ONCE
