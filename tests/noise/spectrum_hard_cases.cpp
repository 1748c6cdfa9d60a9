// Tests one octave of gradient noise as a signal: its root mean square, and how its spectrum
// depends on direction.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "tests/noise/noises.h"
#include "tests/support/hard_case.h"

namespace skybake::noise {
namespace {

using test::hold;

constexpr int kSize = 64;
constexpr int kCells = 8;
constexpr double kTwoPi = 6.283185307179586;

std::vector<float> octave(std::uint64_t seed) {
    const config::Noise noise = test::noise_of({test::perlin({{kCells, kCells, kCells}})}, seed);
    std::vector<float> values = test::whole(noise, {kSize, kSize, kSize})[0];
    for (float& v : values) v = 2 * v - 1;
    return values;
}

// |Fourier coefficient|^2 of the volume at a wave vector, in waves a tile.
double power_at(const std::vector<float>& values, const std::array<int, 3>& wave) {
    std::array<std::vector<std::complex<double>>, 3> phase;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < kSize; ++i) {
            phase[axis].push_back(std::polar(1.0, -kTwoPi * wave[axis] * i / kSize));
        }
    }
    std::complex<double> sum = 0;
    auto value = values.begin();
    for (const auto& z : phase[2]) {
        std::complex<double> slice = 0;
        for (const auto& y : phase[1]) {
            std::complex<double> row = 0;
            for (const auto& x : phase[0]) row += x * double{*value++};
            slice += y * row;
        }
        sum += z * slice;
    }
    return std::norm(sum / static_cast<double>(values.size()));
}

// Power along a direction, integrated over wave lengths of 1/2 to 2 cells, mean over its mirror
// images.
double power_along(const std::vector<float>& values,
                   const std::vector<std::array<int, 3>>& family) {
    double sum = 0;
    for (const std::array<int, 3>& unit : family) {
        const double length = std::hypot(unit[0], unit[1], unit[2]);
        for (int k = 1; k * length <= 2 * kCells; ++k) {
            if (k * length < 0.5 * kCells) continue;
            sum += power_at(values, {k * unit[0], k * unit[1], k * unit[2]}) * length;
        }
    }
    return sum / static_cast<double>(family.size());
}

// The same along an axis, whose waves see only the means of planes.
double power_along_axis(const std::vector<float>& values, std::size_t axis) {
    std::vector<double> means(kSize, 0);
    const std::size_t step = axis == 0 ? 1 : axis == 1 ? kSize : std::size_t{kSize} * kSize;
    for (std::size_t i = 0; i < values.size(); ++i) means[i / step % kSize] += values[i];
    double sum = 0;
    for (int k = kCells / 2; k <= 2 * kCells; ++k) {
        std::complex<double> wave = 0;
        for (std::size_t i = 0; i < kSize; ++i) {
            wave += means[i] * std::polar(1.0, -kTwoPi * k * static_cast<double>(i) / kSize);
        }
        sum += std::norm(wave / static_cast<double>(values.size()));
    }
    return sum;
}

// The lattice, not its gradients, makes the axes stronger. Bounds guard against what a gross error
// of the hash or of the blends would do, no more. A seed's power along an axis has a standard
// deviation of 0.6 of its mean: of 200 seeds, amplitudes of equal axes are within a few percent.
TEST(NoiseHardCase, PerlinSpectrumIsotropy) {
    constexpr int kSeeds = 200;
    constexpr int kSeedsOfDiagonals = 16;
    std::array<double, 3> axes{};
    double faces = 0;
    double diagonals = 0;
    double squares = 0;
    for (int seed = 0; seed < kSeeds; ++seed) {
        const std::vector<float> values = octave(static_cast<std::uint64_t>(seed));
        for (const float v : values) squares += double{v} * v;
        for (std::size_t i = 0; i < 3; ++i) axes[i] += power_along_axis(values, i) / kSeeds;
        if (seed >= kSeedsOfDiagonals) continue;
        faces +=
            power_along(values,
                        {{1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}}) /
            kSeedsOfDiagonals;
        diagonals += power_along(values, {{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}}) /
                     kSeedsOfDiagonals;
    }
    EXPECT_NEAR(power_along_axis(octave(0), 1), power_along(octave(0), {{0, 1, 0}}), 1e-12);
    const double rms = std::sqrt(squares / (double{kSeeds} * kSize * kSize * kSize));
    hold(fmt::format("perlin octave, RMS {:.4f}", rms), "0.27: apart", std::fabs(rms - 0.27), 0.01);
    const double mean = (axes[0] + axes[1] + axes[2]) / 3;
    const auto [weakest, strongest] = std::minmax_element(axes.begin(), axes.end());
    const auto row = [](const char* name, double power_ratio, double bound) {
        const double ratio = std::sqrt(power_ratio);
        hold(fmt::format("perlin spectrum, {}", name),
             fmt::format("isotropic, 1: amplitudes {:.2f} : 1", ratio), std::max(ratio, 1 / ratio),
             bound);
    };
    row("axes to face diagonals", mean / faces, 2);
    row("axes to body diagonals", mean / diagonals, 2);
    row("strongest to weakest axis", *strongest / *weakest, 1.1);
}

}  // namespace
}  // namespace skybake::noise
