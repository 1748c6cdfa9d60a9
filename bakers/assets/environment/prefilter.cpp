#include "bakers/assets/environment/prefilter.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "config/assets/environment.h"

namespace skybake {

namespace {

constexpr int kLobeRings = 24;
constexpr int kLobeSpokes = 16;
// The share of a sample's solid angle whose mean it looks up: lookups between means blur besides.
constexpr double kFiltered = 0.25;

// A direction about the normal, with what it counts and covers.
struct LobeSample {
    glm::dvec3 direction{};  // along two tangents and the normal
    double weight = 0;       // n.l, over the sum of all
    double solid_angle = 0;
};

// Half-angles t have the density D(t) cos t, whose share below t is tan^2 t / (alpha^2 + tan^2 t).
// Reflected directions have the density D / 4 per solid angle, since n.h / (4 v.h) = 1 / 4.
std::vector<LobeSample> ggx_lobe(double roughness) {
    const double square = roughness * roughness * roughness * roughness;  // alpha^2
    std::vector<LobeSample> samples;
    double sum = 0;
    for (int ring = 0; ring < kLobeRings; ++ring) {
        const double share = (ring + 0.5) / kLobeRings;
        const double tangent_square = square * share / (1 - share);
        const double half_square = 1 / (1 + tangent_square);  // cos^2 of the half-angle
        const double cosine = 2 * half_square - 1;
        if (cosine <= 0) continue;
        const double sine = 2 * std::sqrt(half_square * (1 - half_square));
        const double denominator = half_square * (square - 1) + 1;
        const double density = square / (std::numbers::pi * denominator * denominator) / 4;
        for (int spoke = 0; spoke < kLobeSpokes; ++spoke) {
            // Rings are turned against each other by the golden ratio.
            const double turns = (spoke + 0.6180339887498949 * ring) / kLobeSpokes;
            const SineCosine turn = sine_and_cosine(2 * std::numbers::pi * turns);
            samples.push_back({{sine * turn.cosine, sine * turn.sine, cosine},
                               cosine,
                               kFiltered / (density * kLobeRings * kLobeSpokes)});
            sum += cosine;
        }
    }
    for (LobeSample& sample : samples) sample.weight /= sum;
    return samples;
}

// Two unit vectors across a unit vector.
struct Tangents {
    glm::dvec3 first{};
    glm::dvec3 second{};
};
Tangents tangents_of(const glm::dvec3& normal) {
    const glm::dvec3 side = std::fabs(normal.y) < 0.9 ? glm::dvec3{0, 1, 0} : glm::dvec3{1, 0, 0};
    const glm::dvec3 first = glm::normalize(glm::cross(side, normal));
    return {first, glm::cross(normal, first)};
}

Image2<float> half_as_large(const Image2<float>& map, const EnvironmentLayout& layout) {
    const auto [columns, rows] = layout.part_size();
    const int width = std::max(columns / 2, 1);
    const int height = std::max(rows / 2, 1);
    Image2<float> half(width, height * layout.parts(), map.channels);
    for (int part = 0; part < layout.parts(); ++part) {
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                float* out = half.texel(x, part * height + y);
                int count = 0;
                for (int j = y * rows / height; j < (y + 1) * rows / height; ++j) {
                    for (int i = x * columns / width; i < (x + 1) * columns / width; ++i, ++count) {
                        const float* in = map.texel(i, part * rows + j);
                        for (int c = 0; c < map.channels; ++c) out[c] += in[c];
                    }
                }
                for (int c = 0; c < map.channels; ++c) out[c] /= static_cast<float>(count);
            }
        }
    }
    return half;
}

}  // namespace

double roughness_of_level(int level, int levels) {
    return levels > 1 ? static_cast<double>(level) / (levels - 1) : 0;
}

ReflectedLobe::ReflectedLobe(double roughness)
    : square_(roughness * roughness * roughness * roughness), integral_(1) {
    const double b = 1 - square_;
    if (b == 0) return;
    integral_ = 4 * (b + 2 * square_ * logarithm(2 * square_ / (1 + square_))) / (b * b);
}

double ReflectedLobe::density(double cosine) const {
    if (cosine <= 0) return 0;
    const double sine_square = (1 - cosine) / 2;  // of the half-angle
    const double denominator = sine_square + square_ * (1 - sine_square);
    return cosine * square_ / (std::numbers::pi * denominator * denominator * integral_);
}

double ReflectedLobe::width() const { return std::sqrt(square_); }

MapPyramid::MapPyramid(config::EnvironmentMapping mapping, const Image2<float>& map) {
    maps_.push_back(map);
    layouts_.emplace_back(mapping, std::array{map.width, map.height});
    while (layouts_.back().part_size() != EnvironmentLayout::Size{1, 1}) {
        maps_.push_back(half_as_large(maps_.back(), layouts_.back()));
        layouts_.emplace_back(mapping, std::array{maps_.back().width, maps_.back().height});
    }
}

void MapPyramid::add(const glm::dvec3& direction, double solid_angle, double weight,
                     double* sum) const {
    // The solid angle of a texel in this direction, but for how texels vary within a part.
    const EnvironmentLayout& finest = layouts_.front();
    const auto [columns, rows] = finest.part_size();
    const double texel = 4 * std::numbers::pi / (finest.parts() * double(columns) * double(rows));
    const double last = static_cast<double>(maps_.size() - 1);
    const double level =
        std::clamp(0.5 * logarithm(solid_angle / texel) / std::numbers::ln2, 0.0, last);
    const auto below = static_cast<std::size_t>(level);
    const double share = level - static_cast<double>(below);
    add_from(below, direction, weight * (1 - share), sum);
    if (share > 0) add_from(below + 1, direction, weight * share, sum);
}

void MapPyramid::add_from(std::size_t level, const glm::dvec3& direction, double weight,
                          double* sum) const {
    const EnvironmentLayout& layout = layouts_[level];
    const Image2<float>& map = maps_[level];
    const auto [columns, rows] = layout.part_size();
    const EnvironmentLayout::At at = layout.at(direction);
    const double x = at.x * columns - 0.5;
    const double y = at.y * rows - 0.5;
    const double left = std::floor(x);
    const double top = std::floor(y);
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
            const double share =
                (i == 0 ? left + 1 - x : x - left) * (j == 0 ? top + 1 - y : y - top);
            int column = static_cast<int>(left) + i;
            int row = static_cast<int>(top) + j;
            int part = at.part;
            if (column < 0 || row < 0 || column >= columns || row >= rows) {
                // The texel lies beyond an edge: it is the one that shows that direction.
                const EnvironmentLayout::At beyond =
                    layout.at(layout.direction(part, (column + 0.5) / columns, (row + 0.5) / rows));
                part = beyond.part;
                column = std::clamp(static_cast<int>(beyond.x * columns), 0, columns - 1);
                row = std::clamp(static_cast<int>(beyond.y * rows), 0, rows - 1);
            }
            const float* texel = map.texel(column, part * rows + row);
            for (int c = 0; c < map.channels; ++c) sum[c] += weight * share * double{texel[c]};
        }
    }
}

Image2<double> prefiltered(const MapPyramid& pyramid, const EnvironmentLayout& layout,
                           double roughness, const BakeOptions& options) {
    const std::vector<LobeSample> lobe = ggx_lobe(roughness);
    const auto size = layout.part_size();
    Image2<double> level(size.columns, size.rows * layout.parts(), pyramid.channels());
    for_each_tile(level.height, options, "roughness", [&](int line) {
        const int part = line / size.rows;
        const double y = (line % size.rows + 0.5) / size.rows;
        for (int x = 0; x < size.columns; ++x) {
            const glm::dvec3 normal = layout.direction(part, (x + 0.5) / size.columns, y);
            const Tangents across = tangents_of(normal);
            double* texel = level.texel(x, line);
            for (const LobeSample& sample : lobe) {
                const glm::dvec3 direction = sample.direction.x * across.first +
                                             sample.direction.y * across.second +
                                             sample.direction.z * normal;
                pyramid.add(direction, sample.solid_angle, sample.weight, texel);
            }
        }
    });
    return level;
}

}  // namespace skybake
