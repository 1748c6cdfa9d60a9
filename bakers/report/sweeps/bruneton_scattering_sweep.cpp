#include "bakers/report/sweeps/bruneton_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/air/forward_peak.h"
#include "bakers/assets/bruneton/bruneton_volume.h"
#include "bakers/assets/bruneton/iterated_scattering.h"
#include "bakers/assets/bruneton/lookup_fit.h"
#include "bakers/assets/bruneton/scattering_error.h"
#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/io/files/to_string.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/shared_light.h"
#include "bakers/light/solver/solve_light.h"
#include "bakers/report/sweeps/sweep.h"
#include "config/assets/bruneton.h"

namespace skybake {

using config::BrunetonBake;
using config::BrunetonMethod;
using config::PixelType;
using Size = std::array<int, 3>;

namespace {

constexpr int kScatteringPoints = 4096;  // as for --certify=full
constexpr int kQuickScatteringPoints = 512;
// This excludes the published size, 256x128x32; half of that along each axis except nu is 2^17.
constexpr std::int64_t kQuickMostTexels = std::int64_t{1} << 18;
constexpr std::int64_t kMostScatteringTexels = std::int64_t{1} << 24;
// At this size, 4 orders take 4 s.
constexpr std::int64_t kMostIteratedTexels = std::int64_t{1} << 14;

std::int64_t texels_of(const Size& size) { return std::int64_t{size[0]} * size[1] * size[2]; }

// Divides the size, but keeps at least 2 texels per axis, or as many as there are.
Size divided(const BrunetonBake& bake, int divisor) {
    const auto along = [divisor](int texels) {
        return std::min(texels, std::max(texels / divisor, 2));
    };
    return {along(bake.size[0] / bake.nu_size) * bake.nu_size, 2 * along(bake.size[1] / 2),
            along(bake.size[2])};
}

// Returns the sizes, the largest first: the one asked for, a half and a quarter of it. Sizes with
// too many texels are left out; if all have too many, the first smaller one is taken.
std::vector<Size> scattering_sizes(const BrunetonBake& bake, bool quick) {
    const std::int64_t most = quick ? kQuickMostTexels : kMostScatteringTexels;
    std::vector<Size> sizes;
    for (int divisor = 1; divisor <= 4 || sizes.empty(); divisor *= 2) {
        const Size size = divided(bake, divisor);
        const bool is_smallest = size == divided(bake, 2 * divisor);
        if (texels_of(size) > most && !is_smallest) continue;
        if (sizes.empty() || sizes.back() != size) sizes.push_back(size);
    }
    return sizes;
}

Size iterated_size(const BrunetonBake& bake, const Size& smallest) {
    Size size = smallest;
    for (int divisor = 8; texels_of(size) > kMostIteratedTexels; divisor *= 2) {
        const Size next = divided(bake, divisor);
        if (next == size) break;
        size = next;
    }
    return size;
}

// The light and the references that all variants share.
struct Subject {
    Subject(const config::Atmosphere& atmosphere, const BrunetonBake& asked)
        : medium(without_forward_peaks(make_sky_medium(atmosphere))),
          bake(asked),
          content(medium, bake) {}

    // Returns the exact texel at a place, from a memo if possible: lookups of all sizes are at the
    // same places, and their light is expensive.
    Texel exact(const ScatteringView& view, double sun_cos_zenith, double nu) {
        const std::array<double, 6> place = {view.altitude_km, view.s_km,
                                             view.length_km,   view.meets_ground ? 1.0 : 0.0,
                                             sun_cos_zenith,   nu};
        {
            const std::lock_guard lock(mutex);
            const auto known = texels.find(place);
            if (known != texels.end()) return known->second;
        }
        const Texel texel = content.texel(reference->parts(view, sun_cos_zenith, nu));
        const std::lock_guard lock(mutex);
        return texels.emplace(place, texel).first->second;
    }

    ScatteringMapping mapping(const Size& size) const {
        return {shell_of(medium.air), size, bake.nu_size, bake.sun_cos_zenith_min};
    }

    const SkyMedium medium;
    const BrunetonBake bake;
    const ScatteringContent content;
    std::unique_ptr<const SolvedLight> light;  // null: no higher orders
    std::unique_ptr<const SolvedOrders> higher;
    std::unique_ptr<const ScatteringReference> reference;
    std::vector<double> largest;  // of the largest size; one scale for all variants

  private:
    std::mutex mutex;
    std::map<std::array<double, 6>, Texel> texels;
};

class ScatteringSweep {
  public:
    ScatteringSweep(const config::Atmosphere& atmosphere, const BrunetonBake& asked,
                    const ReportOptions& options)
        : subject_(std::make_shared<Subject>(atmosphere, asked)),
          asked_(asked),
          options_(options),
          one_thread_{.threads = 1, .progress = options.progress} {
        made_.repetitions = bruneton_repetitions(options.quick);
        made_.points = options.quick ? kQuickScatteringPoints : kScatteringPoints;
    }

    // Makes the sweep. Returns nothing after an interruption.
    std::optional<BrunetonSweep> make() {
        if (!solve()) return std::nullopt;
        const std::vector<Size> sizes = scattering_sizes(asked_, options_.quick);
        made_.size = sizes.front();
        iterated_size_ = iterated_size(asked_, sizes.back());
        for (const Size& size : sizes) {
            if (!add_solved(size)) return std::nullopt;
        }
        if (subject_->light) {
            if (iterated_size_ != sizes.back() && !add_solved(iterated_size_)) return std::nullopt;
            if (!add_iterated()) return std::nullopt;
        }
        made_.sweep.notes.emplace_back(
            "solved, fitted: texels are moved by up to a quarter, so that lookups between them are "
            "right; their texel errors include the shift");
        return std::move(made_);
    }

  private:
    // Returns the median time of a job, or nothing after an interruption.
    std::optional<double> seconds_of(const std::function<void()>& job) const {
        const std::vector<double> seconds =
            interleaved_medians({job}, made_.repetitions,
                                [&](int, std::size_t) { return !is_cancelled(options_.progress); });
        if (seconds.empty() || is_cancelled(options_.progress)) return std::nullopt;
        return seconds.front();
    }

    bool solve() {
        const auto settings = light_settings(subject_->medium, asked_);
        if (settings) {
            const auto seconds = seconds_of([&] {
                subject_->light = std::make_unique<const SolvedLight>(solve_light(
                    subject_->medium, *settings, one_thread_.threads, one_thread_.progress));
            });
            if (!seconds) return false;
            light_seconds_ = *seconds;
            subject_->higher = std::make_unique<const SolvedOrders>(
                subject_->medium, *subject_->light, subject_->light->degree());
        }
        subject_->reference = std::make_unique<const ScatteringReference>(
            subject_->medium, subject_->content, subject_->higher.get());
        return true;
    }

    bool add_solved(const Size& size) {
        const ScatteringMapping mapping = subject_->mapping(size);
        const ScatteringContent& content = subject_->content;
        std::shared_ptr<VoxelArray> exact;
        std::shared_ptr<VoxelArray> fitted;
        const auto exact_seconds = seconds_of([&] {
            exact = std::make_shared<VoxelArray>(scattering_texels(
                content, mapping,
                make_parts(
                    subject_->medium, subject_->light.get(),
                    content.wants_single() ? make_sunlight(subject_->medium.air, 1) : nullptr,
                    content, mapping, one_thread_)));
        });
        if (!exact_seconds) return false;
        const auto fit_seconds = seconds_of([&] {
            fitted = std::make_shared<VoxelArray>(*exact);
            fit_lookups(mapping, content.measured_channels(), one_thread_, *fitted);
        });
        if (!fit_seconds) return false;
        if (size == made_.size) subject_->largest = largest_values(*fitted);
        const double seconds = light_seconds_ + *exact_seconds;
        const bool is_own = size == asked_.size && asked_.method == BrunetonMethod::solved;
        for (const PixelType type : {PixelType::float32, PixelType::half}) {
            VolumeVariant& variant = add(fmt::format("solved, fitted, {}", to_string(type)),
                                         size_text(size), size, type, fitted);
            variant.seconds = seconds + *fit_seconds;
            variant.of_recipe = is_own && type == asked_.pixel_type;
        }
        for (const PixelType type : {PixelType::float32, PixelType::half}) {
            add(fmt::format("solved, exact, {}", to_string(type)), size_text(size), size, type,
                exact)
                .seconds = seconds;
        }
        return true;
    }

    bool add_iterated() {
        const ScatteringMapping mapping = subject_->mapping(iterated_size_);
        const int most = asked_.orders == 0 ? kIteratedOrders : asked_.orders;
        for (int orders = 2; orders <= std::min(most, kIteratedOrders); ++orders) {
            std::shared_ptr<VoxelArray> table;
            const auto seconds = seconds_of(
                [&] { table = std::make_shared<VoxelArray>(iterated_texels(mapping, orders)); });
            if (!seconds) return false;
            for (const PixelType type : {PixelType::float32, PixelType::half}) {
                VolumeVariant& variant =
                    add(fmt::format("iterated, {}", to_string(type)),
                        fmt::format("{} orders", orders), iterated_size_, type, table);
                variant.seconds = seconds;
                if (orders == kIteratedOrders) variant.baseline = "as published (Bruneton 2017)";
                variant.of_recipe = asked_.method == BrunetonMethod::iterated &&
                                    asked_.size == iterated_size_ && orders == most &&
                                    asked_.pixel_type == type;
            }
        }
        made_.sweep.notes.push_back(fmt::format(
            "iterated: it is measured only at {}, where 4 orders take seconds; its transmittances "
            "and first order are exact, where the published code looks them up in tables",
            size_text(iterated_size_)));
        return true;
    }

    VoxelArray iterated_texels(const ScatteringMapping& mapping, int orders) const {
        const ScatteringContent& content = subject_->content;
        TableParts parts;
        if (content.wants_single()) {
            parts = make_parts(subject_->medium, nullptr, make_sunlight(subject_->medium.air, 1),
                               content, mapping, one_thread_);
        }
        parts.higher = std::make_shared<const HigherOrderParts>(over_rayleigh(
            iterated_scattering(subject_->medium, mapping, orders, one_thread_), mapping));
        return scattering_texels(content, mapping, parts);
    }

    VolumeVariant& add(std::string family, std::string name, const Size& size, PixelType type,
                       const std::shared_ptr<const VoxelArray>& table) {
        VolumeVariant& variant =
            add_variant(made_.sweep, std::move(family), std::move(name), table, size, type);
        variant.in_quadrature_sweep = size == iterated_size_ && type == PixelType::float32;
        variant.measure = [subject = subject_, table, mapping = subject_->mapping(size)](
                              PixelType stored, int points, const BakeOptions& options) {
            return measure_scattering(
                *table, mapping,
                [&subject](const ScatteringView& view, double sun_cos_zenith, double nu) {
                    return subject->exact(view, sun_cos_zenith, nu);
                },
                subject->largest, stored, points, options);
        };
        return variant;
    }

    std::shared_ptr<Subject> subject_;
    const BrunetonBake& asked_;
    const ReportOptions& options_;
    BakeOptions one_thread_;
    BrunetonSweep made_;
    Size iterated_size_{};
    double light_seconds_ = 0;
};

}  // namespace

std::optional<BrunetonSweep> bruneton_scattering_sweep(const config::Atmosphere& atmosphere,
                                                       const BrunetonBake& asked,
                                                       const ReportOptions& options) {
    return ScatteringSweep(atmosphere, asked, options).make();
}

}  // namespace skybake
