// Multiple scattering, moments and irradiance: tables over the sun's cosine and altitude.
#include "bakers/field/image.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/light/solver/solved_light.h"
#include "tests/lookups/lookup_trial.h"

namespace skybake {
namespace gpu::sun_lookups {
#include "lookups/irradiance.glsl.h"
#include "lookups/moments.glsl.h"
#include "lookups/multiple_scattering.glsl.h"
}  // namespace gpu::sun_lookups

namespace {

using config::MultipleScatteringMapping;
using test::BakedLookup;

constexpr auto kCentres = TexelConvention::end_points_on_texel_centres;

// A recipe's first table, its texture and its sun axis.
struct SunTable {
    explicit SunTable(const std::string& recipe, Certification certification = Certification::quick)
        : baked(test::bake_all(recipe, certification)),
          texture(texture_of(baked.asset())),
          shell(baked.shell()),
          columns(sun_columns(baked.asset().mapping == "twilight"
                                  ? MultipleScatteringMapping::twilight
                                  : MultipleScatteringMapping::hillaire,
                              baked.recipe.parameters.scene, shell)),
          D(static_cast<float>(shell.thickness_km)) {
        for (const float texel : texture.texels) largest = std::max(largest, double{texel});
    }
    bool twilight() const { return columns.mapping == MultipleScatteringMapping::twilight; }
    gpu::vec2 size() const { return {texture.size[0], texture.size[1]}; }
    gpu::vec2 crop() const {
        return {static_cast<float>(columns.first),
                static_cast<float>(columns.last - columns.first)};
    }
    // Looks up table `part` of `parts` that lie below each other.
    std::array<double, 4> in_double(double x, double y, int part = 0, int parts = 1) const {
        const double u = texture_coordinate(kCentres, std::clamp(x, 0.0, 1.0), texture.size[0]);
        const double v =
            texture_coordinate(kCentres, std::clamp(y, 0.0, 1.0), texture.size[1] / parts);
        return filtered(texture, {u, (part + v) / parts, 0.5});
    }
    // A sun of the table's: anywhere, or at the terminator, where the light changes most.
    float sun(test::Dice& dice) const {
        const double lowest = columns.cosine(0);
        const double highest = columns.cosine(1);
        const double mu = dice.one_in(2) ? dice.uniform(lowest, highest)
                                         : (dice.one_in(2) ? -1 : 1) * dice.decades(1e-7, 1);
        return static_cast<float>(std::clamp(mu, lowest, highest));
    }

    BakedLookup baked;
    Texture texture;
    Shell shell;
    SunColumns columns;
    float D;
    double largest = 0;
};

// The loss of the lookup of a table, or of the first of several that lie below each other.
test::Loss loss_of_scattering(const SunTable& table, int parts) {
    Texture texture = table.texture;
    texture.size[1] /= parts;
    texture.texels.resize(texture.texels.size() / static_cast<std::size_t>(parts));
    return test::loss_at_places([&](test::Dice& dice, test::Loss& loss) {
        const float h = dice.altitude_km(table.shell.thickness_km);
        const float mu = table.sun(dice);
        const gpu::vec3 found =
            gpu::sun_lookups::multiple_scattering({texture}, gpu::vec2(gpu::size_of(texture)),
                                                  table.D, h, mu, table.twilight(), table.crop());
        test::add_relative(found,
                           table.in_double(table.columns.coordinate(double{mu}),
                                           double{h} / table.shell.thickness_km, 0, parts),
                           table.largest, loss);
    });
}

TEST(MultipleScatteringLookup, FloatLosesLittle) {
    const std::string whole =
        "preset = 'earth_hillaire'\n[bake.multiple_scattering]\n"
        "method = 'converged'\nsize = [32, 32]\nmapping = ";
    for (const std::string& recipe : {whole + "'hillaire'\n", whole + "'twilight'\n"}) {
        SCOPED_TRACE(recipe);
        const SunTable table(recipe);
        expect_little_loss(loss_of_scattering(table, 1), table.baked.asset().certificate);
    }
}

// sigma_s' share of what six tables scatter towards an eye, by the harmonics of the solver itself.
std::array<double, 4> scattered_in_double(const SunTable& table, double x, double y, double mu,
                                          double c, const std::array<double, 3>& chi) {
    std::array<double, 6> harmonics{};
    zenith_harmonics(2, mu, harmonics.data());
    const std::array<double, 3> azimuth = {1, c, std::cos(2 * std::acos(c))};
    std::array<double, 4> sum{};
    for (int l = 0; l <= 2; ++l) {
        for (int m = 0; m <= l; ++m) {
            const auto lm = static_cast<std::size_t>(moment_index(l, m));
            const std::array<double, 4> moment = table.in_double(x, y, moment_index(l, m), 6);
            const double weight = chi[static_cast<std::size_t>(l)] * harmonics[lm] /
                                  harmonic_norm(l, m) * azimuth[static_cast<std::size_t>(m)];
            for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * moment[k];
        }
    }
    return sum;
}

// Six tables of all orders solved, their sun axis cropped to a scene. A finer solution to certify
// them by would cost seconds: it says 0.31 at most, 0.018 RMS.
struct CroppedMoments : SunTable {
    CroppedMoments()
        : SunTable(
              "preset = 'earth_hillaire'\n[scene]\naltitude = ['0 km', '3 km']\nsun_elevation = "
              "['-10 deg', "
              "'90 deg']\n[bake.a]\nasset = 'multiple_scattering'\nmethod = 'solved'\n"
              "content = 'moments'\nmapping = 'twilight'\ndegree = 2\n",
              Certification::off) {
        certificate.lookup = {0.31, 0.018};
    }
    Certificate certificate;
};

// Relative to the light itself, moment 0, as the sum of all may vanish.
TEST(MomentsLookup, FloatLosesLittle) {
    const CroppedMoments table;
    ASSERT_EQ(table.texture.size[1] % 6, 0);
    ASSERT_GT(table.columns.first, 0);
    // Moment 0 by itself is what content = "hillaire" holds.
    expect_little_loss(loss_of_scattering(table, 6), table.certificate);
    const test::Loss lost = test::loss_at_places([&](test::Dice& dice, test::Loss& loss) {
        const float h = dice.altitude_km(table.shell.thickness_km);
        const float mu_s = table.sun(dice);
        const auto mu = static_cast<float>(dice.uniform(-1, 1));
        const auto c = static_cast<float>(dice.uniform(-1, 1));
        const bool rayleigh = dice.one_in(2);
        const gpu::vec3 chi = rayleigh ? gpu::vec3(1, 0, 0.1f) : gpu::vec3(1, 0.8436f, 0.7097f);
        const gpu::vec2 place = gpu::sun_lookups::moment_place(
            table.size() / gpu::vec2(1, 6), table.D, h, mu_s, table.twilight(), table.crop());
        const gpu::vec3 found =
            gpu::sun_lookups::scattered_again({table.texture}, place, 6, mu, c, chi);
        const double x = table.columns.coordinate(double{mu_s});
        const double y = double{h} / table.shell.thickness_km;
        const std::array<double, 4> wanted = scattered_in_double(
            table, x, y, double{mu}, double{c}, {double{chi.x}, double{chi.y}, double{chi.z}});
        const std::array<double, 4> light = table.in_double(x, y, 0, 6);
        for (int k = 0; k < 3; ++k) {
            const auto channel = static_cast<std::size_t>(k);
            loss.add((double{found[k]} - wanted[channel]) /
                     std::max(light[channel], kErrorFloor * table.largest));
        }
    });
    expect_little_loss(lost, table.certificate);
}

TEST(IrradianceLookup, FloatLosesLittle) {
    for (const char* mapping : {"twilight", "hillaire"}) {
        SCOPED_TRACE(mapping);
        const SunTable table(
            "preset = 'earth_hillaire'\n[bake.irradiance]\ncontent = 'direct'\nmapping = '" +
            std::string(mapping) + "'\n");
        const auto in_float = [&](float h, float mu) {
            return gpu::sun_lookups::irradiance({table.texture}, table.size(), table.D, h, mu,
                                                table.twilight());
        };
        const test::Loss lost = test::loss_at_places([&](test::Dice& dice, test::Loss& loss) {
            const float h = dice.altitude_km(table.shell.thickness_km);
            const float mu = table.sun(dice);
            test::add_relative(in_float(h, mu),
                               table.in_double(table.columns.coordinate(double{mu}),
                                               std::sqrt(double{h} / table.shell.thickness_km)),
                               table.largest, loss);
        });
        expect_little_loss(lost, table.baked.asset().certificate);
    }
}

}  // namespace
}  // namespace skybake
