#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/noise/torus_energy.cpp"
#include <hwy/foreach_target.h>
// Highway wants its own header after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bakers/math/transcendental.h"
#include "bakers/noise/torus_energy.h"

HWY_BEFORE_NAMESPACE();
namespace skybake::noise::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Adds weights, in rows of `stride`, to the keys of a tile in rows of kTileEdge, of which those within
// `width` and `height` count. Returns their least, and the complement of their greatest.
std::array<std::int64_t, 2> add_weights(const std::int64_t* HWY_RESTRICT weights,
                                        std::size_t stride, std::size_t width, std::size_t height,
                                        std::int64_t* HWY_RESTRICT keys) {
    const hn::CappedTag<std::int64_t, kTileEdge> d;
    auto least = hn::Set(d, std::numeric_limits<std::int64_t>::max());
    auto greatest = hn::Set(d, std::numeric_limits<std::int64_t>::min());
    for (std::size_t x = 0; x < width; x += hn::Lanes(d)) {
        const auto inside = hn::FirstN(d, width - x);
        for (std::size_t y = 0; y < height; ++y) {
            std::int64_t* at = keys + y * kTileEdge + x;
            const auto key = hn::Add(hn::Load(d, at), hn::LoadU(d, weights + y * stride + x));
            hn::Store(key, d, at);
            least = hn::Min(least, hn::IfThenElse(inside, key, least));
            greatest = hn::Max(greatest, hn::IfThenElse(inside, key, greatest));
        }
    }
    return {hn::GetLane(hn::MinOfLanes(d, least)), ~hn::GetLane(hn::MaxOfLanes(d, greatest))};
}

}  // namespace skybake::noise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake::noise {
namespace {

HWY_EXPORT(add_weights);

constexpr std::size_t kTile = kTileEdge * kTileEdge;
constexpr std::int64_t kFree = std::numeric_limits<std::int64_t>::min();  // no energy

std::int64_t weight(double squared_distance, double sigma) {
    return std::llround(kStampUnit * exponential(-squared_distance / (2 * sigma * sigma)));
}

// The largest distance along an axis at which a weight is above 0.
int reach_of(double sigma) {
    int reach = 0;
    while (weight((reach + 1.0) * (reach + 1.0), sigma) > 0) ++reach;
    return reach;
}

std::size_t tiles_along(std::size_t pixels) { return (pixels + kTileEdge - 1) / kTileEdge; }

}  // namespace

TorusEnergy::TorusEnergy(const std::array<int, 3>& size, double spatial_sigma,
                         double temporal_sigma)
    : width_(static_cast<std::size_t>(size[0])),
      height_(static_cast<std::size_t>(size[1])),
      frames_(static_cast<std::size_t>(size[2])),
      tile_columns_(tiles_along(width_)),
      tiles_(tile_columns_ * tiles_along(height_)),
      temporal_(frames_),
      keys_(frames_ * tiles_ * kTile, kFree),
      extremes_(frames_ * tiles_, {kFree, ~kFree}),
      found_(frames_) {
    const int reach = reach_of(spatial_sigma);
    const std::size_t columns = std::min(static_cast<std::size_t>(2 * reach + 1), width_);
    const std::size_t rows = std::min(static_cast<std::size_t>(2 * reach + 1), height_);
    across_ = reached(static_cast<std::size_t>(reach), columns, width_);
    down_ = reached(static_cast<std::size_t>(reach), rows, height_);
    stamp_stride_ = columns + 2 * kTileEdge;
    for (Keys& stamp : stamps_) stamp.resize(stamp_stride_ * (rows + 2 * kTileEdge));
    // On a small torus images of the stamp fall on each other.
    for (int y = 0; y <= 2 * reach; ++y) {
        for (int x = 0; x <= 2 * reach; ++x) {
            const int squared = (x - reach) * (x - reach) + (y - reach) * (y - reach);
            const std::size_t at =
                (kTileEdge + static_cast<std::size_t>(y) % rows) * stamp_stride_ + kTileEdge +
                static_cast<std::size_t>(x) % columns;
            stamps_[0][at] += weight(squared, spatial_sigma);
            stamps_[1][at] = -stamps_[0][at];
        }
    }
    // The own frame has no weight; what it would add is the same for all pixels.
    const auto count = static_cast<int>(frames_);
    for (int t = -reach_of(temporal_sigma); t <= reach_of(temporal_sigma); ++t) {
        const auto place = static_cast<std::size_t>((t % count + count) % count);
        if (place != 0) temporal_[place] += weight(double{1} * t * t, temporal_sigma);
    }
}

// A stamp of `count` weights may begin anywhere on the axis; what is beyond its end comes in at 0.
std::vector<std::vector<TorusEnergy::Reached>> TorusEnergy::reached(std::size_t reach,
                                                                    std::size_t count,
                                                                    std::size_t size) {
    std::vector<std::vector<Reached>> reached(size);
    for (std::size_t middle = 0; middle < size; ++middle) {
        const std::size_t begin = (middle + size - reach % size) % size;
        const std::size_t inside = std::min(count, size - begin);
        for (std::size_t tile = begin / kTileEdge; tile * kTileEdge < begin + inside; ++tile) {
            reached[middle].push_back({tile, kTileEdge + tile * kTileEdge - begin});
        }
        for (std::size_t tile = 0; tile * kTileEdge < count - inside; ++tile) {
            reached[middle].push_back({tile, kTileEdge + inside + tile * kTileEdge});
        }
    }
    return reached;
}

std::size_t TorusEnergy::place_of(std::size_t pixel) const {
    const std::size_t x = pixel % width_;
    const std::size_t y = pixel / width_;
    return (y / kTileEdge * tile_columns_ + x / kTileEdge) * kTile + y % kTileEdge * kTileEdge +
           x % kTileEdge;
}

std::uint64_t TorusEnergy::at(std::size_t frame, std::size_t pixel) const {
    return static_cast<std::uint64_t>(keys_[frame * tiles_ * kTile + place_of(pixel)] & ~kFree);
}

void TorusEnergy::add_to_tile(std::size_t frame, std::size_t tile, const std::int64_t* weights) {
    const std::size_t width = std::min(kTileEdge, width_ - tile % tile_columns_ * kTileEdge);
    const std::size_t height = std::min(kTileEdge, height_ - tile / tile_columns_ * kTileEdge);
    const std::size_t at = frame * tiles_ + tile;
    extremes_[at] = HWY_DYNAMIC_DISPATCH(add_weights)(weights, stamp_stride_, width, height,
                                                      &keys_[at * kTile]);
}

void TorusEnergy::stamp(std::size_t frame, std::size_t pixel, std::int64_t sign) {
    const std::size_t place = place_of(pixel);
    keys_[frame * tiles_ * kTile + place] ^= kFree;
    const Keys& weights = stamps_[sign > 0 ? 0 : 1];
    for (const Reached& row : down_[pixel / width_]) {
        for (const Reached& column : across_[pixel % width_]) {
            add_to_tile(frame, row.tile * tile_columns_ + column.tile,
                        &weights[row.weight * stamp_stride_ + column.weight]);
        }
    }
    for (Found& found : found_[frame]) found.is_known = false;
    for (std::size_t t = 1; t < frames_; ++t) {
        if (temporal_[t] != 0) change((frame + t) % frames_, pixel, place, sign * temporal_[t]);
    }
}

void TorusEnergy::change(std::size_t frame, std::size_t pixel, std::size_t place, std::int64_t by) {
    std::int64_t& key = keys_[frame * tiles_ * kTile + place];
    const Extremes before = {key, ~key};
    key += by;
    const Extremes after = {key, ~key};
    Extremes& extremes = extremes_[frame * tiles_ + place / kTile];
    for (std::size_t end = 0; end < 2; ++end) {
        if (before[end] == extremes[end] && after[end] > before[end]) {
            add_to_tile(frame, place / kTile, stamps_[0].data());  // the zeros before the stamp
        }
        extremes[end] = std::min(extremes[end], after[end]);
        Found& found = found_[frame][end];
        if (after[end] <= found.key || pixel == found.pixel) found.is_known = false;
    }
}

Extremum TorusEnergy::extremum(std::size_t frame, std::size_t end) {
    Found& found = found_[frame][end];
    if (!found.is_known) found = find(frame, end);
    const std::int64_t key = end == 0 ? found.key : ~found.key;
    return {static_cast<std::uint64_t>(key & ~kFree), found.pixel};
}

TorusEnergy::Found TorusEnergy::find(std::size_t frame, std::size_t end) const {
    const Extremes* extremes = &extremes_[frame * tiles_];
    std::int64_t least = extremes[0][end];
    for (std::size_t tile = 1; tile < tiles_; ++tile) least = std::min(least, extremes[tile][end]);
    const std::int64_t wanted = end == 0 ? least : ~least;
    Found found{true, least, width_ * height_};
    for (std::size_t tile = 0; tile < tiles_; ++tile) {
        if (extremes[tile][end] != least) continue;
        const std::int64_t* keys = &keys_[(frame * tiles_ + tile) * kTile];
        for (std::size_t i = 0; i < kTile; ++i) {
            const std::size_t x = tile % tile_columns_ * kTileEdge + i % kTileEdge;
            const std::size_t y = tile / tile_columns_ * kTileEdge + i / kTileEdge;
            if (keys[i] != wanted || x >= width_ || y >= height_) continue;
            found.pixel = std::min(found.pixel, y * width_ + x);
        }
    }
    return found;
}

}  // namespace skybake::noise
#endif  // HWY_ONCE
