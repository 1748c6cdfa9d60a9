#include "bakers/field/finish_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>

#include "bakers/field/pixel_type.h"
#include "bakers/field/smallest_table.h"

namespace skybake {

namespace {

using config::Diagnostic;
using config::Outcome;

Diagnostic failure(std::string code, std::string message, std::string label = {}) {
    return {config::Severity::error, std::move(code), std::move(message), {}, std::move(label)};
}

// After an interruption tiles were skipped: what they should have made is not to be looked at.
PointCounts points_of(const AccuracyRequest& request, Certification certification) {
    return certification == Certification::full ? request.full : request.quick;
}

// The cheapest level whose kernel holds the bound at the texels measured.
struct LevelChoice {
    std::optional<int> level;
    double best_error = 0;
};

LevelChoice choose_level(const TableModel& model, const AccuracyRequest& request,
                         const ReferencePoints& texels, const BakeOptions& options) {
    LevelChoice choice;
    for (std::size_t level = 0; level < model.cost_per_texel.size(); ++level) {
        choice.best_error =
            measure_kernel(model, static_cast<int>(level), texels, options).figures.max;
        if (choice.best_error <= *request.max_texel_error) {
            choice.level = static_cast<int>(level);
            break;
        }
    }
    return choice;
}

std::optional<Diagnostic> check_range(const Image2<double>& texels, const BakedTable& table,
                                      const std::function<Place(double x, double y)>& place_of,
                                      const TableModel& model) {
    for (std::size_t i = 0; i < texels.texels.size(); ++i) {
        const float stored = table.image.texels[i];
        const double value = texels.texels[i];
        if (std::isfinite(stored) && value >= model.lowest && value <= model.highest) continue;
        const auto texel = static_cast<int>(i / static_cast<std::size_t>(texels.channels));
        const int x = texel % texels.width;
        const int y = texel / texels.width;
        const std::string place =
            place_text(place_of(texel_coordinate(model.convention, x, texels.width),
                                texel_coordinate(model.convention, y, texels.height)));
        if (!std::isfinite(value)) {
            return failure("E0401",
                           fmt::format("`{}`: the value at {} is not finite", table.name, place));
        }
        if (!(value >= model.lowest && value <= model.highest)) {
            return failure("E0405",
                           fmt::format("`{}`: the value at {} is {:.6g}, outside [{:g}, {:g}]",
                                       table.name, place, value, model.lowest, model.highest));
        }
        return failure("E0402",
                       fmt::format("`{}`: {} of {} values are beyond what {} holds; the first is "
                                   "{:.6g} at {}",
                                   table.name, table.range.above_range, texels.texels.size(),
                                   table.pixel_type == config::PixelType::half ? "half" : "float",
                                   value, place),
                       "bake it as float, or bake transmittance");
    }
    return std::nullopt;
}

}  // namespace

std::string place_text(const Place& place) {
    std::string text;
    for (const auto& [name, value] : place) {
        text += fmt::format("{}{} {:.6g}", text.empty() ? "" : ", ", name, value);
    }
    return text;
}

Outcome<BakedTable> finish_table(const TableModel& model, const AccuracyRequest& request,
                                 const BakeOptions& options,
                                 const std::function<Place(double x, double y)>& place_of,
                                 BakedTable table) {
    const PointCounts counts = points_of(request, options.certification);
    const bool certify = options.certification != Certification::off;
    Outcome<BakedTable> outcome;

    // The choice is made by points of its own: how a table is certified must not change its texels.
    std::array<int, 2> size = request.size;
    int level = 0;
    if (request.max_error) {
        const ReferencePoints points = reference_points(model, request.choice, options);
        if (options.cancelled()) return outcome;
        const TableSearch search =
            smallest_table(model, *request.max_error, table.pixel_type, points, options);
        if (options.cancelled()) return outcome;
        if (!search.found) {
            outcome.diagnostics.push_back(failure(
                "E0403",
                fmt::format("`{}`: no size meets max_error = {:.3g}; the best, {}x{}, has {:.3g}",
                            table.name, *request.max_error, search.best.size[0],
                            search.best.size[1], search.best.max_error),
                "use a larger max_error, another mapping or pixel_type = \"float\""));
            return outcome;
        }
        size = search.found->size;
        level = search.found->level;
    }
    std::optional<ReferencePoints> texels;
    if (!request.max_error && request.max_texel_error) {
        texels = reference_texels(model, size, request.quick, options);
        if (options.cancelled()) return outcome;
        const LevelChoice choice = choose_level(model, request, *texels, options);
        if (options.cancelled()) return outcome;
        if (!choice.level) {
            outcome.diagnostics.push_back(
                failure("E0404",
                        fmt::format("`{}`: no quadrature meets max_texel_error = {:.3g}; the "
                                    "finest has {:.3g}",
                                    table.name, *request.max_texel_error, choice.best_error),
                        "use a larger max_texel_error"));
            return outcome;
        }
        level = *choice.level;
    }

    if (options.cancelled()) return outcome;
    const auto start = std::chrono::steady_clock::now();
    const Image2<double> values = bake_texels(model, level, size, options);
    table.bake_seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    table.image = store_texels(values, table.pixel_type, table.range);
    if (options.cancelled()) return outcome;
    if (const auto problem = check_range(values, table, place_of, model)) {
        outcome.diagnostics.push_back(*problem);
        return outcome;
    }
    if (table.range.below_normal > 0) {
        Diagnostic warning = failure(
            "W0201", fmt::format("`{}`: {} of {} values are below {:.3g}, where {} loses precision",
                                 table.name, table.range.below_normal, values.texels.size(),
                                 smallest_normal(table.pixel_type),
                                 table.pixel_type == config::PixelType::half ? "half" : "float"));
        warning.severity = config::Severity::warning;
        outcome.diagnostics.push_back(std::move(warning));
    }
    if (model.cost_per_texel.size() > 1) {
        table.details.emplace_back("quadrature_level", level + 1.0);
        table.details.emplace_back("quadrature_levels",
                                   static_cast<double>(model.cost_per_texel.size()));
    }
    table.certified = certify;
    if (certify) {
        const ReferencePoints points = reference_points(model, counts, options);
        // Choosing the level has measured the quick certificate's texels already.
        if (!texels || options.certification == Certification::full) {
            texels = reference_texels(model, size, counts, options);
        }
        if (options.cancelled()) return outcome;
        const MeasuredErrors lookup = measure_lookups(model, table.image, points);
        table.certificate.texel = measure_lookups(model, table.image, *texels).figures;
        table.certificate.texel_points = texels->count();
        table.certificate.lookup = lookup.figures;
        table.certificate.lookup_points = points.count();
        table.certificate.worst = place_text(place_of(lookup.worst[0], lookup.worst[1]));
    }
    const auto weak = add_probes({table_space(model, size, place_of)}, options, table);
    if (options.cancelled()) return outcome;
    if (weak) {
        outcome.diagnostics.push_back(*weak);
        return outcome;
    }
    outcome.value = std::move(table);
    return outcome;
}

}  // namespace skybake
