// Speed against the project's own baselines, "as in the paper": each pair interleaved, thread CPU
// time, quoted as a ratio in one run. tests/benchmarks/README.md keeps the figures reached.
//
// Run with --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true
// --benchmark_report_aggregates_only=true.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "bakers/air/ray.h"
#include "bakers/air/transmittance_mapping.h"
#include "bakers/assets/multiple_scattering/multiple_scattering_kernel.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/assets/sky/sky_lights.h"
#include "bakers/assets/transmittance/transmittance_table.h"
#include "bakers/field/baked.h"
#include "bakers/field/table_model.h"
#include "bakers/light/solver/solve_light.h"
#include "bakers/math/bake_clock.h"
#include "config/assets/multiple_scattering.h"
#include "config/assets/transmittance.h"
#include "config/recipe/recipe.h"
#include "tests/support/multiple_scattering_as_in_paper.h"

namespace skybake {
namespace {

// Optical depth by equal steps along the ray, as the papers and their samples compute it: the
// baselines to which figures of the exact kernel (optical_depth.h) are ratios.

// The place in a step of length L / n, with L the distance to the top, where its extinction is
// evaluated.
enum class StepRule {
    // At its end, where step i ends at (i + 0.3) L / n: the sample of Hillaire 2020, n = 40.
    // Density falls along most rays, so the result is too small. First order.
    end_point,
    // In its middle. Second order.
    midpoint,
};

constexpr double kSampleInStep = 0.3;  // SampleSegmentT in the sample of Hillaire 2020

// Returns the optical depth from an altitude with s = r mu to the top of the atmosphere. The ray
// must not hit the ground. It takes one sample after the other, without vectors; steps >= 1.
Spectrum optical_depth_by_steps(const Medium& medium, double altitude_km, double s_km, int steps,
                                StepRule rule) {
    assert(steps >= 1);
    const Shell shell = shell_of(medium);
    const double step = distance_to_top_km(shell, altitude_km, s_km) / steps;
    const bool middle = rule == StepRule::midpoint;
    Spectrum depth{};
    double begin = 0;
    for (int i = 0; i < steps; ++i) {
        const double end = step * (i + (middle ? 0.5 : kSampleInStep));
        const double length_km = middle ? step : end - begin;
        begin = end;
        const double altitude =
            std::clamp(altitude_along_km(shell, altitude_km, s_km, end), 0.0, shell.thickness_km);
        depth += length_km * extinction_at(medium, altitude);
    }
    return depth;
}

const config::Recipe& earth_recipe() {
    static const config::Recipe recipe =
        *config::parse_recipe(
             "preset = \"earth_hillaire\"\n[bake.transmittance]\n[bake.multiple_scattering]\n"
             "method = \"converged\"\nmapping = \"hillaire\"\nsize = [32, 32]\n",
             "benchmark")
             .value;
    return recipe;
}

const Medium& earth() {
    static const Medium medium = make_medium(earth_recipe().parameters.atmosphere);
    return medium;
}

// 256x64 by a plain loop over texels and steps.
void transmittance_by_steps(benchmark::State& state, int steps, StepRule rule) {
    const Shell shell = shell_of(earth());
    for (auto _ : state) {
        double sum = 0;
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 256; ++x) {
                const TransmittanceRay ray = transmittance_ray(shell, {x / 255.0, y / 63.0});
                const Spectrum depth =
                    optical_depth_by_steps(earth(), ray.altitude_km, ray.s_km, steps, rule);
                sum += std::exp(-depth.x) + std::exp(-depth.y) + std::exp(-depth.z);
            }
        }
        benchmark::DoNotOptimize(sum);
    }
}

void transmittance_exact(benchmark::State& state) {
    const TableModel model = transmittance_model(earth(), config::TransmittanceBake{});
    for (auto _ : state) {
        benchmark::DoNotOptimize(bake_texels(model, 0, {256, 64}, BakeOptions{1}));
    }
}

// 32x32, both with a ready transmittance function.
std::vector<double> suns() {
    std::vector<double> result;
    for (int i = 0; i < 32; ++i) result.push_back(-1 + 2 * i / 31.0);
    return result;
}

void multiple_scattering_by_paper(benchmark::State& state) {
    const Image2<float> transmittance = as_in_paper::transmittance(earth());
    for (auto _ : state) {
        for (int y = 0; y < 32; ++y) {
            for (const double sun : suns()) {
                benchmark::DoNotOptimize(
                    as_in_paper::multiple_scattering(earth(), transmittance, 100 * y / 31.0, sun));
            }
        }
    }
}

const Sunlight& ready_sunlight() {
    static const Sunlight sunlight(earth(), quadrature_altitudes_km(earth()), {256, 128}, 1);
    return sunlight;
}

std::vector<double> multiple_scattering_table(const QuadratureLevel& level) {
    const std::vector<double> altitudes = quadrature_altitudes_km(earth());
    const std::vector<double> sun = suns();
    std::vector<double> psi(32 * 32 * 3);
    for (int y = 0; y < 32; ++y) {
        const RowQuadrature row = make_row_quadrature(earth(), altitudes, 100 * y / 31.0, level);
        integrate_row(earth(), ready_sunlight(), row, sun.data(), 32, psi.data() + y * 96);
    }
    return psi;
}

// RMS against the finest level, relative to max(value, 1e-3 of the channel's largest).
double rms_error(const std::vector<double>& psi) {
    static const std::vector<double> reference = multiple_scattering_table({48, 1e-4, 1e-5});
    double largest[3] = {};
    for (std::size_t i = 0; i < reference.size(); ++i) {
        double& value = largest[i / 32 % 3];
        value = std::max(value, reference[i]);
    }
    double sum = 0;
    for (std::size_t i = 0; i < psi.size(); ++i) {
        const double scale = std::max(reference[i], 1e-3 * largest[i / 32 % 3]);
        sum += (psi[i] - reference[i]) * (psi[i] - reference[i]) / (scale * scale);
    }
    return std::sqrt(sum / static_cast<double>(psi.size()));
}

void multiple_scattering_converged(benchmark::State& state) {
    const auto level = static_cast<std::size_t>(state.range(0)) - 1;
    const QuadratureLevel& quadrature = quadrature_levels()[level];
    for (auto _ : state) benchmark::DoNotOptimize(multiple_scattering_table(quadrature));
    state.counters["rms"] = rms_error(multiple_scattering_table(quadrature));
}

// Wall clock on one and two threads at 512x512.
void table_on_threads(benchmark::State& state, std::size_t section) {
    const auto threads = static_cast<int>(state.range(0));
    config::Bake bake = earth_recipe().parameters.bakes[section];
    constexpr std::array<int, 2> kSize = {512, 512};
    if (auto* asset = bake.find<config::TransmittanceBake>()) asset->size = kSize;
    if (auto* asset = bake.find<config::MultipleScatteringBake>()) {
        asset->size = kSize;
        asset->max_texel_error = 0.05;
    }
    for (auto _ : state) {
        BakeClock clock;
        const auto baked = bake_asset(earth_recipe(), bake, {threads, Certification::off, nullptr});
        benchmark::DoNotOptimize(baked.value.has_value());
        state.SetIterationTime(clock.seconds().texels);
    }
}

// Light of all orders at this many wavelengths, packet by packet. Air is the measured one, since
// coefficients of other presets are those of three wavelengths.
void light_of_wavelengths(benchmark::State& state) {
    const std::int64_t count = state.range(0);
    std::string wavelengths;
    for (std::int64_t i = 0; i < count; ++i) {
        wavelengths += fmt::format("{}\"{} nm\"", i > 0 ? ", " : "", 400 + 300 * i / count);
    }
    const config::Recipe recipe =
        *config::parse_recipe(
             fmt::format("preset = \"earth\"\nwavelengths = [{}]\n"
                         "[color]\nspace = \"linear_srgb\"\n[bake.sky_view]\naltitude = \"0 km\"\n"
                         "sun_elevations = [\"30 deg\"]\n",
                         wavelengths),
             "benchmark")
             .value;
    std::vector<SkyMedium> packets;
    for (const config::Atmosphere& packet : light_packets(recipe.parameters)) {
        packets.push_back(make_sky_medium(packet));
    }
    for (auto _ : state) {
        for (const SkyMedium& packet : packets) {
            benchmark::DoNotOptimize(solve_light(packet, SolverSettings{}, 1));
        }
    }
    state.counters["packets"] = static_cast<double>(packets.size());
}

// "As in the paper", and in the middles of steps.
BENCHMARK_CAPTURE(transmittance_by_steps, end_points, 40, StepRule::end_point);
BENCHMARK_CAPTURE(transmittance_by_steps, midpoints, 40, StepRule::midpoint);
BENCHMARK(transmittance_exact);
BENCHMARK(multiple_scattering_by_paper);
BENCHMARK(multiple_scattering_converged)
    ->DenseRange(1, static_cast<int>(quadrature_levels().size()));
BENCHMARK(light_of_wavelengths)->ArgsProduct({{3, 4, 8, 16, 40}});
BENCHMARK_CAPTURE(table_on_threads, transmittance, 0)->Arg(1)->Arg(2)->UseManualTime();
BENCHMARK_CAPTURE(table_on_threads, multiple_scattering, 1)->Arg(1)->Arg(2)->UseManualTime();

}  // namespace
}  // namespace skybake
