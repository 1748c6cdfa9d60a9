#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/occupancy/cell_row_kernel.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <bit>
#include <cassert>
#include <limits>

#include "bakers/occupancy/cell_row_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::occupancy::HWY_NAMESPACE {

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

// The same sum of one element.
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
    if (rows_a_node == 2) return take_means_of<2>(rows, length, true, extremes);
    take_means_of<4>(rows, length, false, extremes);
}

void take_face_means(int rows_a_node, const std::vector<const double*>& rows, std::size_t length,
                     Extremes<double>& extremes) {
    if (rows_a_node == 1) return take_means_of<1>(rows, length, true, extremes);
    if (rows_a_node == 2) return take_means_of<2>(rows, length, true, extremes);
    take_means_of<4>(rows, length, false, extremes);
}

// Finds the extremes of rows, element by element.
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
    for (std::size_t x = 0; x < length; x += kDoubleLanes) {
        hn::StoreU(load_at(values, x), kDoubles, out + x);
    }
}

// Merges several extremes, element by element.
void merge(const std::array<const Extremes<double>*, 5>& parts, std::size_t length,
           Extremes<double>& out) {
    for (std::size_t x = 0; x < length; x += kDoubleLanes) {
        DoubleVector low = hn::LoadU(kDoubles, &parts[0]->least[x]);
        DoubleVector high = hn::LoadU(kDoubles, &parts[0]->most[x]);
        for (std::size_t i = 1; i < parts.size(); ++i) {
            low = hn::Min(low, hn::LoadU(kDoubles, &parts[i]->least[x]));
            high = hn::Max(high, hn::LoadU(kDoubles, &parts[i]->most[x]));
        }
        hn::StoreU(low, kDoubles, &out.least[x]);
        hn::StoreU(high, kDoubles, &out.most[x]);
    }
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

// The first cache has room for few lines on their way from memory, and what waits for them waits
// there; the second takes them a fifth faster.
HWY_INLINE void fetch_to_second_cache(const float* values) { __builtin_prefetch(values, 0, 2); }
constexpr std::size_t kLineFloats = 16;

Magnitudes magnitudes(const float* values, std::size_t count, const float* next_values) {
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
        for (std::size_t line = 0; line < 2 * kLanes; line += kLineFloats) {
            fetch_to_second_cache(next_values + i + line);
        }
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

}  // namespace skybake::occupancy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::occupancy {

HWY_EXPORT(take_voxel_means);
HWY_EXPORT(take_face_means);
HWY_EXPORT(row_extremes);
HWY_EXPORT(promote);
HWY_EXPORT(merge);
HWY_EXPORT(widen_windows);
HWY_EXPORT(face_means_of_fours);
HWY_EXPORT(join);
HWY_EXPORT(magnitudes);

namespace {

// Vectors may reach so many doubles beyond the end of a row.
constexpr std::size_t kVectorRoom = 64 / sizeof(double);

// Begins a list of rows, to be filled by add(y, z) once for each that a node is the mean of.
class NodeRows {
  public:
    NodeRows(const RowBundle& bundle, RowScratch& scratch) : bundle_(bundle), scratch_(scratch) {
        scratch.voxel_rows.clear();
        scratch.face_rows.clear();
    }
    void add(int y, int z) {
        const VoxelRow& row = bundle_.at(y, z);
        scratch_.voxel_rows.push_back(row.voxels);
        scratch_.face_rows.push_back(row.faces);
    }

  private:
    const RowBundle& bundle_;
    RowScratch& scratch_;
};

void make_room(const RowBundle& bundle, NodeExtremes& nodes) {
    nodes.voxels.resize(bundle.length + kVectorRoom + static_cast<std::size_t>(bundle.cell));
    nodes.faces.resize(bundle.cells() + 1 + kVectorRoom);
}

void take_means(const RowBundle& bundle, int rows_a_node, const RowScratch& scratch,
                NodeExtremes& nodes) {
    HWY_DYNAMIC_DISPATCH(take_voxel_means)
    (rows_a_node, scratch.voxel_rows, bundle.length, nodes.voxels);
    HWY_DYNAMIC_DISPATCH(take_face_means)
    (rows_a_node, scratch.face_rows, bundle.cells(), nodes.faces);
}

// The first of the two rows, or planes, about a face.
int first_beside(Face face, int count) { return face == Face::lower ? 0 : count - 2; }

void voxel_extremes(const RowBundle& bundle, RowScratch& scratch) {
    NodeRows rows(bundle, scratch);
    for (int z = 1; z < bundle.depth - 1; ++z) {
        for (int y = 1; y < bundle.height - 1; ++y) rows.add(y, z);
    }
    make_room(bundle, scratch.within);
    scratch.voxels.resize(bundle.length + 2 * kVectorRoom);
    float* least = scratch.voxels.least.data();
    float* most = scratch.voxels.most.data();
    HWY_DYNAMIC_DISPATCH(row_extremes)(scratch.voxel_rows, bundle.length, least, most);
    HWY_DYNAMIC_DISPATCH(promote)(least, bundle.length, scratch.within.voxels.least.data());
    HWY_DYNAMIC_DISPATCH(promote)(most, bundle.length, scratch.within.voxels.most.data());
    HWY_DYNAMIC_DISPATCH(take_face_means)
    (1, scratch.face_rows, bundle.cells(), scratch.within.faces);
}

}  // namespace

Magnitudes magnitudes_of(const float* values, std::size_t count, const float* next) {
    return HWY_DYNAMIC_DISPATCH(magnitudes)(values, count, next);
}

bool means_are_exact(const Magnitudes& magnitudes) {
    if (magnitudes.all_zero()) return true;
    // Denormals are multiples of what the smallest normal's last bit is.
    const auto exponent = [](std::uint32_t bits) { return std::max(bits >> 23, 1U); };
    return exponent(magnitudes.largest) - exponent(magnitudes.smallest) <= 26;
}

void face_means(const float* voxels, std::size_t length, int cell, double* means) {
    assert(length >= 1 && cell >= 1);
    const auto edge = static_cast<std::size_t>(cell);
    means[0] = (double{voxels[length - 1]} + double{voxels[0]}) * 0.5;
    std::size_t k = 1;
    if (cell == 4) k = HWY_DYNAMIC_DISPATCH(face_means_of_fours)(voxels, length, means);
    for (; k * edge < length; ++k) {
        means[k] = (double{voxels[k * edge - 1]} + double{voxels[k * edge]}) * 0.5;
    }
}

void y_face_extremes(const RowBundle& bundle, Face face, RowScratch& scratch, NodeExtremes& nodes) {
    make_room(bundle, nodes);
    const int y = first_beside(face, bundle.height);
    NodeRows rows(bundle, scratch);
    for (int z = 1; z < bundle.depth - 1; ++z) {
        rows.add(y, z);
        rows.add(y + 1, z);
    }
    take_means(bundle, 2, scratch, nodes);
}

void z_face_extremes(const RowBundle& bundle, Face face, RowScratch& scratch, NodeExtremes& nodes) {
    make_room(bundle, nodes);
    const int z = first_beside(face, bundle.depth);
    NodeRows rows(bundle, scratch);
    for (int y = 1; y < bundle.height - 1; ++y) {
        rows.add(y, z);
        rows.add(y, z + 1);
    }
    take_means(bundle, 2, scratch, nodes);
    NodeRows edge_rows(bundle, scratch);
    for (const Face edge : {Face::lower, Face::upper}) {
        const int y = first_beside(edge, bundle.height);
        for (const int row : {y, y + 1}) {
            edge_rows.add(row, z);
            edge_rows.add(row, z + 1);
        }
    }
    take_means(bundle, 4, scratch, nodes);
}

void trilinear_row(const RowBundle& bundle, const std::array<const NodeExtremes*, 4>& faces,
                   RowScratch& scratch, Extremes<double>& cells) {
    const std::size_t length = bundle.length;
    const std::size_t count = bundle.cells();
    voxel_extremes(bundle, scratch);
    std::array<const Extremes<double>*, 5> at_voxels = {&scratch.within.voxels};
    std::array<const Extremes<double>*, 5> at_faces = {&scratch.within.faces};
    for (std::size_t i = 0; i < faces.size(); ++i) {
        at_voxels[i + 1] = &faces[i]->voxels;
        at_faces[i + 1] = &faces[i]->faces;
    }
    NodeExtremes& all = scratch.all;
    make_room(bundle, all);
    HWY_DYNAMIC_DISPATCH(merge)(at_voxels, length, all.voxels);
    HWY_DYNAMIC_DISPATCH(merge)(at_faces, count, all.faces);
    // Windows of the last voxels see nothing beyond the row; after the last cell is the first face.
    const auto end = static_cast<std::ptrdiff_t>(length);
    std::fill(all.voxels.least.begin() + end, all.voxels.least.end(),
              std::numeric_limits<double>::infinity());
    std::fill(all.voxels.most.begin() + end, all.voxels.most.end(),
              -std::numeric_limits<double>::infinity());
    all.faces.least[count] = all.faces.least[0];
    all.faces.most[count] = all.faces.most[0];
    HWY_DYNAMIC_DISPATCH(widen_windows)(length, bundle.cell, all.voxels);
    cells.resize(count + kVectorRoom);
    HWY_DYNAMIC_DISPATCH(join)
    (all.voxels, all.faces, count, static_cast<std::size_t>(bundle.cell), cells);
}

void footprint_row(const RowBundle& bundle, int halo, RowScratch& scratch, float* least,
                   float* most) {
    assert(halo >= 0);
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
