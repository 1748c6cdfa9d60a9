#include "bakers/assets/optical_depth/column_volume.h"
#include "bakers/field/baked.h"

#include <gtest/gtest.h>

#include <numbers>

#include "bakers/assets/optical_depth/column_kinds.h"
#include "config/assets/optical_depth.h"
#include "tests/optical_depth/columns.h"
#include "tests/support/outcomes.h"

namespace skybake::test {
namespace {

Baked bake(const config::Atmosphere& atmosphere, const config::OpticalDepthBake& bake,
           Certification certification = Certification::quick, int threads = 2) {
    Baked volume;
    volume.name = "table";
    return test::without_errors(bake_columns(
        atmosphere, bake, BakeOptions{.threads = threads, .certification = certification},
        std::move(volume)));
}

// The bars, for each kind alone and all together, at the default sizes.
TEST(ColumnVolume, TablesOfTheEarthHoldTheirBars) {
    const config::Atmosphere atmosphere = earth_with_presets();
    for (const char* last : {"rain", "snow"}) {
        const std::vector<std::string> kinds = {"rayleigh", "dust", "fog", last};
        for (const auto& bake : path_bakes({256, 128, 1}, {64, 64, 64}, kinds)) {
            const bool to_top = bake.table == config::OpticalDepthTable::to_top;
            const double bar = to_top ? 2e-4 : 1e-3;
            const ColumnErrors errors = errors_of(atmosphere, bake, 512);
            SCOPED_TRACE(static_cast<int>(bake.table) * 10 + static_cast<int>(bake.coordinates));
            EXPECT_LE(errors.together.rms, bar);
            for (std::size_t k = 0; k < kinds.size(); ++k) {
                EXPECT_LE(errors.alone[k].rms, bar) << kinds[k];
                EXPECT_GT(errors.alone[k].rms, 0) << kinds[k];
            }
            EXPECT_LE(errors.additivity.rms, bar);
            EXPECT_LE(errors.symmetry.rms, bar);
            if (!to_top && bake.coordinates == config::BetweenCoordinates::altitudes) {
                EXPECT_LE(errors.symmetry.max, 1e-7);
            }
        }
    }
}

TEST(ColumnVolume, CertificatesTellTransmittance) {
    const auto baked =
        bake(earth_with_presets(), bake_of(config::OpticalDepthTable::to_top, {32, 16, 1}));
    EXPECT_TRUE(baked.certified);
    EXPECT_LE(baked.certificate.texel.max, 1e-6);  // float32 of the exact integral
    EXPECT_GT(baked.certificate.lookup.rms, 1e-4);
    EXPECT_LE(baked.certificate.lookup.max, 1);
    EXPECT_EQ(baked.mapping, "columns_to_top");
    EXPECT_EQ(baked.channel_names, (std::vector<std::string>{"R", "G", "B", "A"}));
    std::string names;
    for (const auto& [name, text] : baked.details) names += name + ' ';
    EXPECT_NE(names.find("transmittance_error_fog"), std::string::npos) << names;
    EXPECT_NE(names.find("additivity_error"), std::string::npos) << names;
}

TEST(ColumnVolume, TwoKindsLeaveTheThirdChannelEmpty) {
    const auto baked = bake(earth_with_presets(), bake_of(config::OpticalDepthTable::between,
                                                          {8, 4, 4}, {"fog", "ozone"}));
    EXPECT_EQ(baked.channel_names, (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_EQ(baked.levels[0].statistics[2].max, 0);
    EXPECT_GT(baked.levels[0].statistics[0].max, 0.9);
    EXPECT_EQ(
        bake(earth_with_presets(), bake_of(config::OpticalDepthTable::density, {8, 1, 1}, {"fog"}))
            .channel_names,
        std::vector<std::string>{"Y"});
}

TEST(ColumnVolume, BytesDoNotDependOnThreads) {
    for (const auto& one : path_bakes({32, 16, 1}, {16, 8, 8}, earth_kinds())) {
        const auto atmosphere = earth_with_presets();
        EXPECT_EQ(bake(atmosphere, one, Certification::off, 1).levels[0].content_hash,
                  bake(atmosphere, one, Certification::off, 2).levels[0].content_hash);
    }
}

TEST(ColumnVolume, DensitiesAreTheProfiles) {
    const auto one = bake_of(config::OpticalDepthTable::density, {1024, 1, 1}, {"dust", "ozone"});
    const auto atmosphere = earth_with_presets();
    const auto baked = bake(atmosphere, one);
    EXPECT_LE(baked.certificate.texel.max, 1e-6);
    EXPECT_LE(baked.certificate.lookup.max, 4.5e-3);  // at the kinks of the tent: 4.1e-3
    std::vector<float> dust(1024);
    baked.levels[0].voxels->fill({{0, 0, 0}, {1024, 1, 1}}, {dust.data(), nullptr, nullptr});
    EXPECT_EQ(dust.front(), 1);
    EXPECT_NEAR(dust.back(), std::exp(-50.0), 1e-25);
}

TEST(ColumnVolume, PhaseFunctionsAreOfOneOverSteradian) {
    const auto one = bake_of(config::OpticalDepthTable::phase, {1024, 1, 1}, {"rayleigh", "fog"});
    const auto baked = bake(earth_with_presets(), one);
    EXPECT_LE(baked.certificate.lookup.max, 1e-4);
    std::vector<float> air(1024), fog(1024);
    baked.levels[0].voxels->fill({{0, 0, 0}, {1024, 1, 1}}, {air.data(), fog.data(), nullptr});
    const double quarter = 3 / (16 * std::numbers::pi);
    EXPECT_NEAR(air.front(), 2 * quarter, 1e-7);
    EXPECT_NEAR(air.back(), 2 * quarter, 1e-7);
    // The integral over directions: 2 pi integral of p sin(angle), angle = pi x^2.
    double sum = 0;
    for (int i = 0; i < 1024; ++i) {
        const double x = i / 1023.0;
        sum += fog[static_cast<std::size_t>(i)] * std::sin(std::numbers::pi * x * x) * 4 *
               std::numbers::pi * std::numbers::pi * x / 1023;
    }
    EXPECT_NEAR(sum, 1, 1e-4);
}

// Shells of equal attenuation are where the thin kinds are: they tell fog better than uniform ones,
// and air, which reaches higher, worse.
TEST(ColumnVolume, EqualAttenuationGainsForThinKinds) {
    const auto atmosphere = earth_with_presets();
    auto one = bake_of(config::OpticalDepthTable::to_top, {32, 16, 1});
    one.shells = 16;
    const auto errors = [&](config::DepthSampling sampling) {
        one.sampling = sampling;
        return errors_of(atmosphere, one, 256);
    };
    const ColumnErrors exact = errors(config::DepthSampling::exact);
    const ColumnErrors equal = errors(config::DepthSampling::equal_attenuation);
    const ColumnErrors uniform = errors(config::DepthSampling::uniform);
    EXPECT_LT(exact.together.rms, uniform.together.rms);
    EXPECT_LT(exact.together.rms, equal.together.rms);
    EXPECT_LT(equal.alone[2].rms, uniform.alone[2].rms);
    EXPECT_GT(equal.alone[0].rms, uniform.alone[0].rms);
}

}  // namespace
}  // namespace skybake::test
