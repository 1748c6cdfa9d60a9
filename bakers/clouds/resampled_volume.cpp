#include "bakers/clouds/resampled_volume.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "bakers/clouds/tile_pieces.h"

namespace skybake::cloud {
namespace {

using config::VolumeWrap;

std::int64_t divided_down(std::int64_t number, std::int64_t by) {
    const std::int64_t quotient = number / by;
    return number % by < 0 ? quotient - 1 : quotient;
}

// `to` is at least `from`.
AxisTaps linear_taps(std::int64_t from, std::int64_t to, std::int64_t i) {
    // (i + 1/2) from / to - 1/2, over 2 to.
    const std::int64_t position = (2 * i + 1) * from - to;
    const std::int64_t below = divided_down(position, 2 * to);
    const std::int64_t beyond = position - below * 2 * to;
    const auto whole = static_cast<double>(2 * to);
    AxisTaps taps{static_cast<int>(below), {static_cast<double>(2 * to - beyond) / whole}};
    if (beyond > 0) taps.weights.push_back(static_cast<double>(beyond) / whole);
    return taps;
}

// `to` is below `from`. Voxel k of the source reaches from k to k + 1 times `to`.
AxisTaps mean_taps(std::int64_t from, std::int64_t to, std::int64_t i) {
    const std::int64_t begin = i * from;
    const std::int64_t end = begin + from;
    AxisTaps taps{static_cast<int>(begin / to), {}};
    for (std::int64_t k = begin / to; k * to < end; ++k) {
        const std::int64_t shared = std::min(end, (k + 1) * to) - std::max(begin, k * to);
        taps.weights.push_back(static_cast<double>(shared) / static_cast<double>(from));
    }
    return taps;
}

// One box of a result while it is made. The source is read in pieces of few slices and rows, and its
// means along x and y are added up slice by slice.
class BoxMaker {
  public:
    BoxMaker(const std::array<std::vector<AxisTaps>, 3>& taps, const VoxelBox& box)
        : taps_(taps),
          box_(box),
          columns_(static_cast<std::size_t>(box.size[0])),
          plane_(columns_ * static_cast<std::size_t>(box.size[1])),
          sums_(plane_ * static_cast<std::size_t>(box.size[2]), 0.0) {}

    // Forgets the slices at hand; `depth` slices of the source follow, from `first` on.
    void begin_slices(int first, int depth) {
        first_slice_ = first;
        slices_.assign(static_cast<std::size_t>(depth) * plane_, 0.0);
    }

    // Takes some rows of those slices.
    void add_rows(const VoxelBox& piece, const std::vector<float>& values) {
        std::vector<double> row(columns_);
        const float* from = values.data();
        for (int z = 0; z < piece.size[2]; ++z) {
            double* slice = slices_.data() + static_cast<std::size_t>(z) * plane_;
            for (int y = 0; y < piece.size[1]; ++y, from += piece.size[0]) {
                make_row(from - piece.origin[0], row);
                add_row(row, piece.origin[1] + y, slice);
            }
        }
    }

    void end_slices() {
        const auto depth = static_cast<int>(slices_.size() / plane_);
        for (int z = 0; z < depth; ++z) {
            const double* slice = slices_.data() + static_cast<std::size_t>(z) * plane_;
            for (int k = 0; k < box_.size[2]; ++k) {
                const double weight = weight_of(2, k, first_slice_ + z);
                if (weight == 0) continue;
                double* to = sums_.data() + static_cast<std::size_t>(k) * plane_;
                for (std::size_t i = 0; i < plane_; ++i) to[i] += weight * slice[i];
            }
        }
    }

    void store(float* out) const {
        for (const double sum : sums_) *out++ = static_cast<float>(sum);
    }

  private:
    const AxisTaps& taps(std::size_t axis, int i) const {
        return taps_[axis][static_cast<std::size_t>(box_.origin[axis] + i)];
    }

    // Returns the weight of a voxel of the source in voxel i of the box, along an axis.
    double weight_of(std::size_t axis, int i, int voxel) const {
        const AxisTaps& of_voxel = taps(axis, i);
        const int at = voxel - of_voxel.first;
        if (at < 0 || at >= static_cast<int>(of_voxel.weights.size())) return 0;
        return of_voxel.weights[static_cast<std::size_t>(at)];
    }

    // `source` points to where voxel 0 of the row would be.
    void make_row(const float* source, std::vector<double>& row) const {
        for (std::size_t i = 0; i < columns_; ++i) {
            const AxisTaps& of_voxel = taps(0, static_cast<int>(i));
            const float* from = source + of_voxel.first;
            double sum = 0;
            for (const double weight : of_voxel.weights) sum += weight * double{*from++};
            row[i] = sum;
        }
    }

    void add_row(const std::vector<double>& row, int source_y, double* slice) const {
        for (int y = 0; y < box_.size[1]; ++y) {
            const double weight = weight_of(1, y, source_y);
            if (weight == 0) continue;
            double* to = slice + static_cast<std::size_t>(y) * columns_;
            for (std::size_t i = 0; i < columns_; ++i) to[i] += weight * row[i];
        }
    }

    const std::array<std::vector<AxisTaps>, 3>& taps_;
    const VoxelBox& box_;
    const std::size_t columns_;
    const std::size_t plane_;     // voxels of a slice of the box
    std::vector<double> sums_;    // of the box
    std::vector<double> slices_;  // of the source, with rows and columns of the box
    int first_slice_ = 0;
};

}  // namespace

std::vector<AxisTaps> axis_taps(int from, int to) {
    std::vector<AxisTaps> taps;
    for (int i = 0; i < to; ++i) {
        taps.push_back(to < from ? mean_taps(from, to, i) : linear_taps(from, to, i));
    }
    return taps;
}

ResampledVolume::ResampledVolume(CloudVolume volume, const std::array<int, 3>& size)
    : volume_(std::move(volume)), size_(size) {
    for (std::size_t i = 0; i < 3; ++i) taps_[i] = axis_taps(volume_.source.size[i], size[i]);
}

// Returns the voxels of the source that a box takes. They may lie beyond the source.
VoxelBox ResampledVolume::taken(const VoxelBox& box) const {
    VoxelBox source;
    for (std::size_t i = 0; i < 3; ++i) {
        const AxisTaps& last = taps_[i][static_cast<std::size_t>(box.origin[i] + box.size[i] - 1)];
        source.origin[i] = taps_[i][static_cast<std::size_t>(box.origin[i])].first;
        source.size[i] = last.first + static_cast<int>(last.weights.size()) - source.origin[i];
    }
    return source;
}

void ResampledVolume::read_source(const VoxelBox& box, float* values) const {
    const VoxelSource& voxels = *volume_.source.voxels;
    if (volume_.wrap == VolumeWrap::empty) return voxels.fill(box, {values});
    const std::array<int, 3>& size = volume_.source.size;
    std::vector<float> piece;
    for (const AxisPiece& rows : wrapped_pieces(box.origin[1], box.size[1], size[1])) {
        for (const AxisPiece& columns : wrapped_pieces(box.origin[0], box.size[0], size[0])) {
            const VoxelBox source{{columns.source, rows.source, box.origin[2]},
                                  {columns.size, rows.size, box.size[2]}};
            piece.resize(static_cast<std::size_t>(source.count()));
            voxels.fill(source, {piece.data()});
            copy_piece(box, columns, rows, piece.data(), values);
        }
    }
}

// A box that reaches beyond a side counts as one that reaches from side to side.
bool ResampledVolume::source_is_empty(VoxelBox box) const {
    for (std::size_t i = 0; i < 2; ++i) {
        const int end = box.origin[i] + box.size[i];
        const bool is_within = box.origin[i] >= 0 && end <= volume_.source.size[i];
        if (volume_.wrap == VolumeWrap::empty || is_within) continue;
        box.origin[i] = 0;
        box.size[i] = volume_.source.size[i];
    }
    return volume_.source.voxels->is_empty(box);
}

bool ResampledVolume::is_empty(const VoxelBox& box) const { return source_is_empty(taken(box)); }

void ResampledVolume::fill(const VoxelBox& box, const std::vector<float*>& channels) const {
    if (volume_.source.size == size_) return volume_.source.voxels->fill(box, channels);
    // A piece of the source has at most this many voxels, unless a row of it has more.
    constexpr std::int64_t most_voxels = 1 << 19;
    constexpr int most_slices = 8;  // as many as leaves of OpenVDB have
    const VoxelBox source = taken(box);
    BoxMaker maker(taps_, box);
    std::vector<float> values;
    VoxelBox piece = source;
    const int end = source.origin[2] + source.size[2];
    for (; piece.origin[2] < end; piece.origin[2] += piece.size[2]) {
        piece.size[2] = std::min(most_slices, end - piece.origin[2]);
        maker.begin_slices(piece.origin[2], piece.size[2]);
        const std::int64_t row = std::int64_t{source.size[0]} * piece.size[2];
        const auto rows = static_cast<int>(std::max<std::int64_t>(1, most_voxels / row));
        const int last = source.origin[1] + source.size[1];
        for (piece.origin[1] = source.origin[1]; piece.origin[1] < last; piece.origin[1] += rows) {
            piece.size[1] = std::min(rows, last - piece.origin[1]);
            if (source_is_empty(piece)) continue;
            values.resize(static_cast<std::size_t>(piece.count()));
            read_source(piece, values.data());
            maker.add_rows(piece, values);
        }
        maker.end_slices();
    }
    maker.store(channels[0]);
}

}  // namespace skybake::cloud
