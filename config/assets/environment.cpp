#include "config/assets/environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/source_volume.h"
#include "config/fields/fields.h"
#include "config/fields/section_decoder.h"
#include "config/sections/cloud.h"
#include "config/sections/parameters.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

constexpr Range camera_place_range{-1e8, 1e8};

constexpr Choice environment_mapping_choices[] = {
    {EnvironmentMapping::longitude_latitude, "longitude_latitude",
     "azimuth along u and elevation along v, twice as wide as high"},
    {EnvironmentMapping::cube, "cube",
     "six square faces below each other: +x, -x, +y, -y, +z, -z, as GPUs have them"},
    {EnvironmentMapping::octahedral, "octahedral",
     "the sphere as an octahedron that is unfolded to a square, the zenith in its middle"},
    {EnvironmentMapping::equal_area, "equal_area",
     "such a square whose texels show equal areas of the sphere, as pbrt-v4 reads it"},
};

constexpr Choice environment_sun_choices[] = {
    {SunInMap::none, "none", "the sun's disc is left out; `lights` tells its light"},
    {SunInMap::disc, "disc", "texels hold the light of the sun's disc, all of it"},
};

constexpr Choice level_choices[] = {
    {LevelContent::mean, "mean", "the means of the level before"},
    {LevelContent::ggx, "ggx",
     "light as rough surfaces reflect it, from smooth to the roughness 1"},
};

const Row<EnvironmentBake> environment_table[] = {
    {"mapping", Kind::choice, &EnvironmentBake::mapping, "which direction a texel shows",
     environment_mapping_choices, Default{R"("longitude_latitude")"}},
    {"size", Kind::size, &EnvironmentBake::size,
     "texels of the image: around, and from the zenith to straight down; of a "
     "cube [256, 1536] by default, of a square [512, 512]",
     texel_range, Default{"[1024, 512]"}},
    {camera_altitude_field, &EnvironmentBake::altitude},
    {"sun_elevation", Kind::angle, &EnvironmentBake::sun_elevation,
     "elevation of the sun, which stands in the middle of a row", elevation_range,
     KeyFlag::required},
    {"sun_azimuth", Kind::angle, &EnvironmentBake::sun_azimuth,
     "azimuth of the sun, to the right of straight ahead, which is the middle of a row and the x "
     "axis of clouds",
     Range{-std::numbers::pi, std::numbers::pi}, Default{R"("0 deg")"}},
    {orders_field, &EnvironmentBake::orders},
    {layers_field, &EnvironmentBake::layers},
    {"clouds", Kind::text_list, &EnvironmentBake::clouds,
     "NAME of the [bake.NAME] with asset = \"cloud_volume\" that covers the sky, or a list of "
     "them, one for each layer; without it, the sky is clear",
     Hint{"for example [\"cumulus\", \"cirrus\"]"}},
    {"camera_x", Kind::length, &EnvironmentBake::camera_x,
     "x of the camera, from the corner of the clouds' tiles", camera_place_range,
     Default{R"("0 m")"}, Needs{"clouds"}},
    {"camera_y", Kind::length, &EnvironmentBake::camera_y,
     "y of the camera, from the corner of the clouds' tiles", camera_place_range,
     Default{R"("0 m")"}, Needs{"clouds"}},
    {"samples", Kind::integer, &EnvironmentBake::samples,
     "rays along each edge of a texel, whose mean through clouds it is", Range{1, 16}, Default{"2"},
     Needs{"clouds"}},
    {"sun", Kind::choice, &EnvironmentBake::sun,
     "whether the map holds the light of the sun's disc", environment_sun_choices,
     Default{R"("none")"}},
    {"level_content", Kind::choice, &EnvironmentBake::level_content,
     "what the levels of `mips` beyond the first hold", level_choices, Default{R"("mean")"},
     Cited{"Karis 2013, Real Shading in Unreal Engine 4"}},
    {"lights", Kind::flag, &EnvironmentBake::lights,
     "writes NAME.json with the sun's light, the light on a level surface, and spherical harmonics "
     "to degree 4",
     Default{"false"}},
    {"solar_irradiance", Kind::fractions, &EnvironmentBake::solar_irradiance,
     "factor of all light, for another unit, or for a moon or a star in the place of the sun; "
     "without it 1",
     Range{0, 1e6, true},
     Hint{"133100 makes cd/m2 of colours under the sun, and 0.31 under a full moon"}},
};

// This is one section while it is resolved.
struct EnvironmentResolver {
    DecodedSection& bake;
    const RecipeSoFar& recipe;
    Decoder& decoder;

    // Returns how many squares the image is high, or 0 where it need not be made of squares.
    int squares() const {
        const auto mapping = choice_of<EnvironmentMapping>(bake.at("mapping"));
        if (mapping == EnvironmentMapping::cube) return 6;
        return mapping == EnvironmentMapping::longitude_latitude ? 0 : 1;
    }

    void resolve_size() const {
        const int high = squares();
        if (high == 0) return;
        const std::array<int, 2> usual = high == 6 ? std::array{256, 1536} : std::array{512, 512};
        derive(bake.at("size"), usual);
        const auto* size = bake.value<std::array<int, 2>>("size");
        if (!size || (*size)[1] == high * (*size)[0]) return;
        decoder.report(
            "E0142", bake, "size",
            fmt::format("of {} makes no squares", high == 6 ? "a cube" : "an octahedron"),
            fmt::format("give [{0}, {1}], or another size that is {2}", (*size)[0],
                        high * (*size)[0],
                        high == 6 ? "six times as high as wide" : "as high as wide"));
    }

    // Squares halve evenly: faces down to one texel, octahedra down to four along an edge.
    void check_halving() const {
        const auto* mips = bake.value<double>("mips");
        const auto* size = bake.value<std::array<int, 2>>("size");
        if (squares() == 0 || !mips || *mips == 1 || !size) return;
        const int least = squares() == 6 ? 1 : 4;
        int most = 1;
        int edge = (*size)[0];
        for (; edge % 2 == 0 && edge >= 2 * least; edge /= 2) ++most;
        if (*mips == 0) bake.at("mips").value = double{1} * most;
        // Levels beyond one texel are out of the range of `mips` itself.
        if (*mips <= most || edge == 1) return;
        decoder.report("E0172", bake, "mips",
                       fmt::format("halves squares of {} texels too often", (*size)[0]),
                       fmt::format("at most {} levels have whole texels, {} along an edge or more",
                                   most, least));
    }

    void check_levels() const {
        check_halving();
        const auto* mips = bake.value<double>("mips");
        const auto content = choice_of<LevelContent>(bake.at("level_content"));
        if (content != LevelContent::ggx || !mips || *mips != 1) return;
        decoder.report("E0172", bake, "level_content", "needs more levels than the map itself",
                       "give `mips`, for instance 6");
    }

    // Refuses clouds whose values are no densities.
    void check_cloud(const std::string& name) const {
        const CloudVolumeBake* volume = find_volume_named(bake, "clouds", name, recipe, decoder);
        const Cloud* cloud = volume ? find_cloud(*volume, recipe) : nullptr;
        if (!cloud || cloud->channels != CloudChannels::noise) return;
        decoder.report("E0172", bake, "clouds", "needs volumes of densities",
                       fmt::format("`channels` of the cloud of `{}` are noise", shorten(name)));
    }

    void check_clouds(const std::vector<std::string>& names) const {
        for (auto name = names.begin(); name != names.end(); ++name) {
            if (std::find(names.begin(), name, *name) == name) {
                check_cloud(*name);
            } else {
                decoder.report("E0172", bake, "clouds",
                               fmt::format("has `{}` twice", shorten(*name)),
                               "name each layer once");
            }
        }
        check_camera_in_air();
    }

    void check_camera_in_air() const {
        const auto* altitude = bake.value<double>("altitude");
        const Atmosphere& air = recipe.parameters.atmosphere;
        const double thickness_m = air.top_radius.meters - air.ground_radius.meters;
        if (!altitude || thickness_m <= 0 || *altitude < thickness_m) return;
        decoder.report(
            "E0172", bake, "clouds", "needs a camera in the air",
            fmt::format("the air ends {} above the ground", length_to_string(thickness_m)));
    }
};

// Fills in the size. It reports a size that the mapping cannot have (E0142), a name that is not a
// cloud volume's (E0133), and values that contradict each other (E0172).
void resolve_environment(DecodedSection& bake, const RecipeSoFar& recipe, Decoder& decoder) {
    const EnvironmentResolver resolver{bake, recipe, decoder};
    resolver.resolve_size();
    resolver.check_levels();
    const auto* clouds = bake.value<std::vector<std::string>>("clouds");
    if (clouds && !clouds->empty()) resolver.check_clouds(*clouds);
}

std::vector<Read> reads_of(const Parameters& parameters, const EnvironmentBake& bake) {
    std::vector<Read> reads = reads_of_light(parameters, Roles::all());
    for (const std::string& clouds : bake.clouds) {
        append(reads_of_source_volume(parameters, clouds), reads);
    }
    return reads;
}

}  // namespace

AssetKind asset_kind(Tag<EnvironmentBake>) {
    return make_asset_kind<EnvironmentBake>(
        {.name = "environment",
         .documentation = "the sky and the ground around a camera, with clouds if wanted",
         .is_table = true,
         .needs_atmosphere = true,
         .use_of_light = UseOfLight::colors,
         .of_another_bake = true},
        with_file_fields(environment_table, table_files), reads_of, resolve_environment);
}

}  // namespace skybake::config
