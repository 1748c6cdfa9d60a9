// Published lookups on trial: run in float at many places, held to the bakers' own mapping in
// double over the same texels.
//
// A lookup may lose to float a tenth of what the table is wrong anyway: its maximum and its
// RMS over all places, each at most a tenth of the lookup error that the manifest says, on the
// scale that the manifest says. At probes a lookup has to hold the probe's tolerance, as in a
// runtime.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/air/ray.h"
#include "bakers/assets/optical_depth/column_table.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/field/baked.h"
#include "bakers/math/relative_error.h"
#include "tests/lookups/gpu.h"
#include "tests/support/atmospheres.h"
#include "tests/support/outcomes.h"
#include "tests/support/probe_place.h"

namespace skybake::test {

constexpr int kPlaces = 100000;

// Differences between the lookup in float and the one in double.
class Loss {
  public:
    void add(double difference) {
        // Not-a-number becomes the largest, too.
        if (!(std::fabs(difference) <= max_)) max_ = std::fabs(difference);
        sum_ += difference * difference;
        ++count_;
    }
    double max() const { return max_; }
    double rms() const { return std::sqrt(sum_ / static_cast<double>(count_)); }
    bool is_a_tenth_of(const ErrorFigures& own) const {
        return count_ > 0 && max() <= 0.1 * own.max && rms() <= 0.1 * own.rms;
    }
    std::string text(const ErrorFigures& own) const {
        char row[160];
        std::snprintf(row, sizeof row,
                      "lost to float: max %.2g, rms %.2g; the table's own: %.2g, %.2g", max(),
                      rms(), own.max, own.rms);
        return row;
    }

  private:
    double max_ = 0;
    double sum_ = 0;
    long count_ = 0;
};

// Adds the relative errors of the first three channels, those of small values against `largest`.
template <class Found>
void add_relative(const Found& found, const std::array<double, 4>& wanted, double largest,
                  Loss& loss) {
    for (int c = 0; c < 3; ++c) {
        loss.add(relative_error(double{found[c]}, wanted[static_cast<std::size_t>(c)], largest));
    }
}

// Adds the errors of all channels as shares of their ranges.
inline void add_shares(const gpu::vec4& found, const std::array<double, 4>& wanted,
                       const Baked& asset, Loss& loss) {
    const std::vector<ValueStatistics>& ranges = asset.levels.front().statistics;
    for (std::size_t c = 0; c < ranges.size(); ++c) {
        const auto channel = static_cast<gpu::vec4::length_type>(c);
        loss.add((double{found[channel]} - wanted[c]) / (ranges[c].max - ranges[c].min));
    }
}

inline void expect_little_loss(const Loss& loss, const Certificate& certificate) {
    EXPECT_TRUE(loss.is_a_tenth_of(certificate.lookup)) << loss.text(certificate.lookup);
    ::testing::Test::RecordProperty("loss", loss.text(certificate.lookup));
}

// The same numbers on every run and machine.
class Dice {
  public:
    // In [0, 1).
    double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
    double uniform(double from, double to) { return from + (to - from) * uniform(); }
    // Returns a number even in decades: as many from 1e-3 to 1e-2 as from 1e-2 to 1e-1.
    double decades(double from, double to) { return from * std::pow(to / from, uniform()); }
    bool one_in(int count) { return uniform() * count < 1; }

    // An altitude of the air: anywhere, near the ground to a millimetre, on the ground and at the
    // top.
    float altitude_km(double thickness_km) {
        if (one_in(50)) return 0;
        if (one_in(50)) return static_cast<float>(thickness_km);
        const double h = one_in(2) ? uniform(0, thickness_km) : decades(1e-6, thickness_km);
        return static_cast<float>(std::min(h, thickness_km));
    }

    // An angle between two others: anywhere, or next to the first.
    double angle(double near, double far) {
        const double range = far - near;
        return near + range * (one_in(2) ? uniform() : decades(1e-7, 1));
    }

    glm::dvec3 direction() {
        const double z = uniform(-1, 1);
        const double azimuth = uniform(0, 6.283185307179586);
        const double level = std::sqrt(1 - z * z);
        return {level * std::cos(azimuth), level * std::sin(azimuth), z};
    }

  private:
    std::mt19937_64 engine_{20240611};
};

// A direction and the sun in a frame of their own, as any engine has one.
struct EngineView {
    gpu::vec3 dir, up, sun;
};

// The azimuth is that from the sun, to the right of somebody who looks at it.
inline EngineView engine_view(double elevation, double azimuth, double sun_elevation,
                              const glm::dvec3& up) {
    const glm::dvec3 side = std::fabs(up.z) < 0.9 ? glm::dvec3{0, 0, 1} : glm::dvec3{1, 0, 0};
    const glm::dvec3 ahead = glm::normalize(glm::cross(up, side));
    const glm::dvec3 level = std::cos(azimuth) * ahead + std::sin(azimuth) * glm::cross(ahead, up);
    const auto raised = [&](const glm::dvec3& from, double angle) {
        return gpu::vec3(std::cos(angle) * from + std::sin(angle) * up);
    };
    return {raised(level, elevation), gpu::vec3(up), raised(ahead, sun_elevation)};
}

// Returns the loss that `add(dice, loss)` adds at kPlaces places, which the dice choose.
template <class Add>
Loss loss_at_places(const Add& add) {
    Dice dice;
    Loss loss;
    for (int i = 0; i < kPlaces; ++i) add(dice, loss);
    return loss;
}

// The cosine of the horizon's zenith angle at an altitude, and the angle itself.
inline double horizon_angle(const Shell& shell, double altitude_km) {
    const double dip = std::atan2(horizon_distance_km(shell, altitude_km), shell.ground_radius_km);
    return 0.5 * std::numbers::pi + dip;
}

// The first asset of a recipe, and what else the lookup must know.
struct BakedLookup {
    config::Recipe recipe;
    std::vector<Baked> assets;

    const Baked& asset(std::size_t i = 0) const { return assets.at(i); }
    Shell shell() const { return shell_of(make_medium(recipe.parameters.atmosphere)); }
};

inline BakedLookup bake_all(const std::string& text,
                            Certification certification = Certification::quick) {
    BakedLookup baked{recipe_of(text), {}};
    for (const config::Bake& bake : baked.recipe.parameters.bakes) {
        baked.assets.push_back(test::without_errors(
            bake_asset(baked.recipe, bake, {.threads = 1, .certification = certification})));
    }
    return baked;
}

inline void expect_probe(const gpu::vec4& found, const std::vector<double>& value,
                         const std::vector<double>& tolerance, const std::string& where) {
    for (std::size_t c = 0; c < value.size(); ++c) {
        const auto channel = static_cast<gpu::vec4::length_type>(c);
        EXPECT_LE(std::fabs(double{found[channel]} - value[c]), tolerance[c])
            << where << ", channel " << c << ": " << value[c];
    }
}

// A lookup that finds the column of a path is one of a texel within the probe's tolerance. Both
// ends of it are rounded to float, as the columns of some kinds are below all of its numbers.
struct ColumnRange {
    std::vector<double> low, high;
};
inline ColumnRange column_range(double length_km, const Probe& probe) {
    const auto column_of = [length_km](double stored) {
        return static_cast<float>(mean_density_of_stored(std::max(stored, 0.0)) * length_km);
    };
    ColumnRange range;
    for (std::size_t k = 0; k < probe.value.size(); ++k) {
        range.low.push_back(column_of(probe.value[k] - probe.tolerance[k]));
        range.high.push_back(column_of(probe.value[k] + probe.tolerance[k]));
    }
    return range;
}
inline void expect_column(const gpu::vec4& column, double length_km, const Probe& probe) {
    const ColumnRange range = column_range(length_km, probe);
    ASSERT_EQ(probe.column_km.size(), probe.value.size());
    for (std::size_t k = 0; k < probe.value.size(); ++k) {
        const float found = column[static_cast<gpu::vec4::length_type>(k)];
        const std::string where = ::testing::PrintToString(probe.at) + ", channel ";
        EXPECT_GE(found, range.low[k]) << where << k;
        EXPECT_LE(found, range.high[k]) << where << k;
        EXPECT_NEAR(double{found}, probe.column_km[k], 2e-3 * probe.column_km[k] + 1e-9)
            << where << k;
    }
}

// How far apart two points are that a probe names by their altitudes and the angle between them.
inline double length_between_km(const Shell& shell, const Probe& probe) {
    const double R = shell.ground_radius_km;
    const double low = at(probe, "low_altitude_km");
    const double high = at(probe, "high_altitude_km");
    const double angle = at(probe, "angle_at_centre_deg") / 180 * std::numbers::pi;
    return std::hypot(high - low, 2 * std::sqrt((R + low) * (R + high)) * std::sin(0.5 * angle));
}

}  // namespace skybake::test
