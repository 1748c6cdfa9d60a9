#include "bakers/field/finish_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "bakers/field/pixel_type.h"
#include "bakers/field/smallest_table.h"
#include "bakers/field/stored_voxels.h"
#include "bakers/field/survey_volume.h"
#include "bakers/math/bake_clock.h"
#include "bakers/math/quadrature.h"

namespace skybake {
namespace {

// The cheapest quadrature level whose kernel keeps within the bound at the measured texels.
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

std::optional<Diagnostic> check_range(const Image2<double>& texels, const Baked& table,
                                      const PlaceOf& place_of, const TableModel& model) {
    const Image2<float>& image = table.image();
    for (std::size_t i = 0; i < texels.texels.size(); ++i) {
        const float stored = image.texels[i];
        const double value = texels.texels[i];
        if (std::isfinite(stored) && value >= model.lowest && value <= model.highest) continue;
        const auto texel = static_cast<int>(i / static_cast<std::size_t>(texels.channels));
        const int x = texel % texels.width;
        const int y = texel / texels.width;
        const std::string place =
            place_text(place_of(texel_coordinate(model.convention, x, texels.width),
                                texel_coordinate(model.convention, y, texels.height)));
        if (!std::isfinite(value)) {
            return diagnosis("E0401",
                             fmt::format("`{}`: the value at {} is not finite", table.name, place));
        }
        if (value < 0 && model.highest > 1) {
            return diagnosis("E0405", fmt::format("`{}`: the light at {} came out negative: {:.6g}",
                                                  table.name, place, value));
        }
        if (!(value >= model.lowest && value <= model.highest)) {
            return diagnosis("E0405",
                             fmt::format("`{}`: the value at {} is {:.6g}, outside [{:g}, {:g}]",
                                         table.name, place, value, model.lowest, model.highest));
        }
        return diagnosis(
            "E0402",
            fmt::format("`{}`: {} of {} values are outside {}; the first is {:.6g} at {}",
                        table.name, table.range.above_range, texels.texels.size(),
                        range_text(table.pixel_type), value, place),
            "bake it as float, or bake transmittance", "pixel_type");
    }
    return std::nullopt;
}

// Returns the places where the probes of a table may lie: coordinates (x, y) in [0, 1], some of
// which model.probe_place moves.
ProbeSpace table_space(const TableModel& model, std::array<int, 2> size, PlaceOf place_of) {
    // The corners, the edges, the middle and places between the texels around them come before the
    // places that are spread evenly.
    static const std::vector<std::array<double, 3>> kFirst = {
        {0, 0},          {1, 0},          {0, 1},          {1, 1},         {0.5, 0},
        {0.5, 1},        {0, 0.5},        {1, 0.5},        {0.5, 0.5},     {0.25, 0.125},
        {0.75, 0.125},   {0.981, 0.0131}, {0.996, 0.0041}, {0.4871, 0.02}, {0.5129, 0.02},
        {0.4613, 0.297}, {0.6173, 0.711}, {0.873, 0.5491}, {0.127, 0.867}, {0.968, 0.871}};
    constexpr int kPlaces = 256;
    ProbeSpace space;
    space.wanted = kFirst;
    for (const PointRow& point : low_discrepancy_points(kPlaces, 1)) {
        space.wanted.push_back({point.x.front(), point.y, 0});
    }
    space.place = [model, size,
                   place_of = std::move(place_of)](const std::array<double, 3>& wanted) {
        std::array<double, 2> xy = {wanted[0], wanted[1]};
        if (model.probe_place) xy = model.probe_place(xy[0], xy[1]);
        return ProbePlace{
            place_of(xy[0], xy[1]),
            {{{lookup_u(model, xy[0], size[0]), lookup_v(model, xy[1], size[1]), 0.5}}}};
    };
    return space;
}

// Moves places into part number `part` of a stack of `parts` tables.
ProbePlaces below_each_other(ProbePlaces place, int part, int parts) {
    return [place = std::move(place), part, parts](const std::array<double, 3>& wanted) {
        ProbePlace result = place(wanted);
        for (ProbeLookup& lookup : result.lookups) {
            lookup.uvw[1] = (part + lookup.uvw[1]) / parts;
        }
        return result;
    };
}

// The number of probes of a table of one part, and of each part of several.
constexpr int kTableProbes = 24;
constexpr int kProbesOfPart = 12;

// Adds the figures of one part to the figures of `parts` parts of the same size.
void add_errors(const ErrorFigures& part, ErrorFigures& sum, int parts) {
    sum.max = std::fmax(sum.max, part.max);
    const double squares = sum.rms * sum.rms * parts + part.rms * part.rms;
    sum.rms = std::sqrt(squares / (parts + 1));
}

void add_certificate(const Certificate& part, Certificate& sum, int parts) {
    if (part.lookup.max > sum.lookup.max) sum.worst = part.worst;
    add_errors(part.texel, sum.texel, parts);
    add_errors(part.lookup, sum.lookup, parts);
    sum.texel_points += part.texel_points;
    sum.lookup_points += part.lookup_points;
}

// Fills an image with all values of a source of one slice.
void fill_image(const VoxelSource& source, Image2<float>& image) {
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::size_t count = image.texels.size() / channels;
    std::vector<float> planes(image.texels.size());
    std::vector<float*> targets;
    for (std::size_t c = 0; c < channels; ++c) targets.push_back(&planes[c * count]);
    source.fill({{}, {image.width, image.height, 1}}, targets);
    store_voxels({targets.begin(), targets.end()}, count, PixelType::float32,
                 reinterpret_cast<char*>(image.texels.data()));
}

// Adds levels of detail. Each is the mean of the level before it, taken before rounding.
void add_levels(Baked& table) {
    std::shared_ptr<const VoxelSource> finer = table.levels.front().voxels;
    while (static_cast<int>(table.levels.size()) < table.mips) {
        const std::array<int, 3> before = table.levels.back().size;
        const std::array<int, 3> size = next_mip_size(before);
        Image2<float> image(size[0], size[1], table.image().channels);
        fill_image(MipSource(finer, before, size), image);
        add_level(in_double(image), table);
        finer = std::make_shared<DenseTexels>(std::move(image));
    }
}

// Returns the range of each channel from its least value, or 0 if that is smaller, to its largest
// value.
std::vector<std::array<double, 2>> histogram_ranges(const Image2<float>& image) {
    std::vector<std::array<double, 2>> ranges(static_cast<std::size_t>(image.channels));
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        auto& [least, largest] = ranges[i % ranges.size()];
        least = std::min(least, double{image.texels[i]});
        largest = std::max(largest, double{image.texels[i]});
    }
    for (auto& [least, largest] : ranges) {
        if (largest == least) largest = least + 1;
    }
    return ranges;
}

std::optional<Diagnostic> add_probes(const std::vector<ProbeSpace>& spaces,
                                     const BakeOptions& options, const Baked& table, Level& level) {
    const int count = std::max(kTableProbes, kProbesOfPart * static_cast<int>(spaces.size()));
    return set_probes(table.name, probed_texture(level, 2, table.pixel_type), spaces, count,
                      options, level);
}

// Surveys all levels and chooses their probes.
std::vector<Diagnostic> look_over(const std::vector<ProbeSpace>& spaces, const BakeOptions& options,
                                  Baked& table) {
    // Texels of level 0 were counted before they were rounded.
    const RangeCounts counted = table.range;
    const auto ranges = histogram_ranges(table.image());
    for (std::size_t i = 0; i < table.levels.size(); ++i) {
        auto problems = survey_level(table, static_cast<int>(i), ranges, options);
        if (!problems.empty() || options.cancelled()) return problems;
        if (i == 0) table.range = counted;
        if (auto weak = add_probes(spaces, options, table, table.levels[i])) return {*weak};
    }
    return {};
}

// Returns the images of all parts in one image, one below the other.
Image2<float> stacked_image(const std::vector<TablePart>& parts) {
    const Image2<float>& first = parts.front().table.image();
    Image2<float> stack(first.width, first.height * static_cast<int>(parts.size()), first.channels);
    stack.texels.clear();
    for (const TablePart& part : parts) {
        const std::vector<float>& texels = part.table.image().texels;
        stack.texels.insert(stack.texels.end(), texels.begin(), texels.end());
    }
    return stack;
}

}  // namespace

std::string place_text(const Place& place) {
    std::string text;
    for (const auto& [name, value] : place) {
        text += fmt::format("{}{} {:.6g}", text.empty() ? "" : ", ", name, value);
    }
    return text;
}

Outcome<TablePart> make_part(const TableModel& model, const AccuracyRequest& request,
                             const BakeOptions& options, const PlaceOf& place_of, Baked table) {
    const bool certify = options.certification != Certification::off;
    const bool is_full = options.certification == Certification::full;
    Outcome<TablePart> outcome;

    // The choice uses its own points and the quick search, whatever the kind of certification, which
    // must not change the texels.
    std::array<int, 2> size = request.size;
    int level = 0;
    if (request.max_error) {
        const ReferencePoints points = reference_points(model, request.choice, options);
        // After an interruption, tiles were skipped, so results must not be read.
        if (options.cancelled()) return outcome;
        const auto check = [&](int at_level, const Image2<float>& image) {
            return search_table(model, at_level, image, request.quick_search, options);
        };
        const TableSearch search =
            smallest_table(model, *request.max_error, table, points, options, check);
        if (options.cancelled()) return outcome;
        if (!search.found) {
            outcome.diagnostics.push_back(diagnosis(
                "E0403",
                fmt::format("`{}`: of the sizes tried none meets max_error = {:.3g}; the "
                            "best, {}x{}, has {:.3g}",
                            table.name, *request.max_error, search.best.size[0],
                            search.best.size[1], search.best.max_error),
                "use a larger max_error, another mapping or pixel_type = \"float\"", "max_error"));
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
            outcome.diagnostics.push_back(diagnosis(
                "E0404",
                fmt::format(
                    "`{}`: no quadrature meets max_texel_error = {:.3g}; the finest has {:.3g}",
                    table.name, *request.max_texel_error, choice.best_error),
                "use a larger max_texel_error", "max_texel_error"));
            return outcome;
        }
        level = *choice.level;
    }

    if (options.cancelled()) return outcome;
    const Image2<double> values = bake_texels(model, level, size, options);
    set_image(store_texels(values, table, table.range), table);
    if (options.cancelled()) return outcome;
    if (const auto problem = check_range(values, table, place_of, model)) {
        outcome.diagnostics.push_back(*problem);
        return outcome;
    }
    // Values of both signs pass through zero, where they need no precision.
    if (table.range.below_normal > 0 && model.lowest >= 0) {
        outcome.diagnostics.push_back(diagnosis(
            "W0201",
            fmt::format("`{}`: {} of {} values are below {:.3g}, where {} loses precision",
                        table.name, table.range.below_normal, values.texels.size(),
                        smallest_normal(table.pixel_type),
                        table.pixel_type == PixelType::half ? "half" : "float"),
            "", "pixel_type"));
    }
    if (model.cost_per_texel.size() > 1) {
        table.details.emplace_back("quadrature_level", level + 1.0);
        table.details.emplace_back("quadrature_levels",
                                   static_cast<double>(model.cost_per_texel.size()));
    }
    table.certified = certify;
    if (certify) {
        const BakeTime time(BakePart::certificate);
        // Choosing the level has already evaluated the texels of the quick certificate.
        if (!texels || is_full) {
            texels = reference_texels(model, size, is_full ? request.full : request.quick, options);
        }
        if (options.cancelled()) return outcome;
        const FoundErrors lookup =
            search_table(model, level, table.image(),
                         is_full ? request.full_search : request.quick_search, options);
        if (options.cancelled()) return outcome;
        table.certificate.texel = measure_lookups(model, table.image(), *texels).figures;
        table.certificate.texel_points = texels->count();
        table.certificate.lookup = lookup.figures;
        table.certificate.lookup_points = lookup.points;
        table.certificate.worst = place_text(place_of(
            model.x_of_point ? model.x_of_point(lookup.worst_point[0]) : lookup.worst_point[0],
            lookup.worst_row[0]));
    }
    outcome.value = TablePart{std::move(table), table_space(model, size, place_of)};
    return outcome;
}

void add_level(const Image2<double>& texels, Baked& table) {
    Level level = table.levels.back();
    level.size = {texels.width, texels.height, 1};
    RangeCounts range;
    level.voxels = std::make_shared<DenseTexels>(store_texels(texels, table, range));
    table.levels.push_back(std::move(level));
}

bool add_part(Outcome<TablePart> part, StackedParts& parts) {
    std::ranges::move(part.diagnostics, std::back_inserter(parts.diagnostics));
    if (!part.value) {
        parts.value.reset();
    } else {
        if (!parts.value) parts.value.emplace();
        parts.value->push_back(std::move(*part.value));
    }
    return parts.value.has_value();
}

Outcome<Baked> stack_tables(StackedParts stacked, const BakeOptions& options,
                            const ChangeTable& change) {
    Outcome<Baked> outcome{{}, std::move(stacked.diagnostics)};
    if (!stacked.value) return outcome;
    std::vector<TablePart>& parts = *stacked.value;
    const auto count = static_cast<int>(parts.size());
    std::vector<ProbeSpace> spaces;
    for (int k = 0; k < count; ++k) {
        ProbeSpace& space = parts[static_cast<std::size_t>(k)].space;
        spaces.push_back({below_each_other(std::move(space.place), k, count), space.wanted});
    }
    std::optional<Image2<float>> stack;
    if (count > 1) stack = stacked_image(parts);
    Baked table = std::move(parts.front().table);
    for (std::size_t k = 1; k < parts.size(); ++k) {
        const Baked& part = parts[k].table;
        table.range.below_normal += part.range.below_normal;
        table.range.above_range += part.range.above_range;
        add_certificate(part.certificate, table.certificate, static_cast<int>(k));
    }
    if (stack) set_image(std::move(*stack), table);
    if (change) change(table);
    if (options.cancelled()) return outcome;
    add_levels(table);
    std::vector<Diagnostic> problems = look_over(spaces, options, table);
    if (options.cancelled()) return outcome;
    std::ranges::move(problems, std::back_inserter(outcome.diagnostics));
    if (problems.empty()) outcome.value = std::move(table);
    return outcome;
}

Outcome<Baked> finish_table(const TableModel& model, const AccuracyRequest& request,
                            const BakeOptions& options, const PlaceOf& place_of, Baked table) {
    StackedParts parts;
    add_part(make_part(model, request, options, place_of, std::move(table)), parts);
    return stack_tables(std::move(parts), options);
}

}  // namespace skybake
