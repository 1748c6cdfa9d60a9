// Conventions and constants of manifests are those of each asset: places of probes are turned into
// texture coordinates by the manifest's numbers alone, as a runtime does it.
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

#include "bakers/assets/registry/registry.h"
#include "tests/probes/baked_recipe.h"

namespace skybake {
namespace conventions_test {
namespace {

using namespace skybake::testing;

FactValue constant(const AxisMapping& axis, const std::string& name) {
    for (const auto& [key, value] : axis.constants) {
        if (key == name) return value;
    }
    throw std::out_of_range(axis.quantity + " " + name);
}
double number(const AxisMapping& axis, const std::string& name) {
    return std::get<double>(constant(axis, name));
}
std::vector<double> list(const AxisMapping& axis, const std::string& name) {
    return std::get<std::vector<double>>(constant(axis, name));
}
// The texture coordinate of x along one of `count` texels.
double coordinate(const AxisMapping& axis, double x, int count) {
    return axis.end_points == TexelConvention::end_points_on_edges
               ? x
               : (0.5 + x * (count - 1)) / count;
}

const ManifestAsset& asset(const std::string& name) { return every_asset().asset(name); }

template <class CoordinatesOf>
void expect_probes(const std::string& name, const CoordinatesOf& coordinates_of) {
    const ManifestAsset& entry = asset(name);
    ASSERT_GE(entry.levels[0].probes.size(), 16U) << name;
    for (const Probe& probe : entry.levels[0].probes) {
        const std::array<double, 2> uv = coordinates_of(entry, probe);
        EXPECT_NEAR(uv[0], probe.uvw[0], 2e-6) << name;
        EXPECT_NEAR(uv[1], probe.uvw[1], 2e-6) << name;
    }
}

std::array<double, 2> transmittance_place(double ground, double top, double altitude, double mu) {
    const double r = ground + altitude;
    const double rho = std::sqrt(std::max(r * r - ground * ground, 0.0));
    const double h = std::sqrt(top * top - ground * ground);
    const double d = std::sqrt(std::max(top * top - r * r * (1 - mu * mu), 0.0)) - r * mu;
    const double d_min = top - r;
    return {(d - d_min) / (rho + h - d_min), rho / h};
}

TEST(EveryAsset, TransmittanceByItsConstants) {
    for (const char* name : {"transmittance", "ue"}) {
        expect_probes(name, [](const ManifestAsset& entry, const Probe& probe) {
            const AxisMapping& u = entry.axes[0];
            const AxisMapping& v = entry.axes[1];
            const auto x =
                transmittance_place(number(u, "ground_radius_km"), number(v, "top_radius_km"),
                                    at(probe, "altitude_km"), at(probe, "cos_zenith"));
            return std::array{coordinate(u, x[0], entry.size[0]),
                              coordinate(v, x[1], entry.size[1])};
        });
    }
}

double sun_place(const ManifestAsset& entry, double mu) {
    const AxisMapping& u = entry.axes[0];
    const double root = mu < 0 ? -std::sqrt(-mu) : std::sqrt(mu);
    const double whole = entry.mapping == "twilight" ? (1 + root) / 2 : (1 + mu) / 2;
    return coordinate(u, (whole - number(u, "first")) / number(u, "share"), entry.size[0]);
}

TEST(EveryAsset, FlipbookByItsConstants) {
    expect_probes("book", [](const ManifestAsset& entry, const Probe& probe) {
        const AxisMapping& w = entry.axes[2];
        EXPECT_EQ(number(w, "frames"), 3);
        const double layer = at(probe, "frame") / number(w, "frames") + number(w, "offset");
        EXPECT_NEAR(layer, probe.uvw[2] - std::floor(probe.uvw[2]), 2e-6);
        return std::array{at(probe, "u"), at(probe, "v")};
    });
}

TEST(EveryAsset, ForwardScatteringByItsConstants) {
    expect_probes("forward", [](const ManifestAsset& entry, const Probe& probe) {
        const double half = at(probe, "scattering_angle_deg") * std::numbers::pi / 360;
        const double depth = at(probe, "optical_depth");
        const double middle = number(entry.axes[1], "middle_depth");
        const double deepest = number(entry.axes[1], "deepest");
        const double y = depth / (depth + middle) * (1 + middle / deepest);
        return std::array{coordinate(entry.axes[0], std::sqrt(std::sin(half)), entry.size[0]),
                          coordinate(entry.axes[1], y, entry.size[1])};
    });
}

TEST(EveryAsset, MultipleScatteringByItsConstants) {
    EXPECT_LT(number(asset("solved").axes[0], "share"), 1);  // cropped by the scene
    for (const char* name : {"closure", "solved"}) {
        expect_probes(name, [](const ManifestAsset& entry, const Probe& probe) {
            const AxisMapping& v = entry.axes[1];
            const double y = at(probe, "altitude_km") / number(v, "thickness_km");
            return std::array{sun_place(entry, at(probe, "sun_cos_zenith")),
                              coordinate(v, y, entry.size[1])};
        });
    }
    expect_probes("moments", [](const ManifestAsset& entry, const Probe& probe) {
        const AxisMapping& v = entry.axes[1];
        const double tables = number(v, "tables");
        EXPECT_EQ(number(v, "degree"), 2);
        const double l = at(probe, "l");
        const double y = at(probe, "altitude_km") / number(v, "thickness_km");
        const int rows = entry.size[1] / static_cast<int>(tables);
        return std::array{sun_place(entry, at(probe, "sun_cos_zenith")),
                          (l * (l + 1) / 2 + at(probe, "m") + coordinate(v, y, rows)) / tables};
    });
}

TEST(EveryAsset, SkyViewByItsConstants) {
    expect_probes("sky", [](const ManifestAsset& entry, const Probe& probe) {
        const AxisMapping& v = entry.axes[1];
        const std::vector<double> suns = list(v, "sun_elevations_deg");
        EXPECT_EQ(suns, (std::vector<double>{30, 3, -4}));
        EXPECT_EQ(number(v, "camera_altitude_km"), 1.5);
        const double dip =
            std::acos(number(v, "ground_radius_km") / (number(v, "ground_radius_km") + 1.5));
        EXPECT_NEAR(number(v, "dip_deg"), dip * 180 / std::numbers::pi, 1e-6);
        double sun = 0;
        while (std::fabs(suns[static_cast<std::size_t>(sun)] - at(probe, "sun_elevation_deg")) >
               1e-6) {
            ++sun;
        }
        const double tables = number(v, "tables");
        const int rows = entry.size[1] / static_cast<int>(tables);
        const double angle = at(probe, "above_horizon_deg");
        double y = angle < 0 ? 0.5 - 0.5 * std::sqrt(-angle / number(v, "range_below_deg"))
                             : 0.5 + 0.5 * std::sqrt(angle / number(v, "range_above_deg"));
        // Sky and ground do not mix: each keeps to its own rows (sky_view_mapping.h).
        const double own = rows % 2 == 0 ? 0.5 * rows / (rows - 1.0) : 0.5;
        y = angle < 0 ? std::min(y, 1 - own) : std::max(y, own);
        return std::array{
            coordinate(entry.axes[0], at(probe, "azimuth_deg") / number(entry.axes[0], "range_deg"),
                       entry.size[0]),
            (sun + coordinate(v, y, rows)) / tables};
    });
}

TEST(EveryAsset, IrradianceAndPhaseByTheirConstants) {
    for (const char* name : {"irradiance", "hillaire_irradiance"}) {
        expect_probes(name, [](const ManifestAsset& entry, const Probe& probe) {
            const AxisMapping& v = entry.axes[1];
            const double y = std::sqrt(at(probe, "altitude_km") / number(v, "thickness_km"));
            return std::array{sun_place(entry, at(probe, "sun_cos_zenith")),
                              coordinate(v, y, entry.size[1])};
        });
    }
    for (const char* name : {"angle", "peaks"}) {
        expect_probes(name, [](const ManifestAsset& entry, const Probe& probe) {
            const double theta = at(probe, "scattering_angle_deg") / 180;
            const double half = theta * std::numbers::pi / 2;
            const double scale = std::pow(2, -0.75);
            double x = theta;
            if (entry.mapping == "peaks") {
                x = theta <= 0.5 ? scale * std::sqrt(std::sin(half))
                                 : 1 - scale * std::sqrt(std::max(std::cos(half), 0.0));
            }
            return std::array{coordinate(entry.axes[0], x, entry.size[0]), 0.5};
        });
    }
}

TEST(EveryAsset, VolumesHaveTheRecipesNumbers) {
    const ManifestAsset& cloud = asset("cloud");
    const ManifestAsset& cells = asset("cells");
    const std::array<double, 3> extent = {6000, 5000, 1500};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(number(cloud.axes[i], "first_m"), i == 2 ? 1200 : 0);
        EXPECT_EQ(number(cloud.axes[i], "extent_m"), extent[i]);
        EXPECT_EQ(number(cells.axes[i], "cell_voxels"), 2);
        EXPECT_EQ(number(cells.axes[i], "cell_m"), 2 * extent[i] / cloud.size[i]);
        EXPECT_EQ(number(cells.axes[i], "first_m"), i == 2 ? 1200 : 0);
        EXPECT_EQ(number(cells.axes[i], "extent_m"),
                  number(cells.axes[i], "cell_m") * cells.size[i]);
        EXPECT_EQ(cells.axes[i].filter, AxisFilter::nearest);
        EXPECT_EQ(cloud.axes[i].filter, AxisFilter::linear);
        EXPECT_EQ(number(asset("noise").axes[i], "offset"), i == 2 ? 0.5 / 8 : 0);
    }
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(number(asset("map").axes[i], "offset"), i == 0 ? 0.5 / 16 : 0.5 / 12);
    }
    const ManifestAsset& mask = asset("mask");
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(number(mask.axes[i], "period"), mask.size[i]);
        EXPECT_EQ(mask.axes[i].filter, AxisFilter::nearest);
    }
    EXPECT_EQ(fact_named(cells.details, "leap_scale"), "1");  // half holds cells as they are
    const ManifestAsset& distance = asset("distance");
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(number(distance.axes[i], "texel_voxels"), 2);
        EXPECT_EQ(number(distance.axes[i], "texel_m"), 2 * extent[i] / cloud.size[i]);
        EXPECT_EQ(distance.axes[i].filter, AxisFilter::linear);
    }
    EXPECT_EQ(fact_named(distance.details, "metres_at_1"), "1");  // half holds metres
    const std::vector<AxisMapping>& aerial = asset("aerial").axes;
    EXPECT_EQ(number(aerial[0], "heading_deg"), 30);
    EXPECT_EQ(number(aerial[1], "pitch_deg"), 5);
    EXPECT_EQ(number(aerial[0], "fov_deg"), 50);
    EXPECT_EQ(number(aerial[1], "fov_deg"), 50);
    EXPECT_EQ(number(aerial[0], "aspect"), 1.5);
    EXPECT_EQ(number(aerial[2], "view_distance_km"), 32);
    EXPECT_EQ(number(aerial[2], "exponent"), 2);
}

TEST(EveryAsset, BrunetonsTablesByTheirConstants) {
    for (const char* name : {"b_scattering", "t_scattering"}) {
        const ManifestAsset& entry = asset(name);
        const AxisMapping& u = entry.axes[0];
        const double ground = number(u, "ground_radius_km");
        const double top = number(u, "top_radius_km");
        const auto distance = [&](double mu) {
            return std::sqrt(top * top - ground * ground * (1 - mu * mu)) - ground * mu;
        };
        const double share =
            (distance(number(u, "sun_cos_zenith_min")) - distance(1)) / (distance(0) - distance(1));
        EXPECT_NEAR(number(u, "largest_share"), share, 1e-9 * share) << name;
        EXPECT_EQ(number(u, "nu_size") * number(u, "sun_size"), entry.size[0]) << name;
    }
    EXPECT_EQ(number(asset("t_scattering").axes[0], "sun_cos_zenith_min"), -0.5);
    EXPECT_GT(number(asset("b_transmittance").axes[1], "thickness_km"), 0);
}

TEST(EveryAsset, ColumnsByTheirConstants) {
    for (const char* name : {"to_top", "along"}) {
        const ManifestAsset& entry = asset(name);
        const std::vector<double> first = list(entry.axes[0], "first");
        const std::vector<double> count = list(entry.axes[0], "count");
        ASSERT_EQ(first.size(), count.size());
        EXPECT_EQ(count.size(), entry.name == "along" ? 3U : 2U);
        double next = 0;
        for (std::size_t i = 0; i < first.size(); ++i) {
            EXPECT_EQ(first[i], next);
            next += count[i];
        }
        EXPECT_EQ(next, entry.size[0]);
        EXPECT_EQ(fact_named(entry.details, "mean_density_exponent"), "8");
        const std::string fine = fact_text(to_digits(number(entry.axes[1], "fine_km"), 9));
        EXPECT_NE(entry.axes[1].formula.find("h / " + fine), std::string::npos)
            << entry.axes[1].formula;
    }
    EXPECT_EQ(number(asset("density").axes[0], "fine_km"),
              number(asset("to_top").axes[1], "fine_km"));
    EXPECT_EQ(number(asset("phases").axes[0], "range_deg"), 180);
}

TEST(EveryAsset, AreThoseOfTheAsset) {
    const std::vector<double> wavelengths = {680, 550, 440};
    const std::vector<double> one = {1, 1, 1};
    const std::vector<double> takram = {1.474, 1.8504, 1.91198};
    const std::vector<double> none;
    struct Wanted {
        std::vector<std::string> names;
        std::string length, angle, radiance;
        std::vector<double> irradiance, wavelengths;
        std::string up;
    };
    const std::vector<Wanted> all = {
        {{"transmittance", "ue", "optical_depth", "b_transmittance"},
         "km",
         "cosine",
         "",
         none,
         wavelengths,
         ""},
        {{"closure", "closure_hillaire", "solved", "twilight", "moments", "b_scattering",
          "b_single_mie"},
         "km",
         "cosine",
         "1/sr",
         one,
         wavelengths,
         ""},
        {{"sky", "sky_of_space", "environment"}, "km", "deg", "1/sr", one, wavelengths, ""},
        {{"aerial"}, "km", "deg", "1/sr", one, wavelengths, "-y"},
        {{"irradiance", "sky_irradiance", "hillaire_irradiance", "b_irradiance"},
         "km",
         "cosine",
         "",
         one,
         wavelengths,
         ""},
        {{"phase", "angle", "peaks"}, "", "deg", "", none, wavelengths, ""},
        {{"shares"}, "", "", "", none, wavelengths, ""},
        {{"t_scattering"}, "km", "cosine", "solar_irradiance/sr", takram, wavelengths, ""},
        {{"t_irradiance"}, "km", "cosine", "", takram, wavelengths, ""},
        {{"to_top", "along", "density"}, "km", "", "", none, wavelengths, ""},
        {{"phases"}, "km", "deg", "", none, wavelengths, ""},
        {{"shape", "noise", "corners"}, "", "", "", none, none, "+z"},
        {{"map", "wave_0001", "wave_0002", "wave_0003", "book", "mask"},
         "",
         "",
         "",
         none,
         none,
         ""},
        {{"forward"}, "", "deg", "", none, none, ""},
        {{"cloud", "congestus", "stratus", "cells", "congestus_cells", "stratus_cells", "light",
          "distance"},
         "m",
         "",
         "",
         none,
         none,
         "+z"},
        {{"radiance", "clear_sky"}, "m", "", "1/sr", none, none, "+z"},
    };
    std::size_t told = 0;
    for (const Wanted& wanted : all) {
        for (const std::string& name : wanted.names) {
            const Conventions& found = asset(name).conventions;
            EXPECT_EQ(found.length_unit, wanted.length) << name;
            EXPECT_EQ(found.coefficient_unit, wanted.length.empty() ? "" : "1/" + wanted.length)
                << name;
            EXPECT_EQ(found.angle_unit, wanted.angle) << name;
            EXPECT_EQ(found.radiance_unit, wanted.radiance) << name;
            EXPECT_EQ(found.solar_irradiance, wanted.irradiance) << name;
            EXPECT_EQ(found.wavelengths_nm, wanted.wavelengths) << name;
            EXPECT_EQ(found.up_axis, wanted.up) << name;
            ++told;
        }
    }
    EXPECT_EQ(told, every_asset().manifest.assets.size());
    // Every kind of asset is among them.
    std::set<std::string> kinds;
    for (const config::Bake& bake : recipe_of(test::recipe_text("every_asset")).parameters.bakes) {
        kinds.insert(std::string(baker_of(bake).asset));
    }
    EXPECT_EQ(kinds.size(), bakers().size());
}

TEST(EveryAsset, AxesWrapAsLookupsAreMade) {
    for (const ManifestAsset& entry : every_asset().manifest.assets) {
        const bool is_tile = entry.mapping == "tile" || entry.mapping == "pixels" ||
                             entry.mapping == "frames";  // of a loop
        const bool is_layer = entry.mapping == "layer";
        const bool is_around = entry.mapping == "longitude_latitude";
        const std::array<bool, 3> repeats = {is_tile || is_layer || is_around, is_tile || is_layer,
                                             is_tile};
        for (std::size_t i = 0; i < entry.axes.size(); ++i) {
            EXPECT_EQ(entry.axes[i].wrap == AxisWrap::repeat, repeats[i]) << entry.name << i;
            const bool says_edges =
                entry.axes[i].convention.find("texel centres") == std::string::npos;
            EXPECT_EQ(entry.axes[i].end_points == TexelConvention::end_points_on_edges, says_edges)
                << entry.name << i;
        }
    }
}

// "Numbers in `details` are numbers": no text of a detail begins as a number does.
TEST(EveryAsset, DetailsKeepNumbersAsNumbers) {
    for (const ManifestAsset& entry : every_asset().manifest.assets) {
        for (const auto& [name, value] : entry.details) {
            const auto* text = std::get_if<std::string>(&value);
            if (text == nullptr || text->empty()) continue;
            EXPECT_EQ(text->find_first_of("0123456789"), std::string::npos)
                << entry.name << " " << name << " " << *text;
        }
    }
}

}  // namespace
}  // namespace conventions_test
}  // namespace skybake
