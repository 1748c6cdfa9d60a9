// C2 continuity of gradient noise, measured on the kernels' floats.
//
// Along an axis improved noise is a polynomial of degree 6 in each cell, a fifth-degree fade times
// a distance. Through seven voxels of a cell, at the Chebyshev-Lobatto nodes, there is one such
// polynomial; its value and first two derivatives at the cell's end are weighted sums of those
// voxels, differences without truncation error. Two cells' sums at the plane between them are equal
// but for rounding: the sum of the weights' magnitudes times the voxels' error. The third
// derivative jumps, which shows that the differences are as sharp as needed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/noise/noises.h"
#include "tests/noise/running_error.h"
#include "tests/support/hard_case.h"

namespace skybake::noise {
namespace {

using test::Frequency;
using test::hold;

constexpr int kSize = 1 << 14;
constexpr int kCells = 16;
constexpr int kVoxelsPerCell = kSize / kCells;
constexpr std::size_t kNodes = 7;

// Weights of f(nodes) in the Taylor coefficients at `at` of the polynomial through them, times k!.
std::array<std::array<double, kNodes>, 4> derivative_weights(
    const std::array<double, kNodes>& nodes, double at) {
    std::array<std::array<double, kNodes>, 4> weights{};
    for (std::size_t i = 0; i < kNodes; ++i) {
        // Lagrange's polynomial of node i about `at`, multiplied out factor by factor.
        std::array<double, 4> taylor = {1, 0, 0, 0};
        for (std::size_t j = 0; j < kNodes; ++j) {
            if (j == i) continue;
            const double scale = 1 / (nodes[i] - nodes[j]);
            for (std::size_t k = 4; k-- > 0;) {
                taylor[k] = scale * ((at - nodes[j]) * taylor[k] + (k > 0 ? taylor[k - 1] : 0));
            }
        }
        constexpr std::array<double, 4> kFactorial = {1, 1, 2, 6};
        for (std::size_t k = 0; k < 4; ++k) weights[k][i] = kFactorial[k] * taylor[k];
    }
    return weights;
}

// The largest jumps at the lattice planes of a row of voxels, of the value and three derivatives,
// and what rounding explains of each.
struct Jumps {
    std::array<double, 4> jump{};
    std::array<double, 4> explained{};
};

void measure(const std::vector<float>& row, double voxel_error, Jumps& jumps) {
    // Voxel centres, in cells, from either end of the cell: the nodes of the right cell are those
    // of the left one mirrored.
    std::array<int, kNodes> voxels{};
    std::array<double, kNodes> nodes{};
    for (std::size_t i = 0; i < kNodes; ++i) {
        const double chebyshev =
            0.5 - 0.5 * std::cos(static_cast<double>(i) * 3.14159265358979 / 6);
        voxels[i] = static_cast<int>(std::lround(chebyshev * (kVoxelsPerCell - 1)));
        nodes[i] = (voxels[i] + 0.5) / kVoxelsPerCell;
    }
    const auto from = derivative_weights(nodes, 0);
    const auto to = derivative_weights(nodes, 1);
    for (int cell = 0; cell < kCells; ++cell) {
        const int next = (cell + 1) % kCells;
        for (std::size_t k = 0; k < 4; ++k) {
            double left = 0;
            double right = 0;
            double magnitudes = 0;
            for (std::size_t i = 0; i < kNodes; ++i) {
                const auto at = [&](int c) {
                    return double{row[static_cast<std::size_t>(c * kVoxelsPerCell + voxels[i])]};
                };
                left += to[k][i] * at(cell);
                right += from[k][i] * at(next);
                magnitudes += std::fabs(to[k][i]) + std::fabs(from[k][i]);
            }
            jumps.jump[k] = std::max(jumps.jump[k], std::fabs(left - right));
            jumps.explained[k] = magnitudes * voxel_error;
        }
    }
}

// Rows along each axis of 2^14 voxels, the other two of 1 and of 3.
Jumps jumps_of(const config::NoiseChannel& channel_of_axis_0, double voxel_error) {
    Jumps jumps;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const int across : {1, 3}) {
            std::array<int, 3> size = {across, across, across};
            size[axis] = kSize;
            config::NoiseChannel channel = channel_of_axis_0;
            for (Frequency& frequency : channel.octaves.frequencies) {
                frequency = {1, 1, 1};  // at 1/2, or at 1/6, 1/2 and 5/6 of a cell
                frequency[axis] = kCells;
            }
            const NoisePlan plan = make_noise_plan(test::noise_of({channel}), size);
            for (int i = 0; i < across; ++i) {
                VoxelBox box{{i, across - 1 - i, i}, {1, 1, 1}};
                box.origin[axis] = 0;
                box.size[axis] = kSize;
                measure(test::filled(NoiseField(plan), box, 1)[0], voxel_error, jumps);
            }
        }
    }
    return jumps;
}

TEST(NoiseHardCase, NoiseIsTwiceContinuous) {
    const Jumps jumps =
        jumps_of(test::perlin({{1, 1, 1}}), test::gradient_octave_error(kCells, false, false));
    const char* names[] = {"value", "first derivative", "second derivative"};
    for (std::size_t k = 0; k < 3; ++k) {
        hold(fmt::format("noise C2 at planes, {}", names[k]),
             fmt::format("equal from both sides; rounding explains {:.1g}", jumps.explained[k]),
             jumps.jump[k], jumps.explained[k]);
    }
    EXPECT_LT(jumps.explained[2], 0.05);  // of second derivatives of about 10
    EXPECT_GT(jumps.jump[3], 10 * jumps.explained[3]);
}

TEST(NoiseHardCase, CurlIsOnceContinuous) {
    config::NoiseChannel channel = test::curl({{1, 1, 1}}, config::CurlComponent::y);
    const Jumps jumps = jumps_of(channel, 2 * test::gradient_octave_error(kCells, true, false));
    hold("curl C1 at planes, value",
         fmt::format("equal from both sides; rounding explains {:.1g}", jumps.explained[0]),
         jumps.jump[0], jumps.explained[0]);
    hold("curl C1 at planes, first derivative",
         fmt::format("equal from both sides; rounding explains {:.1g}", jumps.explained[1]),
         jumps.jump[1], jumps.explained[1]);
    EXPECT_GT(jumps.jump[2], 10 * jumps.explained[2]);
}

}  // namespace
}  // namespace skybake::noise
