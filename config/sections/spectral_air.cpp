#include "config/sections/spectral_air.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <string_view>
#include <utility>

#include "config/fields/fields.h"
#include "config/optics/elementary.h"
#include "config/optics/ground_spectra.h"
#include "config/sections/layer.h"
#include "config/text/mapped.h"
#include "config/text/units.h"

namespace skybake::config {

Particles spheres_of(AerosolComponent component, double relative_humidity) {
    const double percent = relative_humidity * 100;
    const LogNormalRadii radii = radii_of(component, percent);
    Particles spheres;
    spheres.name = name_of(component);
    spheres.material = ParticleMaterial::tabulated;
    for (const Length wavelength : tabulated_wavelengths(component)) {
        const RefractiveIndex index = refractive_index_of(component, wavelength, percent);
        spheres.indices.push_back({wavelength, index.real, index.imaginary});
    }
    spheres.sizes = SizeDistribution::log_normal;
    spheres.radius = radii.mode_radius;
    spheres.geometric_deviation = radii.deviation;
    spheres.smallest_radius = radii.smallest;
    spheres.largest_radius = radii.largest;
    return spheres;
}

std::vector<SphereKind> kinds_of(AerosolMixture mixture, double relative_humidity) {
    return mapped<SphereKind>(parts_of(mixture), [&](const MixturePart& part) {
        return SphereKind{spheres_of(part.component, relative_humidity), part.particles};
    });
}

namespace {

// Koschmieder's law, and Rayleigh scattering at 550 nm at sea level.
constexpr double koschmieder = 3.912;
constexpr double clean_air_per_meter = 1.162e-5;

struct Extinction {
    double scattering = 0;
    double extinction = 0;
};

// Extinction and scattering of a gas or aerosol, per metre, at density 1.
Extinction extinction_of(const Layer& layer, double column_m, Length wavelength) {
    if (layer.gas) {
        const GasOptics optics = gas_optics(layer.gas->gas, wavelength);
        const double per_m3 = layer.gas->column.per_square_meter / column_m;
        return {per_m3 * optics.scattering_m2, per_m3 * optics.extinction_m2()};
    }
    const AerosolLaw& law = *layer.aerosol;
    const double at_550 =
        law.optical_depth ? *law.optical_depth / column_m : law.extinction.per_meter;
    const double extinction =
        at_550 * power(wavelength.meters / aerosol_wavelength.meters, -law.angstrom_exponent);
    return {law.single_scattering_albedo * extinction, extinction};
}

// The wavelengths of a recipe in ascending order, and where each stands among its channels.
struct Spectrum {
    std::vector<std::pair<double, std::size_t>> points;

    explicit Spectrum(std::span<const Length> given) {
        for (std::size_t i = 0; i < given.size(); ++i) points.emplace_back(given[i].meters, i);
        std::ranges::sort(points);
        const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
        points.erase(std::unique(points.begin(), points.end(), same), points.end());
    }

    // The index of the first of the two points whose line or power law holds at a wavelength.
    std::size_t piece_at(double meters) const {
        std::size_t i = 0;
        while (i + 2 < points.size() && meters > points[i + 1].first) ++i;
        return i;
    }

    // How far a wavelength is from point i to the next, from 0 to 1.
    double share_at(std::size_t i, double meters) const {
        const double from = points[i].first;
        return std::clamp((meters - from) / (points[i + 1].first - from), 0.0, 1.0);
    }
};

double on_power_law(const Spectrum& spectrum, const std::vector<InverseLength>& values,
                    double meters) {
    const auto value = [&](std::size_t i) { return values[spectrum.points[i].second].per_meter; };
    if (spectrum.points.size() == 1) return value(0);
    const std::size_t i = spectrum.piece_at(meters);
    const double low = value(i);
    const double high = value(i + 1);
    const double from = spectrum.points[i].first;
    const double to = spectrum.points[i + 1].first;
    if (low == high) return low;
    if (low > 0 && high > 0) {
        const double exponent = logarithm(high / low) / logarithm(to / from);
        return low * power(meters / from, exponent);
    }
    return low + (high - low) * spectrum.share_at(i, meters);
}

double on_line(const Spectrum& spectrum, const std::vector<double>& values, double meters) {
    const auto value = [&](std::size_t i) { return values[spectrum.points[i].second]; };
    if (spectrum.points.size() == 1) return value(0);
    const std::size_t i = spectrum.piece_at(meters);
    return value(i) + (value(i + 1) - value(i)) * spectrum.share_at(i, meters);
}

void interpolate_numbers(Layer& layer, const Spectrum& spectrum, std::span<const Length> wanted) {
    const Layer given = layer;
    layer.scattering.clear();
    layer.extinction.clear();
    for (const Length wavelength : wanted) {
        const double scattering = on_power_law(spectrum, given.scattering, wavelength.meters);
        const double extinction = on_power_law(spectrum, given.extinction, wavelength.meters);
        layer.scattering.push_back({scattering});
        layer.extinction.push_back({std::max(extinction, scattering)});
    }
}

// Returns what is not known at one of the wavelengths, or an empty text.
std::string fault_of_range(std::string_view what, const WavelengthRange& range,
                           std::span<const Length> wavelengths) {
    for (const Length wavelength : wavelengths) {
        if (range.contains(wavelength)) continue;
        return fmt::format("its {} not known at {}, but from {} to {}", what,
                           wavelength_to_string(wavelength.meters),
                           wavelength_to_string(range.shortest.meters),
                           wavelength_to_string(range.longest.meters));
    }
    return "";
}

constexpr std::string_view no_density = "its profile has no density within the air";

std::string resolve_spheres(Layer& layer, Length thickness, std::span<const Length> wavelengths) {
    LayerParticles& particles = layer.particles;
    std::vector<Length> needed(wavelengths.begin(), wavelengths.end());
    if (particles.optical_depth || particles.extinction) needed.push_back(aerosol_wavelength);
    for (const SphereKind& kind : particles.kinds) {
        const std::string what = fmt::format("particles `{}` are", kind.particles.name);
        std::string fault = fault_of_range(what, range_of(kind.particles), needed);
        if (!fault.empty()) return fault;
    }
    if (!particles.optical_depth) return "";
    const double column_m = density_column(layer, thickness);
    if (!(column_m > 0)) return std::string(no_density);
    particles.extinction = InverseLength{*particles.optical_depth / column_m};
    return "";
}

}  // namespace

InverseLength haze_of_visibility(Length visibility) {
    return {koschmieder / visibility.meters - clean_air_per_meter};
}

std::string resolve_matter(Layer& layer, Length thickness, std::span<const Length> wavelengths) {
    if (layer.phase == Phase::mie) return resolve_spheres(layer, thickness, wavelengths);
    if (!layer.gas && !layer.aerosol) return "";
    if (layer.gas) {
        std::string fault = fault_of_range("gas is", range_of(layer.gas->gas), wavelengths);
        if (!fault.empty()) return fault;
    }
    const double column_m = density_column(layer, thickness);
    if (!(column_m > 0)) return std::string(no_density);
    layer.scattering.clear();
    layer.extinction.clear();
    for (const Length wavelength : wavelengths) {
        const Extinction found = extinction_of(layer, column_m, wavelength);
        if (!(found.extinction <= coefficient_range.maximum)) {
            return fmt::format("its extinction is {} at {}, above {}",
                               inverse_length_to_string(found.extinction),
                               wavelength_to_string(wavelength.meters),
                               inverse_length_to_string(coefficient_range.maximum));
        }
        layer.scattering.push_back({found.scattering});
        layer.extinction.push_back({found.extinction});
    }
    return "";
}

Atmosphere atmosphere_at(const Atmosphere& atmosphere, std::span<const Length> given,
                         std::span<const Length> wanted) {
    const Spectrum spectrum(given);
    Atmosphere result = atmosphere;
    result.ground_albedo.clear();
    for (const Length wavelength : wanted) {
        result.ground_albedo.push_back(
            atmosphere.ground_spectrum.empty()
                ? on_line(spectrum, atmosphere.ground_albedo, wavelength.meters)
                : albedo_at(atmosphere.ground_spectrum, wavelength));
    }
    const Length thickness{atmosphere.top_radius.meters - atmosphere.ground_radius.meters};
    for (Layer& layer : result.layers) {
        if (layer.phase == Phase::mie) {
            layer.particles.wavelengths.assign(wanted.begin(), wanted.end());
        } else if (layer.gas || layer.aerosol) {
            const std::string fault = resolve_matter(layer, thickness, wanted);
            assert(fault.empty());
            static_cast<void>(fault);
        } else {
            interpolate_numbers(layer, spectrum, wanted);
        }
    }
    return result;
}

Atmosphere channels_of(const Atmosphere& atmosphere, std::size_t first, std::size_t count) {
    const auto cut = [&](auto& values) {
        if (values.empty()) return;
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
        values = {begin, begin + static_cast<std::ptrdiff_t>(count)};
    };
    Atmosphere part = atmosphere;
    cut(part.ground_albedo);
    for (Layer& layer : part.layers) {
        cut(layer.scattering);
        cut(layer.extinction);
        cut(layer.particles.wavelengths);
    }
    return part;
}

}  // namespace skybake::config
