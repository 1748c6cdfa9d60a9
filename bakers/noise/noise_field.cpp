#include "bakers/noise/noise_field.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>

#include "bakers/math/memory.h"
#include "bakers/noise/cell_kernel.h"
#include "bakers/noise/combine_kernel.h"
#include "bakers/noise/scattered_kernel.h"
#include "bakers/noise/stack_filler.h"

namespace skybake::noise {
namespace {

// Chunks are as deep as the blocks of cellular noise, and small enough for the second cache to hold
// what a chunk has of every field.
constexpr int kChunkDepth = 8;
constexpr int kChunkRows = 16;
constexpr std::size_t kChunkFloats = 1 << 14;

// Fewer voxels than this are not worth the set-up of the kernels that share work.
constexpr std::int64_t kPointwiseVoxels = 512;

// Fills a box of voxels, chunk by chunk.
class BoxFiller {
  public:
    BoxFiller(const NoisePlan& plan, const VoxelBox& box, const std::vector<float*>& channels)
        : plan_(plan), box_(box), channels_(channels) {
        constexpr std::size_t kPadding = kLanePadding;
        row_stride_ = (static_cast<std::size_t>(box.size[0]) + kPadding - 1) / kPadding * kPadding;
        const auto rows = static_cast<int>(kChunkFloats / (row_stride_ * kChunkDepth));
        chunk_rows_ = std::min(box.size[1], std::max(kChunkRows, rows / kChunkRows * kChunkRows));
        layout_.row_stride = row_stride_;
        layout_.floats = row_stride_ * static_cast<std::size_t>(chunk_rows_) *
                         static_cast<std::size_t>(std::min(kChunkDepth, box.size[2]));
        layout_.depth = kChunkDepth;
        layout_.pointwise = box.count() <= kPointwiseVoxels;
        prepare();
    }

    void fill() {
        VoxelBox chunk = box_;
        for (int z = 0; z < box_.size[2]; z += kChunkDepth) {
            chunk.origin[2] = box_.origin[2] + z;
            chunk.size[2] = std::min(kChunkDepth, box_.size[2] - z);
            for (int y = 0; y < box_.size[1]; y += chunk_rows_) {
                chunk.origin[1] = box_.origin[1] + y;
                chunk.size[1] = std::min(chunk_rows_, box_.size[1] - y);
                fill_chunk(chunk);
            }
        }
    }

  private:
    bool wanted(std::size_t channel) const {
        return plan_.pack != NoisePacking::none || channels_[channel] != nullptr;
    }

    void prepare() {
        fields_.resize(plan_.fields.size());
        rows_.resize(plan_.fields.size());
        combined_.reserve(std::max<std::size_t>(4, plan_.channels.size()) * row_stride_);
        callers_.resize(plan_.fields.size(), nullptr);
        lattices_.resize(plan_.fields.size());
        gradients_.resize(plan_.channels.size());
        stacks_.resize(plan_.channels.size());
        warps_.resize(plan_.warps.size());
        for (std::size_t c = 0; c < plan_.channels.size(); ++c) {
            const ChannelPlan& channel = plan_.channels[c];
            if (!wanted(c)) continue;
            if (channel.warp >= 0) prepare_warp(static_cast<std::size_t>(channel.warp));
            for (const WeightedField& use : channel.cells) {
                prepare_field(static_cast<std::size_t>(use.field));
            }
            if (!channel.gradient.octaves.empty()) prepare_gradient(c);
            if (is_one_field(channel)) {
                float*& caller = callers_[static_cast<std::size_t>(channel.cells.front().field)];
                if (caller == nullptr) caller = channels_[c];
            }
            all_direct_ = all_direct_ && is_direct(c);
        }
    }

    void prepare_warp(std::size_t index) {
        if (!warps_[index]) warps_[index].emplace(plan_.warps[index], plan_.axes, box_, layout_);
    }

    void prepare_field(std::size_t index) {
        if (!fields_[index].empty()) return;
        fields_[index].reserve(layout_.floats);
        const CellField& field = plan_.fields[index];
        if (has_shared_bumps(field)) {
            lattices_[index] = make_bump_planes(field, box_, kChunkDepth);
            return;
        }
        const bool shared = !is_scattered(field) && is_resolved(plan_.axes, field.frequency);
        if (layout_.pointwise || !shared) return;
        lattices_[index] = make_cell_planes(field, box_, kChunkDepth);
        if (!candidates_) candidates_ = std::make_unique<CellCandidates>();
    }

    void prepare_gradient(std::size_t index) {
        const ChannelPlan& channel = plan_.channels[index];
        gradients_[index].reserve(layout_.floats);
        stacks_[index].emplace(channel.gradient, plan_.axes, box_, layout_, channel.warp >= 0);
    }

    // Narrow bumps are made voxel by voxel.
    bool has_shared_bumps(const CellField& field) const {
        return field.kind == CellKind::alligator && field.warp < 0 && !layout_.pointwise &&
               has_wide_bumps(field);
    }

    bool is_scattered(const CellField& field) const {
        return field.warp >= 0 || (field.kind == CellKind::alligator && !has_shared_bumps(field));
    }

    // The displacements of the chunk at hand; null pointers for no warp.
    DisplacedRows displaced(int warp) {
        return warp < 0 ? DisplacedRows{} : warps_[static_cast<std::size_t>(warp)]->rows();
    }

    void fill_field(std::size_t index, const VoxelBox& chunk) {
        const CellField& field = plan_.fields[index];
        if (is_scattered(field)) {
            fill_scattered_cell_field(field, chunk, row_stride_, displaced(field.warp),
                                      fields_[index].data());
            return;
        }
        if (!lattices_[index]) {
            fill_cell_field_pointwise(field, chunk, row_stride_, fields_[index].data());
            return;
        }
        const CellTarget target = cell_target(index, chunk);
        if (field.kind == CellKind::alligator) {
            fill_bumps(field, chunk, *lattices_[index], bump_squares_, target);
        } else if (has_wide_cells(field)) {
            fill_wide_cells(field, chunk, *lattices_[index], *candidates_, target);
        } else {
            fill_narrow_cells(field, chunk, *lattices_[index], tile_squares_, target);
        }
    }

    CellTarget cell_target(std::size_t index, const VoxelBox& chunk) {
        if (callers_[index] == nullptr) {
            const auto rows = static_cast<std::size_t>(chunk.size[1]);
            return {fields_[index].data(), chunk.origin, row_stride_, rows * row_stride_};
        }
        const std::size_t slice = static_cast<std::size_t>(box_.size[1]) * row_stride_;
        return {callers_[index], box_.origin, row_stride_, slice};
    }

    // Where the channel's gradient sums go.
    SumTarget sum_target(std::size_t index, const VoxelBox& chunk) {
        const ChannelPlan& channel = plan_.channels[index];
        const bool centered =
            channel.type != NoiseType::curl && channel.fractal == NoiseFractal::fbm;
        const float scale = centered ? 0.5f : 1;
        const float offset = centered ? 0.5f : 0;
        const bool direct = is_direct(index);
        const auto rows = static_cast<std::size_t>(direct ? box_.size[1] : chunk.size[1]);
        float* sums = direct ? row_of(channels_[index], chunk, 0, 0) : gradients_[index].data();
        return {sums, row_stride_, rows * row_stride_, scale, offset};
    }

    // True if kernels may write a channel's rows straight to the caller: nothing else becomes of
    // them, and whole vectors end where rows do.
    bool is_bare(const ChannelPlan& channel) const {
        return !channel.is_shaped() && plan_.pack == NoisePacking::none &&
               row_stride_ == static_cast<std::size_t>(box_.size[0]);
    }

    // True if the channel is one field of cells as it is.
    bool is_one_field(const ChannelPlan& channel) const {
        if (channel.type != NoiseType::worley || channel.cells.size() != 1) return false;
        const auto& [field, weight] = channel.cells.front();
        return is_bare(channel) && weight == 1 && lattices_[static_cast<std::size_t>(field)];
    }

    bool is_direct(std::size_t index) const {
        const ChannelPlan& channel = plan_.channels[index];
        if (is_one_field(channel)) {  // other channels may have it, too
            const auto field = static_cast<std::size_t>(channel.cells.front().field);
            return callers_[field] == channels_[index];
        }
        return is_bare(channel) && channel.cells.empty() && stacks_[index] &&
               stacks_[index]->is_separable() && channel.fractal != NoiseFractal::rectified;
    }

    // Row (y, z) of the chunk in an array over the whole box.
    float* row_of(float* base, const VoxelBox& chunk, int y, int z) const {
        const auto slice = static_cast<std::size_t>(chunk.origin[2] - box_.origin[2] + z);
        const auto row = static_cast<std::size_t>(chunk.origin[1] - box_.origin[1] + y);
        return base + (slice * static_cast<std::size_t>(box_.size[1]) + row) *
                          static_cast<std::size_t>(box_.size[0]);
    }

    void fill_chunk(const VoxelBox& chunk) {
        for (std::optional<WarpFiller>& warp : warps_) {
            if (warp) warp->fill(chunk);
        }
        for (std::size_t i = 0; i < fields_.size(); ++i) {
            if (!fields_[i].empty()) fill_field(i, chunk);
        }
        for (std::size_t c = 0; c < plan_.channels.size(); ++c) {
            if (!stacks_[c]) continue;
            stacks_[c]->fill(chunk, displaced(plan_.channels[c].warp), sum_target(c, chunk));
        }
        if (all_direct_) return;
        for (int z = 0; z < chunk.size[2]; ++z) {
            for (int y = 0; y < chunk.size[1]; ++y) write_row(chunk, y, z);
        }
    }

    void write_row(const VoxelBox& chunk, int y, int z) {
        const std::size_t offset = static_cast<std::size_t>(z * chunk.size[1] + y) * row_stride_;
        for (std::size_t i = 0; i < fields_.size(); ++i) {
            rows_[i] = fields_[i].empty() ? nullptr : fields_[i].data() + offset;
            if (callers_[i] != nullptr) rows_[i] = row_of(callers_[i], chunk, y, z);
        }
        const bool packed = plan_.pack != NoisePacking::none;
        for (std::size_t c = 0; c < plan_.channels.size(); ++c) {
            if (!wanted(c) || is_direct(c)) continue;
            const float* gradient = gradients_[c].empty() ? nullptr : gradients_[c].data() + offset;
            float* target = packed ? nullptr : row_of(channels_[c], chunk, y, z);
            // Whole vectors may go straight to the caller where rows end with one.
            const bool whole = !packed && row_stride_ == static_cast<std::size_t>(box_.size[0]);
            combine_channel(plan_.channels[c], gradient, rows_, row_stride_,
                            whole ? target : row(c));
            if (!packed && !whole) copy_row(row(c), target);
        }
        if (!packed || channels_[0] == nullptr) return;
        pack_channels(plan_.pack, {row(0), row(1), row(2), row(3)}, row_stride_, row(0));
        copy_row(row(0), row_of(channels_[0], chunk, y, z));
    }

    float* row(std::size_t channel) { return combined_.data() + channel * row_stride_; }

    void copy_row(const float* from, float* to) const {
        std::memcpy(to, from, static_cast<std::size_t>(box_.size[0]) * sizeof(float));
    }

    const NoisePlan& plan_;
    const VoxelBox& box_;
    const std::vector<float*>& channels_;
    std::size_t row_stride_ = 0;
    ChunkLayout layout_;
    int chunk_rows_ = 0;
    bool all_direct_ = true;             // no channel needs its rows combined
    std::vector<ScratchFloats> fields_;  // of the chunk; empty where no wanted channel has it
    std::vector<float*> callers_;        // per field: the channel over the box that it is, or none
    std::vector<ScratchFloats> gradients_;                // of the chunk, per channel
    std::vector<std::optional<StackFiller>> stacks_;      // per channel; none if it is not wanted
    std::vector<std::optional<WarpFiller>> warps_;        // none if no wanted channel has it
    std::vector<std::optional<LatticePlanes>> lattices_;  // none: pointwise
    std::unique_ptr<CellCandidates> candidates_;
    AlignedFloats tile_squares_, bump_squares_;  // room for kernels
    std::vector<const float*> rows_;  // of the fields, the row at hand
    ScratchFloats combined_;          // a row of each channel
};

}  // namespace

NoiseField::NoiseField(NoisePlan plan) : plan_(std::move(plan)) {}

void NoiseField::fill(const VoxelBox& box, const std::vector<float*>& channels) const {
    BoxFiller(plan_, box, channels).fill();
}

}  // namespace skybake::noise
