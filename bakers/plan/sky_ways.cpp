#include "bakers/plan/sky_ways.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "bakers/report/measurement.h"
#include "config/text/key_path.h"

namespace skybake {

using config::SkyBy;
using config::toml_string;

namespace {

constexpr std::array kSteps = {8, 16, 32, 64};

// How finely the two tables of a march are stored.
struct Grade {
    std::string_view transmittance, multiple_scattering, pixel_type;
};
constexpr std::array<Grade, 3> kGrades = {{{"[256, 64]", "[64, 64]", "float"},
                                           {"[256, 64]", "[64, 64]", "half"},
                                           {"[128, 32]", "[32, 16]", "half"}}};

// The light scattered before, as a march finds it.
struct Closure {
    std::string family, baseline;
    std::vector<std::pair<std::string, std::string>> keys;  // empty: no table
};

std::vector<Closure> closures() {
    std::vector<Closure> all = {
        {"single scattering", "single scattering", {}},
        {"mean radiance of two orders",
         "Hillaire 2020",
         {{"method", toml_string("as_in_paper")}, {"mapping", toml_string("hillaire")}}},
        {"mean radiance of all orders", "", {{"content", toml_string("hillaire")}}}};
    for (const int degree : {2, 4, 8}) {
        all.push_back({fmt::format("moments of degree {}", degree),
                       "",
                       {{"content", toml_string("moments")}, {"degree", std::to_string(degree)}}});
    }
    return all;
}

WayAsset asset_of(std::string name, std::string_view asset, std::string_view size,
                  std::string_view pixel_type) {
    return {std::move(name),
            {{"asset", toml_string(asset)},
             {"size", std::string(size)},
             {"pixel_type", toml_string(pixel_type)}}};
}

void add_marches(std::vector<SkyWay>& ways) {
    for (const Closure& closure : closures()) {
        for (const Grade& grade : kGrades) {
            std::vector<WayAsset> assets = {
                asset_of("transmittance", "transmittance", grade.transmittance, grade.pixel_type)};
            if (!closure.keys.empty()) {
                assets.push_back(asset_of("multiple_scattering", "multiple_scattering",
                                          grade.multiple_scattering, grade.pixel_type));
                auto& keys = assets.back().keys;
                keys.insert(keys.end(), closure.keys.begin(), closure.keys.end());
            }
            const std::string_view size =
                closure.keys.empty() ? grade.transmittance : grade.multiple_scattering;
            for (const int steps : kSteps) {
                ways.push_back(
                    {{"march", closure.family,
                      fmt::format("{}, {}, {} steps", plain_value(size), grade.pixel_type, steps),
                      closure.baseline, assets, steps},
                     SkyBy::march});
            }
        }
    }
}

void add_fetches(std::vector<SkyWay>& ways) {
    constexpr std::array<std::string_view, 2> kSizes = {"[128, 64, 16]", "[256, 128, 32]"};
    for (const std::string_view size : kSizes) {
        WayAsset asset = asset_of("scattering", "bruneton", size, "half");
        asset.keys.emplace_back("combined", "true");
        ways.push_back({{"fetch",
                         "scattering along rays",
                         fmt::format("{}, half", plain_value(size)),
                         size == kSizes[1] ? "Bruneton 2017, all orders" : "",
                         {asset}},
                        SkyBy::fetch});
    }
}

void add_pictures(const std::vector<std::string>& suns, const std::string& camera,
                  std::vector<SkyWay>& ways) {
    for (const std::string_view size : {"[96, 54]", "[192, 108]", "[384, 216]"}) {
        WayAsset asset = asset_of("sky_view", "sky_view", size, "half");
        asset.keys.emplace_back("altitude", camera);
        asset.keys.emplace_back("sun_elevations", fmt::format("[{}]", fmt::join(suns, ", ")));
        ways.push_back(
            {{"picture", "sky views", fmt::format("{}, half", plain_value(size)), "", {asset}},
             SkyBy::picture});
    }
}

}  // namespace

std::vector<SkyWay> sky_ways(const std::vector<SkyBy>& by, const std::vector<std::string>& suns,
                             const std::string& camera) {
    const auto allows = [&](SkyBy one) {
        return by.empty() || std::ranges::find(by, one) != by.end();
    };
    std::vector<SkyWay> ways;
    if (allows(SkyBy::march)) add_marches(ways);
    if (allows(SkyBy::fetch)) add_fetches(ways);
    if (allows(SkyBy::picture) && !suns.empty() && suns.size() <= kMostViewedSuns) {
        add_pictures(suns, camera, ways);
    }
    return ways;
}

}  // namespace skybake
