#include "bakers/assets/phase/phase_fit.h"
#include "bakers/field/image.h"
#include "config/assets/phase.h"
#include "tests/lookups/lookup_trial.h"

namespace skybake {
namespace gpu::phase_lookups {
#include "lookups/phase.glsl.h"
}  // namespace gpu::phase_lookups
// Lookups by 1 - cos and 1 + cos of a cosine, which the manifest once said.
namespace gpu::phase_by_cosines {
inline float phase_by_peaks(vec3 a, vec3 b) {
    const float cosine = dot(a, b);
    return cosine >= 0 ? 0.5f * sqrt(sqrt(1.0f - cosine)) : 1.0f - 0.5f * sqrt(sqrt(1.0f + cosine));
}
}  // namespace gpu::phase_by_cosines

namespace {

using config::PhaseSpacing;
using gpu::vec3;

constexpr auto kEndsOnCentres = TexelConvention::end_points_on_texel_centres;
constexpr double kPi = std::numbers::pi;

std::array<double, 4> in_double(const Texture& texture, double x) {
    return filtered(texture, {texture_coordinate(kEndsOnCentres, x, texture.size[0]), 0.5, 0.5});
}

// Two unit vectors, as floats, about this angle apart.
struct Pair {
    vec3 a, b;

    ScatteringAngle angle() const {
        const glm::dvec3 from = glm::normalize(glm::dvec3(a));
        const glm::dvec3 to = glm::normalize(glm::dvec3(b));
        return {0.5 * glm::dot(to - from, to - from), 0.5 * glm::dot(to + from, to + from)};
    }
};

Pair pair_of(double angle, const glm::dvec3& a) {
    const glm::dvec3 other = std::fabs(a.x) < 0.9 ? glm::dvec3{1, 0, 0} : glm::dvec3{0, 1, 0};
    const glm::dvec3 aside = glm::normalize(glm::cross(a, other));
    return {vec3(a), vec3(std::cos(angle) * a + std::sin(angle) * aside)};
}

struct Spacing {
    PhaseSpacing spacing;
    std::string name;
    float (*coordinate)(gpu::vec2 half_angle);
};
const std::array<Spacing, 4> kSpacings = {
    {{PhaseSpacing::angle, "angle", gpu::phase_lookups::phase_by_angle},
     {PhaseSpacing::cosine, "cosine", gpu::phase_lookups::phase_by_cosine},
     {PhaseSpacing::peaks, "peaks", gpu::phase_lookups::phase_by_peaks},
     {PhaseSpacing::cosine_from_back, "cosine_from_back",
      gpu::phase_lookups::phase_by_cosine_from_back}}};

struct PhaseTrial {
    explicit PhaseTrial(const Spacing& which)
        : of(which),
          baked(test::bake_all(
              "preset = 'earth_hillaire'\n[particles.fog]\npreset = 'fog'\n[bake.a]\n"
              "asset = 'phase'\nparticles = 'fog'\nspacing = '" +
              of.name + "'\n")),
          texture(texture_of(baked.asset())) {}

    vec3 in_float(const Pair& pair) const {
        const float x = of.coordinate(gpu::phase_lookups::half_angle(pair.a, pair.b));
        return gpu::phase_lookups::phase_function({texture}, gpu::size_of(texture).x, x);
    }
    template <class Lookup>
    test::Loss loss(const Lookup& lookup) const {
        return test::loss_at_places([&](test::Dice& dice, test::Loss& loss) {
            const double angle = dice.one_in(2) ? dice.angle(0, kPi) : dice.angle(kPi, 0);
            const Pair pair = pair_of(angle, dice.direction());
            const vec3 found = lookup(pair);
            const std::array<double, 4> wanted =
                in_double(texture, phase_coordinate(of.spacing, pair.angle()));
            for (int c = 0; c < 3; ++c) {
                loss.add(double{found[c]} / wanted[static_cast<std::size_t>(c)] - 1);
            }
        });
    }

    const Spacing& of;
    test::BakedLookup baked;
    Texture texture;
};

TEST(PhaseLookup, FloatLosesLittle) {
    for (const Spacing& spacing : kSpacings) {
        const PhaseTrial trial(spacing);
        SCOPED_TRACE(spacing.name);
        EXPECT_EQ(trial.baked.asset().mapping, spacing.name);
        expect_little_loss(trial.loss([&](const Pair& pair) { return trial.in_float(pair); }),
                           trial.baked.asset().certificate);
    }
}

TEST(PhaseLookup, CosinesWouldBeNoticed) {
    const PhaseTrial trial(kSpacings[2]);  // peaks
    const test::Loss loss = trial.loss([&](const Pair& pair) {
        return gpu::phase_lookups::phase_function(
            {trial.texture}, gpu::size_of(trial.texture).x,
            gpu::phase_by_cosines::phase_by_peaks(pair.a, pair.b));
    });
    const ErrorFigures& own = trial.baked.asset().certificate.lookup;
    EXPECT_FALSE(loss.is_a_tenth_of(own)) << loss.text(own);
}

TEST(SampledAngleLookup, FloatLosesLittle) {
    const test::BakedLookup baked = test::bake_all(
        "preset = 'earth_hillaire'\n[particles.haze]\npreset = 'haze'\n[bake.a]\nasset = 'phase'\n"
        "particles = 'haze'\ncontent = 'inverse_cumulative'\n");
    const Texture texture = texture_of(baked.asset());
    test::Dice dice;
    test::Loss loss;
    const auto half_turns = [](double one_minus) {
        return radians({one_minus, 2 - one_minus}) / kPi;
    };
    for (int i = 0; i < test::kPlaces; ++i) {
        const auto share = static_cast<float>(dice.uniform());
        const vec3 found =
            gpu::phase_lookups::sampled_angle({texture}, gpu::size_of(texture).x, share);
        const std::array<double, 4> wanted = in_double(texture, double{share});
        for (int c = 0; c < 3; ++c) {
            loss.add(half_turns(double{found[c]}) -
                     half_turns(wanted[static_cast<std::size_t>(c)]));
        }
    }
    expect_little_loss(loss, baked.asset().certificate);
}

}  // namespace
}  // namespace skybake
