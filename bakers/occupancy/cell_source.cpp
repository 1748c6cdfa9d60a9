#include "bakers/occupancy/cell_source.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "bakers/core/pixel_type.h"
#include "bakers/occupancy/leap_distance.h"

namespace skybake::occupancy {

namespace {

using config::OccupancyContent;
using config::PixelType;

constexpr float kFarthestLeap = 255;

// From a half to the next above it: at most so much.
float half_step(float half) {
    constexpr int kSmallestExponent = -14;
    constexpr int kMantissaBits = 10;
    const int exponent = half == 0 ? kSmallestExponent : std::ilogb(half);
    return std::ldexp(1.0f, std::max(exponent, kSmallestExponent) - kMantissaBits);
}

// The nearest value of the type and its neighbour upwards.
float next_up(float stored, PixelType type) {
    if (type == PixelType::half) return stored + half_step(stored);
    const double steps = type == PixelType::unorm8 ? 255 : 65535;
    return static_cast<float>((std::round(stored * steps) + 1) / steps);
}

}  // namespace

float stored_up(float value, PixelType type) {
    const float nearest = round_to_pixel_type(value, type);
    return nearest < value ? next_up(nearest, type) : nearest;
}

float stored_down(float value, PixelType type) {
    const float nearest = round_to_pixel_type(value, type);
    if (nearest <= value) return nearest;
    if (type == PixelType::half) return -stored_up(-value, type);
    const double steps = type == PixelType::unorm8 ? 255 : 65535;
    return static_cast<float>((std::round(nearest * steps) - 1) / steps);
}

CellSource::CellSource(CellRanges ranges, OccupiedCells occupied,
                       std::vector<OccupancyContent> contents, PixelType pixel_type)
    : ranges_(std::move(ranges)),
      occupied_(std::move(occupied)),
      leap_(leap_distance(occupied_)),
      contents_(std::move(contents)),
      pixel_type_(pixel_type) {}

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
