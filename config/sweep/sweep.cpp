#include "config/sweep/sweep.h"

#include <cassert>

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

}  // namespace skybake::config
