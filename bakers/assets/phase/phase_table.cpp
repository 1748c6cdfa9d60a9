// The baker of asset = "phase".
#include "bakers/assets/phase/phase_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "bakers/air/particles/phase_function.h"
#include "bakers/assets/phase/phase_fit.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/field/baked.h"
#include "bakers/field/finish_table.h"
#include "bakers/field/smallest_table.h"
#include "bakers/math/transcendental.h"

namespace skybake {

using config::PhaseBake;
using config::PhaseContent;
using config::PhaseSpacing;

namespace {

constexpr std::array kSpacings = {PhaseSpacing::angle, PhaseSpacing::cosine, PhaseSpacing::peaks};

constexpr PointCounts kChoice = {4096, 1};

std::string_view formula_of(PhaseSpacing spacing) {
    switch (spacing) {
        case PhaseSpacing::angle:
            return "x = theta / pi";
        case PhaseSpacing::cosine:
            return "x = (1 - cos theta) / 2";
        case PhaseSpacing::cosine_from_back:
            return "x = (1 + cos theta) / 2";
        case PhaseSpacing::peaks:
        case PhaseSpacing::best:
            break;
    }
    return "x = 2^(-3/4) sqrt(sin(theta / 2)) up to 90 deg, 1 - 2^(-3/4) sqrt(cos(theta / 2)) "
           "beyond";
}

TableModel flat_model(std::size_t channels) {
    TableModel model;
    model.channels = static_cast<int>(channels);
    model.one_row = true;
    model.cost_per_texel = {1};
    model.lowest = 0;
    return model;
}

// The spacing with the smallest table that keeps the error, or with the least error at this size.
PhaseSpacing best_spacing(const PhaseSource& source, const PhaseBake& bake,
                          const BakeOptions& options) {
    PhaseSpacing best = PhaseSpacing::peaks;
    double least = std::numeric_limits<double>::max();
    for (const PhaseSpacing spacing : kSpacings) {
        const TableModel model = phase_model(source, spacing);
        const ReferencePoints points = reference_points(model, kChoice, options);
        double cost = 0;
        if (bake.max_error) {
            const TableSearch search =
                smallest_table(model, *bake.max_error, bake, points, options);
            // Spacings that do not get there are told apart by how far they come.
            cost = search.found ? search.found->size[0] : 1e6 * (1 + search.best.max_error);
        } else {
            RangeCounts range;
            const Image2<float> image =
                store_texels(bake_texels(model, 0, {bake.size, 1}, options), bake, range);
            cost = measure_lookups(model, image, points).figures.max;
        }
        if (cost < least) {
            least = cost;
            best = spacing;
        }
    }
    return best;
}

void describe(const PhaseBake& bake, const PhaseSource& source, PhaseSpacing spacing,
              Baked& table) {
    const bool inverse = bake.content == PhaseContent::inverse_cumulative;
    const std::string convention = "end points on texel centres";
    table.kind = "phase";
    table.axes.resize(2);
    set_files(bake, table);
    if (inverse) {
        table.content = fmt::format(
            "1 - cosine of the angle below which a share x of the light is scattered, in [0, 2], "
            "of {}: with x uniform in [0, 1], directions distributed as the phase function",
            source.text);
        table.mapping = "share";
        table.axes[0] = {"share", "x: a share of the scattered light", convention, 0, 1};
        table.certificate.scale = "a half turn, absolute, of the angle";
    } else {
        table.content = fmt::format(
            "phase function (1/sr) of {}: its integral over directions is 1", source.text);
        table.mapping = spacing_name(spacing);
        table.axes[0] = {"scattering_angle_deg", std::string(formula_of(spacing)), convention, 0,
                         180};
        table.certificate.scale = "relative";
    }
    table.axes[1] = {"none", "one row", convention, 0, 0};
    table.conventions.length_unit.clear();
    table.conventions.coefficient_unit.clear();
    if (!inverse) table.conventions.angle_unit = "deg";
    table.certificate.reference =
        source.error > 0
            ? fmt::format("Lorenz-Mie series averaged over sizes, itself within {:.2g}",
                          source.error)
            : "closed form";
}

// Each parameter of the form, and how good the fit is, under a name of its own.
void add_fit(const PhaseFit& fit, const std::string& channel, Facts& details) {
    const std::string name = fmt::format("fit_{}{}", fit.form, channel);
    const auto names = parameter_names(fit.form);
    for (std::size_t i = 0; i < names.size(); ++i) {
        details.emplace_back(fmt::format("{}_{}", name, names[i]), to_digits(fit.parameters[i], 6));
    }
    details.emplace_back(name + "_misplaced", to_digits(fit.misplaced, 4));
    details.emplace_back(name + "_largest_ratio", to_digits(fit.largest_ratio, 4));
}

// Adds the facts for a runtime that computes in place of looking up.
void add_facts(const PhaseBake& bake, const PhaseSource& source, Baked& table) {
    table.details.insert(table.details.end(), source.facts.begin(), source.facts.end());
    std::vector<PhaseFit> fits;
    for (std::size_t c = 0; c < source.functions.size(); ++c) {
        const std::string channel = "_" + table.channel_names[c];
        const std::vector<double> moments = legendre_moments(source.functions[c], bake.degree);
        table.details.emplace_back("mean_cosine" + channel, to_digits(moments[1], 9));
        table.details.emplace_back("legendre_moments" + channel, to_digits(moments, 7));
        // Closed forms are alike in all channels.
        if (c == 0 || source.functions[c] != source.functions[c - 1]) {
            fits = fit_phase(source.functions[c]);
        }
        for (const PhaseFit& fit : fits) add_fit(fit, channel, table.details);
    }
}

Outcome<Baked> bake(const Parameters& parameters, const config::PhaseBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    return bake_phase(parameters, asset, options, labelled_table(parameters, std::move(label)));
}

Estimate estimate(const Parameters&, const config::PhaseBake& asset) {
    constexpr std::size_t kMostChannels = 4;
    return estimate_texels(asset, {asset.max_error ? 0 : asset.size, 1}, kMostChannels, 1e-6, 1);
}

// Returns the place in a table by the spacing that its file names; none names shares of the light.
double share_of_table(std::optional<config::PhaseSpacing> spacing, double at) {
    if (!spacing) return at;  // a share of the light
    if (*spacing == config::PhaseSpacing::angle) return at / 180;
    const double half_sine = cosine_of_pi(0.5 - at / 360);
    const double half_cosine = cosine_of_pi(at / 360);
    const ScatteringAngle angle = {2 * half_sine * half_sine, 2 * half_cosine * half_cosine};
    return phase_coordinate(*spacing, angle);
}

AssetPlaces places(const Parameters&, const config::PhaseBake& asset, const StoredTexels& stored) {
    const bool inverse = asset.content == config::PhaseContent::inverse_cumulative;
    return single_lookup({inverse ? "share" : "scattering_angle_deg"}, [=](const Place& at) {
        const double x = share_of_table(spacing_named(stored.mapping), at[0].second);
        return Uvw{
            texture_coordinate(TexelConvention::end_points_on_texel_centres, x, stored.size[0]),
            0.5, 0.5};
    });
}

AssetLookup lookup(const Parameters&, const config::PhaseBake& asset, const StoredTexels& stored) {
    const std::string_view suffix = of_4(stored.channels);
    const std::string size = glsl_number(stored.size[0]);
    GlslFunction function;
    if (asset.content == config::PhaseContent::inverse_cumulative) {
        function.comment =
            "Returns 1 - cos(angle). For shares that are uniform in [0, 1] the angles are "
            "distributed as the phase function.";
        function.arguments = "sampler2D table, float share";
        function.value = fmt::format("sampled_angle{}(table, {}, share)", suffix, size);
    } else {
        function.comment =
            "Returns the phase function in 1/sr. The unit vectors point along the view ray and to "
            "the sun.";
        function.arguments = "sampler2D table, vec3 view, vec3 sun";
        function.value =
            fmt::format("phase_function{}(table, {}, phase_by_{}(half_angle(view, sun)))", suffix,
                        size, stored.mapping);
    }
    return {"phase", {with_wavelengths(stored.channels, std::move(function))}};
}

}  // namespace

TableModel phase_model(const PhaseSource& source, PhaseSpacing spacing) {
    TableModel model = flat_model(source.functions.size());
    model.highest = std::numeric_limits<double>::max();
    const auto values = [&source, spacing](const std::vector<double>& x, double* to) {
        for (const double coordinate : x) {
            const ScatteringAngle angle = scattering_angle(spacing, coordinate);
            for (const PhaseFunction& function : source.functions) {
                *to++ = phase_value(function, angle.one_minus, angle.one_plus);
            }
        }
    };
    model.row = [values](int, double, const std::vector<double>& x, double* to) { values(x, to); };
    model.reference = [values](double, const std::vector<double>& x, double* to) { values(x, to); };
    // At the same angles whatever the spacing, so that a peak is not overlooked by one that has no
    // texels there.
    model.x_of_point = [spacing](double x) {
        return phase_coordinate(spacing, scattering_angle(PhaseSpacing::peaks, x));
    };
    model.error = [](double value, double reference, double) { return value / reference - 1; };
    return model;
}

TableModel inverse_phase_model(const PhaseSource& source) {
    TableModel model = flat_model(source.tables.size());
    model.highest = 2;
    const auto values = [&source](const std::vector<double>& x, double* to) {
        for (const double share : x) {
            for (const auto& table : source.tables) {
                // The last share is straight back.
                *to++ = share < 1 ? sample_tabulated_phase(*table, share).one_minus : 2.0;
            }
        }
    };
    model.row = [values](int, double, const std::vector<double>& x, double* to) { values(x, to); };
    model.reference = [values](double, const std::vector<double>& x, double* to) { values(x, to); };
    model.error = [](double value, double reference, double) {
        return (radians({value, 2 - value}) - radians({reference, 2 - reference})) /
               std::numbers::pi;
    };
    return model;
}

Outcome<Baked> bake_phase(const Parameters& parameters, const PhaseBake& bake,
                          const BakeOptions& options, Baked table) {
    const PhaseSource source = phase_source(parameters, bake, options.threads);
    if (options.cancelled()) return {};
    const bool inverse = bake.content == PhaseContent::inverse_cumulative;
    PhaseSpacing spacing = bake.spacing;
    if (!inverse && spacing == PhaseSpacing::best) spacing = best_spacing(source, bake, options);
    if (options.cancelled()) return {};
    describe(bake, source, spacing, table);
    add_facts(bake, source, table);
    AccuracyRequest request;
    request.size = {bake.size, 1};
    request.max_error = bake.max_error;
    request.choice = kChoice;
    request.quick = {1024, 1};
    request.full = {16384, 1};
    request.quick_search = {1, 4096, 0, 32, 0};
    request.full_search = {1, 65536, 0, 128, 0};
    const auto place_of = [inverse, spacing](double x, double) {
        if (inverse) return Place{{"share", x}};
        return Place{{"scattering_angle_deg",
                      radians(scattering_angle(spacing, x)) * 180 / std::numbers::pi}};
    };
    return finish_table(inverse ? inverse_phase_model(source) : phase_model(source, spacing),
                        request, options, place_of, std::move(table));
}

Baker<config::PhaseBake> baker(BakerTag<config::PhaseBake>) {
    return {.version = 7,
            .bake = bake,
            .estimate = estimate,
            .places = places,
            .lookup = lookup,
            .variants = {{"size"}, {"pixel_type"}, {"spacing"}}};
}

}  // namespace skybake
