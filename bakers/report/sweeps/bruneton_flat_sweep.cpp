#include "bakers/report/sweeps/bruneton_sweep.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bakers/air/forward_peak.h"
#include "bakers/assets/bruneton/bruneton_volume.h"
#include "bakers/assets/bruneton/flat_tables.h"
#include "bakers/io/files/to_string.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/solver/solve_light.h"
#include "bakers/report/sweeps/sweep.h"
#include "config/assets/bruneton.h"

namespace skybake {

using config::BrunetonBake;
using config::BrunetonConvention;
using config::BrunetonTable;
using config::PixelType;

namespace {

constexpr int kTransmittancePoints = 16384;
constexpr int kQuickTransmittancePoints = 1024;
// The number of points is small, because the reference sums over 12 times as many directions as a
// texel does.
constexpr int kIrradiancePoints = 256;
constexpr int kQuickIrradiancePoints = 32;
constexpr std::int64_t kMostFlatTexels = std::int64_t{1} << 20;
constexpr std::int64_t kMostIrradianceTexels = std::int64_t{1} << 12;
constexpr std::int64_t kQuickMostIrradianceTexels = std::int64_t{1} << 10;

// A table as a function, with everything that it depends on.
struct FlatSubject {
    SkyMedium medium;
    std::vector<double> solar_irradiance;
    std::unique_ptr<const SolvedLight> light;
    std::unique_ptr<const SkyLight> sky;
    FlatTable table;
};

// Makes the subject. `seconds` is the time of solving the light. Returns null after an
// interruption.
std::shared_ptr<const FlatSubject> subject_of(const config::Atmosphere& atmosphere,
                                              const BrunetonBake& asked,
                                              const ReportOptions& options, double& seconds) {
    auto subject = std::make_shared<FlatSubject>();
    subject->medium = make_sky_medium(atmosphere);
    if (asked.table == BrunetonTable::transmittance) {
        subject->table = flat_transmittance(subject->medium.air);
        return subject;
    }
    subject->medium = without_forward_peaks(std::move(subject->medium));
    subject->solar_irradiance = asked.solar_irradiance;
    std::unique_ptr<const HigherOrders> higher;
    if (const auto settings = light_settings(subject->medium, asked)) {
        const double start = thread_cpu_seconds();
        subject->light = std::make_unique<const SolvedLight>(
            solve_light(subject->medium, *settings, 1, options.progress));
        seconds = thread_cpu_seconds() - start;
        if (is_cancelled(options.progress)) return nullptr;
        higher = std::make_unique<SolvedOrders>(subject->medium, *subject->light,
                                                subject->light->degree());
    }
    const auto orders = higher ? config::SkyOrders::all : config::SkyOrders::single;
    subject->sky = std::make_unique<const SkyLight>(subject->medium, orders, std::move(higher));
    subject->table = flat_irradiance(*subject->sky, subject->solar_irradiance);
    return subject;
}

// Returns sizes from a quarter to twice as many texels along each axis, without those of too many
// texels. If all have too many, the size asked for is halved until it is small enough.
std::vector<std::array<int, 3>> flat_sizes(const BrunetonBake& asked, bool quick) {
    const std::int64_t irradiance = quick ? kQuickMostIrradianceTexels : kMostIrradianceTexels;
    const std::int64_t most =
        asked.table == BrunetonTable::transmittance ? kMostFlatTexels : irradiance;
    std::vector<std::array<int, 3>> sizes =
        sizes_around<3>(asked.size, {{0.25, 0.25, 1}, {0.5, 0.5, 1}, {1, 1, 1}, {2, 2, 1}}, most);
    if (sizes.empty()) sizes.push_back(size_within<3>(asked.size, most));
    return sizes;
}

}  // namespace

std::optional<BrunetonSweep> bruneton_flat_sweep(const config::Atmosphere& atmosphere,
                                                 const BrunetonBake& asked,
                                                 const ReportOptions& options) {
    BrunetonSweep made;
    made.repetitions = bruneton_repetitions(options.quick);
    const bool is_transmittance = asked.table == BrunetonTable::transmittance;
    made.points = is_transmittance
                      ? (options.quick ? kQuickTransmittancePoints : kTransmittancePoints)
                      : (options.quick ? kQuickIrradiancePoints : kIrradiancePoints);
    double light_seconds = 0;
    const auto subject = subject_of(atmosphere, asked, options, light_seconds);
    if (!subject) return std::nullopt;
    const std::size_t channels =
        subject->table.colours + (asked.convention == BrunetonConvention::takram ? 1 : 0);
    const std::vector<std::array<int, 3>> sizes = flat_sizes(asked, options.quick);
    for (const std::array<int, 3>& size : sizes) {
        std::shared_ptr<const VoxelArray> texels;
        const auto make = [&] {
            texels = std::make_shared<const VoxelArray>(
                flat_texels(subject->table, size, channels, BakeOptions{.threads = 1}));
        };
        const std::vector<double> seconds =
            interleaved_medians({make}, made.repetitions,
                                [&](int, std::size_t) { return !is_cancelled(options.progress); });
        if (seconds.empty()) return std::nullopt;
        for (const PixelType type : {PixelType::float32, PixelType::half}) {
            VolumeVariant& variant =
                add_variant(made.sweep, std::string("quadrature, ") + std::string(to_string(type)),
                            size_text(size), texels, size, type);
            variant.seconds = light_seconds + seconds.front();
            variant.of_recipe = size == asked.size && type == asked.pixel_type;
            variant.in_quadrature_sweep = size == asked.size && type == PixelType::float32;
        }
        if (made.size != asked.size) made.size = size;
    }
    made.reference = [subject, channels](const std::array<int, 3>& size) -> VolumeReference {
        const auto remembered = std::make_shared<RememberedReference>(
            [subject, exact = flat_reference(subject->table, size, channels)](
                const std::array<double, 3>& uvw) { return exact(uvw); });
        return [remembered](const std::array<double, 3>& uvw) { return (*remembered)(uvw); };
    };
    return made;
}

}  // namespace skybake
