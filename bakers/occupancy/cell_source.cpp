#include "bakers/occupancy/cell_source.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "bakers/field/pixel_type.h"
#include "bakers/math/half_conversion.h"
#include "bakers/occupancy/leap_distance.h"
#include "config/assets/occupancy.h"

namespace skybake::occupancy {

namespace {

using config::OccupancyContent;
using config::PixelType;

constexpr float kFarthestLeap = 255;

// The next half above one that is not infinite.
float next_half_up(float half) {
    const std::uint16_t bits = half_of_float(half);
    if ((bits & 0x7fffU) == 0) return float_of_half(1);  // 0, whatever its sign
    const bool negative = (bits & 0x8000U) != 0;
    return float_of_half(static_cast<std::uint16_t>(negative ? bits - 1 : bits + 1));
}

double steps_of(PixelType type) { return type == PixelType::unorm8 ? 255 : 65535; }

}  // namespace

float stored_up(float value, PixelType type) {
    if (type == PixelType::float32) return value;
    if (type == PixelType::half) {
        const float nearest = round_to_pixel_type(value, type);
        return nearest < value ? next_half_up(nearest) : nearest;
    }
    // In double, where no product of a float and 65535 is rounded.
    return static_cast<float>(std::ceil(double{value} * steps_of(type)) / steps_of(type));
}

float stored_down(float value, PixelType type) {
    if (type == PixelType::float32) return value;
    if (type == PixelType::half) return -stored_up(-value, type);
    return static_cast<float>(std::floor(double{value} * steps_of(type)) / steps_of(type));
}

CellSource::CellSource(CellRanges ranges, OccupiedCells occupied,
                       std::vector<OccupancyContent> contents, PixelType pixel_type)
    : ranges_(std::move(ranges)),
      occupied_(std::move(occupied)),
      contents_(std::move(contents)),
      pixel_type_(pixel_type) {
    const bool leaps =
        std::find(contents_.begin(), contents_.end(), OccupancyContent::leap) != contents_.end();
    if (leaps) leap_ = leap_distance(occupied_);
}

float CellSource::value(OccupancyContent content, std::size_t cell) const {
    switch (content) {
        case OccupancyContent::occupied:
            return occupied_.occupied[cell];
        case OccupancyContent::minimum:
            return stored_down(ranges_.minimum[cell], pixel_type_);
        case OccupancyContent::maximum:
            return stored_up(ranges_.maximum[cell], pixel_type_);
        case OccupancyContent::leap:
            break;
    }
    const bool unorm = pixel_type_ == PixelType::unorm8 || pixel_type_ == PixelType::unorm16;
    return unorm ? static_cast<float>(leap_[cell]) / kFarthestLeap
                 : static_cast<float>(leap_[cell]);
}

void CellSource::fill(const VoxelBox& box, const std::vector<float*>& channels) const {
    for (std::size_t c = 0; c < channels.size(); ++c) {
        if (channels[c] == nullptr) continue;
        float* out = channels[c];
        for (int z = 0; z < box.size[2]; ++z) {
            for (int y = 0; y < box.size[1]; ++y) {
                const std::size_t row =
                    index_of(ranges_.size, box.origin[0], box.origin[1] + y, box.origin[2] + z);
                const auto width = static_cast<std::size_t>(box.size[0]);
                for (std::size_t x = 0; x < width; ++x) *out++ = value(contents_[c], row + x);
            }
        }
    }
}

}  // namespace skybake::occupancy
