#include "bakers/noise/void_and_cluster.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "bakers/math/mix64.h"
#include "bakers/noise/torus_energy.h"

namespace skybake::noise {
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
        for (std::size_t rank = first_pixels(pixels_); rank-- > 0 && !options_.cancelled();) {
            rank_each_frame(rank, false, ranks);
        }
        energy_ = first;
        std::size_t rank = first_pixels(pixels_);
        for (; rank < pixels_ && !options_.cancelled(); ++rank) {
            rank_each_frame(rank, true, ranks);
            if (options_.progress == nullptr) continue;
            options_.progress->advance(
                "blue noise", static_cast<double>(rank + 1) / static_cast<double>(pixels_));
        }
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

    // Fills the largest void of each frame, or removes its tightest cluster, the best of those left
    // first, and ranks them.
    void rank_each_frame(std::size_t rank, bool fills, Ranks& ranks) {
        std::vector<std::size_t> waiting(frames_);
        std::iota(waiting.begin(), waiting.end(), std::size_t{0});
        while (!waiting.empty()) {
            auto best = waiting.begin();
            Extremum found;
            for (auto frame = waiting.begin(); frame != waiting.end(); ++frame) {
                const Extremum other =
                    fills ? energy_.largest_void(*frame) : energy_.tightest_cluster(*frame);
                const bool is_better =
                    fills ? other.energy < found.energy : other.energy > found.energy;
                if (frame != waiting.begin() && !is_better) continue;
                best = frame;
                found = other;
            }
            fills ? energy_.add(*best, found.pixel) : energy_.remove(*best, found.pixel);
            ranks[*best * pixels_ + found.pixel] = static_cast<std::uint32_t>(rank);
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
