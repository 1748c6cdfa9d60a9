#include "bakers/noise/void_and_cluster.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bakers/math/transcendental.h"
#include "bakers/noise/lattice_hash.h"

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

namespace {

using Ranks = std::vector<std::uint32_t>;

// The chosen pixels of all frames, and what step of the method they are in.
class Pattern {
  public:
    Pattern(const MaskShape& shape, const BakeOptions& options)
        : shape_(shape),
          options_(options),
          frames_(static_cast<std::size_t>(shape.size[2])),
          pixels_(static_cast<std::size_t>(shape.size[0]) *
                  static_cast<std::size_t>(shape.size[1])),
          energy_(shape.size, shape.spatial_sigma, shape.temporal_sigma) {}

    Ranks ranks() {
        choose_first();
        relax();
        Ranks ranks(pixels_ * frames_);
        const TorusEnergy first = energy_;
        rank_first(ranks);
        energy_ = first;
        rank_rest(ranks);
        if (options_.cancelled()) return {};
        return ranks;
    }

  private:
    void choose_first() {
        std::vector<std::pair<std::uint64_t, std::size_t>> order(pixels_);
        for (std::size_t frame = 0; frame < frames_; ++frame) {
            for (std::size_t i = 0; i < pixels_; ++i) {
                order[i] = {first_hash(shape_.seed, frame, i), i};
            }
            std::ranges::sort(order);
            for (std::size_t i = 0; i < first_pixels(pixels_); ++i) {
                energy_.add(frame, order[i].second);
            }
        }
    }

    // Moves the tightest cluster of a frame into its largest void. Returns false where it lies in
    // the largest void already.
    bool move_one(std::size_t frame) {
        const Extremum cluster = energy_.tightest_cluster(frame);
        energy_.remove(frame, cluster.pixel);
        const Extremum target = energy_.largest_void(frame);
        const bool is_better = target.energy < energy_.at(frame, cluster.pixel);
        energy_.add(frame, is_better ? target.pixel : cluster.pixel);
        return is_better;
    }

    // Ends because each move lowers the sum of all energies, which is a whole number.
    void relax() {
        if (first_pixels(pixels_) == pixels_) return;
        bool moved = true;
        while (moved && !options_.cancelled()) {
            moved = false;
            for (std::size_t frame = 0; frame < frames_; ++frame) moved |= move_one(frame);
        }
    }

    void advance(std::size_t done) const {
        if (options_.progress == nullptr) return;
        options_.progress->advance("blue noise",
                                   static_cast<double>(done) / static_cast<double>(pixels_));
    }

    void rank_first(Ranks& ranks) {
        const auto cluster = [this](std::size_t frame) { return energy_.tightest_cluster(frame); };
        const auto is_tighter = [](const Extremum& a, const Extremum& b) {
            return a.energy > b.energy;
        };
        for (std::size_t rank = first_pixels(pixels_); rank-- > 0 && !options_.cancelled();) {
            each_frame_once(cluster, is_tighter, [&](std::size_t frame, std::size_t pixel) {
                energy_.remove(frame, pixel);
                ranks[frame * pixels_ + pixel] = static_cast<std::uint32_t>(rank);
            });
        }
    }

    void rank_rest(Ranks& ranks) {
        const auto empty = [this](std::size_t frame) { return energy_.largest_void(frame); };
        const auto is_larger = [](const Extremum& a, const Extremum& b) {
            return a.energy < b.energy;
        };
        for (std::size_t rank = first_pixels(pixels_); rank < pixels_; ++rank) {
            if (options_.cancelled()) return;
            each_frame_once(empty, is_larger, [&](std::size_t frame, std::size_t pixel) {
                energy_.add(frame, pixel);
                ranks[frame * pixels_ + pixel] = static_cast<std::uint32_t>(rank);
            });
            advance(rank + 1);
        }
    }

    // Calls use(frame, pixel) for one pixel of each frame, the best one of those left first.
    template <class Find, class IsBetter, class Use>
    void each_frame_once(const Find& find, const IsBetter& is_better, const Use& use) {
        std::vector<std::size_t> waiting(frames_);
        for (std::size_t frame = 0; frame < frames_; ++frame) waiting[frame] = frame;
        while (!waiting.empty()) {
            auto best = waiting.begin();
            Extremum found = find(*best);
            for (auto frame = best + 1; frame != waiting.end(); ++frame) {
                const Extremum other = find(*frame);
                if (!is_better(other, found)) continue;
                best = frame;
                found = other;
            }
            use(*best, found.pixel);
            waiting.erase(best);  // the order of frames stays
        }
    }

    const MaskShape& shape_;
    const BakeOptions& options_;
    const std::size_t frames_;
    const std::size_t pixels_;
    TorusEnergy energy_;
};

}  // namespace

std::size_t first_pixels(std::size_t pixels) { return (pixels + 9) / 10; }

std::uint64_t first_hash(std::uint64_t seed, std::size_t frame, std::size_t pixel) {
    const std::uint64_t of_frame = mix64(mix64(seed + kGolden64) + (frame + 1) * kGolden64);
    return mix64(of_frame + (pixel + 1) * kGolden64);
}

std::vector<std::uint32_t> void_and_cluster_ranks(const MaskShape& shape,
                                                  const BakeOptions& options) {
    return Pattern(shape, options).ranks();
}

}  // namespace skybake::noise
