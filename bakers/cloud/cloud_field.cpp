#include "bakers/cloud/cloud_field.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>
#include <utility>

#include "bakers/cloud/column_field.h"
#include "bakers/cloud/shape_kernel.h"
#include "bakers/core/aligned_floats.h"

namespace skybake::cloud {

namespace {

// Regions that are proved empty or not: small enough to follow a cloud's outline, large enough for
// the noise kernels, which share work within a box.
constexpr int kBrickWidth = 32;
constexpr int kBrickRows = 16;
constexpr int kBrickDepth = 8;

// The greatest values over the columns of a brick.
struct ColumnBound {
    float towers = -std::numeric_limits<float>::infinity();
    float offset = -std::numeric_limits<float>::infinity();
};

std::vector<ColumnBound> column_bounds(const Columns& columns) {
    std::vector<ColumnBound> bounds(
        static_cast<std::size_t>((columns.width + kBrickWidth - 1) / kBrickWidth));
    std::size_t at = 0;
    for (int row = 0; row < columns.rows; ++row) {
        for (int x = 0; x < columns.width; ++x, ++at) {
            ColumnBound& bound = bounds[static_cast<std::size_t>(x / kBrickWidth)];
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

// Neighbouring bricks that are not proved empty, as one.
std::vector<Run> runs_of(const CloudPlan& plan, const std::vector<ColumnBound>& bounds,
                         float profile, int width) {
    constexpr int kLongest = 16 * kBrickWidth;  // what the second cache holds of a brick's depth
    std::vector<Run> runs;
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        if (!can_exceed_level(plan, bounds[i], profile)) continue;
        const int first = static_cast<int>(i) * kBrickWidth;
        const int last = std::min(first + kBrickWidth, width);
        if (!runs.empty() && runs.back().last == first && last - runs.back().first <= kLongest) {
            runs.back().last = last;
        } else {
            runs.push_back({first, last});
        }
    }
    return runs;
}

class BoxFiller {
  public:
    BoxFiller(const CloudPlan& plan, const VoxelBox& box, const std::vector<float*>& channels)
        : plan_(plan), box_(box), channels_(channels), made_(channels.size()) {}

    void fill() {
        fill_plain_channels();
        if (!wants_shape()) return;
        for (int y = 0; y < box_.size[1]; y += kBrickRows) {
            VoxelBox chunk = box_;
            chunk.origin[1] += y;
            chunk.size[1] = std::min(kBrickRows, box_.size[1] - y);
            columns_ =
                make_columns(plan_, box_.origin[0], box_.size[0], chunk.origin[1], chunk.size[1]);
            const std::vector<ColumnBound> bounds = column_bounds(columns_);
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
        const bool wanted = std::any_of(plain.begin(), plain.end(),
                                        [](const float* channel) { return channel != nullptr; });
        if (wanted) plan_.base->fill(box_, plain);
    }

    void fill_chunk(const VoxelBox& chunk, const std::vector<ColumnBound>& bounds) {
        clear(chunk);
        const float profile = profile_bound(plan_, chunk.origin[2], chunk.size[2]);
        for (const Run& run : runs_of(plan_, bounds, profile, box_.size[0])) {
            VoxelBox part = chunk;
            part.origin[0] += run.first;
            part.size[0] = run.last - run.first;
            fill_part(part);
        }
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

    ColumnRow columns_at(int x, int y, const VoxelBox& part) const {
        // columns_ begin at the part's first row and the box's first column.
        const std::size_t at = static_cast<std::size_t>(y - part.origin[1]) *
                                   static_cast<std::size_t>(columns_.width) +
                               static_cast<std::size_t>(x - box_.origin[0]);
        ColumnRow row{columns_.towers.data() + at, columns_.offset.data() + at};
        if (plan_.type_map) {
            row.second_type = columns_.second_type.data() + at;
            row.third_type = columns_.third_type.data() + at;
        }
        return row;
    }

    void fill_part(const VoxelBox& part) {
        const auto count = static_cast<std::size_t>(part.count());
        std::vector<float*> targets(channels_.size(), nullptr);
        for (std::size_t c = 0; c < shaped_channels(); ++c) {
            if (channels_[c] == nullptr) continue;
            made_[c].resize(count);
            targets[c] = made_[c].data();
        }
        plan_.base->fill(part, targets);
        bool has_detail = false;
        for (std::size_t c = 0; c < shaped_channels(); ++c) {
            if (channels_[c] == nullptr || !shape(part, made_[c])) continue;
            if (plan_.detail && !has_detail) {
                detail_.resize(count);
                plan_.detail->fill(part, {detail_.data()});
                has_detail = true;
            }
            finish_part(part, made_[c], channels_[c]);
        }
    }

    // False where all is proved to be nothing.
    bool shape(const VoxelBox& part, AlignedFloats& values) const {
        const auto width = static_cast<std::size_t>(part.size[0]);
        bool any = false;
        float* row = values.data();
        for_each_row(part, [&](int y, int z) {
            const SliceShape& slice = plan_.slices[static_cast<std::size_t>(z)];
            any |=
                shape_base(slice, columns_at(part.origin[0], y, part), plan_.level(), width, row);
            row += width;
        });
        return any;
    }

    void finish_part(const VoxelBox& part, AlignedFloats& values, float* channel) const {
        const auto width = static_cast<std::size_t>(part.size[0]);
        std::size_t at = 0;
        for_each_row(part, [&](int y, int z) {
            float* const row = values.data() + at;
            if (plan_.detail) {
                erode(plan_.slices[static_cast<std::size_t>(z)], detail_.data() + at, plan_.level(),
                      width, row);
            }
            finish(plan_, width, row);
            std::memcpy(channel + place(part.origin[0], y, z), row, width * sizeof(float));
            at += width;
        });
    }

    const CloudPlan& plan_;
    const VoxelBox& box_;
    const std::vector<float*>& channels_;
    Columns columns_;
    std::vector<AlignedFloats> made_;  // per channel, of the part at hand
    AlignedFloats detail_;
};

}  // namespace

CloudField::CloudField(CloudPlan plan) : plan_(std::move(plan)) {}

void CloudField::fill(const VoxelBox& box, const std::vector<float*>& channels) const {
    BoxFiller(plan_, box, channels).fill();
}

bool CloudField::is_empty(const VoxelBox& box) const {
    if (plan_.channels > plan_.shaped_channels) return false;
    const Columns columns =
        make_columns(plan_, box.origin[0], box.size[0], box.origin[1], box.size[1]);
    const float profile = profile_bound(plan_, box.origin[2], box.size[2]);
    return runs_of(plan_, column_bounds(columns), profile, box.size[0]).empty();
}

}  // namespace skybake::cloud
