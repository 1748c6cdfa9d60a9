#include "bakers/clouds/cloud_field.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "bakers/clouds/shape_kernel.h"
#include "bakers/math/memory.h"

namespace skybake::cloud {
namespace {

// Regions that are proved empty or not: small enough to follow a cloud's outline, large enough for
// the noise kernels, which share work within a box.
constexpr int kBrickWidth = 32;
constexpr int kBrickRows = 16;
constexpr int kBrickDepth = 8;

// So many columns are made once for all boxes: 32 MiB at most, with a type map.
constexpr std::int64_t kKeptColumns = 1 << 21;

// The greatest values over the columns of a brick.
struct ColumnBound {
    float towers = -std::numeric_limits<float>::infinity();
    float offset = -std::numeric_limits<float>::infinity();
};

// Over the bricks of columns x ... x + width - 1, y ... y + rows - 1.
std::vector<ColumnBound> column_bounds(const Columns& columns, int first_x, int width, int first_y,
                                       int rows) {
    std::vector<ColumnBound> bounds(
        static_cast<std::size_t>((width + kBrickWidth - 1) / kBrickWidth));
    for (int y = first_y; y < first_y + rows; ++y) {
        const std::size_t row = columns.index(first_x, y);
        for (int x = 0; x < width; ++x) {
            ColumnBound& bound = bounds[static_cast<std::size_t>(x / kBrickWidth)];
            const std::size_t at = row + static_cast<std::size_t>(x);
            bound.towers = std::max(bound.towers, columns.towers[at]);
            bound.offset = std::max(bound.offset, columns.offset[at]);
        }
    }
    return bounds;
}

// The greatest profile of slices.
float profile_bound(const CloudPlan& plan, int first_z, int depth) {
    float bound = 0;
    for (int z = first_z; z < first_z + depth; ++z) {
        for (const float profile : plan.slices[static_cast<std::size_t>(z)].profile) {
            bound = std::max(bound, profile);
        }
    }
    // A blend of three rounds at most six times, by half of 2^-23 of 1 each.
    constexpr float kBlendRoom = 4e-7f;
    return plan.type_map ? bound + kBlendRoom : bound;
}

// Each step rounds monotonically, so that what holds for real numbers holds for floats.
bool can_exceed_level(const CloudPlan& plan, const ColumnBound& columns, float profile) {
    return !(plan.noise_bound * (profile + columns.towers) + columns.offset <= plan.level());
}

// Columns [first, last) of a box.
struct Run {
    int first = 0;
    int last = 0;
};

// Neighbouring bricks of which `wanted(brick)` holds, as one, in a box of `width` columns.
template <class Wanted>
std::vector<Run> runs_of(int width, const Wanted& wanted) {
    constexpr int kLongest = 16 * kBrickWidth;  // the part of a brick that the second cache holds
    std::vector<Run> runs;
    for (int first = 0; first < width; first += kBrickWidth) {
        if (!wanted(static_cast<std::size_t>(first / kBrickWidth))) continue;
        const int last = std::min(first + kBrickWidth, width);
        if (!runs.empty() && runs.back().last == first && last - runs.back().first <= kLongest) {
            runs.back().last = last;
        } else {
            runs.push_back({first, last});
        }
    }
    return runs;
}

// The part of a box that a run of its columns is.
VoxelBox part_of(const VoxelBox& box, const Run& run) {
    VoxelBox part = box;
    part.origin[0] += run.first;
    part.size[0] = run.last - run.first;
    return part;
}

class BoxFiller {
  public:
    // `all_columns` are those of the plan, or none.
    BoxFiller(const CloudPlan& plan, const Columns& all_columns, const VoxelBox& box,
              const std::vector<float*>& channels)
        : plan_(plan),
          all_columns_(all_columns),
          box_(box),
          channels_(channels),
          made_(channels.size()) {}

    void fill() {
        fill_plain_channels();
        if (!wants_shape()) return;
        for (int y = 0; y < box_.size[1]; y += kBrickRows) {
            VoxelBox chunk = box_;
            chunk.origin[1] += y;
            chunk.size[1] = std::min(kBrickRows, box_.size[1] - y);
            columns_ = &all_columns_;
            if (all_columns_.width == 0) {
                own_columns_ = make_columns(plan_, box_.origin[0], box_.size[0], chunk.origin[1],
                                            chunk.size[1]);
                columns_ = &own_columns_;
            }
            const std::vector<ColumnBound> bounds = column_bounds(
                *columns_, box_.origin[0], box_.size[0], chunk.origin[1], chunk.size[1]);
            for (int z = 0; z < box_.size[2]; z += kBrickDepth) {
                chunk.origin[2] = box_.origin[2] + z;
                chunk.size[2] = std::min(kBrickDepth, box_.size[2] - z);
                fill_chunk(chunk, bounds);
            }
        }
    }

  private:
    std::size_t shaped_channels() const { return static_cast<std::size_t>(plan_.shaped_channels); }

    bool wants_shape() const {
        return std::any_of(channels_.begin(), channels_.begin() + plan_.shaped_channels,
                           [](const float* channel) { return channel != nullptr; });
    }

    // Channels that are noise as it is.
    void fill_plain_channels() const {
        std::vector<float*> plain = channels_;
        std::fill(plain.begin(), plain.begin() + plan_.shaped_channels, nullptr);
        const bool wanted =
            std::ranges::any_of(plain, [](const float* channel) { return channel != nullptr; });
        if (wanted) plan_.fill_shape(box_, plain);
    }

    void fill_chunk(const VoxelBox& chunk, const std::vector<ColumnBound>& bounds) {
        clear(chunk);
        const float profile = profile_bound(plan_, chunk.origin[2], chunk.size[2]);
        const auto may_hold = [&](std::size_t brick) {
            return can_exceed_level(plan_, bounds[brick], profile) && !is_empty(chunk, brick);
        };
        for (const Run& run : runs_of(box_.size[0], may_hold)) fill_part(part_of(chunk, run));
    }

    // Whether the brick of a chunk is known to be empty by what the cloud is made of.
    bool is_empty(const VoxelBox& chunk, std::size_t brick) const {
        const int first = static_cast<int>(brick) * kBrickWidth;
        return plan_.is_empty(
            part_of(chunk, {first, std::min(first + kBrickWidth, chunk.size[0])}));
    }

    template <class Visit>
    static void for_each_row(const VoxelBox& box, const Visit& visit) {
        for (int z = box.origin[2]; z < box.origin[2] + box.size[2]; ++z) {
            for (int y = box.origin[1]; y < box.origin[1] + box.size[1]; ++y) visit(y, z);
        }
    }

    // Where voxel (x, y, z) of a channel belongs.
    std::size_t place(int x, int y, int z) const {
        const auto row =
            static_cast<std::size_t>(z - box_.origin[2]) * static_cast<std::size_t>(box_.size[1]) +
            static_cast<std::size_t>(y - box_.origin[1]);
        return row * static_cast<std::size_t>(box_.size[0]) +
               static_cast<std::size_t>(x - box_.origin[0]);
    }

    void clear(const VoxelBox& chunk) const {
        for (std::size_t c = 0; c < shaped_channels(); ++c) {
            if (channels_[c] == nullptr) continue;
            for_each_row(chunk, [&](int y, int z) {
                std::memset(channels_[c] + place(chunk.origin[0], y, z), 0,
                            static_cast<std::size_t>(chunk.size[0]) * sizeof(float));
            });
        }
    }

    ColumnRow columns_at(int x, int y) const {
        const std::size_t at = columns_->index(x, y);
        ColumnRow row{columns_->towers.data() + at, columns_->offset.data() + at};
        if (plan_.type_map) {
            row.second_type = columns_->second_type.data() + at;
            row.third_type = columns_->third_type.data() + at;
        }
        return row;
    }

    const SliceShape& slice(int z) const { return plan_.slices[static_cast<std::size_t>(z)]; }

    void fill_part(const VoxelBox& part) {
        const auto count = static_cast<std::size_t>(part.count());
        std::vector<float*> targets(channels_.size(), nullptr);
        for (std::size_t c = 0; c < shaped_channels(); ++c) {
            if (channels_[c] == nullptr) continue;
            made_[c].resize(count);
            targets[c] = made_[c].data();
        }
        plan_.fill_shape(part, targets);
        for (std::size_t c = 0; c < shaped_channels(); ++c) {
            if (channels_[c] != nullptr) shape(part, c);
        }
    }

    // From the channel's base noise of the part to the caller's voxels, brick by brick: most of
    // what bounds leave is empty all the same, and needs no detail noise.
    void shape(const VoxelBox& part, std::size_t channel) {
        const auto width = static_cast<std::size_t>(part.size[0]);
        std::vector<char> holds((width + kBrickWidth - 1) / kBrickWidth, 0);
        float* row = made_[channel].data();
        for_each_row(part, [&](int y, int z) {
            for (std::size_t brick = 0; brick < holds.size(); ++brick) {
                const std::size_t x = brick * kBrickWidth;
                const std::size_t count = std::min<std::size_t>(kBrickWidth, width - x);
                const bool above =
                    shape_base(slice(z), columns_at(part.origin[0] + static_cast<int>(x), y),
                               plan_.level(), count, row + x);
                holds[brick] = static_cast<char>(holds[brick] | static_cast<char>(above));
            }
            row += width;
        });
        const auto is_held = [&](std::size_t brick) { return holds[brick] != 0; };
        for (const Run& run : runs_of(part.size[0], is_held)) {
            finish_run(part, run, made_[channel], channels_[channel]);
        }
    }

    // `values` are those of the part.
    void finish_run(const VoxelBox& part, const Run& run, AlignedFloats& values, float* channel) {
        const VoxelBox cut = part_of(part, run);
        const auto width = static_cast<std::size_t>(cut.size[0]);
        if (plan_.detail) {
            detail_.resize(static_cast<std::size_t>(cut.count()));
            plan_.fill_detail(cut, detail_.data());
        }
        float* row = values.data() + run.first;
        const float* detail = detail_.data();
        for_each_row(cut, [&](int y, int z) {
            if (plan_.detail) erode(slice(z), detail, plan_.level(), width, row);
            finish(plan_, slice(z).water, width, row);
            std::memcpy(channel + place(cut.origin[0], y, z), row, width * sizeof(float));
            row += part.size[0];
            detail += width;
        });
    }

    const CloudPlan& plan_;
    const Columns& all_columns_;
    const VoxelBox& box_;
    const std::vector<float*>& channels_;
    const Columns* columns_ = nullptr;  // hold the columns of the rows at hand
    Columns own_columns_;
    std::vector<AlignedFloats> made_;  // per channel, of the part at hand
    AlignedFloats detail_;
};

}  // namespace

CloudField::CloudField(CloudPlan plan) : plan_(std::move(plan)) {
    if (std::int64_t{plan_.size[0]} * plan_.size[1] > kKeptColumns) return;
    columns_ = make_columns(plan_, 0, plan_.size[0], 0, plan_.size[1]);
}

void CloudField::fill(const VoxelBox& box, const std::vector<float*>& channels) const {
    fill_cloud(plan_, columns_, box, channels);
}

void fill_cloud(const CloudPlan& plan, const Columns& columns, const VoxelBox& box,
                const std::vector<float*>& channels) {
    if (!plan.flow) return BoxFiller(plan, columns, box, channels).fill();
    std::vector<float*> wanted = channels;
    AlignedFloats density(static_cast<std::size_t>(box.count()));
    if (wanted.front() == nullptr) wanted.front() = density.data();
    BoxFiller(plan, columns, box, wanted).fill();
    for (std::size_t c = 1; c < wanted.size(); ++c) {
        for (std::int64_t i = 0; wanted[c] != nullptr && i < box.count(); ++i) {
            if (!(wanted.front()[i] > 0)) wanted[c][i] = 0;
        }
    }
}

bool CloudField::is_empty(const VoxelBox& box) const {
    if (plan_.channels > plan_.shaped_channels && !plan_.flow) return false;
    if (plan_.is_empty(box)) return true;
    const auto [x, y, z] = box.origin;
    const auto [width, rows, depth] = box.size;
    Columns own_columns;
    if (columns_.width == 0) own_columns = make_columns(plan_, x, width, y, rows);
    const Columns& columns = columns_.width > 0 ? columns_ : own_columns;
    const std::vector<ColumnBound> bounds = column_bounds(columns, x, width, y, rows);
    const float profile = profile_bound(plan_, z, depth);
    return std::ranges::none_of(
        bounds, [&](const ColumnBound& bound) { return can_exceed_level(plan_, bound, profile); });
}

}  // namespace skybake::cloud
