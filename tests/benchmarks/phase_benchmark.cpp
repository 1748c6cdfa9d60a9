// Lorenz-Mie series: the kernel against plain sums, and the average over the sizes of cloud droplets.
// tests/benchmarks/README.md keeps the figures reached.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include "bakers/air/particles/lorenz_mie.h"
#include "bakers/air/particles/particle_scattering.h"
#include "tests/phase/one_sphere.h"

namespace skybake {
namespace {

constexpr ComplexNumber kWater = {1.333, 2e-9};
constexpr double kSizeParameter = 114;  // 10 um at 550 nm
constexpr std::size_t kPairs = 900;     // of angles: 1800 in all
constexpr std::size_t kAtOnce = 180;    // pairs of plain code, whose sums stay in the cache

std::vector<double> one_minus_cosines() {
    std::vector<double> values;
    for (std::size_t i = 0; i < kPairs; ++i) {
        const double half = std::sin(0.25 * std::numbers::pi * (static_cast<double>(i) + 0.5) /
                                     static_cast<double>(kPairs));
        values.push_back(2 * half * half);
    }
    return values;
}

// 1800 angles of one sphere.
void kernel(benchmark::State& state) {
    const std::vector<double> angles = one_minus_cosines();
    const std::vector<MieTerms> spheres = {test::mie_sphere(kSizeParameter, kWater).terms};
    const std::vector<double> weights = {1};
    for (auto _ : state) {
        MieIntensities sums = no_intensities(kPairs);
        add_mie_intensities(spheres, weights, angles, 1, sums);
        benchmark::DoNotOptimize(sums.parallel.data());
    }
}
BENCHMARK(kernel)->Unit(benchmark::kMicrosecond);

// The same by upward recurrence of pi_n at the cosine (Bohren & Huffman 1983, appendix A), in loops
// over angles within one over n, of which compilers make vectors. Of two sums the second changes its
// sign at 180 degrees - theta. An older baseline, with the loops the other way round, stayed scalar
// and took five times as long.
[[gnu::always_inline]] inline void swapped_loops(benchmark::State& state) {
    const std::vector<double> angles = one_minus_cosines();
    const MieTerms terms = test::mie_sphere(kSizeParameter, kWater).terms;
    for (auto _ : state) {
        MieIntensities sums = no_intensities(kPairs);
        for (std::size_t first = 0; first < kPairs; first += kAtOnce) {
            double mu[kAtOnce], pi[kAtOnce], before[kAtOnce] = {};
            double s1[2][2][kAtOnce] = {}, s2[2][2][kAtOnce] = {};  // of two sums, both parts
            std::fill_n(pi, kAtOnce, 1.0);
            for (std::size_t j = 0; j < kAtOnce; ++j) mu[j] = 1 - angles[first + j];
            for (std::size_t i = 0; i < terms.size(); ++i) {
                const double n = static_cast<double>(i) + 1;
                const double sign = i % 2 == 0 ? 0.5 : -0.5;
                const std::complex sum(0.5 * terms[i][0], 0.5 * terms[i][1]);
                const std::complex difference(sign * terms[i][2], sign * terms[i][3]);
                const std::complex a = sum + difference;
                const std::complex b = sum - difference;
                for (std::size_t j = 0; j < kAtOnce; ++j) {
                    const double tau = n * mu[j] * pi[j] - (n + 1) * before[j];
                    s1[i % 2][0][j] += a.real() * pi[j];
                    s1[i % 2][1][j] += a.imag() * pi[j];
                    s2[i % 2][0][j] += b.real() * pi[j];
                    s2[i % 2][1][j] += b.imag() * pi[j];
                    s1[1 - i % 2][0][j] += b.real() * tau;
                    s1[1 - i % 2][1][j] += b.imag() * tau;
                    s2[1 - i % 2][0][j] += a.real() * tau;
                    s2[1 - i % 2][1][j] += a.imag() * tau;
                    const double next = (2 * n + 1) / n * mu[j] * pi[j] - (n + 1) / n * before[j];
                    before[j] = pi[j];
                    pi[j] = next;
                }
            }
            const auto square = [](const auto& s, std::size_t j, double sign) {
                const double real = s[0][0][j] + sign * s[1][0][j];
                const double imaginary = s[0][1][j] + sign * s[1][1][j];
                return real * real + imaginary * imaginary;
            };
            for (std::size_t j = 0; j < kAtOnce; ++j) {
                sums.perpendicular[first + j] = square(s1, j, 1);
                sums.parallel[first + j] = square(s2, j, 1);
                sums.back_perpendicular[first + j] = square(s1, j, -1);
                sums.back_parallel[first + j] = square(s2, j, -1);
            }
        }
        benchmark::DoNotOptimize(sums.parallel.data());
    }
}
void plain_sum(benchmark::State& state) { swapped_loops(state); }
BENCHMARK(plain_sum)->Unit(benchmark::kMicrosecond);
[[gnu::target("avx512f,avx512dq,avx512vl")]] void plain_sum_avx512(benchmark::State& state) {
    if (!__builtin_cpu_supports("avx512dq")) return state.SkipWithError("no AVX-512");
    swapped_loops(state);
}
BENCHMARK(plain_sum_avx512)->Unit(benchmark::kMicrosecond);

// Gamma distribution of 10 um at 680, 550 and 440 nm, one thread, to the percentage asked.
void cloud_droplets(benchmark::State& state) {
    config::Particles cloud;
    cloud.effective_radius = {10e-6};
    cloud.effective_variance = 0.1;
    const double accuracy = static_cast<double>(state.range(0)) / 1000;
    for (auto _ : state) {
        for (const double wavelength : {680e-9, 550e-9, 440e-9}) {
            benchmark::DoNotOptimize(particle_scattering(cloud, {wavelength}, accuracy, 1).error);
        }
    }
}
BENCHMARK(cloud_droplets)->Arg(10)->Arg(3);

}  // namespace
}  // namespace skybake
