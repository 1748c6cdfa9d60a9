// Lorenz-Mie series: the kernel against the plain sum of Bohren & Huffman's BHMIE, and the average
// over the sizes of cloud droplets. tests/benchmarks/README.md keeps the figures reached.
#include <benchmark/benchmark.h>

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

// The same by upward recurrence of pi_n at the cosine, angle by angle with its mirror image, as
// BHMIE has it (Bohren & Huffman 1983, appendix A).
void plain_sum(benchmark::State& state) {
    const std::vector<double> angles = one_minus_cosines();
    const MieCoefficients sphere = mie_coefficients(kSizeParameter, kWater);
    for (auto _ : state) {
        double total = 0;
        for (const double one_minus : angles) {
            const double mu = 1 - one_minus;
            double before = 0;
            double pi = 1;
            double s1[2] = {};
            double s2[2] = {};
            double back1[2] = {};
            double back2[2] = {};
            double sign = 1;
            for (std::size_t i = 0; i < sphere.a.size(); ++i) {
                const double n = static_cast<double>(i) + 1;
                const double tau = n * mu * pi - (n + 1) * before;
                const double c = (2 * n + 1) / (n * (n + 1));
                const double a[2] = {sphere.a[i].real, sphere.a[i].imaginary};
                const double b[2] = {sphere.b[i].real, sphere.b[i].imaginary};
                for (int k = 0; k < 2; ++k) {
                    s1[k] += c * (a[k] * pi + b[k] * tau);
                    s2[k] += c * (a[k] * tau + b[k] * pi);
                    back1[k] += sign * c * (a[k] * pi - b[k] * tau);
                    back2[k] += sign * c * (b[k] * pi - a[k] * tau);
                }
                sign = -sign;
                const double next = ((2 * n + 1) * mu * pi - (n + 1) * before) / n;
                before = pi;
                pi = next;
            }
            for (int k = 0; k < 2; ++k) {
                total += s1[k] * s1[k] + s2[k] * s2[k] + back1[k] * back1[k] + back2[k] * back2[k];
            }
        }
        benchmark::DoNotOptimize(total);
    }
}
BENCHMARK(plain_sum);

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
