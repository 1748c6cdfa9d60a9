// Void and cluster as Ulichney 1993 and Wolfe et al. 2022 describe it: every energy is summed anew
// from all chosen pixels whenever one is wanted, over the images of each that are near enough, and
// the last ranks go to the tightest clusters of free pixels. Shares nothing with the method on test
// but the hash of the first pixels.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "bakers/noise/void_and_cluster.h"

namespace skybake::test {

class MaskReference {
  public:
    explicit MaskReference(const noise::MaskShape& shape)
        : shape_(shape), width_(shape.size[0]), height_(shape.size[1]), frames_(shape.size[2]) {
        for (int frame = 0; frame < frames_; ++frame) {
            chosen_.push_back(first(static_cast<std::size_t>(frame)));
        }
    }

    // ranks[frame][pixel]
    std::vector<std::vector<int>> ranks() {
        while (move_some()) {
        }
        const int pixels = width_ * height_;
        const int begun = (pixels + 9) / 10;
        std::vector<std::vector<int>> ranks(chosen_.size(), std::vector<int>(chosen_[0].size()));
        const auto begin = chosen_;
        for (int rank = begun - 1; rank >= 0; --rank) turn(ranks, rank, true, 1);
        chosen_ = begin;
        for (int rank = begun; rank < pixels / 2; ++rank) turn(ranks, rank, false, 0);
        for (int rank = std::max(begun, pixels / 2); rank < pixels; ++rank) {
            turn(ranks, rank, true, 0);
        }
        return ranks;
    }

  private:
    struct Found {
        int frame = -1;
        int pixel = -1;
        std::uint64_t energy = 0;
    };

    // A tenth of the pixels, those of the least hashes.
    std::vector<int> first(std::size_t frame) const {
        const auto pixels = static_cast<std::size_t>(width_ * height_);
        std::vector<std::size_t> order(pixels);
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::stable_sort(order, {}, [&](std::size_t pixel) {
            return noise::first_hash(shape_.seed, frame, pixel);
        });
        std::vector<int> chosen(pixels);
        for (std::size_t i = 0; i < (pixels + 9) / 10; ++i) chosen[order[i]] = 1;
        return chosen;
    }
    int& chosen(int frame, int pixel) {
        return chosen_[static_cast<std::size_t>(frame)][static_cast<std::size_t>(pixel)];
    }
    int chosen(int frame, int pixel) const {
        return chosen_[static_cast<std::size_t>(frame)][static_cast<std::size_t>(pixel)];
    }

    static std::uint64_t gauss(double squares, double sigma) {
        return static_cast<std::uint64_t>(
            std::llround(0x1p52 * std::exp(-squares / (2 * sigma * sigma))));
    }

    // The energy of a pixel by all pixels that are in `state`.
    std::uint64_t energy(int frame, int pixel, int state) const {
        std::uint64_t sum = 0;
        const double far = 10 * shape_.spatial_sigma;
        for (int q = 0; q < width_ * height_; ++q) {
            if (chosen(frame, q) != state) continue;
            const double dx = q % width_ - pixel % width_, dy = q / width_ - pixel / width_;
            for (double y = dy - height_ * std::ceil(far / height_); y <= far; y += height_) {
                for (double x = dx - width_ * std::ceil(far / width_); x <= far; x += width_) {
                    sum += gauss(x * x + y * y, shape_.spatial_sigma);
                }
            }
        }
        const double long_ago = 10 * shape_.temporal_sigma;
        for (int other = 0; other < frames_; ++other) {
            if (other == frame || chosen(other, pixel) != state) continue;
            const double dt = other - frame;
            for (double t = dt - frames_ * std::ceil(long_ago / frames_); t <= long_ago;
                 t += frames_) {
                sum += gauss(t * t, shape_.temporal_sigma);
            }
        }
        return sum;
    }

    // The pixel of the greatest or least energy by pixels in `by`, among those of a frame that are
    // in `state`.
    Found extreme(int frame, int state, int by, bool greatest) const {
        Found found;
        for (int p = 0; p < width_ * height_; ++p) {
            if (chosen(frame, p) != state) continue;
            const std::uint64_t e = energy(frame, p, by);
            const bool better = greatest ? e > found.energy : e < found.energy;
            if (found.pixel < 0 || better) found = {frame, p, e};
        }
        return found;
    }

    bool move_some() {
        bool moved = false;
        for (int frame = 0; frame < frames_; ++frame) {
            const Found cluster = extreme(frame, 1, 1, true);
            chosen(frame, cluster.pixel) = 0;
            const Found target = extreme(frame, 0, 1, false);
            const bool better = target.energy < energy(frame, cluster.pixel, 1);
            chosen(frame, better ? target.pixel : cluster.pixel) = 1;
            moved = moved || better;
        }
        return moved;
    }

    // Gives a rank to one pixel of each frame. `state` is that of the pixels that may have it: the
    // tightest cluster of the chosen ones, or of the free ones, or the largest void.
    void turn(std::vector<std::vector<int>>& ranks, int rank, bool is_cluster, int state) {
        std::vector<bool> done(chosen_.size());
        for (int i = 0; i < frames_; ++i) {
            Found best;
            for (int frame = 0; frame < frames_; ++frame) {
                if (done[static_cast<std::size_t>(frame)]) continue;
                const Found found = extreme(frame, state, is_cluster ? state : 1, is_cluster);
                const bool better =
                    is_cluster ? found.energy > best.energy : found.energy < best.energy;
                if (best.pixel < 0 || better) best = found;
            }
            const auto frame = static_cast<std::size_t>(best.frame);
            ranks[frame][static_cast<std::size_t>(best.pixel)] = rank;
            chosen(best.frame, best.pixel) = 1 - chosen(best.frame, best.pixel);
            done[frame] = true;
        }
    }

    const noise::MaskShape shape_;
    const int width_, height_, frames_;
    std::vector<std::vector<int>> chosen_;  // 1 or 0
};

}  // namespace skybake::test
