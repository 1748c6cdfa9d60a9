#include "bakers/field/smallest_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "bakers/field/interpolation.h"

namespace skybake {
namespace {

constexpr std::array<int, 19> kSizes = {4,   6,   8,   12,  16,  24,  32,   48,   64,  96,
                                        128, 192, 256, 384, 512, 768, 1024, 1536, 2048};
constexpr std::array<int, 6> kLongRows = {3072, 4096, 6144, 8192, 12288, 16384};

std::vector<int> widths(const TableModel& model) {
    std::vector<int> sizes(kSizes.begin(), kSizes.end());
    if (model.one_row) sizes.insert(sizes.end(), kLongRows.begin(), kLongRows.end());
    return sizes;
}

std::vector<int> heights(const TableModel& model) {
    if (model.one_row) return {1};
    return {kSizes.begin(), kSizes.end()};
}

struct Candidate {
    std::array<int, 2> size;
    int level;
    double cost;
};

std::vector<Candidate> candidates(const TableModel& model) {
    std::vector<Candidate> all;
    for (std::size_t level = 0; level < model.cost_per_texel.size(); ++level) {
        for (const int width : widths(model)) {
            for (const int height : heights(model)) {
                all.push_back({{width, height},
                               static_cast<int>(level),
                               static_cast<double>(width) * height * model.cost_per_texel[level]});
            }
        }
    }
    std::ranges::stable_sort(all, [](const Candidate& a, const Candidate& b) {
        if (a.cost != b.cost) return a.cost < b.cost;
        return a.size[0] < b.size[0];
    });
    return all;
}

// The two texels around a coordinate, and the coordinate's position between them, from 0 to 1.
struct TexelPair {
    int first;
    int second;
    double fraction;
};

TexelPair texels_about(TexelConvention convention, double x, int count) {
    const double position =
        std::clamp(texture_coordinate(convention, x, count) * count - 0.5, 0.0, count - 1.0);
    const int first = static_cast<int>(position);
    return {first, std::min(first + 1, count - 1), position - first};
}

struct PointIndex {
    std::size_t row;
    std::size_t column;
};

std::vector<PointIndex> all_points(const ReferencePoints& points) {
    std::vector<PointIndex> all;
    for (std::size_t j = 0; j < points.rows.size(); ++j) {
        for (std::size_t i = 0; i < points.rows[j].x.size(); ++i) all.push_back({j, i});
    }
    return all;
}

// Returns the error of one lookup. Only the four texels that the lookup needs are made.
double lookup_error(const TableModel& model, const Candidate& candidate, TexelRounding rounding,
                    const ReferencePoints& points, PointIndex index) {
    const PointRow& point = points.rows[index.row];
    const auto [width, height] = candidate.size;
    const TexelPair across = texels_about(model.convention, point.x[index.column], width);
    const TexelPair up = texels_about(model.convention, point.y, height);
    Image2<double> texels(2, 2, model.channels);
    const std::vector<double> x = {texel_coordinate(model.convention, across.first, width),
                                   texel_coordinate(model.convention, across.second, width)};
    model.row(candidate.level, texel_coordinate(model.convention, up.first, height), x,
              texels.texel(0, 0));
    model.row(candidate.level, texel_coordinate(model.convention, up.second, height), x,
              texels.texel(0, 1));
    RangeCounts range;
    const Image2<float> stored = store_texels(texels, rounding, range, {across.first, up.first});
    std::vector<double> value(static_cast<std::size_t>(model.channels));
    bilinear(stored, (across.fraction + 0.5) / 2, (up.fraction + 0.5) / 2, value.data());
    double largest = 0;
    for (std::size_t c = 0; c < value.size(); ++c) {
        const double reference = points.values[index.row][index.column * value.size() + c];
        const double error = std::fabs(model.error(value[c], reference, points.scale[c]));
        if (!(error <= largest)) largest = error;
    }
    return largest;
}

// Adds the place of the largest error that a check found.
PointIndex add_point(const TableModel& model, const FoundErrors& found, ReferencePoints& points) {
    const double x =
        model.x_of_point ? model.x_of_point(found.worst_point[0]) : found.worst_point[0];
    std::vector<double> values(static_cast<std::size_t>(model.channels));
    model.reference(found.worst_row[0], {x}, values.data());
    for (std::size_t c = 0; c < values.size(); ++c) {
        points.scale[c] = std::max(points.scale[c], values[c]);
    }
    points.rows.push_back({found.worst_row[0], {x}});
    points.values.push_back(std::move(values));
    return {points.rows.size() - 1, 0};
}

}  // namespace

std::array<int, 2> largest_table(bool one_row) {
    return one_row ? std::array{kLongRows.back(), 1} : std::array{kSizes.back(), kSizes.back()};
}

TableSearch smallest_table(const TableModel& model, double max_error, TexelRounding rounding,
                           ReferencePoints points, const BakeOptions& options,
                           const TableCheck& check) {
    // No table keeps within the bound if the kernel's error at that level exceeds it. If the
    // kernel's error is an eighth of the bound, a more expensive level gains almost nothing.
    const int levels = static_cast<int>(model.cost_per_texel.size());
    int first = levels;
    int last = levels - 1;
    for (int level = levels - 1; level >= 0; --level) {
        const double error = measure_kernel(model, level, points, options).figures.max;
        if (!(error <= max_error)) break;
        first = level;
        if (error <= max_error / 8) last = level;
    }

    TableSearch search;
    // Points that refuted the last tables are tried first, so most candidates fail at the first
    // point.
    std::vector<PointIndex> order = all_points(points);
    for (const Candidate& candidate : candidates(model)) {
        if (options.cancelled()) break;
        if (candidate.level < first || candidate.level > last) continue;
        double largest = 0;
        for (std::size_t k = 0; k < order.size() && largest <= max_error; ++k) {
            const double error = lookup_error(model, candidate, rounding, points, order[k]);
            if (error <= largest) continue;
            largest = error;
            if (!(error <= max_error)) {
                const auto refuted = order.begin() + static_cast<std::ptrdiff_t>(k);
                std::rotate(order.begin(), refuted, refuted + 1);
            }
        }
        if (largest <= max_error && check) {
            RangeCounts range;
            const Image2<float> image = store_texels(
                bake_texels(model, candidate.level, candidate.size, options), rounding, range);
            if (options.cancelled()) break;
            const FoundErrors found = check(candidate.level, image);
            if (options.cancelled()) break;
            largest = std::max(largest, found.figures.max);
            if (!(largest <= max_error)) {
                order.insert(order.begin(), add_point(model, found, points));
            }
        }
        if (largest <= max_error) {
            search.found = TableChoice{candidate.size, candidate.level, largest};
            search.best = *search.found;
            return search;
        }
    }
    // No table keeps within the bound: report what the largest table at the finest level reaches.
    const Candidate largest = {largest_table(model.one_row), levels - 1, 0};
    search.best = {largest.size, largest.level, 0};
    for (const PointIndex& index : order) {
        const double error = lookup_error(model, largest, rounding, points, index);
        search.best.max_error = std::max(search.best.max_error, error);
    }
    return search;
}

}  // namespace skybake
