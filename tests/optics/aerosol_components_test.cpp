// OPAC's components and mixtures, against its data files and its published totals.
#include "config/optics/aerosol_components.h"
#include "config/fields/section_decoder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skybake::config {
namespace {

using enum AerosolComponent;
using enum AerosolMixture;

constexpr Length nanometers(double nm) { return {nm * 1e-9}; }

// Micrometres cubed per particle: all moments of a log-normal distribution are known.
double mean_volume_um3(AerosolComponent component, double humidity) {
    const LogNormalRadii radii = radii_of(component, humidity);
    const double mode_um = radii.mode_radius.meters * 1e6, width = std::log(radii.deviation);
    return 4 * std::numbers::pi / 3 * std::pow(mode_um, 3) * std::exp(4.5 * width * width);
}

// Hess 1998, table 1c: the mode radius of the volume is exp(3 ln^2 deviation) times that of the
// number. It is published with one or two digits.
TEST(Aerosols, HaveThePublishedSizes) {
    struct Row {
        AerosolComponent component;
        double volume_mode_um;
    };
    for (const Row row : {Row{insoluble, 6.00},
                          {water_soluble, 0.15},
                          {soot, 0.05},
                          {sea_salt_accumulation, 0.94},
                          {sea_salt_coarse, 7.90},
                          {mineral_nucleation, 0.27},
                          {mineral_accumulation, 1.60},
                          {mineral_coarse, 11.00},
                          {mineral_transported, 3.00},
                          {sulfate_droplets, 0.31}}) {
        const LogNormalRadii radii = radii_of(row.component, 0);
        const double width = std::log(radii.deviation);
        const double volume_mode_um = radii.mode_radius.meters * 1e6 * std::exp(3 * width * width);
        EXPECT_NEAR(volume_mode_um / row.volume_mode_um, 1, 0.08) << name_of(row.component);
    }
}

// OPAC 3.1's output for continental polluted air at 80 %: volumes in um^3 per m^3.
TEST(Aerosols, HaveTheVolumesOfContinentalPollutedAir) {
    struct Row {
        AerosolComponent component;
        double number_per_cm3, volume;
    };
    for (const Row row : {Row{water_soluble, 15700, 3.518e7}, {soot, 34300, 2.051e6}})
        EXPECT_NEAR(mean_volume_um3(row.component, 80) * row.number_per_cm3 * 1e6 / row.volume, 1,
                    0.01)
            << name_of(row.component);
}

// The indices of OPAC's files, which show the growth: their imaginary part is the dry one's,
// thinned.
TEST(Aerosols, MixWithWaterAsOpac) {
    struct Row {
        AerosolComponent component;
        double humidity, nm, real, imaginary;
    };
    for (const Row row : {Row{water_soluble, 0, 550, 1.530, 6.000e-3},
                          {water_soluble, 50, 550, 1.437, 3.179e-3},
                          {water_soluble, 80, 550, 1.399, 1.995e-3},
                          {water_soluble, 90, 450, 1.381, 1.130e-3},
                          {water_soluble, 95, 550, 1.363, 9.000e-4},
                          {water_soluble, 95, 650, 1.361, 1.050e-3},
                          {sea_salt_accumulation, 50, 750, 1.369, 3.784e-7},
                          {sea_salt_accumulation, 90, 750, 1.342, 2.247e-7},
                          {sea_salt_accumulation, 95, 750, 1.337, 1.941e-7},
                          {sulfate_droplets, 0, 550, 1.430, 1.000e-8},
                          {sulfate_droplets, 80, 550, 1.353, 3.603e-9},
                          {sulfate_droplets, 80, 400, 1.360, 3.523e-9},
                          {sulfate_droplets, 99, 550, 1.336, 2.179e-9}}) {
        const RefractiveIndex index =
            refractive_index_of(row.component, nanometers(row.nm), row.humidity);
        EXPECT_NEAR(index.real, row.real, 6e-4) << name_of(row.component) << row.humidity;
        EXPECT_NEAR(index.imaginary / row.imaginary, 1, 2e-3)
            << name_of(row.component) << row.humidity;
    }
}

TEST(Aerosols, HaveThePublishedDryIndices) {
    const auto imaginary = [](AerosolComponent component, double nm) {
        return refractive_index_of(component, nanometers(nm), 0).imaginary;
    };
    EXPECT_DOUBLE_EQ(imaginary(soot, 550), 0.44);
    EXPECT_DOUBLE_EQ(imaginary(insoluble, 425), 8e-3);
    EXPECT_DOUBLE_EQ(imaginary(mineral_coarse, 550), 5.5e-3);
    EXPECT_NEAR(imaginary(mineral_transported, 425), (1.3e-2 + 8.5e-3) / 2, 1e-12);
    EXPECT_DOUBLE_EQ(imaginary(mineral_nucleation, 400), imaginary(mineral_accumulation, 400));
    EXPECT_EQ(water_index(nanometers(550)), (RefractiveIndex{1.333, 1.96e-9}));
}

TEST(Aerosols, SwellWithHumidityOrDoNot) {
    for (const AerosolComponent component : all_aerosol_components()) {
        const bool swells = component == water_soluble || component == sea_salt_accumulation ||
                            component == sea_salt_coarse || component == sulfate_droplets;
        for (double humidity = 1; humidity <= 99; ++humidity) {
            const double before = radii_of(component, humidity - 1).mode_radius.meters;
            const double after = radii_of(component, humidity).mode_radius.meters;
            EXPECT_EQ(after > before, swells) << name_of(component) << humidity;
            EXPECT_GE(after, before);
            EXPECT_GE(water_share(component, humidity), 0);
            EXPECT_LT(water_share(component, humidity), 1);
        }
        EXPECT_EQ(water_share(component, 0), 0);
        const LogNormalRadii radii = radii_of(component, 80);
        EXPECT_LT(radii.smallest.meters, radii.mode_radius.meters);
        EXPECT_GT(radii.largest.meters, radii.mode_radius.meters);
        EXPECT_GT(radii.deviation, 1);
    }
}

TEST(Aerosols, AreKnownOverTheVisible) {
    EXPECT_EQ(all_aerosol_components().size(), 10u);
    for (const AerosolComponent component : all_aerosol_components()) {
        EXPECT_TRUE(range_of(component).contains(nanometers(350)));
        EXPECT_TRUE(range_of(component).contains(nanometers(800)));
        for (double nm = 350; nm <= 800; nm += 5) {
            const RefractiveIndex index = refractive_index_of(component, nanometers(nm), 70);
            EXPECT_GT(index.real, 1.3);
            EXPECT_LT(index.real, 1.8);
            EXPECT_GT(index.imaginary, 0);
            EXPECT_LT(index.imaginary, 0.5);
        }
    }
}

// Hess 1998, table 4: particles per cm^3 of each mixture.
TEST(Mixtures, HaveThePublishedNumbers) {
    struct Row {
        AerosolMixture mixture;
        double total_per_cm3;
    };
    for (const Row row : {Row{continental_clean, 2600},
                          {continental_average, 15300},
                          {continental_polluted, 50000},
                          {urban, 158000},
                          {desert, 2300},
                          {maritime_clean, 1520},
                          {maritime_polluted, 9000},
                          {maritime_tropical, 600},
                          {arctic, 6600},
                          {antarctic, 43}}) {
        double total = 0;
        for (const MixturePart& part : parts_of(row.mixture))
            total += part.particles.per_cubic_meter;
        EXPECT_NEAR(total / (row.total_per_cm3 * 1e6), 1, 0.0015) << row.total_per_cm3;
    }
}

}  // namespace
}  // namespace skybake::config
