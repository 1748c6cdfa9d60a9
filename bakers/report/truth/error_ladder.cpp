#include "bakers/report/truth/error_ladder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "bakers/air/medium.h"
#include "bakers/air/optical_depth.h"
#include "bakers/light/sky_colors.h"
#include "bakers/light/sky_irradiance.h"
#include "bakers/light/sky_ray.h"
#include "bakers/light/sky_view_mapping.h"
#include "config/assets/multiple_scattering.h"
#include "config/optics/standard_profiles.h"
#include "config/sections/layer.h"
#include "config/sections/spectral_air.h"

namespace skybake {

namespace {

using config::Parameters;

// --- Colour -------------------------------------------------------------------------------------

LadderStep color_step(const Parameters& parameters, const BakeOptions& options) {
    const std::vector<config::Length>& wavelengths = parameters.wavelengths;
    const bool is_visible = std::all_of(
        wavelengths.begin(), wavelengths.end(),
        [](config::Length one) { return one.meters >= 380e-9 && one.meters <= 780e-9; });
    const bool is_plain = !parameters.color && wavelengths.size() == 3;
    if (!is_visible || (!parameters.color && !is_plain) || wavelengths.size() < 2) {
        return {"colour", std::nullopt, "The recipe's wavelengths are not shown as colours."};
    }
    const config::Color color = parameters.color.value_or(config::Color());
    const ColorSkies skies(parameters.atmosphere, wavelengths, options);
    if (options.cancelled()) return {};
    const ColorError error = skies.error(
        wavelengths, color,
        is_plain ? weights_as_rgb(wavelengths) : skies.fitted_weights(wavelengths, color));
    return {"colour", LadderSize{error.median, error.ninth_decile},
            is_plain ? std::string("Three wavelengths shown as red, green and blue differ so much "
                                   "from the colours of whole spectra, over luminance.")
                     : fmt::format("Colours made of {} wavelengths differ so much from those of "
                                   "whole spectra, over luminance.",
                                   wavelengths.size())};
}

// --- Air ----------------------------------------------------------------------------------------

// The errors that the table of ozone and Bucholtz's formula leave (examples/colors.md).
constexpr LadderSize kMeasuredAir = {0.001, 0.001};

bool is_of_earth(const config::Atmosphere& atmosphere) {
    return std::fabs(atmosphere.ground_radius.kilometers() / 6371 - 1) < 0.01;
}

// Returns how far the coefficients of a layer of air are from those of a column of 1013.25 hPa, at
// each wavelength.
std::vector<double> off_from_measured(const config::Layer& layer,
                                      const config::Atmosphere& atmosphere,
                                      const std::vector<config::Length>& wavelengths) {
    config::Layer measured = layer;
    measured.gas = config::GasAmount{config::Gas::air, {config::air_column_per_m2()}};
    const config::Length thickness{atmosphere.top_radius.meters - atmosphere.ground_radius.meters};
    if (!config::resolve_matter(measured, thickness, wavelengths).empty()) return {};
    std::vector<double> off;
    for (std::size_t c = 0; c < wavelengths.size(); ++c) {
        const double wanted = measured.scattering[c].per_meter;
        off.push_back(std::fabs(layer.scattering[c].per_meter / wanted - 1));
    }
    return off;
}

LadderStep air_step(const Parameters& parameters) {
    const config::Atmosphere& atmosphere = parameters.atmosphere;
    const auto is_air = [](const config::Layer& layer) {
        return layer.phase == config::Phase::rayleigh;
    };
    const auto air = std::find_if(atmosphere.layers.begin(), atmosphere.layers.end(), is_air);
    if (!is_of_earth(atmosphere) || air == atmosphere.layers.end()) {
        return {"air", std::nullopt, "There is no measured air of this planet to compare with."};
    }
    if (air->gas) {
        return {"air", kMeasuredAir, "The coefficients of its gases are measured ones."};
    }
    const std::vector<double> off = off_from_measured(*air, atmosphere, parameters.wavelengths);
    if (off.empty()) return {"air", std::nullopt, "Air is not known at these wavelengths."};
    double sum = 0;
    for (const double one : off) sum += one;
    return {"air",
            LadderSize{sum / static_cast<double>(off.size()),
                       *std::max_element(off.begin(), off.end())},
            fmt::format("The optical depth of the layer `{}` differs so much from that of the "
                        "Earth's air at 1013.25 hPa.",
                        air->name)};
}

// --- Profile ------------------------------------------------------------------------------------

// In degrees of elevation: by day, and through dusk.
constexpr std::array kSunsOfProfile = {30.0, 10.0, 5.0, 2.0, 0.0, -2.0, -4.0, -6.0};

// The same amounts of air and ozone, where the US Standard Atmosphere has them.
config::Atmosphere with_standard_profiles(config::Atmosphere atmosphere) {
    const config::Length thickness{atmosphere.top_radius.meters - atmosphere.ground_radius.meters};
    for (config::Layer& layer : atmosphere.layers) {
        const bool is_air = layer.phase == config::Phase::rayleigh;
        const bool is_ozone = layer.gas && layer.gas->gas == config::Gas::ozone;
        if (!is_air && !is_ozone) continue;
        const double before = config::density_column(layer, thickness);
        layer.profile = config::Profile::tabulated;
        layer.table.clear();
        for (const config::ProfilePoint& point :
             config::standard_profile(is_air ? config::Gas::air : config::Gas::ozone)) {
            layer.table.push_back({{point.altitude_m}, point.relative_density});
        }
        const double factor = before / config::density_column(layer, thickness);
        for (auto& one : layer.scattering) one.per_meter *= factor;
        for (auto& one : layer.extinction) one.per_meter *= factor;
    }
    return atmosphere;
}

// Returns the light of the sky on level ground, scattered once: by sun, then by channel.
std::vector<double> light_of_dusk(const config::Atmosphere& atmosphere,
                                  const BakeOptions& options) {
    std::vector<double> light;
    for (const config::Atmosphere& packet : packets_of(atmosphere)) {
        const SkyLight sky(packet, config::SkyOrders::single, {}, {.threads = options.threads});
        SkyIrradiance ground(sky, 0);
        for (const double sun : kSunsOfProfile) {
            const Spectrum irradiance =
                ground.under(sun_at_elevation(sun / kDegreesPerRadian).cosine, {.single = 16});
            for (std::size_t c = 0; c < packet.ground_albedo.size(); ++c) {
                light.push_back(irradiance[c]);
            }
        }
    }
    return light;
}

LadderStep profile_step(const Parameters& parameters, const BakeOptions& options) {
    const config::Atmosphere& atmosphere = parameters.atmosphere;
    const bool has_air = std::any_of(
        atmosphere.layers.begin(), atmosphere.layers.end(),
        [](const config::Layer& layer) { return layer.phase == config::Phase::rayleigh; });
    if (!is_of_earth(atmosphere) || !has_air) {
        return {"profile", std::nullopt, "There is no measured profile of this planet's air."};
    }
    std::vector<double> off = light_of_dusk(atmosphere, options);
    const std::vector<double> right = light_of_dusk(with_standard_profiles(atmosphere), options);
    for (std::size_t i = 0; i < off.size(); ++i) off[i] = std::fabs(off[i] / right[i] - 1);
    std::sort(off.begin(), off.end());
    return {"profile", LadderSize{off[off.size() / 2], off.back()},
            "Light of the sky on level ground, scattered once, differs so much from that of the "
            "same amounts of air and ozone in the US Standard Atmosphere: in the median of suns "
            "from 30 degrees to -6, and of the lowest."};
}

// --- Polarisation -------------------------------------------------------------------------------

// Errors of light that is taken as unpolarised, in the median of the dome, in air without particles over
// black ground: from the best sun to the worst, by the zenith optical depth of the air at 680, 550
// and 440 nm.
struct PolarisationRow {
    double depth, low, high;
};
constexpr std::array<PolarisationRow, 3> kPolarisation = {
    {{0.0409, 0.007, 0.021}, {0.0968, 0.013, 0.038}, {0.2423, 0.027, 0.061}}};

// It is linear in the logarithm of the depth. The second order, where it begins, is in proportion to
// the depth; deeper air than in the table is taken as its last.
PolarisationRow polarisation_at(double depth) {
    const PolarisationRow& first = kPolarisation.front();
    if (depth <= first.depth) {
        const double share = depth / first.depth;
        return {depth, first.low * share, first.high * share};
    }
    for (std::size_t i = 1; i < kPolarisation.size(); ++i) {
        const PolarisationRow& a = kPolarisation[i - 1];
        const PolarisationRow& b = kPolarisation[i];
        if (depth > b.depth) continue;
        const double share = std::log(depth / a.depth) / std::log(b.depth / a.depth);
        return {depth, a.low + share * (b.low - a.low), a.high + share * (b.high - a.high)};
    }
    return kPolarisation.back();
}

LadderStep polarisation_step(const Parameters& parameters) {
    std::vector<double> depths(parameters.wavelengths.size(), 0.0);
    std::size_t first = 0;
    for (const config::Atmosphere& packet : packets_of(parameters.atmosphere)) {
        const SkyMedium medium = make_sky_medium(packet);
        for (std::size_t k = 0; k < medium.layers.size(); ++k) {
            if (packet.layers[k].phase != config::Phase::rayleigh) continue;
            const Spectrum depth = optical_depth_along(medium.layers[k].alone, 0, 1,
                                                       medium.layers[k].alone.thickness_km);
            for (std::size_t c = 0; c < packet.ground_albedo.size(); ++c) {
                depths[first + c] += depth[c];
            }
        }
        first += packet.ground_albedo.size();
    }
    LadderSize size;
    for (const double depth : depths) {
        const PolarisationRow at = polarisation_at(depth);
        size.typical += (at.low + at.high) / 2 / static_cast<double>(depths.size());
        size.high = std::max(size.high, at.high);
    }
    return {"polarisation", size,
            "Light is taken as unpolarised; by vector transport in clean air over black ground, an "
            "estimate from its optical depth."};
}

// --- Closure and table --------------------------------------------------------------------------

LadderStep closure_step(const MethodErrors& methods) {
    if (methods.empty()) return {"closure", std::nullopt, "No method was compared."};
    return {
        "closure", methods.back().second,
        "The light of all orders, as it is solved for, differs so much from traced paths, whose "
        "noise is part of it."};
}

// Returns how the keys of methods that are like this table begin (sky_methods.h).
std::string_view method_like(const config::MultipleScatteringBake& bake) {
    using config::MultipleScatteringContent;
    using config::MultipleScatteringMethod;
    if (bake.method == MultipleScatteringMethod::as_in_paper) return "as_in_paper";
    if (bake.method == MultipleScatteringMethod::converged) return "converged";
    if (bake.content == MultipleScatteringContent::moments) return "moments";
    return "mean_radiance";
}

LadderStep table_step(const Parameters& parameters, const MethodErrors& methods) {
    for (const config::Bake& bake : parameters.bakes) {
        const auto* asset = bake.find<config::MultipleScatteringBake>();
        if (!asset) continue;
        const std::string_view like = method_like(*asset);
        const bool is_twilight = asset->mapping == config::MultipleScatteringMapping::twilight;
        const std::pair<std::string, LadderSize>* found = nullptr;
        for (const auto& method : methods) {
            if (!method.first.starts_with(like)) continue;
            // Among several, takes the one with the same mapping; among moments, the highest degree.
            const bool fits = is_twilight == method.first.ends_with("twilight");
            if (!found || fits || like == "moments") found = &method;
        }
        if (!found) continue;
        return {"table", found->second,
                fmt::format("The sky of a runtime that marches with a table like `{}` differs so "
                            "much from traced paths.",
                            bake.name)};
    }
    return {"table", std::nullopt,
            "The recipe has no table of multiple scattering; each asset's `error.lookup` says what "
            "its own texels add."};
}

}  // namespace

std::vector<LadderStep> error_ladder(const Parameters& parameters, const MethodErrors& methods,
                                     const BakeOptions& options) {
    return {
        color_step(parameters, options), air_step(parameters),  profile_step(parameters, options),
        polarisation_step(parameters),   closure_step(methods), table_step(parameters, methods)};
}

}  // namespace skybake
