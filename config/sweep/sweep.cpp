#include "config/sweep/sweep.h"

#include <array>
#include <cassert>

#include "config/fields/key.h"

namespace skybake::config {

int variant_count(const Sweep& sweep) {
    if (sweep.axes.empty()) return 0;
    int count = 1;
    for (const SweepAxis& axis : sweep.axes) count *= static_cast<int>(axis.rows.size());
    return count;
}

std::vector<std::string> swept_paths(const Sweep& sweep) {
    std::vector<std::string> paths;
    for (const SweepAxis& axis : sweep.axes) {
        paths.insert(paths.end(), axis.paths.begin(), axis.paths.end());
    }
    return paths;
}

std::vector<SweepValue> variant_values(const Sweep& sweep, int index) {
    assert(index >= 0 && index < variant_count(sweep));
    std::vector<const std::vector<SweepValue>*> rows(sweep.axes.size());
    auto rest = static_cast<std::size_t>(index);
    for (std::size_t i = sweep.axes.size(); i-- > 0;) {
        const auto& choices = sweep.axes[i].rows;
        rows[i] = &choices[rest % choices.size()];
        rest /= choices.size();
    }
    std::vector<SweepValue> values;
    for (const auto* row : rows) values.insert(values.end(), row->begin(), row->end());
    return values;
}

std::vector<std::string> variant_settings(const Sweep& sweep, int index) {
    const std::vector<std::string> paths = swept_paths(sweep);
    const std::vector<SweepValue> values = variant_values(sweep, index);
    std::vector<std::string> settings;
    for (std::size_t i = 0; i < paths.size(); ++i)
        settings.push_back(paths[i] + '=' + values[i].toml);
    return settings;
}

namespace {

constexpr Choice scale_choices[] = {
    {SweepScale::linear, "linear", "equal differences"},
    {SweepScale::log, "log", "equal ratios, which need from and to above 0"},
};

// These are the keys of [sweep] itself and of a range in it. All other keys of [sweep] are paths of
// keys.
constexpr std::array sweep_table = {
    key("zip", Kind::path_groups,
        "keys varied in lockstep instead of crossed, with equally many values each"),
    key("sobol", Kind::integer, "points of a Sobol sequence that cover all ranges without a count",
        Range{1, most_variants}, Hint{"a power of two covers them best"},
        Cited{"Joe and Kuo 2008, Constructing Sobol sequences with better two-dimensional "
              "projections"}),
};

constexpr std::array range_table = {
    key("from", Kind::swept, "the first value, written as the key takes it", KeyFlag::required),
    key("to", Kind::swept, "the last value; Sobol points stay below it", KeyFlag::required),
    key("count", Kind::integer,
        "number of values, with both ends; without it `sobol` says how many",
        Range{2, most_variants}),
    key("scale", Kind::choice, "how the values are spaced", scale_choices, Default{R"("linear")"}),
};

}  // namespace

std::span<const Field> sweep_fields() { return sweep_table; }

std::span<const Field> sweep_range_fields() { return range_table; }

}  // namespace skybake::config
