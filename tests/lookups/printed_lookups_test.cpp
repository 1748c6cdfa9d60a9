// Holds the functions that `skybake info --lookup` prints of a file to its probes:
// print_lookups.cmake has baked tests/recipes/lookups.toml and made C++ of what was printed.
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "bakers/assets/optical_depth/column_table.h"
#include "bakers/io/manifest/asset_files.h"
#include "bakers/preview/load_assets.h"
#include "bakers/preview/runtime/runtime_library.h"
#include "bakers/render/sky_view.h"
#include "tests/lookups/printed_call.h"

namespace metal::printed {
#include "printed/lookups_msl.h"
}

namespace skybake {
namespace gpu::printed {
#include "printed/lookups.h"
}

namespace {

namespace fs = std::filesystem;
using gpu::vec2;
using gpu::vec3;
using gpu::vec4;

const fs::path kFolder = SKYBAKE_PRINTED_FOLDER;
constexpr double kDegree = std::numbers::pi / 180;

using test::widened;

#define SKYBAKE_CALL(file, function, ...)                                                          \
    test::called(#file, #function, gpu::printed::file::function, ::metal::printed::file::function, \
                 __VA_ARGS__)

// Read once.
const Manifest& manifest_of(const std::string& folder) {
    static std::map<std::string, Manifest> known;
    const auto found = known.find(folder);
    if (found != known.end()) return found->second;
    auto manifest = read_manifest(kFolder / folder);
    if (!manifest.value) throw std::runtime_error("no manifest in " + folder);
    return known.emplace(folder, std::move(*manifest.value)).first->second;
}

// A baked file as a runtime loads it.
class BakedFile {
  public:
    explicit BakedFile(const std::string& name, const std::string& folder = "colours") {
        for (const ManifestAsset& asset : manifest_of(folder).assets) {
            for (const ManifestFile& file : asset.files) {
                if (file.path == name) load(kFolder / folder, asset, file);
            }
        }
        if (texture_.texels.empty()) throw std::runtime_error("no " + name);
    }

    const Texture& texture() const { return texture_; }
    const ManifestAsset& asset() const { return asset_; }
    const std::vector<Probe>& probes() const { return probes_; }

    // The lookup takes the texture and a probe.
    template <class Lookup>
    void holds(const Lookup& lookup) const {
        int held = 0;
        for (const Probe& probe : probes_) {
            if (is_undecided(probe)) continue;
            test::expect_probe_of_call(widened(lookup(texture_, probe)), probe);
            ++held;
        }
        EXPECT_GT(held, asset_.kind == "sky_view" ? 20 : 10) << texture_.name;
    }
    // A constant of the asset's mapping.
    double constant(std::size_t axis, const std::string& name) const {
        return std::stod(fact_named(asset_.axes[axis].constants, name));
    }

  private:
    // On the horizon itself rounding decides between sky and ground, which do not mix. Before the first
    // slice of air a lookup goes on towards the camera, where a probe has the slice's value.
    bool is_undecided(const Probe& probe) const {
        if (asset_.kind == "sky_view") {
            return std::fabs(test::at(probe, "above_horizon_deg")) * kDegree < 5e-7;
        }
        return asset_.kind == "aerial_perspective" && probe.uvw[2] < 0.5 / texture_.size[2];
    }

    void load(const fs::path& folder, const ManifestAsset& asset, const ManifestFile& file) {
        const ManifestLevel& level = asset.levels[static_cast<std::size_t>(file.level)];
        asset_ = asset;
        probes_ = level.probes;
        texture_.size = level.size;
        texture_.channels = static_cast<int>(asset.channels.size());
        texture_.repeats = repeating_axes(asset.axes);
        texture_.name = folder.filename().string() + "_" + file.path;
        const auto keep = [&](std::int64_t, std::int64_t count, const float* values) {
            texture_.texels.insert(texture_.texels.end(), values,
                                   values + count * texture_.channels);
            return true;
        };
        const auto done = read_asset_file(folder / file.path, asset, file, 0, keep);
        if (!done.value) throw std::runtime_error(done.diagnostics.front().message);
    }

    ManifestAsset asset_;
    std::vector<Probe> probes_;
    Texture texture_;
};

float coordinate(const Probe& probe, const char* name) {
    return static_cast<float>(test::at(probe, name));
}
float altitude(const Probe& probe) { return coordinate(probe, "altitude_km"); }
float cosine(const Probe& probe) { return coordinate(probe, "cos_zenith"); }
float sun_cosine(const Probe& probe) { return coordinate(probe, "sun_cos_zenith"); }

TEST(PrintedLookups, AreHereForEveryAsset) {
    const std::vector<ManifestAsset>& assets = manifest_of("colours").assets;
    for (const AnyBaker& baker : bakers()) {
        EXPECT_TRUE(std::any_of(assets.begin(), assets.end(), [&](const ManifestAsset& asset) {
            return asset.kind.starts_with(baker.asset);
        })) << baker.asset;
    }
}

// Holds a function, called with the texture of a file and these arguments of a probe `at`, to all probes
// of the file; and the lookup of NAME.EXT, of a folder of its own, too.
#define SKYBAKE_HOLDS_OF(baked, file, function, ...)             \
    baked.holds([&](const Texture& table, const Probe& at) {     \
        return SKYBAKE_CALL(file, function, table, __VA_ARGS__); \
    })
#define SKYBAKE_HOLDS(name, ext, ...) \
    SKYBAKE_HOLDS_OF(BakedFile(#name "." #ext), name##_##ext, baked_##name, __VA_ARGS__)
#define SKYBAKE_HOLDS_IN(folder, name, ext, ...)                                                \
    SKYBAKE_HOLDS_OF(BakedFile(#name "." #ext, #folder), folder##_##name##_##ext, baked_##name, \
                     __VA_ARGS__)

// --- Tables over altitude -----------------------------------------------------------------------

TEST(PrintedLookups, Transmittance) {
    SKYBAKE_HOLDS(transmittance, exr, altitude(at), cosine(at));
    SKYBAKE_HOLDS_IN(one_colour, transmittance, exr, altitude(at), cosine(at));
    SKYBAKE_HOLDS(transmittance_ue, exr, altitude(at), cosine(at));
    SKYBAKE_HOLDS(transmittance_ue, dds, altitude(at), cosine(at));
}

TEST(PrintedLookups, MultipleScattering) {
    SKYBAKE_HOLDS(hillaire, exr, altitude(at), sun_cosine(at));
    SKYBAKE_HOLDS(twilight, exr, altitude(at), sun_cosine(at));
    EXPECT_GT(BakedFile("cropped.exr").constant(0, "first"), 0);
    SKYBAKE_HOLDS(cropped, exr, altitude(at), sun_cosine(at));
}

int part_of(const Probe& probe) {
    const auto l = static_cast<int>(test::at(probe, "l"));
    return l * (l + 1) / 2 + static_cast<int>(test::at(probe, "m"));
}

TEST(PrintedLookups, Moments) {
    SKYBAKE_HOLDS(moments, exr, altitude(at), sun_cosine(at), part_of(at));
    SKYBAKE_HOLDS_OF(BakedFile("moments-of-degree-3.exr"), moments_of_degree_3_exr,
                     baked_moments_of_degree_3, altitude(at), sun_cosine(at), part_of(at));
}

// The mean radiance, moment 0, is what a layer that scatters alike in all directions sees.
template <class Scattered>
void expect_mean(const BakedFile& moments, const Scattered& scattered) {
    std::set<int> parts;
    for (const Probe& probe : moments.probes()) {
        parts.insert(part_of(probe));
        if (part_of(probe) != 0) continue;
        test::expect_probe_of_call(widened(scattered(moments.texture(), probe)), probe);
    }
    EXPECT_EQ(parts.size(), 6U) << "probes of each degree and order";
}

TEST(PrintedLookups, ScatteredMoments) {
    const vec3 isotropic(1, 0, 0);
    expect_mean(BakedFile("moments.exr"), [&](const Texture& table, const Probe& at) {
        const vec3 scattered = SKYBAKE_CALL(moments_exr, baked_moments_scattered, table,
                                            altitude(at), sun_cosine(at), 0.3f, 0.6f, isotropic);
        EXPECT_EQ(scattered, gpu::printed::moments_exr::baked_moments({table}, altitude(at),
                                                                      sun_cosine(at), 0));
        return scattered;
    });
    expect_mean(BakedFile("moments.exr", "four_wavelengths"),
                [&](const Texture& table, const Probe& at) {
                    return SKYBAKE_CALL(four_wavelengths_moments_exr, baked_moments_scattered,
                                        table, altitude(at), sun_cosine(at), 0.3f, 0.5f, isotropic);
                });
}

TEST(PrintedLookups, Irradiance) {
    SKYBAKE_HOLDS(irradiance, exr, altitude(at), sun_cosine(at));
    SKYBAKE_HOLDS(irradiance_hillaire, exr, altitude(at), sun_cosine(at));
    // A level of a texture is read by the size of level 0.
    SKYBAKE_HOLDS_OF(BakedFile("irradiance_hillaire.mip1.exr"), irradiance_hillaire_mip1_exr,
                     baked_irradiance_hillaire, altitude(at), sun_cosine(at));
}

// Two directions that a scattering angle is between.
std::pair<vec3, vec3> pair_of(const Probe& probe) {
    const double angle = test::at(probe, "scattering_angle_deg") * kDegree;
    return {vec3(1, 0, 0), vec3(std::cos(angle), std::sin(angle), 0)};
}

// --- Four wavelengths ---------------------------------------------------------------------------

TEST(PrintedLookups, FourWavelengths) {
    SKYBAKE_HOLDS_IN(four_wavelengths, transmittance, exr, altitude(at), cosine(at));
    SKYBAKE_HOLDS_IN(four_wavelengths, transmittance_ue, exr, altitude(at), cosine(at));
    SKYBAKE_HOLDS_IN(four_wavelengths, twilight, exr, altitude(at), sun_cosine(at));
    SKYBAKE_HOLDS_IN(four_wavelengths, moments, exr, altitude(at), sun_cosine(at), part_of(at));
    SKYBAKE_HOLDS_IN(four_wavelengths, phase, exr, pair_of(at).first, pair_of(at).second);
    SKYBAKE_HOLDS_IN(four_wavelengths, sampled_angle, exr, coordinate(at, "share"));
}

// One wavelength at a time, and all of them: colours by the manifest's weights.
TEST(PrintedLookups, ColoursOfWavelengths) {
    const BakedFile table("twilight.exr", "four_wavelengths");
    ASSERT_TRUE(table.asset().conventions.color);
    const std::vector<double>& weights = table.asset().conventions.color->weights;
    for (const vec4& light : {vec4(1, 0, 0, 0), vec4(0, 1, 0, 0), vec4(0, 0, 1, 0),
                              vec4(0, 0, 0, 1), vec4(1, 2, 3, 4)}) {
        std::vector<double> color(3);
        for (std::size_t i = 0; i < 12; ++i) {
            color[i % 3] += weights[i] * double{light[static_cast<glm::length_t>(i / 3)]};
        }
        test::expect_color_of_call(
            SKYBAKE_CALL(four_wavelengths_twilight_exr, baked_twilight_color, light), color);
    }
}

// --- Skies --------------------------------------------------------------------------------------

// The view of a probe at an elevation, by degrees, the sun straight ahead.
test::EngineView view_at(const Probe& probe, double elevation, double sun_elevation) {
    return test::engine_view(elevation * kDegree, test::at(probe, "azimuth_deg") * kDegree,
                             sun_elevation * kDegree, {0, 0, 1});
}
#define SKYBAKE_PARTS(view) view.dir, view.up, view.sun
// Of a probe of a panorama, and of one of a sky, whose horizon is so much lower than the level.
#define SKYBAKE_VIEW(sun_elevation) \
    SKYBAKE_PARTS(view_at(at, test::at(at, "elevation_deg"), sun_elevation))
#define SKYBAKE_VIEW_OVER(dip) \
    SKYBAKE_PARTS(             \
        view_at(at, test::at(at, "above_horizon_deg") - dip, test::at(at, "sun_elevation_deg")))

TEST(PrintedLookups, SkyView) {
    const double dip = BakedFile("sky.exr").constant(1, "dip_deg");
    SKYBAKE_HOLDS(sky, exr, SKYBAKE_VIEW_OVER(dip));
    SKYBAKE_HOLDS_IN(one_colour, sky, exr, SKYBAKE_VIEW_OVER(dip));
    const auto sun = [](const Probe& at) {
        const double elevation = test::at(at, "sun_elevation_deg");
        return elevation > 20 ? 0 : elevation < 0 ? 1 : 2;
    };
    const double from_space = BakedFile("skies.exr").constant(1, "dip_deg");
    SKYBAKE_HOLDS(skies, exr, SKYBAKE_VIEW_OVER(from_space), sun(at));
}

TEST(PrintedLookups, Environment) {
    SKYBAKE_HOLDS(panorama, exr, SKYBAKE_VIEW(20));
    // Azimuths count from straight ahead, which is not where the sun is.
    SKYBAKE_HOLDS(panorama_turned, exr, SKYBAKE_VIEW(0));
    SKYBAKE_HOLDS(faces, exr, SKYBAKE_VIEW(0));
    // Half a texel before the edge of a face the lookup stays where it is, as the next face follows.
    const BakedFile faces("faces.exr");
    const auto ahead_and_down = [&](float down) {
        return SKYBAKE_CALL(faces_exr, baked_faces, faces.texture(), vec3(1, 0, -down),
                            vec3(0, 0, 1), vec3(1, 0, 0));
    };
    EXPECT_EQ(ahead_and_down(0.999F), ahead_and_down(15.0F / 16));
    SKYBAKE_HOLDS(octahedron, exr, SKYBAKE_VIEW(0));
}

vec2 picture(const Probe& probe) {
    return vec2(coordinate(probe, "picture_x"), coordinate(probe, "picture_y"));
}
float distance(const Probe& probe) { return coordinate(probe, "distance_km"); }

TEST(PrintedLookups, AerialPerspective) {
    SKYBAKE_HOLDS(air, exr, picture(at), distance(at));
    SKYBAKE_HOLDS(air_light, dds, picture(at), distance(at));
    SKYBAKE_HOLDS(air_transmittance, bin, picture(at), distance(at));
    SKYBAKE_HOLDS_IN(one_colour, air, exr, picture(at), distance(at));
    // 60 degrees high, and one and a half times as wide.
    const vec2 corner =
        SKYBAKE_CALL(air_exr, baked_air_picture,
                     glm::normalize(vec3(1, -1.5 * std::tan(30 * kDegree), std::tan(30 * kDegree))),
                     vec3(1, 0, 0), vec3(0, -1, 0), vec3(0, 0, 1));
    EXPECT_NEAR(corner.x, 1, 1e-6);
    EXPECT_NEAR(corner.y, 0, 1e-6);
}

// --- Packets -------------------------------------------------------------------------------------

TEST(PrintedLookups, SkiesOfPackets) {
    const double dip = BakedFile("sky.exr", "packets").constant(1, "dip_deg");
    SKYBAKE_HOLDS_IN(packets, sky, exr, SKYBAKE_VIEW_OVER(dip));
    SKYBAKE_HOLDS_IN(packets, panorama, exr, SKYBAKE_VIEW(20));
    SKYBAKE_HOLDS_IN(packets, air_light, exr, picture(at), distance(at));
    SKYBAKE_HOLDS_IN(packets, air_transmittance, exr, picture(at), distance(at));
}

TEST(PrintedLookups, FlatTablesOfPackets) {
    SKYBAKE_HOLDS_IN(packets, irradiance_2, exr, altitude(at), sun_cosine(at));
    SKYBAKE_HOLDS_IN(packets, b_irradiance, exr, altitude(at), sun_cosine(at));
    SKYBAKE_HOLDS_IN(packets, b_transmittance, exr, altitude(at), cosine(at));
}

// Before the first slice, where no probe is, light falls to 0 and the transmittance rises to 1 in all
// four channels.
TEST(PrintedLookups, AirOfPacketsBeginsAtTheCamera) {
    const BakedFile light("air_light.exr", "packets");
    const BakedFile share("air_transmittance.exr", "packets");
    const vec2 picture(0.5, 0.4);
    const vec4 none =
        SKYBAKE_CALL(packets_air_light_exr, baked_air_light, light.texture(), picture, 0.0f);
    const vec4 all = SKYBAKE_CALL(packets_air_transmittance_exr, baked_air_transmittance,
                                  share.texture(), picture, 0.0f);
    for (int c = 0; c < 4; ++c) {
        EXPECT_EQ(none[c], 0.0f) << c;
        EXPECT_EQ(all[c], 1.0f) << c;
    }
}

// --- Angles -------------------------------------------------------------------------------------

TEST(PrintedLookups, Phase) {
    SKYBAKE_HOLDS(phase_by_angle, exr, pair_of(at).first, pair_of(at).second);
    SKYBAKE_HOLDS(phase_by_cosine, exr, pair_of(at).first, pair_of(at).second);
    SKYBAKE_HOLDS(phase_by_cosine_from_back, exr, pair_of(at).first, pair_of(at).second);
    SKYBAKE_HOLDS(phase_by_peaks, exr, pair_of(at).first, pair_of(at).second);
    SKYBAKE_HOLDS(sampled_angle, exr, coordinate(at, "share"));
}

// --- Bruneton's tables --------------------------------------------------------------------------

#define SKYBAKE_RAY \
    altitude(at), cosine(at), sun_cosine(at), coordinate(at, "nu"), test::at(at, "ground") != 0

TEST(PrintedLookups, Bruneton) {
    SKYBAKE_HOLDS(b_transmittance, exr, altitude(at), cosine(at));
    SKYBAKE_HOLDS(b_irradiance, exr, altitude(at), sun_cosine(at));
    SKYBAKE_HOLDS(b_scattering, exr, SKYBAKE_RAY);
    SKYBAKE_HOLDS(b_single_mie, exr, SKYBAKE_RAY);
    SKYBAKE_HOLDS(b_higher_orders, exr, SKYBAKE_RAY);
    SKYBAKE_HOLDS_IN(four_wavelengths, b_single_mie, exr, SKYBAKE_RAY);
}

// --- Columns ------------------------------------------------------------------------------------

TEST(PrintedLookups, Columns) {
    const BakedFile to_top("to_top.exr");
    const Shell shell{to_top.constant(1, "ground_radius_km"), to_top.constant(1, "thickness_km")};
    for (const Probe& at : to_top.probes()) {
        const double h = test::at(at, "altitude_km");
        const double s = (shell.ground_radius_km + h) * test::at(at, "cos_zenith");
        const auto column =
            SKYBAKE_CALL(to_top_exr, baked_to_top, to_top.texture(), altitude(at), cosine(at));
        test::expect_column_of_call(widened(column), distance_to_top_km(shell, h, s), at);
    }
    const BakedFile between("between.exr");
    for (const Probe& at : between.probes()) {
        const double length_km = test::length_between_km(shell, at);
        const auto column = SKYBAKE_CALL(
            between_exr, baked_between, between.texture(), coordinate(at, "low_altitude_km"),
            coordinate(at, "high_altitude_km"), static_cast<float>(length_km));
        test::expect_column_of_call(widened(column), length_km, at);
    }
    const BakedFile along("along.exr");
    for (const Probe& at : along.probes()) {
        const auto column = SKYBAKE_CALL(along_exr, baked_along, along.texture(), altitude(at),
                                         cosine(at), coordinate(at, "length_km"));
        test::expect_column_of_call(widened(column), test::at(at, "length_km"), at);
    }
}

TEST(PrintedLookups, DensitiesAndPhasesOfColumns) {
    SKYBAKE_HOLDS(densities, exr, altitude(at));
    SKYBAKE_HOLDS(phases, exr, pair_of(at).first, pair_of(at).second);
}

// --- Noise and clouds ---------------------------------------------------------------------------

// In tiles of 8 by 4 by 6 of some unit.
const vec3 kTile(8, 4, 6);
vec3 noise_place(const Probe& probe) {
    return kTile * vec3(coordinate(probe, "x_tile"), coordinate(probe, "y_tile"),
                        coordinate(probe, "z_tile"));
}

TEST(PrintedLookups, Noise) {
    SKYBAKE_HOLDS(noise, png, noise_place(at), kTile);
    SKYBAKE_HOLDS(noise_at_corners, bin, noise_place(at), kTile);
    SKYBAKE_HOLDS_OF(BakedFile("noise_at_corners.mip1.bin"), noise_at_corners_mip1_bin,
                     baked_noise_at_corners, noise_place(at), kTile);
    SKYBAKE_HOLDS(noise_slices, exr, noise_place(at), kTile);
}

vec2 map_place(const Probe& probe) {
    return vec2(8, 4) * vec2(coordinate(probe, "x_tile"), coordinate(probe, "y_tile"));
}

TEST(PrintedLookups, WeatherMap) {
    const vec2 tile(8, 4);
    SKYBAKE_HOLDS(weather, png, map_place(at), tile);
    SKYBAKE_HOLDS(weather_at_corners, ktx2, map_place(at), tile);
    SKYBAKE_HOLDS(weather_directions, dds, map_place(at), tile);
}

TEST(PrintedLookups, Flipbooks) {
    const auto u = [](const Probe& at) { return coordinate(at, "u"); };
    const auto v = [](const Probe& at) { return coordinate(at, "v"); };
    const auto frame = [](const Probe& at) { return coordinate(at, "frame"); };
    SKYBAKE_HOLDS(book, ktx2, u(at), v(at), frame(at));
    SKYBAKE_HOLDS(layered, ktx2, u(at), v(at), frame(at));
    // Two loops away.
    SKYBAKE_HOLDS(layered, dds, u(at) + 1.0f, v(at), frame(at) - 10.0f);
    SKYBAKE_HOLDS(part, dds, u(at), v(at), frame(at));
}

vec2 mask_pixel(const Probe& probe) {
    return vec2(coordinate(probe, "x_px"), coordinate(probe, "y_px"));
}

TEST(PrintedLookups, BlueNoise) {
    SKYBAKE_HOLDS(mask, bin, mask_pixel(at), coordinate(at, "frame"));
    // Two masks and six frames away.
    SKYBAKE_HOLDS(mask, bin, mask_pixel(at) - vec2(48, -40), coordinate(at, "frame") - 6.0f);
    SKYBAKE_HOLDS(mask_of_one, dds, mask_pixel(at), coordinate(at, "frame") + 17.0f);
}

// x, y and altitude in metres.
vec3 cloud_place(const Probe& probe) {
    return vec3(coordinate(probe, "x_m"), coordinate(probe, "y_m"),
                coordinate(probe, "altitude_m"));
}

TEST(PrintedLookups, Clouds) {
    SKYBAKE_HOLDS(cloud, vdb, cloud_place(at));
    SKYBAKE_HOLDS(cloud, bin, cloud_place(at));
    SKYBAKE_HOLDS(cloud_parts, vdb, cloud_place(at));
    const BakedFile open("cloud_open.dds");
    SKYBAKE_HOLDS(cloud_open, dds, cloud_place(at));
    // Its edge is the recipe's: a threshold of 0.1, 0.05 wide.
    for (const Probe& probe : open.probes()) {
        const double v = std::max(probe.value.front(), 0.0);
        const double x = std::clamp((v - 0.1) / 0.05, 0.0, 1.0);
        const double density = v * x * x * (3 - 2 * x);
        const double tolerance = 31 * probe.tolerance.front();
        EXPECT_NEAR(SKYBAKE_CALL(cloud_open_dds, baked_cloud_open_density, open.texture(),
                                 cloud_place(probe)),
                    density, tolerance);
        test::bound_call(density, tolerance);
    }
}

TEST(PrintedLookups, CellsOfClouds) {
    SKYBAKE_HOLDS(cells, exr, cloud_place(at));
    SKYBAKE_HOLDS_OF(BakedFile("cells.mip1.exr"), cells_mip1_exr, baked_cells, cloud_place(at));
    SKYBAKE_HOLDS(leaps, bin, cloud_place(at));
}

TEST(PrintedLookups, DistancesToClouds) {
    SKYBAKE_HOLDS(distance, bin, cloud_place(at));
    SKYBAKE_HOLDS(fields, exr, cloud_place(at));
}

TEST(PrintedLookups, LightInClouds) {
    SKYBAKE_HOLDS(light, exr, cloud_place(at));
    SKYBAKE_HOLDS(light_of_one, bin, cloud_place(at));
    SKYBAKE_HOLDS(shadow, exr, cloud_place(at));
    const BakedFile shadow("shadow.exr");
    for (const Probe& probe : shadow.probes()) {
        EXPECT_EQ(test::at(probe, "altitude_m"), 1200) << "below the cloud";
    }
    SKYBAKE_HOLDS(sky_of_cloud, exr, cloud_place(at));
    SKYBAKE_HOLDS(suns_of_cloud, exr, cloud_place(at));
    SKYBAKE_HOLDS(depths_of_cloud, exr, cloud_place(at));
    SKYBAKE_HOLDS(radiance_of_cloud, exr, cloud_place(at));
    SKYBAKE_HOLDS(sky_radiance_of_cloud, exr, cloud_place(at));
    SKYBAKE_HOLDS(clear_sky_radiance_of_cloud, exr, cloud_place(at));
}

TEST(PrintedLookups, ForwardScattering) {
    const auto offset = [](const Probe& at) {
        const double half_sine = std::sin(test::at(at, "scattering_angle_deg") * kDegree / 2);
        return static_cast<float>(2 * half_sine * half_sine);
    };
    SKYBAKE_HOLDS(forward, exr, offset(at), coordinate(at, "optical_depth"));
}

// A march by leaps finds the densities that one without finds, and asks for fewer.
template <class Leap, class March>
void expect_leaping_march(const std::string& name, const Leap& leap, const March& march) {
    const BakedFile cloud("cloud.bin");
    const BakedFile cells(name);
    test::Dice dice;
    long looked = 0;
    long steps = 0;
    double total = 0;
    int leaps = 0;
    for (int i = 0; i < 400; ++i) {
        const vec3 from(dice.uniform(-4000, 4000), dice.uniform(-4000, 4000), 1200);
        const vec3 ray = glm::normalize(vec3(dice.uniform(-1, 1), dice.uniform(-1, 1), 0.5));
        const auto count = static_cast<int>(900 / (20 * double{ray.z}));
        double sum = 0;
        for (int k = 0; k < count; ++k) {
            const vec3 p = from + ray * (20.0f * static_cast<float>(k));
            sum += 20 * double{gpu::printed::cloud_bin::baked_cloud({cloud.texture()}, p)};
        }
        const double empty = leap(cells.texture(), from, ray);
        if (empty > 0) ++leaps;
        test::bound_call(empty, 0.002);  // m; floats of 4000 have steps of 0.0002
        cloud.texture().lookups = 0;
        EXPECT_NEAR(march(cloud.texture(), cells.texture(), from, ray, 20.0f, count), sum,
                    1e-3 * sum + 0.05)
            << name << ", ray " << i;
        // GPUs filter in steps of 1/256 texel.
        test::bound_call(sum, 0.01 * sum + 0.05);
        looked += cloud.texture().lookups;
        steps += count;
        total += sum;
    }
    EXPECT_GT(total, 0);
    EXPECT_GT(leaps, 40) << name;
    EXPECT_LT(looked, 2 * 3 * steps / 4) << name;  // in two languages
}

// The grid of a file, and its functions: one that marches, and one that leaps by these arguments.
#define SKYBAKE_MARCHES(path, file, march, leap, ...)                                     \
    expect_leaping_march(                                                                 \
        path,                                                                             \
        [](const Texture& cells, const vec3& p, [[maybe_unused]] const vec3& ray) {       \
            return SKYBAKE_CALL(file, leap, cells, __VA_ARGS__);                          \
        },                                                                                \
        [](const Texture& cloud, const Texture& cells, const vec3& from, const vec3& ray, \
           float stride, int count) {                                                     \
            return SKYBAKE_CALL(file, march, cloud, cells, from, ray, stride, count);     \
        })

TEST(PrintedLookups, MarchesByLeapsAndDistances) {
    SKYBAKE_MARCHES("cells.exr", cells_exr, baked_cells_march, baked_cells_leap, p, ray);
    SKYBAKE_MARCHES("cells.mip1.exr", cells_mip1_exr, baked_cells_march, baked_cells_leap, p, ray);
    SKYBAKE_MARCHES("leaps.bin", leaps_bin, baked_leaps_march, baked_leaps_leap, p, ray);
    SKYBAKE_MARCHES("distance.bin", distance_bin, baked_distance_trace, baked_distance_distance, p);
}

// The library of a folder has the numbers of its recipe and the functions of its files.
TEST(PrintedLookups, AreInTheLibraryOfTheirFolder) {
    namespace library = gpu::printed::colours;
    EXPECT_FLOAT_EQ(library::baked_ground_radius_km(), 6360);
    EXPECT_FLOAT_EQ(library::baked_top_radius_km(), 6460);
    EXPECT_FLOAT_EQ(library::baked_cloud_extent_m().y, 2400);
    EXPECT_FLOAT_EQ(library::baked_cloud_corner_m().z, 1200);
    EXPECT_FLOAT_EQ(metal::printed::colours::baked_cloud_extinction_per_m(),
                    library::baked_cloud_extinction_per_m());
    const BakedFile file("transmittance.exr");
    const auto own =
        SKYBAKE_CALL(transmittance_exr, baked_transmittance, file.texture(), 2.0F, 0.4F);
    EXPECT_EQ(SKYBAKE_CALL(colours, baked_transmittance, file.texture(), 2.0F, 0.4F), own);
}

// The sky that a library marches is that of previews, which have the same tables: at the ground and high
// above it, towards the zenith, the horizon and the ground, by day, at dusk and below the horizon.
template <class Sky>
void expect_sky_of_previews(const std::string& folder, const Sky& sky) {
    const auto assets = load_folder(kFolder / folder, LoadedTexels::tables);
    ASSERT_TRUE(assets.value && assets.value->recipe);
    const auto air = runtime_air(*assets.value->recipe, *assets.value, 1);
    ASSERT_TRUE(has_colours(air));
    struct View {
        double altitude_km, sun_mu, mu;
    };
    std::vector<View> views;
    std::vector<SkyRay> rays;
    for (const double altitude_km : {0.0, 2.0, 40.0}) {
        for (const double sun_mu : {0.8, 0.05, -0.08}) {
            for (const double mu : {1.0, 0.3, 0.01, -0.3}) {
                const SunZenith sun = {sun_mu, std::sqrt(1 - sun_mu * sun_mu)};
                views.push_back({altitude_km, sun_mu, mu});
                rays.push_back(sky_ray(shell_of(air->medium.air), altitude_km, sun,
                                       sky_direction(sun, mu, std::sqrt(1 - mu * mu), -0.6)));
            }
        }
    }
    const std::vector<Spectrum> marched = march_sky(air->medium, air->tables, rays, kSkySteps, 1);
    for (std::size_t i = 0; i < views.size(); ++i) {
        const auto& [altitude_km, sun_mu, mu] = views[i];
        const double level = std::sqrt(1 - mu * mu);
        const auto found =
            widened(sky(vec3(0, 0, 1000 * altitude_km), vec3(-0.6 * level, 0.8 * level, mu),
                        vec3(std::sqrt(1 - sun_mu * sun_mu), 0, sun_mu)));
        for (int c = 0; c < air->medium.air.channels; ++c) {
            const double wanted = marched[i][static_cast<std::size_t>(c)];
            EXPECT_NEAR(found[static_cast<glm::length_t>(c)], wanted, 0.002 * wanted + 1e-9)
                << folder << ", ray " << i << ", channel " << c;
        }
    }
}

TEST(PrintedLookups, MarchTheSkyOfPreviews) {
    const BakedFile transmittance("transmittance.exr");
    const BakedFile hillaire("hillaire.exr");
    expect_sky_of_previews("colours", [&](const vec3& camera, const vec3& ray, const vec3& sun) {
        return SKYBAKE_CALL(colours, skybake_sky, transmittance.texture(), hillaire.texture(),
                            camera, ray, sun, 0.001F);
    });
    const BakedFile of_four("transmittance.exr", "four_wavelengths");
    const BakedFile twilight("twilight.exr", "four_wavelengths");
    expect_sky_of_previews(
        "four_wavelengths", [&](const vec3& camera, const vec3& ray, const vec3& sun) {
            return SKYBAKE_CALL(four_wavelengths_four_wavelengths, skybake_sky, of_four.texture(),
                                twilight.texture(), camera, ray, sun, 0.001F);
        });
}

}  // namespace
}  // namespace skybake
