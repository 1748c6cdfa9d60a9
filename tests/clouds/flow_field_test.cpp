// The velocity of a cloud that has grown, at its voxels.
#include "bakers/clouds/flow_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "bakers/clouds/cloud_field.h"
#include "bakers/clouds/cloud_reference.h"
#include "bakers/clouds/grown_volume.h"
#include "tests/clouds/cloud_specification.h"
#include "tests/noise/noises.h"
#include "tests/support/volumes.h"

namespace skybake::cloud {
namespace {

using convection::GrownCloud;
using test::filled;
using test::Planes;
using testing::for_each_voxel;

constexpr std::array cells = {6, 4, 5};
constexpr std::size_t cell_count = 6 * 4 * 5;

std::shared_ptr<GrownCloud> still_cloud() {
    auto cloud = std::make_shared<GrownCloud>();
    cloud->cells = cells;
    cloud->full_water = 2;
    cloud->water.assign(cell_count, 1.0F);
    cloud->velocity.assign(3 * cell_count, 0.0F);
    return cloud;
}

std::shared_ptr<GrownCloud> random_cloud() {
    std::mt19937 random(8);
    std::normal_distribution<float> number(0, 1);
    auto cloud = still_cloud();
    for (float& water : cloud->water) water = number(random);
    for (float& velocity : cloud->velocity) velocity = 5 * number(random);
    return cloud;
}

// A cell that alone moves is seen in its axis' channel, up to the next cells' centres and across the tile's edge.
TEST(FlowField, HasEachVelocityInItsPlace) {
    const std::array size = {30, 20, 25};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto cloud = still_cloud();
        cloud->velocity[axis * cell_count + (2 * 4 + 1) * 6 + 0] = 7;  // cell (0, 1, 2)
        const Planes found = filled(FlowField(cloud, size), {{}, size}, 3);
        std::size_t next = 0;
        for_each_voxel(size, [&](int x, int y, int z) {
            const std::size_t i = next++;
            const double from = x < 15 ? x - 2 : x - 32;
            const double share = std::max(0.0, 1 - std::abs(from) / 5) *
                                 std::max(0.0, 1 - std::abs(y - 7.0) / 5) *
                                 std::max(0.0, 1 - std::abs(z - 12.0) / 5);
            for (std::size_t c = 0; c < 3; ++c) {
                ASSERT_NEAR(double{found[c][i]}, c == axis ? 7 * share : 0, 1e-5) << i;
            }
        });
    }
}

// Above the highest centres and below the lowest ones it goes on as it is there.
TEST(FlowField, GoesOnBeyondTheOutermostCells) {
    const auto cloud = still_cloud();
    for (std::size_t i = 0; i < cell_count; ++i) {
        cloud->velocity[2 * cell_count + i] = static_cast<float>(i / 24);  // the level
    }
    const Planes found = filled(FlowField(cloud, {1, 1, 50}), {{}, {1, 1, 50}}, 3);
    for (int z = 0; z < 50; ++z) {
        EXPECT_NEAR(double{found[2][static_cast<std::size_t>(z)]},
                    std::clamp((z + 0.5) / 10 - 0.5, 0.0, 4.0), 1e-6);
    }
}

TEST(FlowField, IsNearItsReference) {
    const std::array size = {13, 4, 17};
    const auto cloud = random_cloud();
    const Planes found = filled(FlowField(cloud, size), {{}, size}, 3);
    std::size_t next = 0;
    for_each_voxel(size, [&](int x, int y, int z) {
        const std::size_t i = next++;
        const auto wanted = flow_reference(
            *cloud, {(x + 0.5) / size[0], (y + 0.5) / size[1], (z + 0.5) / size[2]});
        for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(double{found[c][i]}, wanted[c], 1e-5);
    });
}

// Kernel, specification and reference agree, in any box and channel by channel, and no velocity is without cloud.
TEST(FlowField, OfACloudIsWhereTheCloudIs) {
    const std::array size = {13, 9, 17};
    config::Cloud cloud;
    cloud.shape = config::CloudShape::convection;
    cloud.channels = config::CloudChannels::velocity;
    cloud.extent = {{{600}, {400}, {500}}};
    const CloudVolume volume = volume_of_grown(random_cloud(), cloud, nullptr, size);
    const CloudField field(make_cloud_plan(cloud, volume, nullptr, size, {}));
    const CloudReference reference(cloud, volume, nullptr, size, {});
    const Planes whole = filled(field, {{}, size}, 4);
    int moving = 0;
    std::size_t next = 0;
    for_each_voxel(size, [&](int x, int y, int z) {
        const std::size_t i = next++;
        const std::vector<float> specified = cloud_at(field.plan(), {x, y, z});
        const std::vector<double> wanted =
            reference({(x + 0.5) / size[0], (y + 0.5) / size[1], (z + 0.5) / size[2]});
        ASSERT_EQ(wanted.size(), 4u);
        moving += whole[1][i] != 0 ? 1 : 0;
        for (std::size_t c = 0; c < 4; ++c) {
            ASSERT_EQ(whole[c][i], specified[c]);
            ASSERT_NEAR(double{whole[c][i]}, wanted[c], 2e-5);
            ASSERT_TRUE(whole[0][i] != 0 || whole[c][i] == 0);
        }
    });
    EXPECT_GT(moving, 200);
    EXPECT_LT(moving, 13 * 9 * 17 - 200);
    const VoxelBox box{{3, 2, 5}, {7, 4, 6}};
    std::vector<float> alone(static_cast<std::size_t>(box.count()), -99);
    field.fill(box, {nullptr, nullptr, alone.data(), nullptr});
    for (std::size_t i = 0; i < alone.size(); ++i) {
        const int at = static_cast<int>(i);
        const int x = 3 + at % 7, y = 2 + at / 7 % 4, z = 5 + at / 28;
        ASSERT_EQ(alone[i], whole[2][static_cast<std::size_t>((z * 9 + y) * 13 + x)]);
    }
}

}  // namespace
}  // namespace skybake::cloud
