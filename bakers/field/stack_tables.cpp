#include "bakers/field/stack_tables.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace skybake {

namespace {

// Both are figures of so many points.
void add_errors(const ErrorFigures& part, int part_points, ErrorFigures& sum, int points) {
    sum.max = std::fmax(sum.max, part.max);
    const double squares = sum.rms * sum.rms * points + part.rms * part.rms * part_points;
    sum.rms = points + part_points > 0 ? std::sqrt(squares / (points + part_points)) : 0;
}

void add_certificate(const Certificate& part, Certificate& sum) {
    if (part.lookup.max > sum.lookup.max) sum.worst = part.worst;
    add_errors(part.texel, part.texel_points, sum.texel, sum.texel_points);
    add_errors(part.lookup, part.lookup_points, sum.lookup, sum.lookup_points);
    sum.texel_points += part.texel_points;
    sum.lookup_points += part.lookup_points;
}

}  // namespace

config::Outcome<BakedTable> stack_tables(std::vector<BakedTable> parts,
                                         std::vector<ProbeSpace> spaces,
                                         const BakeOptions& options) {
    const auto count = static_cast<int>(parts.size());
    if (count == 1) return {std::move(parts.front()), {}};
    Image2<float> stack(parts[0].image.width, parts[0].image.height * count,
                        parts[0].image.channels);
    stack.texels.clear();
    for (const BakedTable& part : parts) {
        stack.texels.insert(stack.texels.end(), part.image.texels.begin(), part.image.texels.end());
    }
    BakedTable table = std::move(parts.front());
    for (std::size_t k = 1; k < parts.size(); ++k) {
        table.range.below_normal += parts[k].range.below_normal;
        table.range.above_range += parts[k].range.above_range;
        table.bake_seconds += parts[k].bake_seconds;
        add_certificate(parts[k].certificate, table.certificate);
    }
    table.image = std::move(stack);
    const auto weak = add_probes(std::move(spaces), options, table);
    if (options.cancelled()) return {};
    if (weak) return {{}, {*weak}};
    return {std::move(table), {}};
}

}  // namespace skybake
