#include "bakers/assets/bruneton/scattering_volume.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "bakers/air/ray.h"
#include "bakers/assets/bruneton/scattering_error.h"
#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/assets/bruneton/table_content.h"
#include "bakers/field/baked.h"
#include "bakers/field/finish_volume.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/shared_light.h"

namespace skybake {
namespace {

constexpr const char* kScatteringConvention = "end points on texel centres; clamps";

std::string content_text(const BrunetonBake& bake, const TableContent& content) {
    const std::string single = "single scattering by all other layers";
    const std::string higher = bake.orders == 0 ? std::string("all higher orders")
                                                : fmt::format("orders 2 to {}", bake.orders);
    const std::string over = "over Rayleigh's phase function, times the solar irradiance";
    if (bake.table == BrunetonTable::single_mie) {
        return "single scattering by the Mie layers over their phase function, times the solar "
               "irradiance";
    }
    if (bake.table == BrunetonTable::higher_orders) return fmt::format("{} {}", higher, over);
    const std::string light =
        bake.orders == 1 ? single + " " + over : fmt::format("{} and {} {}", single, higher, over);
    if (!content.first().has_alpha()) return light;
    return fmt::format(
        "colours: {}; A: single scattering by the Mie layers over their phase function, of the "
        "first colour",
        light);
}

// Adds the constants of the sun's axis: D(1), D(0), and the largest share A that is on it.
void describe_axes(const ScatteringMapping& mapping, Baked& volume) {
    const Shell& shell = mapping.shell();
    for (AxisMapping& axis : volume.axes) axis.constants = shell_constants(shell);
    Facts& along_u = volume.axes[0].constants;
    along_u.emplace_back("nu_size", static_cast<double>(mapping.nu_size()));
    along_u.emplace_back("sun_size", static_cast<double>(mapping.sun_size()));
    along_u.emplace_back("sun_cos_zenith_min", mapping.sun_cos_zenith_min());
    along_u.emplace_back("largest_share", mapping.largest_share());
}

void describe(const BrunetonBake& bake, const TableContent& content,
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
          "lower half: rays to the ground, x = 1 - (d - d_min) / (d_max - d_min), d_min = h, d_max "
          "= rho; upper half: rays to the top, x = (d - d_min) / (d_max - d_min), d_min = R_top - "
          "r, d_max = rho + H",
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

// One packet of wavelengths: what its texels are made of and measured by.
struct PacketTable {
    PacketTable(const ScatteringPacket& packet, const BrunetonBake& bake)
        : content(packet.medium, bake) {}

    // Makes the parts of the texels. After an interruption they must not be used.
    void make_parts(const ScatteringPacket& packet, const BrunetonBake& bake,
                    const ScatteringMapping& mapping, const BakeOptions& options) {
        const SkyMedium& medium = packet.medium;
        light = content.wants_higher() ? packet.light.get() : nullptr;
        if (content.wants_single()) {
            sunlight = sunlight_of({packet.atmosphere}, medium.air, options);
        }
        parts = shared_parts(packet.atmosphere, bake, medium, light, sunlight, content, mapping,
                             options);
    }

    void make_reference(const SkyMedium& medium) {
        if (light != nullptr) {
            higher = std::make_unique<SolvedOrders>(medium, *light, light->degree());
        }
        reference = std::make_unique<ScatteringReference>(medium, content, higher.get());
        rows = std::make_unique<ScatteringRows>(medium, light, sunlight);
    }

    ScatteringContent content;
    const SolvedLight* light = nullptr;
    std::shared_ptr<const TransmittanceField> sunlight;
    TableParts parts;
    std::unique_ptr<const SolvedOrders> higher;
    std::unique_ptr<const ScatteringReference> reference;
    std::unique_ptr<const ScatteringRows> rows;
};

// Returns of each packet what `part` returns.
template <class Part>
auto of_each(std::vector<std::unique_ptr<PacketTable>>& packets, const Part& part) {
    std::vector<decltype(part(*packets.front()))> all;
    for (const auto& packet : packets) all.push_back(part(*packet));
    return all;
}

constexpr auto kAtCentres = TexelConvention::end_points_on_texel_centres;

// The coordinate in [0, 1] of a position in texels, whose centres are at whole numbers.
double unit_coordinate_of(double position, int count) {
    return count == 1 ? 0.5 : std::clamp(position / (count - 1), 0.0, 1.0);
}

// Rays to the ground have a length only above it.
constexpr double kLowestEyeKm = 0.01;

ScatteringView off_the_horizon(const Shell& shell, ScatteringView view) {
    if (view.meets_ground) {
        view.altitude_km = std::max(view.altitude_km, kLowestEyeKm);
        view.s_km = std::min(view.s_km, highest_s_of_ground_km(shell, view.altitude_km));
        view.s_km = std::max(view.s_km, -(shell.ground_radius_km + view.altitude_km));
        view.length_km = distance_to_ground_km(shell, view.altitude_km, view.s_km);
    } else {
        view.s_km = std::max(view.s_km, lowest_s_of_sky_km(shell, view.altitude_km));
        view.length_km = distance_to_top_km(shell, view.altitude_km, view.s_km);
    }
    return view;
}

}  // namespace

Outcome<Baked> bake_scattering(const std::vector<ScatteringPacket>& packets,
                               const std::vector<glm::dvec3>& weights, const BrunetonBake& bake,
                               const BakeOptions& options, Baked volume) {
    std::vector<std::unique_ptr<PacketTable>> tables;
    for (const ScatteringPacket& packet : packets) {
        tables.push_back(std::make_unique<PacketTable>(packet, bake));
    }
    const TableContent content(
        of_each(tables, [](PacketTable& one) -> const ScatteringContent* { return &one.content; }),
        weights, bake.solar_irradiance);
    const ScatteringMapping mapping(shell_of(packets.front().medium.air), bake.size, bake.nu_size,
                                    bake.sun_cos_zenith_min);
    describe(bake, content, mapping, volume);
    for (std::size_t p = 0; p < packets.size(); ++p) {
        tables[p]->make_parts(packets[p], bake, mapping, options);
        if (options.cancelled()) return {};
    }
    const auto table = std::make_shared<VoxelArray>(table_texels(
        content, mapping, of_each(tables, [](PacketTable& one) { return one.parts; }), options));
    for (std::size_t p = 0; p < packets.size(); ++p) tables[p]->make_reference(packets[p].medium);
    VolumeFinish finish;
    finish.histogram_ranges = table->ranges();
    finish.measure = [&](const Baked& baked, const BakeOptions& how) {
        const ExactTexel exact = exact_texel(
            content, of_each(tables, [](PacketTable& one) { return one.reference.get(); }));
        const std::vector<double> largest = largest_values(*table);
        Certificate certificate =
            measure_scattering(*table, mapping, exact, largest, baked.pixel_type,
                               scattering_points(how.certification), how);
        if (how.cancelled()) return certificate;
        const TexelRow row =
            texel_row(content, of_each(tables, [](PacketTable& one) { return one.rows.get(); }));
        search_scattering(*table, mapping, exact, row, largest, baked.pixel_type, how, certificate);
        return certificate;
    };
    finish.probe_place = [&mapping](const std::array<double, 3>& uvw, int) {
        return scattering_probe_place(mapping, uvw);
    };
    add_voxels(bake.size, table, volume);
    add_mip_levels(bake.mips, options, volume);
    return finish_volume(std::move(volume), finish, options);
}

ScatteringPlace scattering_place(const ScatteringMapping& mapping,
                                 const std::array<double, 3>& uvw) {
    const std::array<int, 3>& size = mapping.size();
    const double across = uvw[1] * size[1] - 0.5;
    const bool ground = uvw[1] < 0.5;
    const int half = mapping.half_size();
    const double x_mu = unit_coordinate_of(ground ? half - 1 - across : across - half, half);
    const double x_r = unit_coordinate_of(uvw[2] * size[2] - 0.5, size[2]);
    // u is the sun's within a sub-image. nu lies as far beyond the sub-image's own as the sun is
    // from a texel's centre: any place between two will do.
    const double image = std::clamp(uvw[0] * mapping.nu_size(), 0.0, mapping.nu_size() - 1e-9);
    const double sun = (image - std::floor(image)) * mapping.sun_size() - 0.5;
    const double between = std::floor(image) + (sun - std::floor(sun));
    ScatteringPlace place;
    place.view = off_the_horizon(mapping.shell(), mapping.view(x_mu, ground, x_r));
    place.sun_cos_zenith = mapping.sun_cos_zenith(unit_coordinate_of(sun, mapping.sun_size()));
    const double r = mapping.shell().ground_radius_km + place.view.altitude_km;
    const FeasibleCosines there_are = feasible_cosines(place.view.s_km / r, place.sun_cos_zenith);
    place.nu = std::clamp(ScatteringMapping::nu(unit_coordinate_of(between, mapping.nu_size())),
                          there_are.low, there_are.high);
    return place;
}

std::vector<ProbeLookup> scattering_lookups(const ScatteringMapping& mapping,
                                            const ScatteringPlace& place) {
    const ScatteringCoordinates x = mapping.coordinates(place.view, place.sun_cos_zenith, place.nu);
    const double half = texture_coordinate(kAtCentres, x.x_mu, mapping.half_size());
    const double v = x.meets_ground ? 0.5 - 0.5 * half : 0.5 + 0.5 * half;
    const double w = texture_coordinate(kAtCentres, x.x_r, mapping.size()[2]);
    const double sun = texture_coordinate(kAtCentres, x.x_mu_s, mapping.sun_size());
    const int images = mapping.nu_size();
    const auto u = [&](double image) { return (image + sun) / images; };
    if (images == 1) return {{{u(0), v, w}}};
    const double position = std::clamp(x.x_nu, 0.0, 1.0) * (images - 1);
    const double first = std::min(std::floor(position), images - 2.0);
    const double share = position - first;
    return {{{u(first), v, w}, 1 - share}, {{u(first + 1), v, w}, share}};
}

ProbePlace scattering_probe_place(const ScatteringMapping& mapping,
                                  const std::array<double, 3>& uvw) {
    const ScatteringPlace place = scattering_place(mapping, uvw);
    const double r = mapping.shell().ground_radius_km + place.view.altitude_km;
    return {{{"altitude_km", place.view.altitude_km},
             {"cos_zenith", place.view.s_km / r},
             {"sun_cos_zenith", place.sun_cos_zenith},
             {"nu", place.nu},
             {"ground", place.view.meets_ground ? 1 : 0}},
            scattering_lookups(mapping, place)};
}

ScatteringPlace scattering_place(const ScatteringMapping& mapping, double altitude_km,
                                 double cos_zenith, double sun_cos_zenith, double nu, bool ground) {
    const Shell& shell = mapping.shell();
    ScatteringView view;
    view.altitude_km = altitude_km;
    view.s_km = (shell.ground_radius_km + altitude_km) * cos_zenith;
    view.meets_ground = ground;
    view.length_km = ground ? distance_to_ground_km(shell, altitude_km, view.s_km)
                            : distance_to_top_km(shell, altitude_km, view.s_km);
    return {view, sun_cos_zenith, nu};
}

}  // namespace skybake
