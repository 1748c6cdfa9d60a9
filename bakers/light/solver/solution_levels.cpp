#include "bakers/light/solver/solution_levels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "bakers/math/transcendental.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

// Levels per scale height at the ground, and the scale heights over which they thin out by e.
constexpr double kPerScaleHeight = 4;
constexpr double kThinningScaleHeights = 2.5;
// Layers are alike up to this ratio of their scale heights: levels that suit the lowest of them suit
// all.
constexpr double kAlike = 1.25;
constexpr double kOverTheShell = 8;
constexpr double kPerPiece = 3;
constexpr double kThinPart = 0.05;  // of a layer's largest density
constexpr double kPerOpticalDepth = 2;
constexpr double kMostPerOpticalDepth = 80;  // in all
// Within a layer that begins abruptly light changes over the depth that a low sun reaches: levels
// per e-fold of the depth from its edge, counted from the smallest depth that is resolved. Layers
// that are thin altogether need none of them.
constexpr double kPerFoldOfDepth = 2;
constexpr double kLeastDepth = 0.03;
constexpr double kThickLayer = 0.25;
// From this depth on a layer with an abrupt end begins as abruptly on the ground, which sends less light
// than the layer itself.
constexpr double kThickOverGround = 1.5;
constexpr double kAbrupt = 0.5;    // the share of the extinction that is missing on the other side
constexpr int kBlockSamples = 64;  // of a block, to place its levels
constexpr std::size_t kLevelsPerSunlightBlock = 3;

// The scale heights of exponential layers, ascending, one for all layers that are alike.
std::vector<double> distinct_scale_heights_km(const Medium& medium) {
    auto all = mapped<double>(medium.exponential_layers, &ExponentialLayer::scale_height_km);
    std::ranges::sort(all);
    std::vector<double> distinct;
    for (const double height : all) {
        if (distinct.empty() || height > kAlike * distinct.back()) distinct.push_back(height);
    }
    return distinct;
}

double densest(const PiecewiseLayer& layer) {
    double most = 0;
    for (const LinearPiece& piece : layer.pieces) {
        most = std::max({most, piece.density_at_bottom, piece.density_at_top});
    }
    return most;
}

// True where a table's density goes on without a jump, and its slope changes by less than would
// double the density over the longer piece: there light is as smooth as with an exponential
// density. Where the layer is thin, what counts is kThinPart of it.
bool is_smooth_joint(const LinearPiece& below, const LinearPiece& above, double densest) {
    if (below.top_km != above.bottom_km || below.density_at_top != above.density_at_bottom) {
        return false;
    }
    const double bend = std::fabs(above.density_per_km - below.density_per_km);
    const double reach_km =
        std::max(below.top_km - below.bottom_km, above.top_km - above.bottom_km);
    return bend * reach_km < std::max(above.density_at_bottom, kThinPart * densest);
}

// Pieces of a layer that smooth joints hold together: from the first to before the last.
struct PieceRun {
    std::size_t first;
    std::size_t last;
};

std::vector<PieceRun> smooth_runs(const PiecewiseLayer& layer) {
    const double most = densest(layer);
    std::vector<PieceRun> runs;
    for (std::size_t i = 0; i < layer.pieces.size(); ++i) {
        const bool goes_on = i > 0 && is_smooth_joint(layer.pieces[i - 1], layer.pieces[i], most);
        if (!goes_on) runs.push_back({i, i});
        runs.back().last = i + 1;
    }
    return runs;
}

// The altitudes at which blocks of levels begin and end: the ground, the top, and the kinks of the
// medium but for smooth joints.
std::vector<double> block_edges_km(const Medium& medium) {
    std::vector<double> edges = {0, medium.thickness_km};
    for (const PiecewiseLayer& layer : medium.piecewise_layers) {
        for (const PieceRun& run : smooth_runs(layer)) {
            edges.push_back(layer.pieces[run.first].bottom_km);
            edges.push_back(layer.pieces[run.last - 1].top_km);
        }
    }
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

// Returns the levels for a run of pieces at an altitude within it. Tables have as many as exponential layers
// with the piece's scale height, with levels that thin out with the root of the density.
double levels_per_km_of_run(const PiecewiseLayer& layer, const PieceRun& run, double altitude_km) {
    if (run.last == run.first + 1) {
        const LinearPiece& piece = layer.pieces[run.first];
        return kPerPiece / (piece.top_km - piece.bottom_km);
    }
    const auto piece =
        std::find_if(layer.pieces.begin() + static_cast<std::ptrdiff_t>(run.first),
                     layer.pieces.begin() + static_cast<std::ptrdiff_t>(run.last - 1),
                     [&](const LinearPiece& any) { return altitude_km <= any.top_km; });
    const double middle = 0.5 * (piece->density_at_bottom + piece->density_at_top);
    return kPerScaleHeight * std::fabs(piece->density_per_km) / std::sqrt(middle * densest(layer));
}

// Returns the levels for the steepest of the pieces there.
double levels_per_km_of_pieces(const Medium& medium, double altitude_km) {
    double most = 0;
    for (const PiecewiseLayer& layer : medium.piecewise_layers) {
        for (const PieceRun& run : smooth_runs(layer)) {
            if (altitude_km > layer.pieces[run.first].bottom_km &&
                altitude_km < layer.pieces[run.last - 1].top_km) {
                most = std::max(most, levels_per_km_of_run(layer, run, altitude_km));
            }
        }
    }
    return most;
}

double levels_per_km(const Medium& medium, const std::vector<double>& scale_heights_km,
                     double altitude_km) {
    double density = kOverTheShell / medium.thickness_km;
    for (const double height : scale_heights_km) {
        const double reach = kThinningScaleHeights * height;
        density += kPerScaleHeight / height * exponential(-altitude_km / reach);
    }
    return density + levels_per_km_of_pieces(medium, altitude_km);
}

double largest_extinction(const Medium& medium, double altitude_km) {
    return largest(extinction_at(medium, altitude_km));
}

// The air between two kinks, sampled where levels may be needed most: at its bottom, where
// exponential air is densest, and at both ends where it begins abruptly at the upper one too.
class SampledBlock {
  public:
    SampledBlock(const Medium& medium, double bottom_km, double top_km)
        : bottom_km_(bottom_km), top_km_(top_km) {
        const double inside_km = 1e-6 * (top_km - bottom_km);
        const auto is_abrupt = [&](double inside, double outside) {
            return largest_extinction(medium, outside) <
                   (1 - kAbrupt) * largest_extinction(medium, inside);
        };
        // Where the air ends altogether some extinction is always missing: there a layer counts that
        // is thick itself at the density of its end.
        if (top_km >= medium.thickness_km) {
            end_depth_ = largest_extinction(medium, top_km - inside_km) * (top_km - bottom_km);
        } else if (is_abrupt(top_km - inside_km, top_km + inside_km)) {
            end_depth_ = std::numeric_limits<double>::infinity();
        }
        begins_abruptly_ = bottom_km > 0 && is_abrupt(bottom_km + inside_km, bottom_km - inside_km);
        for (int i = 0; i < kBlockSamples; ++i) {
            extinction_per_km_.push_back(largest_extinction(medium, altitude_km(i + 0.5)));
            depths_.push_back(depth() +
                              extinction_per_km_.back() * (altitude_km(i + 1) - altitude_km(i)));
        }
        if (bottom_km == 0) begins_abruptly_ = ends_abruptly() && depth() > kThickOverGround;
    }

    double depth() const { return depths_.back(); }
    bool is_abrupt(double least_depth) const {
        return depth() > least_depth && (begins_abruptly_ || end_depth_ > least_depth);
    }
    AltitudeRange range() const { return {bottom_km_, top_km_}; }

    // Adds the levels above the bottom, `per_km` (altitude, extinction) of them and those of abrupt
    // ends, evenly in their count.
    template <class LevelsPerKm>
    void add_levels(const LevelsPerKm& per_km, double scale, std::vector<double>& levels) const {
        std::vector<double> count = {0};  // of levels up to each sample
        for (int i = 0; i < kBlockSamples; ++i) {
            const double density = per_km(altitude_km(i + 0.5), extinction_per_km_[index(i)]) +
                                   scale * levels_per_km_of_ends(i);
            count.push_back(count.back() + density * (altitude_km(i + 1) - altitude_km(i)));
        }
        const int steps = std::max(1, static_cast<int>(std::ceil(count.back())));
        std::size_t at = 0;
        for (int k = 1; k < steps; ++k) {
            const double wanted = count.back() * k / steps;
            while (count[at + 1] < wanted) ++at;
            const double within = (wanted - count[at]) / (count[at + 1] - count[at]);
            levels.push_back(altitude_km(static_cast<double>(at) + within));
        }
        levels.push_back(top_km_);
    }

  private:
    bool ends_abruptly() const { return end_depth_ > kThickLayer; }
    static std::size_t index(int i) { return static_cast<std::size_t>(i); }

    double altitude_km(double i) const {
        const double y = i / kBlockSamples;
        return bottom_km_ + (top_km_ - bottom_km_) * y * y * (ends_abruptly() ? 3 - 2 * y : 1);
    }

    double levels_per_km_of_ends(int i) const {
        if (!is_abrupt(kThickLayer)) return 0;
        const double from_bottom = 0.5 * (depths_[index(i)] + depths_[index(i + 1)]);
        double per_depth = 0;
        if (begins_abruptly_) per_depth += kPerFoldOfDepth / (from_bottom + kLeastDepth);
        if (ends_abruptly()) per_depth += kPerFoldOfDepth / (depth() - from_bottom + kLeastDepth);
        return per_depth * extinction_per_km_[index(i)];
    }

    double bottom_km_;
    double top_km_;
    bool begins_abruptly_ = false;
    double end_depth_ = 0;  // layers of less than this depth count as ending abruptly
    std::vector<double> extinction_per_km_;  // in the middles of samples
    std::vector<double> depths_ = {0};       // from the bottom to each sample's end
};

std::vector<SampledBlock> sampled_blocks(const Medium& medium) {
    const std::vector<double> edges = block_edges_km(medium);
    std::vector<SampledBlock> blocks;
    for (std::size_t b = 0; b + 1 < edges.size(); ++b) {
        blocks.emplace_back(medium, edges[b], edges[b + 1]);
    }
    return blocks;
}

}  // namespace

std::vector<AltitudeRange> abrupt_layers_km(const Medium& medium, double depth) {
    std::vector<AltitudeRange> ranges;
    for (const SampledBlock& block : sampled_blocks(medium)) {
        if (block.is_abrupt(depth)) ranges.push_back(block.range());
    }
    return ranges;
}

std::vector<double> solution_levels_km(const Medium& medium, double scale) {
    const std::vector<SampledBlock> blocks = sampled_blocks(medium);
    double depth = 0;
    for (const SampledBlock& block : blocks) depth += block.depth();
    const double per_depth =
        depth > 0 ? std::min(kPerOpticalDepth, kMostPerOpticalDepth / depth) : 0.0;
    const std::vector<double> scale_heights = distinct_scale_heights_km(medium);
    std::vector<double> levels = {0};
    for (const SampledBlock& block : blocks) {
        block.add_levels(
            [&](double altitude_km, double extinction_per_km) {
                return scale * (levels_per_km(medium, scale_heights, altitude_km) +
                                per_depth * extinction_per_km);
            },
            scale, levels);
    }
    return levels;
}

std::vector<double> sunlight_blocks_km(const Medium& medium, const std::vector<double>& levels_km) {
    const std::vector<double> kinks = block_edges_km(medium);
    std::vector<double> blocks = {levels_km.front()};
    std::size_t since = 0;  // levels since the last block's end
    for (std::size_t i = 1; i < levels_km.size(); ++i) {
        ++since;
        const bool is_kink = std::ranges::find(kinks, levels_km[i]) != kinks.end();
        if (since < kLevelsPerSunlightBlock && !is_kink && i + 1 < levels_km.size()) continue;
        blocks.push_back(levels_km[i]);
        since = 0;
    }
    return blocks;
}

TransmittanceField tabulated_sunlight(const Medium& medium, const std::vector<double>& levels_km,
                                      TransmittanceField::Size size, int threads) {
    return {medium, sunlight_blocks_km(medium, levels_km), size, threads};
}

}  // namespace skybake
