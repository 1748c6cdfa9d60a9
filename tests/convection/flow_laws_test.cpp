// Laws of the whole flow.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "bakers/convection/convection.h"
#include "bakers/convection/flow.h"
#include "tests/convection/fields.h"

namespace skybake::convection {
namespace {

using test::each_cell;
using test::largest_divergence;
using test::rows_of;
using test::small;

double total(const Grid& grid, Field& field) {
    double sum = 0;
    each_cell(grid, field, [&](float value, int, int, int) { sum += double{value}; });
    return sum;
}

// The largest speed along an axis, relative to the wind at the start.
double largest_change(const Specification& wanted, Flow& flow, std::size_t axis) {
    Flow start(wanted, 1);
    double largest = 0;
    each_cell(wanted.grid, flow.state().velocity[axis], [&](float value, int x, int y, int z) {
        const float before = start.state().velocity[axis].row(y, z)[x];
        largest = std::max(largest, std::abs(double{value} - double{before}));
    });
    return largest;
}

void run(Flow& flow, double until_s) {
    while (flow.time_s() < until_s) flow.step(until_s);
}

// A warm, moist ball above the floor.
void warm_ball(const Specification& wanted, Flow& flow, float kelvin, std::array<int, 2> middle) {
    const Grid& grid = wanted.grid;
    each_cell(grid, flow.state().heat, [&](float& value, int x, int y, int z) {
        const int dx = std::abs(x - middle[0]), dy = std::abs(y - middle[1]);
        const int across = std::min(dx, grid.cells[0] - dx),
                  along = std::min(dy, grid.cells[1] - dy);
        if (across * across + along * along + (z - 4) * (z - 4) <= 9) value += kelvin;
    });
}

TEST(Flow, StillAirStaysStill) {
    Specification wanted = small();
    wanted.patches = 0;
    wanted.wind_top_m_per_s = {};
    Flow flow(wanted, 2);
    run(flow, 300);
    for (const std::size_t axis : {0, 1, 2}) EXPECT_EQ(largest_change(wanted, flow, axis), 0);
}

// Wind alone lifts nothing either: layers slide over each other.
TEST(Flow, WindThatChangesWithHeightStaysAsItIs) {
    Specification wanted = small();
    wanted.patches = 0;
    Flow flow(wanted, 2);
    run(flow, 300);
    for (const std::size_t axis : {0, 1, 2}) EXPECT_LE(largest_change(wanted, flow, axis), 1e-5);
}

TEST(Flow, KeepsHeatAndWater) {
    Specification wanted = small();
    wanted.patches = 0;
    Flow flow(wanted, 2);
    warm_ball(wanted, flow, 3, {12, 10});
    each_cell(wanted.grid, flow.state().water, [&](float& value, int, int, int z) {
        if (z < 9) value *= 1.02F;
    });
    const double heat = total(wanted.grid, flow.state().heat);
    const double water = total(wanted.grid, flow.state().water);
    run(flow, 600);
    EXPECT_GT(largest_change(wanted, flow, 2), 2);
    // 14 400 cells have values of about 10, which have been rounded 200 times.
    EXPECT_NEAR(total(wanted.grid, flow.state().heat), heat, 1e-6 * 14400 * 10);
    EXPECT_NEAR(total(wanted.grid, flow.state().water), water, 1e-6 * 14400 * 10);
    EXPECT_LE(largest_divergence(wanted.grid, flow.state().velocity), 1e-6);
}

// Air that is warmer by 1 K stops where the air around it is: some ten metres higher in air that warms
// by 0.02 K/m, where it swings with a period of about 4 minutes.
TEST(Flow, StableDryAirDoesNotConvect) {
    Specification wanted = small();
    wanted.patches = 0;
    wanted.instability_k_per_km = -14;
    wanted.humidity = 0.01;
    Flow flow(wanted, 2);
    each_cell(wanted.grid, flow.state().water, [](float& value, int, int, int) { value = 0.01F; });
    each_cell(wanted.grid, flow.state().heat, [&](float& value, int x, int y, int z) {
        if (std::abs(x - 12) < 3 && std::abs(y - 10) < 3 && std::abs(z - 14) < 3) value += 1;
    });
    std::vector<float> before(24 * 20 * 30);
    run(flow, 900);
    double highest = 0;
    each_cell(wanted.grid, flow.state().velocity[2], [&](float value, int, int, int z) {
        if (z >= 20) highest = std::max(highest, std::abs(double{value}));
    });
    EXPECT_LE(highest, 0.5);
    std::vector<float> row(24);
    for (int z = 0; z < 30; ++z) {
        for (int y = 0; y < 20; ++y) {
            flow.condensed_row(y, z, row.data());
            for (const float water : row) ASSERT_LE(water, 0);
        }
    }
}

// The same ball in unstable air reaches the inversion as cloud.
TEST(Flow, UnstableMoistAirMakesCloudFromTheBaseUp) {
    Specification wanted = small();
    wanted.patches = 2;
    wanted.patch_width_m = {400, 500};
    wanted.growth_s = 900;
    const auto cloud = grow(wanted, {});
    const std::size_t plane = 24 * 20;
    std::vector<float> most;
    for (std::size_t z = 0; z < cloud->water.size() / plane; ++z) {
        const float* level = cloud->water.data() + z * plane;
        most.push_back(*std::max_element(level, level + plane));
    }
    const auto top =
        std::find_if(most.rbegin(), most.rend(), [](float water) { return water > 0; });
    const auto levels = most.rend() - top;
    EXPECT_GE(levels, 6);
    EXPECT_LE(most.front(), 0.3F);  // next to nothing at the condensation level
    const float greatest = *std::max_element(most.begin(), most.end());
    EXPECT_GE(greatest, 3 * most.front());
    EXPECT_LE(greatest, 1.3F * cloud->full_water);  // patches are moister than the base's own air
}

// The grid has no preferred place but for the rounding of its transform.
TEST(Flow, MovesWithWhatIsMoved) {
    Specification wanted = small();
    wanted.patches = 0;
    Flow one(wanted, 1), other(wanted, 1);
    warm_ball(wanted, one, 2, {12, 10});
    warm_ball(wanted, other, 2, {19, 4});
    run(one, 60);
    run(other, 60);
    double greatest = 0, largest = 0;
    const Field& moved = other.state().velocity[2];
    each_cell(wanted.grid, one.state().velocity[2], [&](float value, int x, int y, int z) {
        greatest = std::max(greatest, std::abs(double{value}));
        largest =
            std::max(largest, std::abs(double{value} - double{moved.row(y - 6, z)[(x + 7) % 24]}));
    });
    EXPECT_GT(greatest, 1);
    EXPECT_LE(largest, 1e-4 * greatest);
}

// Kept velocities change nothing else and are the flow's. No level gains air, and water changes as they move it.
TEST(Flow, KeptVelocityMovesTheCloud) {
    Specification wanted = small();
    wanted.patches = 2;
    wanted.patch_width_m = {400, 500};
    const auto without = grow(wanted, {});
    EXPECT_TRUE(without->velocity.empty());
    wanted.keeps_velocity = true;
    const auto cloud = grow(wanted, {});
    ASSERT_EQ(cloud->water, without->water);
    Flow flow(wanted, 1);
    while (flow.time_s() < wanted.growth_s) flow.step(wanted.growth_s);
    std::vector<float> velocity;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::vector<float> along =
            rows_of(wanted, [&](int y, int z, float* out) { flow.velocity_row(axis, y, z, out); });
        velocity.insert(velocity.end(), along.begin(), along.end());
    }
    ASSERT_EQ(cloud->velocity, velocity);
    constexpr double kStep_s = 3;
    while (flow.time_s() < wanted.growth_s + kStep_s) flow.step(wanted.growth_s + kStep_s);
    const std::vector<float> later =
        rows_of(wanted, [&](int y, int z, float* out) { flow.condensed_row(y, z, out); });
    const auto [nx, ny, nz] = cloud->cells;
    const std::size_t count = cloud->water.size();
    const auto at = [&](const std::vector<float>& field, int x, int y, int z) {
        const int row = z * 20 + (y + 20) % 20;
        return double{field[static_cast<std::size_t>(row * 24 + (x + 24) % 24)]};
    };
    double changed = 0, moved = 0, both = 0, fastest = 0;
    for (int z = 1; z + 1 < nz; ++z) {
        double rising = 0;
        for (int i = 0; i < nx * ny; ++i) {
            const int x = i % nx, y = i / nx;
            const auto here = static_cast<std::size_t>(z * nx * ny + i);
            const double rise = double{velocity[2 * count + here]};
            rising += rise;
            fastest = std::max(fastest, rise);
            if (cloud->water[here] <= 0 || later[here] <= 0) continue;
            // By the flow and by what condenses as air rises, to first order.
            double gained = kStep_s * rise * double{cloud->full_water} / wanted.inversion_m;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const int dx = axis == 0, dy = axis == 1, dz = axis == 2;
                gained -= kStep_s * double{velocity[axis * count + here]} *
                          (at(cloud->water, x + dx, y + dy, z + dz) -
                           at(cloud->water, x - dx, y - dy, z - dz)) /
                          (2 * double{wanted.grid.edge_m[axis]});
            }
            const double change = double{later[here]} - double{cloud->water[here]};
            changed += change * change;
            moved += gained * gained;
            both += change * gained;
        }
        EXPECT_NEAR(rising / (nx * ny), 0, 1e-4) << z;
    }
    EXPECT_GT(fastest, 1);
    EXPECT_GT(both, 0.85 * std::sqrt(changed * moved));
    EXPECT_NEAR(both / moved, 1, 0.35);
}

TEST(Flow, IsTheSameForAnyThreads) {
    Specification wanted = small();
    wanted.growth_s = 240;
    std::vector<std::vector<float>> grown;
    for (const int threads : {1, 2, 3}) {
        BakeOptions options;
        options.threads = threads;
        grown.push_back(grow(wanted, options)->water);
    }
    for (const auto& other : grown) {
        ASSERT_EQ(std::memcmp(other.data(), grown[0].data(), other.size() * sizeof(float)), 0);
    }
    wanted.seed = 2;
    EXPECT_NE(grow(wanted, {})->water, grown[0]);
}

// Stops when asked to.
class Stopped : public Progress {
  public:
    void advance(std::string_view, double) override { ++steps_; }
    bool cancelled() const override { return steps_ >= 3; }

  private:
    int steps_ = 0;
};

TEST(Flow, EndsWhenInterrupted) {
    Stopped progress;
    BakeOptions options;
    options.progress = &progress;
    EXPECT_EQ(grow(small(), options), nullptr);
}

}  // namespace
}  // namespace skybake::convection
