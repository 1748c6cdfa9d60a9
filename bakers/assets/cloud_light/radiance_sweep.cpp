#include "bakers/assets/cloud_light/radiance_sweep.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bakers/assets/cloud_light/radiance_kernel.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "config/text/mapped.h"

namespace skybake::cloud_light {
namespace {

constexpr int kZenithNodes = 4;
constexpr int kAzimuths = 8;
static_assert(kZenithNodes * kAzimuths <= 2 * kMostPairs);

// Turns a direction to the middle between two azimuths.
glm::dvec3 half_a_step_on(const glm::dvec3& direction) {
    const SineCosine turn = sine_and_cosine(std::numbers::pi / kAzimuths);
    return {turn.cosine * direction.x - turn.sine * direction.y,
            turn.sine * direction.x + turn.cosine * direction.y, direction.z};
}

// Calls use(first, second) for the ordinates whose azimuths are opposite, of all zenith angles.
template <class Use>
void for_each_pair(const Use& use) {
    for (std::size_t n = 0; n < kZenithNodes * kAzimuths; ++n) {
        if (n % kAzimuths < kAzimuths / 2) use(n, n + kAzimuths / 2);
    }
}

PairHarmonics pair_harmonics(const glm::dvec3& direction, double weight, std::size_t count) {
    const Harmonics values = harmonics(direction);
    PairHarmonics pair{{}, count};
    for (std::size_t c = 0; c < count; ++c) {
        pair.values[c] = static_cast<float>(weight * values[c]);
    }
    return pair;
}

}  // namespace

CellFields::CellFields(const std::array<int, 3>& size, std::size_t count)
    : size_(size),
      count_(count),
      stride_((static_cast<std::size_t>(size[0]) + 2 * kRowSlack - 1) / kRowSlack * kRowSlack),
      values_(stride_ * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]) *
              count) {}

std::size_t CellFields::at(std::size_t field, int z, int y) const {
    const auto rows = static_cast<std::size_t>(size_[1]);
    const auto planes = static_cast<std::size_t>(size_[2]);
    return ((field * planes + static_cast<std::size_t>(z)) * rows + static_cast<std::size_t>(y)) *
           stride_;
}

std::vector<float> values_of(const CellFields& fields, std::size_t field) {
    const auto length = static_cast<std::ptrdiff_t>(fields.size()[0]);
    std::vector<float> values;
    for (int z = 0; z < fields.size()[2]; ++z) {
        for (int y = 0; y < fields.size()[1]; ++y) {
            const float* row = fields.row(field, z, y);
            values.insert(values.end(), row, row + length);
        }
    }
    return values;
}

// Light of one direction in a plane. Rows have a cell more on each side, at kRowSlack - 1 and behind the
// last, which are those of the next tiles.
struct RadianceSweep::Rays {
    Ordinate ordinate;
    PairHarmonics sent_out;       // of this direction, if it is the first of a pair
    PairHarmonics gathered;       // the same times its solid angle
    std::array<int, 2> upwind{};  // the neighbour from which light comes
    std::array<float, 4> share{};
    CellFields before, after, source, mean;

    Rays(const std::array<int, 3>& size, const Ordinate& along, std::size_t coefficients,
         double entering)
        : ordinate(along),
          sent_out(pair_harmonics(along.direction, 1, coefficients)),
          gathered(pair_harmonics(along.direction, along.solid_angle, coefficients)),
          before({size[0] + 2 * static_cast<int>(kRowSlack), size[1], 1}, 1),
          after(before),
          source({size[0], size[1], 1}, 1),
          mean({size[0], size[1], 1}, 1) {
        for (int y = 0; y < size[1]; ++y) {
            std::fill_n(before.row(0, 0, y), before.size()[0], static_cast<float>(entering));
        }
    }
};

RadianceSweep::RadianceSweep(const LayerCells& cells, int degree, int threads)
    : size_(cells.extinction.size()),
      edge_m_(cells.edge_m),
      coefficients_(static_cast<std::size_t>((degree + 1) * (degree + 1))),
      passing_(size_, kZenithNodes),
      mean_passing_(size_, kZenithNodes),
      leaving_(size_, 1) {
    for (const SkyDirection& sky : sky_directions(kZenithNodes, kAzimuths)) {
        const std::size_t node = downward_.size() / kAzimuths;
        if (downward_.size() % kAzimuths == 0) {
            const double cosine = sky.direction.z;
            const double tangent = std::sqrt(1 - cosine * cosine) / cosine;
            const double cells_across = tangent * edge_m_[2] / std::min(edge_m_[0], edge_m_[1]);
            steps_.push_back(std::max(1, static_cast<int>(std::ceil(cells_across))));
            fill_passing(cells, node, cosine, sky.solid_angle * kAzimuths / (2 * std::numbers::pi),
                         threads);
        }
        const glm::dvec3 direction = node % 2 == 0 ? sky.direction : half_a_step_on(sky.direction);
        downward_.push_back({{direction.x, direction.y, -direction.z}, sky.solid_angle, node});
    }
}

std::vector<SkyDirection> RadianceSweep::sky_ordinates() const {
    return mapped<SkyDirection>(downward_, [&](const Ordinate& ordinate) {
        return SkyDirection{-ordinate.direction, ordinate.solid_angle};
    });
}

void RadianceSweep::fill_passing(const LayerCells& cells, std::size_t node, double cosine,
                                 double share_of_sphere, int threads) {
    const double length = edge_m_[2] / (cosine * steps_[node]);
    parallel_for(size_[2], threads, [&](int z) {
        for (int y = 0; y < size_[1]; ++y) {
            const float* extinction = cells.extinction.row(0, z, y);
            float* passing = passing_.row(node, z, y);
            float* mean = mean_passing_.row(node, z, y);
            float* leaving = leaving_.row(0, z, y);
            for (int x = 0; x < size_[0]; ++x) {
                const double depth = double{extinction[x]} * length;
                const double share = exponential(-depth);
                passing[x] = static_cast<float>(share);
                mean[x] = static_cast<float>(mean_of_exponential(depth, share));
                leaving[x] += static_cast<float>(share_of_sphere) * mean[x];
            }
        }
    });
}

// Crosses one row, from `before` to `after`.
void RadianceSweep::step(const Ordinate& ordinate, int z, int y, Rays& rays) const {
    const auto count = static_cast<std::size_t>(size_[0]);
    const int beside = (y + rays.upwind[1] + size_[1]) % size_[1];
    const float* here = rays.before.row(0, 0, y) + kRowSlack;
    const float* there = rays.before.row(0, 0, beside) + kRowSlack;
    RowStep step;
    step.light = {here, here + rays.upwind[0], there, there + rays.upwind[0]};
    step.share = rays.share;
    step.passing = passing_.row(ordinate.node, z, y);
    step.mean_passing = mean_passing_.row(ordinate.node, z, y);
    step.source = rays.source.row(0, 0, y);
    step.part = 1 / static_cast<float>(steps_[ordinate.node]);
    float* after = rays.after.row(0, 0, y) + kRowSlack;
    step_row(step, count, after, rays.mean.row(0, 0, y));
    after[-1] = after[count - 1];
    after[count] = after[0];
}

void RadianceSweep::send_out_row(const CellFields& sources, int z, int y,
                                 std::vector<Rays>& rays) const {
    CoefficientRows<const float> rows{};
    for (std::size_t c = 0; c < coefficients_; ++c) rows[c] = sources.row(c, z, y);
    const auto count = static_cast<std::size_t>(size_[0]);
    for_each_pair([&](std::size_t first, std::size_t second) {
        send_out(rays[first].sent_out, rows, count, rays[first].source.row(0, 0, y),
                 rays[second].source.row(0, 0, y));
    });
}

void RadianceSweep::cross_plane(int z, Rays& rays) const {
    const Ordinate& ordinate = rays.ordinate;
    for (int y = 0; y < size_[1]; ++y) std::fill_n(rays.mean.row(0, 0, y), size_[0], 0.0F);
    const int steps = steps_[ordinate.node];
    std::array<double, 2> moved{};  // cells in a step
    for (std::size_t a = 0; a < 2; ++a) {
        moved[a] = ordinate.direction[a] / std::fabs(ordinate.direction.z) * edge_m_[2] /
                   (edge_m_[a] * steps);
        rays.upwind[a] = moved[a] > 0 ? -1 : 1;
        moved[a] = std::min(std::fabs(moved[a]), 1.0);  // rounding
    }
    rays.share = {static_cast<float>((1 - moved[0]) * (1 - moved[1])),
                  static_cast<float>(moved[0] * (1 - moved[1])),
                  static_cast<float>((1 - moved[0]) * moved[1]),
                  static_cast<float>(moved[0] * moved[1])};
    for (int i = 0; i < steps; ++i) {
        for (int y = 0; y < size_[1]; ++y) step(ordinate, z, y, rays);
        std::swap(rays.before, rays.after);
    }
}

void RadianceSweep::gather_row(const std::vector<Rays>& rays, int z, int y,
                               CellFields& sums) const {
    std::vector<PairLight> pairs;
    for_each_pair([&](std::size_t first, std::size_t second) {
        pairs.push_back(
            {rays[first].gathered, rays[first].mean.row(0, 0, y), rays[second].mean.row(0, 0, y)});
    });
    CoefficientRows<float> rows{};
    for (std::size_t c = 0; c < coefficients_; ++c) rows[c] = sums.row(c, z, y);
    gather(pairs, static_cast<std::size_t>(size_[0]), rows);
}

void RadianceSweep::sweep(const CellFields& sources, const std::vector<double>& entering,
                          bool rises, CellFields& sums, const BakeOptions& options) const {
    std::vector<Rays> rays;
    for (Ordinate ordinate : downward_) {
        if (rises) ordinate.direction.z = -ordinate.direction.z;
        rays.emplace_back(size_, ordinate, coefficients_, entering[rays.size()]);
    }
    for (int i = 0; i < size_[2] && !options.cancelled(); ++i) {
        const int z = rises ? i : size_[2] - 1 - i;
        parallel_for(size_[1], options.threads, [&](int y) { send_out_row(sources, z, y, rays); });
        parallel_for(static_cast<int>(rays.size()), options.threads,
                     [&](int n) { cross_plane(z, rays[static_cast<std::size_t>(n)]); });
        parallel_for(size_[1], options.threads, [&](int y) { gather_row(rays, z, y, sums); });
    }
}

void RadianceSweep::find_radiance(const CellFields& sources, const EnteringLight& entering,
                                  CellFields& radiance, const BakeOptions& options) const {
    radiance.clear();
    std::vector<double> sky(downward_.size(), entering.sky);
    for (std::size_t n = 0; n < entering.sky_shape.size(); ++n) sky[n] *= entering.sky_shape[n];
    sweep(sources, sky, false, radiance, options);
    sweep(sources, std::vector<double>(downward_.size(), entering.ground), true, radiance, options);
}

}  // namespace skybake::cloud_light
