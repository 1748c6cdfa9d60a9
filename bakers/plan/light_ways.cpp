#include "bakers/plan/light_ways.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "bakers/assets/sky/sky_lights.h"
#include "bakers/report/measurement.h"
#include "config/text/key_path.h"

namespace skybake {

using config::Draws;
using config::SkyBy;
using config::toml_string;

namespace {

constexpr std::array kSteps = {8, 16, 32, 64};

// How finely the two tables of a march are stored.
struct TableGrade {
    std::string_view transmittance, multiple_scattering, pixel_type;
};
constexpr std::array<TableGrade, 3> kTableGrades = {{{"[256, 64]", "[64, 64]", "float"},
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
         {{"method", toml_string("converged")}, {"mapping", toml_string("hillaire")}}},
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

// Adds marches whose assets have names that begin with `prefix`.
void add_marches(const std::string& prefix, std::vector<LightWay>& ways) {
    for (const Closure& closure : closures()) {
        for (const TableGrade& grade : kTableGrades) {
            std::vector<WayAsset> assets = {asset_of(prefix + "transmittance", "transmittance",
                                                     grade.transmittance, grade.pixel_type)};
            if (!closure.keys.empty()) {
                assets.push_back(asset_of(prefix + "multiple_scattering", "multiple_scattering",
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
                     SkyBy::march,
                     {}});
            }
        }
    }
}

void add_fetches(std::vector<LightWay>& ways) {
    constexpr std::array<std::string_view, 2> kSizes = {"[128, 64, 16]", "[256, 128, 32]"};
    for (const std::string_view size : kSizes) {
        WayAsset asset = asset_of("scattering", "bruneton", size, "half");
        asset.keys.emplace_back("combined", "true");
        ways.push_back({{"fetch",
                         "scattering along rays",
                         fmt::format("{}, half", plain_value(size)),
                         size == kSizes[1] ? "Bruneton 2017, all orders" : "",
                         {asset}},
                        SkyBy::fetch,
                        {}});
    }
}

// Pictures of a scene are seen from the middle of its cameras' altitudes.
class Pictures {
  public:
    Pictures(const SceneRange& range, const Shell& shell) : range_(range), shell_(shell) {
        const double middle_km = (range.lowest_altitude_km + range.highest_altitude_km) / 2;
        camera_ = fmt::format("\"{} km\"", middle_km);
        for (const double sun_deg : range.suns_deg) {
            suns_.push_back(fmt::format("\"{} deg\"", sun_deg));
        }
    }

    // Sky views hold all suns. They have no parallax, so that cameras at other altitudes see the picture
    // where the same share of their sky is.
    void add_sky_views(std::vector<LightWay>& ways) const {
        for (const std::string_view size : {"[96, 54]", "[192, 108]", "[384, 216]"}) {
            WayAsset asset = asset_of("sky_view", "sky_view", size, "half");
            asset.keys.emplace_back("altitude", camera_);
            asset.keys.emplace_back("sun_elevations", fmt::format("[{}]", fmt::join(suns_, ", ")));
            add(ways, "sky views", size, {asset}, [](const LightView& view) {
                return Reading{0,
                               {{"azimuth_deg", view.sky.azimuth_deg},
                                {"above_horizon_deg", view.sky.above_horizon_deg},
                                {"sun_elevation_deg", view.sky.sun_elevation_deg}}};
            });
        }
    }

    // Two square pictures of 90 degrees show the right half of all that is near the horizon; the left
    // half is its mirror image.
    void add_volumes(int channels, std::vector<LightWay>& ways) const {
        for (const std::string_view size : {"[16, 16, 16]", "[32, 32, 32]", "[64, 64, 32]"}) {
            std::vector<WayAsset> assets;
            for (const std::string& sun : suns_) {
                for (const double heading_deg : kHeadings_deg) {
                    assets.push_back(asset_of(fmt::format("air_{}", assets.size() + 1),
                                              "aerial_perspective", size, "half"));
                    auto& keys = assets.back().keys;
                    if (channels != 3) keys.emplace_back("content", toml_string("in_scatter"));
                    keys.emplace_back("altitude", camera_);
                    keys.emplace_back("sun_elevation", sun);
                    keys.emplace_back("heading", fmt::format("\"{} deg\"", heading_deg));
                    keys.emplace_back("fov", "\"90 deg\"");
                    keys.emplace_back("aspect", "1");
                }
            }
            add(ways, "volumes of air", size, std::move(assets),
                [of = *this](const LightView& view) { return of.in_volume(view); });
        }
    }

    // Maps of all directions, one for each sun.
    void add_environments(std::vector<LightWay>& ways) const {
        for (const std::string_view size : {"[32, 16]", "[64, 32]", "[128, 64]", "[256, 128]"}) {
            add_environment("panoramas", "longitude_latitude", size, ways);
        }
        for (const std::string_view size : {"[32, 32]", "[64, 64]", "[128, 128]"}) {
            add_environment("octahedra", "octahedral", size, ways);
        }
    }

  private:
    static constexpr std::array kHeadings_deg = {45.0, 135.0};

    static void add(std::vector<LightWay>& ways, std::string family, std::string_view size,
                    std::vector<WayAsset> assets, std::function<Reading(const LightView&)> reads) {
        const std::string name = fmt::format("{}, half", plain_value(size));
        ways.push_back({{"picture", std::move(family), name, "", std::move(assets)},
                        SkyBy::picture,
                        std::move(reads)});
    }

    void add_environment(std::string family, std::string_view mapping, std::string_view size,
                         std::vector<LightWay>& ways) const {
        std::vector<WayAsset> assets;
        for (const std::string& sun : suns_) {
            assets.push_back(asset_of(fmt::format("surroundings_{}", assets.size() + 1),
                                      "environment", size, "half"));
            auto& keys = assets.back().keys;
            keys.emplace_back("mapping", toml_string(mapping));
            keys.emplace_back("altitude", camera_);
            keys.emplace_back("sun_elevation", sun);
        }
        add(ways, std::move(family), size, std::move(assets), [of = *this](const LightView& view) {
            return Reading{of.sun_of(view),
                           {{"azimuth_deg", view.sky.azimuth_deg},
                            {"elevation_deg", elevation_deg(of.shell_, view.sky)}}};
        });
    }

    std::size_t sun_of(const LightView& view) const {
        const auto off = [&](double sun_deg) {
            return std::fabs(sun_deg - view.sky.sun_elevation_deg);
        };
        const auto nearest = std::ranges::min_element(range_.suns_deg, {}, off);
        return static_cast<std::size_t>(nearest - range_.suns_deg.begin());
    }

    Reading in_volume(const LightView& view) const {
        const std::size_t side = view.sky.azimuth_deg < 90 ? 0 : 1;
        const double across = (view.sky.azimuth_deg - kHeadings_deg[side]) / kDegreesPerRadian;
        const double up = elevation_deg(shell_, view.sky) / kDegreesPerRadian;
        return {kHeadings_deg.size() * sun_of(view) + side,
                {{"picture_x", 0.5 + 0.5 * std::tan(across)},
                 {"picture_y", 0.5 - 0.5 * std::tan(up) / std::cos(across)},
                 {"distance_km", view.distance_km}}};
    }

    SceneRange range_;
    Shell shell_;
    std::string camera_;
    std::vector<std::string> suns_;
};

void add_irradiance(std::vector<LightWay>& ways) {
    const auto add = [&](std::string_view content, std::string_view size, std::string_view type) {
        const bool is_all = content == "total";
        WayAsset asset = asset_of("ground_light", "irradiance", size, type);
        asset.keys.emplace_back("content", toml_string(content));
        ways.push_back({{"fetch",
                         is_all ? "light of sun and sky" : "light of the sun alone",
                         fmt::format("{}, {}", plain_value(size), type),
                         is_all ? "" : "sunlight alone",
                         {asset}},
                        SkyBy::picture,
                        [](const LightView& view) {
                            return Reading{0,
                                           {{"altitude_km", view.sky.altitude_km},
                                            {"sun_cos_zenith", view.sky.sun.cosine}}};
                        }});
    };
    for (const std::string_view size : {"[16, 8]", "[32, 16]", "[64, 32]"}) {
        add("total", size, "half");
    }
    add("total", "[64, 32]", "float");
    add("direct", "[64, 32]", "half");
}

}  // namespace

bool has_viewed_suns(const SceneRange& range) {
    return !range.suns_deg.empty() && range.suns_deg.size() <= kMostViewedSuns;
}

std::vector<LightWay> light_ways(Draws light, const Parameters& parameters,
                                 const SceneRange& range) {
    const auto allows = [&by = parameters.scene->sky_by](SkyBy one) {
        return by.empty() || std::ranges::find(by, one) != by.end();
    };
    const bool marches = allows(SkyBy::march) && parameters.wavelengths.size() <= kMaxChannels;
    const bool looks = allows(SkyBy::picture) && has_viewed_suns(range);
    const Pictures pictures(range, shell_of(parameters.atmosphere));
    std::vector<LightWay> ways;
    switch (light) {
        case Draws::sky:
            if (marches) add_marches("", ways);
            if (allows(SkyBy::fetch)) add_fetches(ways);
            if (looks) pictures.add_sky_views(ways);
            break;
        case Draws::distance:
            if (marches) add_marches("distance_", ways);
            if (looks) pictures.add_volumes(light_channels(parameters), ways);
            break;
        case Draws::ground_light:
            add_irradiance(ways);
            break;
        case Draws::surroundings:
            if (has_viewed_suns(range)) pictures.add_environments(ways);
            break;
        case Draws::clouds:
            break;
    }
    return ways;
}

}  // namespace skybake
