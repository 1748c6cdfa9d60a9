#include "bakers/assets/bruneton/scattering_volume.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bakers/air/shell_constants.h"
#include "bakers/assets/bruneton/iterated_scattering.h"
#include "bakers/assets/bruneton/lookup_fit.h"
#include "bakers/assets/bruneton/over_rayleigh.h"
#include "bakers/assets/bruneton/scattering_error.h"
#include "bakers/assets/bruneton/scattering_probe.h"
#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/field/finish_volume.h"
#include "bakers/light/solved_orders.h"
#include "config/assets/bruneton.h"

namespace skybake {

using config::BrunetonBake;
using config::BrunetonTable;

namespace {

constexpr const char* kScatteringConvention = "end points on texel centres; clamps";

std::string content_text(const BrunetonBake& bake, const ScatteringContent& content) {
    const std::string single = "single scattering by all other layers";
    const std::string higher = bake.orders == 0 ? std::string("all higher orders")
                                                : fmt::format("orders 2 to {}", bake.orders);
    const std::string over = "over Rayleigh's phase function, times the solar irradiance";
    if (bake.table == BrunetonTable::single_mie) {
        return "single scattering by the Mie layers over their phase function, times the "
               "solar irradiance";
    }
    if (bake.table == BrunetonTable::higher_orders) return fmt::format("{} {}", higher, over);
    const std::string light =
        bake.orders == 1 ? single + " " + over : fmt::format("{} and {} {}", single, higher, over);
    if (!content.has_alpha()) return light;
    return fmt::format(
        "colours: {}; A: single scattering by the Mie layers over their phase "
        "function, of the first colour",
        light);
}

// What follows from the sun's axis: D(1), D(0), and the largest share A that is on it.
void describe_axes(const ScatteringMapping& mapping, Baked& volume) {
    const Shell& shell = mapping.shell();
    for (AxisMapping& axis : volume.axes) axis.constants = shell_constants(shell);
    Facts& along_u = volume.axes[0].constants;
    along_u.emplace_back("nu_size", static_cast<double>(mapping.nu_size()));
    along_u.emplace_back("sun_size", static_cast<double>(mapping.sun_size()));
    along_u.emplace_back("sun_cos_zenith_min", mapping.sun_cos_zenith_min());
    along_u.emplace_back("largest_share", mapping.largest_share());
}

void describe(const BrunetonBake& bake, const ScatteringContent& content,
              const ScatteringMapping& mapping, Baked& volume) {
    volume.content = content_text(bake, content);
    volume.mapping = "bruneton_scattering";
    volume.axes = {
        {{"nu_and_sun_cos_zenith",
          fmt::format("{} sub-images side by side, nu = -1 ... 1, blended linearly by hand; in "
                      "each x = (1 - a / A) / (1 + a), a = (D - D(1)) / (D(0) - D(1)), D(mu_s) the "
                      "distance from the ground to the top, A = a({:.9g})",
                      bake.nu_size, bake.sun_cos_zenith_min),
          kScatteringConvention, bake.sun_cos_zenith_min, 1},
         {"view_distance_km",
          "lower half: rays to the ground, x = 1 - (d - d_min) / (d_max - d_min), d_min = h, "
          "d_max = rho; upper half: rays to the top, x = (d - d_min) / (d_max - d_min), "
          "d_min = R_top - r, d_max = rho + H",
          kScatteringConvention, 0, 1},
         {"altitude_km",
          "x = rho / H, rho = sqrt(h (2 R_ground + h)), h the altitude, H = rho at the top",
          kScatteringConvention, 0, mapping.shell().thickness_km}}};
    describe_axes(mapping, volume);
    for (std::size_t c = 0; c < bake.solar_irradiance.size(); ++c) {
        volume.details.emplace_back(fmt::format("solar_irradiance_{}", volume.channel_names[c]),
                                    to_digits(bake.solar_irradiance[c], 9));
    }
    if (!bake.mie_layers.empty()) {
        volume.details.emplace_back("mie_layers",
                                    fmt::format("{}", fmt::join(bake.mie_layers, ", ")));
        // A runtime has one phase function for all of them.
        volume.details.emplace_back("over_phase_function_of", bake.mie_layers.front());
    }
    volume.details.emplace_back("nu_size", static_cast<double>(bake.nu_size));
    volume.details.emplace_back("sun_cos_zenith_min", bake.sun_cos_zenith_min);
}

}  // namespace

config::Outcome<Baked> bake_scattering(const SkyMedium& medium,
                                       const std::shared_ptr<const SolvedLight>& light,
                                       const BrunetonBake& bake, const BakeOptions& options,
                                       Baked volume) {
    const ScatteringContent content(medium, bake);
    const ScatteringMapping mapping(shell_of(medium.air), bake.size, bake.nu_size,
                                    bake.sun_cos_zenith_min);
    describe(bake, content, mapping, volume);
    const auto start = std::chrono::steady_clock::now();
    const SolvedLight* wanted = content.wants_higher() ? light.get() : nullptr;
    const bool iterated = wanted != nullptr && bake.method == config::BrunetonMethod::iterated;
    TableParts parts = remembered_parts(medium, light, content, mapping, content.wants_single(),
                                        wanted != nullptr && !iterated, options);
    if (iterated) {
        parts.higher = std::make_shared<const HigherOrderParts>(
            over_rayleigh(iterated_scattering(medium, mapping, bake.orders, options), mapping));
    }
    if (options.cancelled()) return {};
    const auto table = std::make_shared<HeldVoxels>(scattering_texels(content, mapping, parts));
    // The baseline's texels stay as they are.
    if (!iterated) fit_lookups(mapping, content.measured_channels(), options, *table);
    volume.bake_seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::unique_ptr<const SolvedOrders> higher;
    if (wanted != nullptr) {
        higher = std::make_unique<SolvedOrders>(medium, *wanted, wanted->degree());
    }
    const ScatteringReference reference(medium, content, higher.get());
    VolumeFinish finish;
    for (std::size_t c = 0; c < content.channels(); ++c) {
        const double largest = table->largest(c);
        finish.histogram_ranges.push_back({0, largest > 0 ? largest : 1});
    }
    finish.measure = [&](const Baked& baked, const BakeOptions& how) {
        return measure_scattering(*table, mapping, exact_texel(content, reference),
                                  largest_values(*table), baked.pixel_type,
                                  scattering_points(how.certification), how);
    };
    finish.probe_place = [&mapping](const std::array<double, 3>& uvw, int) {
        return scattering_probe_place(mapping, uvw);
    };
    Level level;
    level.size = bake.size;
    level.repeats = repeating_axes(volume.axes);
    level.voxels = table;
    volume.levels.push_back(std::move(level));
    add_mip_levels(bake.mips, options, volume);
    return finish_volume(std::move(volume), finish, options);
}

}  // namespace skybake
