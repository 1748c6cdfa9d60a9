#include "config/text/suggest.h"

#include <algorithm>
#include <vector>

namespace skybake::config {

int edit_distance(std::string_view a, std::string_view b) {
    const std::size_t columns = b.size() + 1;
    std::vector<int> before_last(columns);
    std::vector<int> last(columns);
    std::vector<int> row(columns);
    for (std::size_t j = 0; j < columns; ++j) row[j] = static_cast<int>(j);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before_last = last;
        last = row;
        row[0] = static_cast<int>(i);
        for (std::size_t j = 1; j < columns; ++j) {
            const int substitution = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, substitution});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
    }
    return row[b.size()];
}

std::optional<std::string> nearest_name(std::string_view name,
                                        std::span<const std::string_view> known) {
    constexpr std::size_t longest_sensible_name = 80;
    if (name.empty() || name.size() > longest_sensible_name) return std::nullopt;
    int best = static_cast<int>(name.size()) / 3 + 1;
    std::optional<std::string> nearest;
    for (const std::string_view candidate : known) {
        const int distance = edit_distance(name, candidate);
        // A name that keeps none of its letters is no neighbour, however short it is.
        if (distance >= static_cast<int>(name.size())) continue;
        if (nearest ? distance < best : distance <= best) {
            best = distance;
            nearest = std::string(candidate);
        }
    }
    return nearest;
}

std::string did_you_mean(std::string_view name, std::span<const std::string_view> known) {
    const std::optional<std::string> nearest = nearest_name(name, known);
    return nearest ? "did you mean `" + *nearest + "`?" : "";
}

}  // namespace skybake::config
