#include "config/sections/atmosphere.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <initializer_list>
#include <span>
#include <utility>

#include "config/fields/section_decoder.h"
#include "config/optics/aerosol_components.h"
#include "config/optics/elementary.h"
#include "config/optics/standard_profiles.h"
#include "config/sections/sections.h"
#include "config/sections/spectral_air.h"
#include "config/text/key_path.h"
#include "config/text/mapped.h"
#include "config/text/text.h"
#include "config/text/units.h"

namespace skybake::config {
namespace {

// Integrates the density over the part of a line that lies between `bottom` and `top`. The line
// runs from a to b, and the density on it linearly from density_a to density_b. The result is the
// length of the part times its mean density.
double linear_column(double a, double density_a, double b, double density_b, double bottom,
                     double top) {
    const double low = std::max(a, bottom);
    const double high = std::min(b, top);
    if (!(high > low)) return 0;
    const double middle = ((low - a) + (high - a)) / 2 / (b - a);
    return (high - low) * (density_a + (density_b - density_a) * middle);
}

double tent_column(double center, double half_width, double thickness) {
    return linear_column(center - half_width, 0, center, 1, 0, thickness) +
           linear_column(center, 1, center + half_width, 0, 0, thickness);
}

double tabulated_column(const std::vector<DensityPoint>& table, double thickness) {
    double column = 0;
    for (std::size_t i = 1; i < table.size(); ++i) {
        column += linear_column(table[i - 1].altitude.meters, table[i - 1].density,
                                table[i].altitude.meters, table[i].density, 0, thickness);
    }
    return column;
}

using Numbers = std::vector<double>;  // one per channel

// Returns the place of a channel's value within its list.
Place channel_place(const Value& value, std::size_t channel) {
    const auto* array = std::get_if<Array>(&value.data);
    if (!array || array->size() <= 1) return value.place;
    return (*array)[channel].place;
}

std::string channel_name(std::size_t channel, std::size_t channels) {
    constexpr std::string_view letters[] = {"R", "G", "B"};
    return channels == 3 ? fmt::format(" in channel {}", letters[channel]) : std::string();
}

void check_extinction(const DecodedSection& layer, Decoder& decoder) {
    const DecodedField& extinction = layer.at("extinction");
    const auto* lower = layer.value<Numbers>("scattering");
    const auto* upper = extinction.as<Numbers>();
    if (!lower || !upper || !extinction.source || lower->size() != upper->size()) return;
    for (std::size_t channel = 0; channel < upper->size(); ++channel) {
        if ((*upper)[channel] >= (*lower)[channel]) continue;
        decoder.diagnostics.error(
            "E0112", channel_place(*extinction.source, channel),
            fmt::format("`{}` is below scattering{}: {} < {}", join_path(layer.path, "extinction"),
                        channel_name(channel, upper->size()),
                        inverse_length_to_string((*upper)[channel]),
                        inverse_length_to_string((*lower)[channel])),
            "extinction is scattering plus absorption; if this is absorption, name it "
            "`absorption`");
        return;
    }
}

// Derives the extinction from what was given instead: absorption, the albedo, or nothing.
void derive_extinction(DecodedSection& layer, Decoder& decoder) {
    DecodedField& extinction = layer.at("extinction");
    const DecodedField& absorption = layer.at("absorption");
    const DecodedField& albedo = layer.at("single_scattering_albedo");
    const auto* scattering = layer.value<Numbers>("scattering");
    // A source without a value was at fault, which has been reported.
    const bool at_fault =
        (absorption.source && !absorption.value) || (albedo.source && !albedo.value);
    if (extinction.source || at_fault || !scattering) return;
    Numbers result = *scattering;
    if (const auto* added = absorption.as<Numbers>()) {
        for (std::size_t i = 0; i < result.size() && i < added->size(); ++i)
            result[i] += (*added)[i];
    } else if (const auto* share = albedo.as<Numbers>()) {
        for (std::size_t i = 0; i < result.size() && i < share->size(); ++i)
            result[i] /= (*share)[i];
    }
    const double most = extinction.field->range.maximum;
    for (const double value : result) {
        if (value <= most) continue;
        const Value* source = albedo.source ? albedo.source : absorption.source;
        decoder.diagnostics.error(
            "E0110", source ? source->place : layer.place,
            fmt::format("`{}` is out of range: {}", join_path(layer.path, "extinction"),
                        inverse_length_to_string(value)),
            "must be " + describe_range(*extinction.field));
        return;
    }
    derive(extinction, std::move(result));
}

// Checks that the top of a slab is above its bottom.
void check_slab(const DecodedSection& section, Decoder& decoder) {
    const std::optional<double> low = section.number("bottom_altitude");
    const std::optional<double> high = section.number("top_altitude");
    if (!low || !high || *high > *low) return;
    decoder.report("E0113", section, "top_altitude",
                   fmt::format("is not above bottom_altitude: {}", length_to_string(*high)),
                   fmt::format("must be above {}", length_to_string(*low)));
}

bool is_switched_off(const Table& table) {
    const Entry* entry = find_entry(table, "enabled");
    const bool* enabled = entry ? std::get_if<bool>(&entry->value.data) : nullptr;
    return enabled && !*enabled;
}

// Checks a layer that is switched off, so that a mistake is found before the layer is wanted again.
// Only the key `enabled` of the layer is shown.
void decode_switched_off(DecodedSection& section, Decoder& decoder) {
    check_extinction(section, decoder);
    check_slab(section, decoder);
    for (DecodedField& decoded : section.fields) {
        if (decoded.field->key != "enabled") decoded.value.reset();
    }
    append_values(section, decoder);
}

// The source of a layer's coefficients: its numbers, [particles.NAME], kinds
// of spheres, a gas, or an amount of haze.
enum class Matter { numbers, particles, spheres, gas, aerosol };

Matter matter_of(const DecodedSection& layer) {
    if (choice_of<Phase>(layer.at("phase")) == Phase::mie) return Matter::particles;
    if (layer.gives("aerosol") || layer.gives("components")) return Matter::spheres;
    if (layer.gives("gas")) return Matter::gas;
    const bool is_aerosol = layer.gives("optical_depth") || layer.gives("visibility");
    return is_aerosol ? Matter::aerosol : Matter::numbers;
}

// Removes keys that contradict what the layer is made of, and reports those that are given.
void leave_out(std::initializer_list<std::string_view> keys, std::string_view of,
               const std::string& reason, DecodedSection& layer, Decoder& decoder) {
    for (const std::string_view key : keys) {
        DecodedField& decoded = layer.at(key);
        decoded.value.reset();
        if (!decoded.source) continue;
        decoder.report("E0139", layer, key, fmt::format("cannot be given for a layer of {}", of),
                       reason);
    }
}

// Leaves a layer's coefficients to what it is made of. Given ones would contradict it.
void leave_coefficients_to(Matter matter, DecodedSection& layer, Decoder& decoder) {
    if (matter == Matter::particles) {
        leave_out({"scattering", "extinction", "absorption", "single_scattering_albedo", "gas",
                   "aerosol", "components", "relative_humidity", "angstrom_exponent"},
                  "particles",
                  "phase = \"mie\" computes it from their number and size; leave it out", layer,
                  decoder);
        return;
    }
    if (matter == Matter::spheres) {
        leave_out({"scattering", "extinction", "absorption", "single_scattering_albedo", "gas",
                   "angstrom_exponent", "phase", "g", "depolarization"},
                  "spheres", "it follows from their sizes and numbers; leave it out", layer,
                  decoder);
        return;
    }
    const DecodedField& phase = layer.at("phase");
    if (phase.source && !phase.value) return;  // at fault: perhaps it was to name particles
    leave_out({"number_density", "relative_humidity"}, "other matter than spheres",
              "it goes with aerosol, components or phase = \"mie\"; leave it out", layer, decoder);
    if (matter == Matter::gas) {
        leave_out({"scattering", "extinction", "absorption", "single_scattering_albedo",
                   "optical_depth", "visibility", "angstrom_exponent"},
                  "a gas", "`gas` sets it at every wavelength; remove this key", layer, decoder);
    } else if (matter == Matter::aerosol) {
        leave_out({"scattering", "extinction", "absorption"}, "an aerosol",
                  "it follows from the optical depth or the visibility; leave it out", layer,
                  decoder);
    } else {
        leave_out({"angstrom_exponent"}, "given coefficients",
                  "give optical_depth or visibility in place of them", layer, decoder);
    }
}

// Where an amount is given, only ratios of a table count: it may be in particles per volume.
void scale_table(Matter matter, DecodedSection& layer, Decoder& decoder) {
    constexpr double most = 1e6;
    DecodedField& table = layer.at("table");
    auto* points = table.value ? std::get_if<std::vector<DensityPoint>>(&*table.value) : nullptr;
    if (!points) return;
    const auto greatest = std::ranges::max_element(
        *points, [](const auto& a, const auto& b) { return a.density < b.density; });
    const double whole = greatest->density;
    if (whole <= most) return;
    if (matter == Matter::gas || layer.at("optical_depth").source) {
        for (DensityPoint& point : *points) point.density /= whole;
        return;
    }
    const auto number = static_cast<std::size_t>(greatest - points->begin());
    decoder.diagnostics.error(
        "E0110", std::get<Array>(table.source->data).at(number).place,
        fmt::format("`{}` is out of range: {}", join_path(layer.path, "table"),
                    number_to_string(whole)),
        "densities are at most 1000000; with a gas or optical_depth only their ratios count");
}

// The exponent of common haze, the depolarisation of air at 550 nm, and the
// humidity for which OPAC prints its mixtures.
constexpr double usual_angstrom_exponent = 1.3;
constexpr double depolarization_of_air = 0.0279;
constexpr double usual_humidity = 0.8;

// Returns the depolarisation of a layer's gas.
double depolarization_of(const Layer& layer) {
    if (!layer.gas || !scatters(layer.gas->gas)) return 0;
    if (layer.gas->gas == Gas::air) return depolarization_of_air;
    return gas_optics(layer.gas->gas, aerosol_wavelength).depolarization;
}

// Molecules that scatter do so by Rayleigh's law, also where a recipe does not say it.
void derive_phase_of_gas(DecodedSection& section) {
    const std::optional<Gas> gas = choice_of<Gas>(section.at("gas"));
    DecodedField& phase = section.at("phase");
    if (gas && scatters(*gas)) derive(phase, chosen(*phase.field, Phase::rayleigh));
}

void bind_gas(const DecodedSection& section, Decoder& decoder, Layer& layer) {
    const DecodedField& named = section.at("gas");
    if (!named.value) return;
    GasAmount amount;
    amount.gas = choice_of<Gas>(named).value_or(Gas::air);
    if (amount.gas == Gas::air) {
        amount.column = {
            air_column_per_m2(section.number("pressure").value_or(kStandardPressure_Pa))};
    } else {
        amount.column = {section.number("column").value_or(0)};
    }
    layer.gas = amount;
    const DecodedField& phase = section.at("phase");
    if (scatters(amount.gas) && layer.phase != Phase::rayleigh && phase.value) {
        decoder.report(
            "E0139", section, "phase",
            fmt::format("does not fit gas = \"{}\"", choice_name(*named.field, amount.gas)),
            "it scatters with phase = \"rayleigh\"");
    }
}

// The extinction at 550 nm of the visibility that the section gives, if it
// does.
std::optional<InverseLength> visible_extinction(const DecodedSection& section) {
    const std::optional<double> visibility = section.number("visibility");
    return visibility ? std::optional(haze_of_visibility({*visibility})) : std::nullopt;
}

// Returns the spheres that an entry of `components` names: those of the recipe
// first, then OPAC's.
std::optional<Particles> named_spheres(const std::string& name, double relative_humidity,
                                       const Parameters& recipe) {
    for (const Particles& particles : recipe.particles) {
        if (particles.name == name) return particles;
    }
    for (const AerosolComponent component : all_aerosol_components()) {
        if (name_of(component) == name) return spheres_of(component, relative_humidity);
    }
    return std::nullopt;
}

void report_unknown_component(const DecodedSection& section, std::size_t entry,
                              const std::string& name, const Parameters& recipe, Decoder& decoder) {
    auto names = mapped<std::string_view>(recipe.particles, &Particles::name);
    for (const AerosolComponent component : all_aerosol_components()) {
        names.push_back(name_of(component));
    }
    std::string label = did_you_mean(name, names);
    if (label.empty()) label = fmt::format("there are {}", fmt::join(names, ", "));
    const Array& entries = std::get<Array>(section.at("components").source->data);
    decoder.diagnostics.error("E0140", std::get<Array>(entries[entry].data).front().place,
                              fmt::format("`{}` names no component and no [particles.{}]",
                                          join_path(section.path, "components"), shorten(name)),
                              std::move(label));
}

std::vector<SphereKind> bind_components(const DecodedSection& section, double relative_humidity,
                                        const Parameters& recipe, Decoder& decoder) {
    std::vector<SphereKind> kinds;
    const auto* components = section.value<std::vector<ComponentNumber>>("components");
    if (!components) return kinds;
    for (std::size_t i = 0; i < components->size(); ++i) {
        std::optional<Particles> spheres =
            named_spheres((*components)[i].component, relative_humidity, recipe);
        if (spheres) {
            kinds.push_back({std::move(*spheres), (*components)[i].number_density});
        } else if (decoder.complete) {
            report_unknown_component(section, i, (*components)[i].component, recipe, decoder);
        }
    }
    return kinds;
}

// Multiplies the numbers of all kinds, so that there are `total` particles.
void scale_numbers(double total, std::vector<SphereKind>& kinds) {
    double sum = 0;
    for (const SphereKind& kind : kinds) sum += kind.number_density.per_cubic_meter;
    for (SphereKind& kind : kinds) kind.number_density.per_cubic_meter *= total / sum;
}

void bind_amount(const DecodedSection& section, LayerParticles& particles) {
    particles.optical_depth = section.number("optical_depth");
    particles.extinction = visible_extinction(section);
    const std::optional<double> number = section.number("number_density");
    if (number) scale_numbers(*number, particles.kinds);
}

// Swollen spheres of OPAC in humid air, which has 80 % where nothing else is
// said.
void bind_spheres(const DecodedSection& section, const Parameters& recipe, Decoder& decoder,
                  Layer& layer) {
    layer.phase = Phase::mie;
    const double humidity = section.number("relative_humidity").value_or(usual_humidity);
    const std::optional<AerosolMixture> mixture = choice_of<AerosolMixture>(section.at("aerosol"));
    layer.particles.kinds = mixture ? kinds_of(*mixture, humidity)
                                    : bind_components(section, humidity, recipe, decoder);
    layer.particles.wavelengths = recipe.wavelengths;
    bind_amount(section, layer.particles);
}

void report_missing_amount(const DecodedSection& section, Decoder& decoder) {
    decoder.diagnostics.error(
        "E0105", section.place_of("phase"),
        fmt::format("`{}` is missing: phase mie needs it",
                    join_path(section.path, "number_density")),
        "give a number per volume, such as \"300 /cm3\", or an optical_depth or visibility");
}

void bind_particles(const DecodedSection& section, const Parameters& recipe, Decoder& decoder,
                    Layer& layer) {
    const Particles* particles =
        find_named(section, "particles", std::span<const Particles>(recipe.particles),
                   particles_reference, decoder);
    const bool has_amount = section.gives("optical_depth") || section.gives("visibility") ||
                            section.gives("number_density");
    if (!has_amount && decoder.complete) report_missing_amount(section, decoder);
    if (!particles) return;
    layer.particles.kinds = {{*particles, {1}}};
    layer.particles.wavelengths = recipe.wavelengths;
    bind_amount(section, layer.particles);
}

void bind_aerosol(const DecodedSection& section, Decoder& decoder, Layer& layer) {
    AerosolLaw law;
    law.angstrom_exponent = section.number("angstrom_exponent").value_or(usual_angstrom_exponent);
    if (const auto* albedo = section.value<Numbers>("single_scattering_albedo")) {
        law.single_scattering_albedo = albedo->front();
        if (std::ranges::any_of(*albedo, [&](double value) { return value != albedo->front(); })) {
            decoder.report("E0139", section, "single_scattering_albedo",
                           "must be one value for an aerosol",
                           "give one number for all wavelengths, or coefficients for each");
        }
    }
    law.optical_depth = section.number("optical_depth");
    law.extinction = visible_extinction(section).value_or(InverseLength{});
    layer.aerosol = law;
}

// Takes the measured profile of the layer's gas in place of the word for it.
void bind_standard_profile(const DecodedSection& section, Decoder& decoder, Layer& layer) {
    if (layer.profile != Profile::standard) return;
    layer.profile = Profile::tabulated;
    if (layer.gas) {
        for (const ProfilePoint& point : standard_profile(layer.gas->gas)) {
            layer.table.push_back({{point.altitude_m}, point.relative_density});
        }
        return;
    }
    decoder.report("E0111", section, "profile",
                   "= \"standard\" belongs to a gas, and there is none",
                   "give the layer a gas, or another profile");
}

// Files carry the extinction of a layer of numbers in place of its albedo. That of an aerosol stands
// for itself.
void carry_albedo(const DecodedSection& section, Decoder& decoder) {
    const std::string path = join_path(section.path, "single_scattering_albedo");
    for (ResolvedValue& value : decoder.values) {
        if (value.path == path) value.only_shown = false;
    }
}

// Turns a complete section into a layer, with what it takes from the recipe.
Layer bind_layer(const std::string& name, const DecodedSection& section, const Parameters& recipe,
                 Decoder& decoder) {
    Layer layer;
    layer.name = name;
    bind_section(section, layer_fields(), layer);
    const Matter matter = matter_of(section);
    if (matter == Matter::gas) bind_gas(section, decoder, layer);
    if (matter == Matter::aerosol) bind_aerosol(section, decoder, layer);
    if (layer.phase == Phase::rayleigh) {
        layer.depolarization = section.number("depolarization").value_or(depolarization_of(layer));
    }
    bind_standard_profile(section, decoder, layer);
    if (matter == Matter::particles) bind_particles(section, recipe, decoder, layer);
    if (matter == Matter::spheres) bind_spheres(section, recipe, decoder, layer);
    return layer;
}

}  // namespace

Atmosphere::Atmosphere() = default;
Atmosphere::Atmosphere(const Atmosphere&) = default;
Atmosphere::Atmosphere(Atmosphere&&) noexcept = default;
Atmosphere& Atmosphere::operator=(const Atmosphere&) = default;
Atmosphere& Atmosphere::operator=(Atmosphere&&) noexcept = default;
Atmosphere::~Atmosphere() = default;

double density_column(const Layer& layer, Length thickness) {
    const double top = thickness.meters;
    switch (layer.profile) {
        case Profile::exponential:
            return -layer.scale_height.meters *
                   exponential_less_one(-top / layer.scale_height.meters);
        case Profile::tent:
            return tent_column(layer.center_altitude.meters, layer.half_width.meters, top);
        case Profile::slab:
            return linear_column(layer.bottom_altitude.meters, 1, layer.top_altitude.meters, 1, 0,
                                 top);
        case Profile::tabulated:
            return tabulated_column(layer.table, top);
        case Profile::standard:
            break;  // is tabulated when it is bound
    }
    return 0;
}

std::vector<double> zenith_optical_depth(const Layer& layer, const Atmosphere& atmosphere) {
    const Length thickness{atmosphere.top_radius.meters - atmosphere.ground_radius.meters};
    const double column = density_column(layer, thickness);
    return mapped<double>(layer.extinction, [&](const InverseLength extinction) {
        return extinction.per_meter * column;
    });
}

std::optional<Layer> decode_layer(const Entry& entry, const Parameters& recipe, Decoder& decoder) {
    const Table& table = *as_table(entry.value);
    const bool off = is_switched_off(table);
    DecodedSection section = decode_section(
        *find_section("atmosphere.layers.*"), join_path("atmosphere.layers", entry.key),
        entry.key_place, table, off ? Absent::left_out : Absent::filled_in, decoder);
    if (off) {
        decode_switched_off(section, decoder);
        return std::nullopt;
    }
    const Matter matter = matter_of(section);
    leave_coefficients_to(matter, section, decoder);
    if (matter == Matter::numbers) {
        check_extinction(section, decoder);
        derive_extinction(section, decoder);
    }
    check_slab(section, decoder);
    scale_table(matter, section, decoder);
    if (matter == Matter::spheres) derive(section.at("relative_humidity"), usual_humidity);
    if (matter == Matter::gas) derive_phase_of_gas(section);
    append_values(section, decoder);
    if (matter == Matter::aerosol) carry_albedo(section, decoder);
    return bind_layer(entry.key, section, recipe, decoder);
}

void check_optical_depth(const Layer& layer, const Atmosphere& atmosphere, const Table& table,
                         Decoder& decoder) {
    constexpr double opaque = 100;
    const std::vector<double> depths = zenith_optical_depth(layer, atmosphere);
    for (std::size_t channel = 0; channel < depths.size(); ++channel) {
        if (depths[channel] <= opaque) continue;
        const std::string path = join_path("atmosphere.layers", layer.name);
        const Entry* source = nullptr;
        for (const std::string_view key : {"extinction", "absorption", "scattering"}) {
            if (!source) source = find_entry(table, key);
        }
        decoder.diagnostics.warning(
            "W0202", source ? source->value.place : Place{},
            fmt::format("layer `{}` has a zenith optical depth of {:.3g}{}", path, depths[channel],
                        channel_name(channel, depths.size())),
            "is the unit right?");
        return;
    }
}

}  // namespace skybake::config
