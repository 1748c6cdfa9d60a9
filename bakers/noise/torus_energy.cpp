#include "bakers/noise/torus_energy.h"

#include <algorithm>
#include <cmath>

#include "bakers/math/transcendental.h"

namespace skybake::noise {

namespace {

std::uint64_t weight(double squared_distance, double sigma) {
    const double share = exponential(-squared_distance / (2 * sigma * sigma));
    return static_cast<std::uint64_t>(std::llround(kStampUnit * share));
}

// The largest distance along an axis at which a weight is above 0.
int reach_of(double sigma) {
    int reach = 0;
    while (weight((reach + 1.0) * (reach + 1.0), sigma) > 0) ++reach;
    return reach;
}

// Adds the weights of the stamp's images that fall on each other on a small torus.
std::vector<std::uint64_t> spatial_stamp(int reach, double sigma, std::size_t columns,
                                         std::size_t rows) {
    std::vector<std::uint64_t> stamp(columns * rows);
    for (int y = 0; y <= 2 * reach; ++y) {
        for (int x = 0; x <= 2 * reach; ++x) {
            const double dx = x - reach;
            const double dy = y - reach;
            const std::size_t place = static_cast<std::size_t>(y) % rows * columns +
                                      static_cast<std::size_t>(x) % columns;
            stamp[place] += weight(dx * dx + dy * dy, sigma);
        }
    }
    return stamp;
}

// The own frame has no weight; what it would add is the same for all pixels.
std::vector<std::uint64_t> temporal_stamp(double sigma, std::size_t frames) {
    std::vector<std::uint64_t> stamp(frames);
    const int reach = reach_of(sigma);
    for (int t = -reach; t <= reach; ++t) {
        const auto count = static_cast<int>(frames);
        const auto place = static_cast<std::size_t>((t % count + count) % count);
        if (place != 0) stamp[place] += weight(double{1} * t * t, sigma);
    }
    return stamp;
}

}  // namespace

TorusEnergy::TorusEnergy(const std::array<int, 3>& size, double spatial_sigma,
                         double temporal_sigma)
    : width_(static_cast<std::size_t>(size[0])),
      height_(static_cast<std::size_t>(size[1])),
      frames_(static_cast<std::size_t>(size[2])),
      reach_(reach_of(spatial_sigma)),
      columns_(std::min(static_cast<std::size_t>(2 * reach_ + 1), width_)),
      rows_(std::min(static_cast<std::size_t>(2 * reach_ + 1), height_)),
      spatial_(spatial_stamp(reach_, spatial_sigma, columns_, rows_)),
      temporal_(temporal_stamp(temporal_sigma, frames_)),
      energy_(width_ * height_ * frames_),
      chosen_(energy_.size()),
      clusters_(width_, height_, frames_),
      voids_(width_, height_, frames_) {}

// Raised energies raise the keys of voids and lower those of clusters. The method raises energies
// while it looks for voids, and lowers them while it looks for clusters, so what has become lower
// is rarely searched.
void TorusEnergy::note(const Span& span, bool is_raised) {
    LeastKeys& grown = is_raised ? voids_ : clusters_;
    LeastKeys& changed = is_raised ? clusters_ : voids_;
    grown.grown(span.frame, span.row, span.first, span.last);
    changed.forget(span.frame, span.row);
}

void TorusEnergy::stamp_span(const Span& span, const std::uint64_t* weights, bool is_raised) {
    std::uint64_t* energy = &energy_[(span.frame * height_ + span.row) * width_ + span.first];
    const std::size_t count = span.last - span.first + 1;
    if (is_raised) {
        for (std::size_t i = 0; i < count; ++i) energy[i] += weights[i];
    } else {
        for (std::size_t i = 0; i < count; ++i) energy[i] -= weights[i];
    }
    note(span, is_raised);
}

// The part of the stamp beyond the right edge comes in at the left one.
void TorusEnergy::stamp_row(std::size_t frame, std::size_t row, std::size_t column,
                            const std::uint64_t* weights, bool is_raised) {
    const std::size_t inside = std::min(columns_, width_ - column);
    stamp_span({frame, row, column, column + inside - 1}, weights, is_raised);
    if (inside == columns_) return;
    stamp_span({frame, row, 0, columns_ - inside - 1}, weights + inside, is_raised);
}

void TorusEnergy::stamp(std::size_t frame, std::size_t pixel, bool is_raised) {
    const std::size_t x = pixel % width_;
    const std::size_t y = pixel / width_;
    const auto reach = static_cast<std::size_t>(reach_);
    const std::size_t left = (x + width_ - reach % width_) % width_;
    const std::size_t lower = (y + height_ - reach % height_) % height_;
    for (std::size_t i = 0; i < rows_; ++i) {
        stamp_row(frame, (lower + i) % height_, left, &spatial_[i * columns_], is_raised);
    }
    for (std::size_t t = 1; t < frames_; ++t) {
        if (temporal_[t] == 0) continue;
        stamp_span({(frame + t) % frames_, y, x, x}, &temporal_[t], is_raised);
    }
}

void TorusEnergy::add(std::size_t frame, std::size_t pixel) {
    chosen_[frame * width_ * height_ + pixel] = 1;
    stamp(frame, pixel, true);
}

void TorusEnergy::remove(std::size_t frame, std::size_t pixel) {
    chosen_[frame * width_ * height_ + pixel] = 0;
    stamp(frame, pixel, false);
}

Extremum TorusEnergy::tightest_cluster(std::size_t frame) {
    const LeastKey found = clusters_.find(frame, [&](std::size_t row, std::size_t column) {
        return cluster_key((frame * height_ + row) * width_ + column);
    });
    return {~found.key, found.row * width_ + found.column};
}

Extremum TorusEnergy::largest_void(std::size_t frame) {
    const LeastKey found = voids_.find(frame, [&](std::size_t row, std::size_t column) {
        return void_key((frame * height_ + row) * width_ + column);
    });
    return {found.key, found.row * width_ + found.column};
}

}  // namespace skybake::noise
