#include "config/assets/cloud_light_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>
#include <vector>

#include "config/text/key_path.h"

namespace skybake::config {
namespace {

// This is one section while it is checked.
struct ContentsCheck {
    const DecodedSection& bake;
    Decoder& decoder;

    const Place& place_of(std::string_view key) const {
        const DecodedField& decoded = bake.at(key);
        return decoded.source ? decoded.source->place : bake.place;
    }

    std::size_t angles(std::string_view key) const {
        const auto& value = bake.at(key).value;
        return value ? std::get<std::vector<double>>(*value).size() : 0;
    }

    // Returns the number of suns, or 1 if it cannot be told.
    std::size_t check_suns() const {
        const std::size_t suns = angles("sun_elevations");
        if (suns == 2 || suns > 4) {
            decoder.diagnostics.error(
                "E0129", place_of("sun_elevations"),
                fmt::format("`{}` has {} suns, and a file one, three or four channels",
                            join_path(bake.path, "sun_elevations"), suns),
                suns == 2 ? "add a sun, or bake them as two assets"
                          : "bake them as several assets of at most four suns");
        }
        check_azimuths();
        return std::clamp<std::size_t>(suns, 1, 4);
    }

    void check_azimuths() const {
        const std::size_t suns = angles("sun_elevations");
        const std::size_t azimuths = angles("sun_azimuths");
        if (azimuths > 0 && suns > 0 && azimuths != suns) {
            decoder.diagnostics.error("E0171", place_of("sun_azimuths"),
                                      fmt::format("`{}` has {} azimuths for {} sun{}",
                                                  join_path(bake.path, "sun_azimuths"), azimuths,
                                                  suns, suns == 1 ? "" : "s"),
                                      "give one azimuth for each elevation");
        }
    }

    void check_sun_of_radiance() const {
        const std::size_t suns = angles("sun_elevations");
        if (suns > 1) {
            decoder.diagnostics.error(
                "E0176", place_of("sun_elevations"),
                fmt::format("`{}` has {} suns, and a file the radiance of one",
                            join_path(bake.path, "sun_elevations"), suns),
                "give one elevation, and bake an asset for each sun");
        }
        check_azimuths();
    }

    std::size_t check_part() const {
        const auto& degree = bake.at("degree").value;
        const auto& part = bake.at("part").value;
        if (!degree || !part) return 1;
        CloudLightBake harmonics;
        harmonics.contents = CloudLightContents::sky_visibility;
        harmonics.degree = static_cast<int>(std::get<double>(*degree));
        harmonics.part = static_cast<int>(std::get<double>(*part));
        const std::size_t channels = channels_of(harmonics);
        if (channels > 0) return channels;
        const int coefficients = (harmonics.degree + 1) * (harmonics.degree + 1);
        const int parts = (coefficients + 3) / 4;
        decoder.diagnostics.error(
            "E0171", place_of("part"),
            fmt::format("`{}` is {}, but harmonics of degree {} have {} coefficient{} in {} part{}",
                        join_path(bake.path, "part"), harmonics.part, harmonics.degree,
                        coefficients, coefficients == 1 ? "" : "s", parts, parts == 1 ? "" : "s"),
            fmt::format("use at most {}", parts));
        return 1;
    }
};

}  // namespace

std::size_t check_contents(const DecodedSection& bake, CloudLightContents contents,
                           Decoder& decoder) {
    const ContentsCheck check{bake, decoder};
    if (is_per_sun(contents)) return check.check_suns();
    if (is_of_one_sun(contents)) check.check_sun_of_radiance();
    return check.check_part();
}

void check_clear_sky(const DecodedSection& bake, const Cloud* cloud, const RecipeSoFar& recipe,
                     Decoder& decoder) {
    const Atmosphere& air = recipe.parameters.atmosphere;
    const double thickness_m = air.top_radius.meters - air.ground_radius.meters;
    const Place& place = bake.at("contents").source->place;
    if (air.top_radius.meters <= 0) {
        if (!decoder.complete || decoder.diagnostics.has_errors()) return;
        decoder.diagnostics.error(
            "E0189", place,
            fmt::format("`{}` needs a sky, and the recipe has no [atmosphere]",
                        join_path(bake.path, "contents")),
            "give the recipe an atmosphere, for instance preset = \"earth\"");
        return;
    }
    if (!cloud) return;
    const double top_m = cloud->base_altitude.meters + cloud->extent[2].meters;
    if (thickness_m <= 0 || top_m < thickness_m) return;
    decoder.diagnostics.error(
        "E0189", place,
        fmt::format("`{}` needs air above the cloud, whose top is at {}",
                    join_path(bake.path, "contents"), length_to_string(top_m)),
        fmt::format("the air ends {} above the ground", length_to_string(thickness_m)));
}

}  // namespace skybake::config
