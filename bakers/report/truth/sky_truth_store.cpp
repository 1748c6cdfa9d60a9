#include "bakers/report/truth/sky_truth_store.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "bakers/io/files/read_file.h"
#include "bakers/math/hash.h"
#include "bakers/report/truth/sky_truth_budget.h"

namespace skybake {

namespace {

constexpr std::string_view kSign = "# skybake sky truth ";
constexpr std::uintmax_t kLargestFile = 16 << 20;

// All of the text but its first line.
std::string_view after_first_line(std::string_view text) {
    const std::size_t end = text.find('\n');
    return end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
}

std::string first_line(const std::string& key, std::string_view values) {
    return fmt::format("{}{}, values {}", kSign, key, xxh3_hex(values));
}

}  // namespace

std::string sky_truth_key(const config::Recipe& recipe,
                          const std::vector<SkyTruthDirection>& directions,
                          std::int64_t mean_paths) {
    static const std::array<std::string, 3> air = {"wavelengths", "atmosphere.*",
                                                   "atmosphere.layers.*.*"};
    std::string text = fmt::format("version {}\n{} paths\n{}\n", kSkyTruthVersion, mean_paths,
                                   config::parameters_toml(recipe, air));
    for (const SkyTruthDirection& at : directions) {
        text += fmt::format("{} {} {} {}\n", at.altitude_km, at.sun_zenith_degrees,
                            at.view_zenith_degrees, at.azimuth_degrees);
    }
    return xxh3_hex(text);
}

std::string stored_sky_truth(const std::vector<SkyTruth>& truth, const std::string& key) {
    const std::string csv = sky_truth_csv(truth, "");
    const std::string_view values = after_first_line(csv);
    return fmt::format("{}\n{}", first_line(key, values), values);
}

bool is_stored_sky_truth(std::string_view text) { return text.starts_with(kSign); }

std::optional<std::vector<SkyTruth>> parse_stored_sky_truth(std::string_view text,
                                                            const std::string& key) {
    const std::string_view values = after_first_line(text);
    if (!text.starts_with(first_line(key, values) + '\n')) return std::nullopt;
    return parse_sky_truth_csv(text);
}

std::optional<std::vector<SkyTruth>> load_sky_truth(const std::filesystem::path& path,
                                                    const std::string& key) {
    const auto text = read_file(path, kLargestFile);
    if (!text.value) return std::nullopt;
    return parse_stored_sky_truth(*text.value, key);
}

std::filesystem::path cached_sky_truth_path(const std::filesystem::path& cache,
                                            const std::string& key) {
    return cache / "sky_truth" / key.substr(0, 2) / (key + ".csv");
}

}  // namespace skybake
