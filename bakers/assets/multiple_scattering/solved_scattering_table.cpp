#include "bakers/assets/multiple_scattering/solved_scattering_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "bakers/air/ray.h"
#include "bakers/assets/description/probe_places.h"
#include "bakers/assets/sky/sky_asset.h"
#include "bakers/field/finish_table.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/light/shared_light.h"
#include "bakers/light/solver/energy_balance.h"
#include "bakers/light/solver/solve_light.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/math/relative_error.h"

namespace skybake {

using config::MultipleScatteringBake;
using config::MultipleScatteringContent;
using config::MultipleScatteringMapping;

namespace {

// Air with spheres scatters light into peaks, which the sky's own light leaves out. Moments of this
// degree feed its mean radiance.
constexpr int kDegreeWithPeaks = 4;

// M_lm of solved_scattering_table.h.
Spectrum moment_of(const SolvedLight& light, int l, int m, double altitude_km,
                   double sun_cos_zenith) {
    if (l == 0) return light.mean_radiance_at(altitude_km, sun_cos_zenith);
    return harmonic_norm(l, m) * light.moment_at(altitude_km, sun_cos_zenith, l, m);
}

// Returns the largest moment of any channel on the solution's grid, or 0 where there is no solution.
double largest_moment(const SolvedLight& light, int l, int m) {
    double most = 0;
    for (const double altitude_km : light.altitudes_km) {
        for (const double cosine : light.suns.cosines) {
            most = std::max(most, largest(absolute(moment_of(light, l, m, altitude_km, cosine))));
        }
    }
    return most;
}

TableModel moment_model(const SolvedLight& light, const SolvedLight& finer_light, int l, int m,
                        const SunColumns& columns, double thickness_km) {
    TableModel model;
    model.channels = light.channels;
    model.lowest = l == 0 ? 0 : std::numeric_limits<double>::lowest();
    model.highest = std::numeric_limits<double>::max();
    model.cost_per_texel = {1};
    const auto row = [l, m, &columns, thickness_km](const SolvedLight& from, double y,
                                                    const std::vector<double>& x, double* values) {
        for (const double coordinate : x) {
            const Spectrum value =
                moment_of(from, l, m, y * thickness_km, columns.cosine(coordinate));
            values = std::copy_n(data(value), from.channels, values);
        }
    };
    model.row = [row, &light](int, double y, const std::vector<double>& x, double* values) {
        row(light, y, x, values);
    };
    model.reference = [row, &finer_light](double y, const std::vector<double>& x, double* values) {
        row(finer_light, y, x, values);
    };
    if (l == 0) {
        model.error = relative_error;
    } else {
        // Moments have both signs: their errors are shares of the largest.
        const double largest = largest_moment(finer_light, l, m);
        model.error = [largest](double value, double reference, double) {
            return largest > 0 ? (value - reference) / largest : value - reference;
        };
    }
    return model;
}

void describe(const MultipleScatteringBake& bake, const SunColumns& columns, int degree,
              const Shell& shell, Baked& table) {
    const int parts = moment_count(degree);
    table.kind = "multiple_scattering";
    table.content =
        "Psi (1/sr): mean radiance of all light but the sun's own, per unit of solar irradiance; "
        "multiply by sigma_s alone";
    if (degree > 0) {
        table.content = fmt::format(
            "moments M_lm (1/sr) of the light, degree {}: sigma_s chi_l M_lm P_l^m(mu) cos(m phi), "
            "summed over l and m, is what an eye that looks along (mu, phi) gets from a km of a "
            "layer",
            degree);
    }
    const std::string altitude = "x = altitude / (R_top - R_ground)";
    describe_sun_table(
        bake.mapping,
        parts > 1 ? fmt::format(
                        "{} in each of {} tables one below the other, (l, m) the (l (l + 1) / 2 + "
                        "m)-th: v = (l (l + 1) / 2 + m + v of its table) / {}",
                        altitude, parts, parts)
                  : altitude,
        shell, table);
    AxisMapping& sun = table.axes[0];
    const double share = columns.last - columns.first;
    if (columns.first > 0 || columns.last < 1) {
        sun.formula = fmt::format("x = ({} - {:.17g}) / {:.17g}", sun.formula.substr(4),
                                  columns.first, share);
    }
    sun.first = columns.cosine(0);
    sun.last = columns.cosine(1);
    sun.constants = {{"first", columns.first}, {"share", share}};
    table.axes[1].constants.emplace_back("tables", static_cast<double>(parts));
    table.axes[1].constants.emplace_back("degree", static_cast<double>(degree));
    table.conventions.radiance_unit = "1/sr";
    set_files(bake, table);
    table.certificate.reference = "the same light before it was stored";
    if (degree > 0) table.certificate.scale += "; moments beyond the first: to their largest";
}

// The light of the sky itself, which a recipe that has both solves for once, unless spheres have peaks
// or the table holds moments of a higher degree.
LightRequest light_request(const config::Atmosphere& atmosphere,
                           const MultipleScatteringBake& bake) {
    LightRequest request = {.atmosphere = atmosphere, .peaks_of_spheres = true};
    const int wanted = bake.content == MultipleScatteringContent::moments ? bake.degree : 0;
    if (has_spheres(atmosphere)) {
        request.degree = std::max(wanted, kDegreeWithPeaks);
    } else if (wanted > kLeastSkyDegree) {
        request.degree = wanted;
    }
    return request;
}

// Whether errors are measured against a finer solution. A quick certificate compares with the light
// that was stored: error.sky tells how far that light is off, by paths.
bool needs_finer_light(const MultipleScatteringBake& bake, Certification certification) {
    return certification == Certification::full || bake.max_error;
}

// The reference of the certificate.
LightRequest finer_request(const config::Atmosphere& atmosphere,
                           const MultipleScatteringBake& bake) {
    LightRequest request = light_request(atmosphere, bake);
    request.finer = true;
    request.degree_more = bake.content == MultipleScatteringContent::moments ? 2 : 0;
    return request;
}

}  // namespace

std::vector<Need> needs_of_solved_scattering(const config::Atmosphere& atmosphere,
                                             const MultipleScatteringBake& bake,
                                             Certification certification) {
    std::vector<Need> needs = {need_of(light_request(atmosphere, bake))};
    if (needs_finer_light(bake, certification)) {
        needs.push_back(need_of(finer_request(atmosphere, bake)));
    }
    return needs;
}

Outcome<Baked> bake_solved_scattering(const config::Atmosphere& atmosphere,
                                      const std::optional<config::Scene>& scene,
                                      const MultipleScatteringBake& bake,
                                      const BakeOptions& options, Baked table) {
    const SkyMedium medium = make_sky_medium(atmosphere);
    const double thickness_km = medium.air.thickness_km;
    const bool moments = bake.content == MultipleScatteringContent::moments;
    const int degree = moments ? bake.degree : 0;
    const SunColumns columns = sun_columns(bake.mapping, scene, shell_of(medium.air));
    describe(bake, columns, degree, shell_of(medium.air), table);

    Outcome<Baked> outcome;
    if (moments && bake.max_error) {
        outcome.diagnostics.push_back(diagnosis(
            "E0403", fmt::format("`{}`: max_error does not work with this `content`", table.name),
            "give `size` in place of `max_error`", "max_error"));
        return outcome;
    }
    const auto solved = light_of(light_request(atmosphere, bake), medium, options);
    if (options.cancelled()) return outcome;
    const SolvedLight& light = *solved;
    const EnergyBalance balance = energy_balance(medium, light);
    if (const auto failure = check_light(balance, light, table.name)) {
        outcome.diagnostics.push_back(*failure);
        return outcome;
    }
    table.details.emplace_back("method", "solved");
    table.details.emplace_back("orders", light.applications + 1.0);
    table.details.emplace_back("left_out", to_digits(light.left_out, 2));
    table.details.emplace_back("energy_error", to_digits(balance.largest_error(), 2));

    std::shared_ptr<const SolvedLight> finer_light;
    if (needs_finer_light(bake, options.certification)) {
        table.certificate.reference =
            "the same equation on a finer grid of altitudes, directions and rays";
        finer_light = light_of(finer_request(atmosphere, bake), medium, options);
        if (options.cancelled()) return outcome;
    }

    AccuracyRequest request;
    request.size = bake.size;
    request.max_error = bake.max_error;
    request.choice = {32, 16};
    request.quick = {32, 16};
    request.full = {1024, 16};
    request.quick_search = {128, 64, 16, 32, 0};
    request.full_search = {1024, 256, 64, 128, 0};
    StackedParts parts;
    for (int l = 0; l <= degree; ++l) {
        for (int m = 0; m <= l; ++m) {
            const auto place_of = [&columns, thickness_km, moments, l, m](double x, double y) {
                Place place = {{"altitude_km", y * thickness_km},
                               {"sun_cos_zenith", columns.cosine(x)}};
                if (moments) place.insert(place.end(), {{"l", l}, {"m", m}});
                return place;
            };
            const TableModel model = moment_model(light, finer_light ? *finer_light : light, l, m,
                                                  columns, thickness_km);
            if (!add_part(make_part(model, request, options, place_of, table), parts)) {
                return {{}, std::move(parts.diagnostics)};
            }
        }
    }
    return stack_tables(std::move(parts), options);
}

bool is_solved(const MultipleScatteringBake& asset) {
    return asset.method == config::MultipleScatteringMethod::solved;
}

int tables_of(const MultipleScatteringBake& asset) {
    const bool moments = asset.content == config::MultipleScatteringContent::moments;
    return is_solved(asset) && moments ? moment_count(asset.degree) : 1;
}

SunColumns sun_columns_of(const Parameters& parameters, const MultipleScatteringBake& asset) {
    const auto scene = is_solved(asset) ? parameters.scene : std::nullopt;
    return sun_columns(asset.mapping, scene, shell_of(parameters.atmosphere));
}

std::unique_ptr<const HigherOrders> stored_orders(const Parameters& parameters,
                                                  const MultipleScatteringBake& asset,
                                                  const SkyMedium& medium,
                                                  const Image2<float>& table) {
    const double thickness_km = shell_of(parameters.atmosphere).thickness_km;
    const PlaceInTable place = [columns = sun_columns_of(parameters, asset), thickness_km](
                                   double altitude_km, double sun_cos_zenith) {
        return TablePlace{columns.coordinate(sun_cos_zenith), altitude_km / thickness_km};
    };
    const int degree = tables_of(asset) > 1 ? asset.degree : 0;
    return std::make_unique<const TableOrders>(medium, table, degree, place);
}

}  // namespace skybake
