// Lorenz-Mie series: the kernel against plain sums, and the average over the sizes of cloud droplets.
// tests/benchmarks/README.md keeps the figures reached.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "bakers/air/particles/lorenz_mie.h"
#include "bakers/air/particles/particle_scattering.h"
#include "tests/support/plain_mie.h"

namespace skybake {
namespace {

constexpr ComplexNumber kWater = {1.333, 2e-9};
constexpr double kSizeParameter = 114;  // 10 um at 550 nm
constexpr std::size_t kPairs = 900;     // of angles: 1800 in all
constexpr std::size_t kAtOnce = 128;    // pairs of plain code, whose sums stay in the cache

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
    const std::vector<MieTerms> spheres = {mie_terms(mie_coefficients(kSizeParameter, kWater))};
    const std::vector<double> weights = {1};
    for (auto _ : state) {
        MieIntensities sums = no_intensities(kPairs);
        add_mie_intensities(spheres, weights, angles, 1, sums);
        benchmark::DoNotOptimize(sums.parallel.data());
    }
}
BENCHMARK(kernel);

// The same by upward recurrence of pi_n at the cosine (Bohren & Huffman 1983, appendix A), in loops
// over angles within one over n, which compilers make vectors of. The first of two sums has what is
// the same at 180 degrees - theta, the second what has the other sign there. The baseline before was
// BHMIE's loop over n within one over angles, which stays scalar and takes five times as long.
[[gnu::always_inline]] inline void swapped_loops(const MieCoefficients& sphere,
                                                 const double* angles, std::size_t count,
                                                 double* const* out) {
    double mu[kAtOnce], pi[kAtOnce], before[kAtOnce];
    double s1[2][2][kAtOnce] = {}, s2[2][2][kAtOnce] = {};  // part, sum
    for (std::size_t j = 0; j < count; ++j) {
        mu[j] = 1 - angles[j];
        pi[j] = 1;
        before[j] = 0;
    }
    for (std::size_t i = 0; i < sphere.a.size(); ++i) {
        const double n = static_cast<double>(i) + 1;
        const ComplexNumber a = (2 * n + 1) / (n * (n + 1)) * sphere.a[i];
        const ComplexNumber b = (2 * n + 1) / (n * (n + 1)) * sphere.b[i];
        const std::size_t same = i % 2;
        for (std::size_t j = 0; j < count; ++j) {
            const double tau = n * mu[j] * pi[j] - (n + 1) * before[j];
            s1[0][same][j] += a.real * pi[j];
            s1[1][same][j] += a.imaginary * pi[j];
            s2[0][same][j] += b.real * pi[j];
            s2[1][same][j] += b.imaginary * pi[j];
            s1[0][1 - same][j] += b.real * tau;
            s1[1][1 - same][j] += b.imaginary * tau;
            s2[0][1 - same][j] += a.real * tau;
            s2[1][1 - same][j] += a.imaginary * tau;
            const double next = (2 * n + 1) / n * mu[j] * pi[j] - (n + 1) / n * before[j];
            before[j] = pi[j];
            pi[j] = next;
        }
    }
    const auto square = [](double x) { return x * x; };
    for (std::size_t j = 0; j < count; ++j) {
        out[0][j] = square(s1[0][0][j] + s1[0][1][j]) + square(s1[1][0][j] + s1[1][1][j]);
        out[1][j] = square(s2[0][0][j] + s2[0][1][j]) + square(s2[1][0][j] + s2[1][1][j]);
        out[2][j] = square(s1[0][0][j] - s1[0][1][j]) + square(s1[1][0][j] - s1[1][1][j]);
        out[3][j] = square(s2[0][0][j] - s2[0][1][j]) + square(s2[1][0][j] - s2[1][1][j]);
    }
}

void plain_sums(const MieCoefficients& sphere, const double* angles, std::size_t count,
                double* const* out) {
    swapped_loops(sphere, angles, count, out);
}
[[gnu::target("avx512f,avx512dq,avx512vl")]] void plain_sums_avx512(const MieCoefficients& sphere,
                                                                    const double* angles,
                                                                    std::size_t count,
                                                                    double* const* out) {
    swapped_loops(sphere, angles, count, out);
}

void plain(benchmark::State& state, decltype(plain_sums)* add) {
    if (add == plain_sums_avx512 && !__builtin_cpu_supports("avx512dq")) {
        return state.SkipWithError("no AVX-512");
    }
    const std::vector<double> angles = one_minus_cosines();
    const MieCoefficients sphere = mie_coefficients(kSizeParameter, kWater);
    for (auto _ : state) {
        MieIntensities sums = no_intensities(kPairs);
        for (std::size_t j = 0; j < kPairs; j += kAtOnce) {
            double* const out[] = {&sums.perpendicular[j], &sums.parallel[j],
                                   &sums.back_perpendicular[j], &sums.back_parallel[j]};
            add(sphere, &angles[j], std::min(kAtOnce, kPairs - j), out);
        }
        benchmark::DoNotOptimize(sums.parallel.data());
    }
}
BENCHMARK_CAPTURE(plain, as_compiled, plain_sums);
BENCHMARK_CAPTURE(plain, avx512, plain_sums_avx512);

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
BENCHMARK(cloud_droplets)->Arg(10)->Arg(3)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace skybake

BENCHMARK_MAIN();
