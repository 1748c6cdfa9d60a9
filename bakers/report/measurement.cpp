#include "bakers/report/measurement.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "bakers/assets/registry/registry.h"
#include "config/assets/asset_kind.h"
#include "config/fields/fields.h"
#include "config/text/key_path.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

// Returns the whole numbers of a value such as "[256, 64]" or "4".
std::vector<int> numbers_of(std::string_view toml) {
    std::vector<int> numbers;
    const char* at = toml.data();
    const char* const end = at + toml.size();
    while (at < end) {
        int number = 0;
        const auto [after, error] = std::from_chars(at, end, number);
        if (error == std::errc{}) numbers.push_back(number);
        at = error == std::errc{} ? after : at + 1;
    }
    return numbers;
}

// Multiplies numbers above 1, which stay at 2 or above.
std::string scaled(const std::vector<int>& numbers, double factor, bool is_list) {
    auto result = mapped<int>(numbers, [&](const int number) {
        return number < 2 ? number : std::max(2, static_cast<int>(number * factor));
    });
    return is_list ? fmt::format("[{}]", fmt::join(result, ", ")) : std::to_string(result.front());
}

// Returns the other values of a key, as TOML.
std::vector<std::string> other_values(const config::Field& field, const std::string& own) {
    auto values = mapped<std::string>(field.choices, [&](const config::Choice& choice) {
        return field.kind == config::Kind::choice_list ? fmt::format("[\"{}\"]", choice.name)
                                                       : fmt::format("\"{}\"", choice.name);
    });
    const std::vector<int> numbers = numbers_of(own);
    if (field.choices.empty() && !numbers.empty()) {
        for (const double factor : {0.5, 2.0}) {
            values.push_back(scaled(numbers, factor, own.starts_with('[')));
        }
    }
    std::erase(values, own);
    return values;
}

const config::ResolvedValue* find_value(const Recipe& recipe, const std::string& path) {
    const auto found = std::ranges::find(recipe.values, path, &config::ResolvedValue::path);
    return found == recipe.values.end() ? nullptr : &*found;
}

// Whether choice a beats choice b. A choice always has a smaller error than the one that it beats,
// or a smaller cost at the same error, so the choice of the least error is always on the front.
bool beats(const CostAndError& a, const CostAndError& b, double noise) {
    if (a.error == b.error) return a.cost < b.cost;
    return a.error < b.error && a.cost <= b.cost * (1 + noise);
}

}  // namespace

std::string plain_value(std::string_view toml) {
    std::string text;
    for (const char letter : toml) {
        if (letter == ',') text += 'x';
        if (letter != '"' && letter != '[' && letter != ']' && letter != ',' && letter != ' ') {
            text += letter;
        }
    }
    return text;
}

std::vector<Variant> variants_of(const Recipe& recipe, const Bake& bake) {
    std::vector<Variant> variants = {{"this recipe", "", "", {}}};
    const AnyBaker& baker = baker_of(bake);
    const config::Section* section = config::find_section("bake.*", baker.asset);
    for (const VariantKey& key : baker.variants) {
        const std::string path =
            config::join_path(config::join_path("bake", bake.name), std::string(key.name));
        const config::ResolvedValue* own = find_value(recipe, path);
        const config::Field* field = config::find_field(*section, key.name);
        if (own == nullptr || field == nullptr) continue;
        for (const std::string& value : other_values(*field, own->canonical)) {
            const bool is_published = !key.published.empty() && plain_value(value) == key.published;
            variants.push_back({std::string(key.name),
                                plain_value(value),
                                std::string(is_published ? key.baseline : ""),
                                {fmt::format("{}={}", path, value)}});
        }
    }
    return variants;
}

std::string size_text(std::span<const int> size) {
    return fmt::format("{}", fmt::join(size.begin(), size.end(), "x"));
}

double thread_cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

MemoryFile::MemoryFile() : file_(::memfd_create("skybake-report", MFD_CLOEXEC)) {}

std::filesystem::path MemoryFile::path() const {
    return fmt::format("/proc/self/fd/{}", file_.get());
}

std::uint64_t MemoryFile::bytes() const {
    struct stat status {};
    if (!file_.valid() || ::fstat(file_.get(), &status) != 0) return 0;
    return static_cast<std::uint64_t>(status.st_size);
}

std::vector<bool> pareto_front(const std::vector<CostAndError>& choices, double noise) {
    std::vector<bool> front;
    for (const CostAndError& choice : choices) {
        const auto is_better = [&](const CostAndError& other) {
            return beats(other, choice, noise);
        };
        front.push_back(std::isfinite(choice.cost) && std::isfinite(choice.error) &&
                        std::ranges::none_of(choices, is_better));
    }
    return front;
}

void mark_front(std::vector<ChartPoint>& points, double noise) {
    const auto front = pareto_front(mapped<CostAndError>(points,
                                                         [](const ChartPoint& point) {
                                                             return CostAndError{point.x, point.y};
                                                         }),
                                    noise);
    for (std::size_t i = 0; i < points.size(); ++i) points[i].on_front = front[i];
}

}  // namespace skybake
