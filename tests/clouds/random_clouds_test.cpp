// Properties of any cloud: kernels equal the specification bit for bit on every instruction set, no
// region that holds something is taken for empty, and values are as near to the reference as floats
// allow.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "bakers/clouds/cloud_reference.h"
#include "tests/clouds/cloud_specification.h"
#include "tests/clouds/clouds.h"
#include "tests/noise/every_target.h"

namespace skybake::cloud {
namespace {

using test::any_cloud;
using test::CloudCase;
using test::Planes;

TEST(RandomClouds, KernelsEqualTheSpecification) {
    EXPECT_TRUE(rc::check([] {
        const CloudCase any = any_cloud();
        const CloudField field(any.plan());
        VoxelBox box = test::any_box(any.size);
        // The specification is slow: at most a few thousand voxels.
        while (box.count() > 4000) {
            for (int& side : box.size) side = std::max(1, side * 2 / 3);
        }
        const Planes wanted = test::specified(field.plan(), box);
        test::Mismatches mismatches;
        test::on_every_target([&](const char* name) {
            const Planes made = test::filled_with_canaries(field, box, field.plan().channels);
            mismatches.compare(made, wanted, box, name);
        });
        if (mismatches.count != 0) RC_LOG() << mismatches.first;
        RC_ASSERT(mismatches.count == 0);
        if (field.is_empty(box)) {
            for (const auto& plane : wanted) {
                RC_ASSERT(std::all_of(plane.begin(), plane.end(), [](float v) { return v == 0; }));
            }
        }
    }));
}

TEST(RandomClouds, ChannelsMayBeLeftOut) {
    EXPECT_TRUE(rc::check([] {
        const CloudCase any = any_cloud();
        const CloudField field(any.plan());
        const VoxelBox box{{}, any.size};
        const Planes all = test::filled(field, box, field.plan().channels);
        for (std::size_t wanted = 0; wanted < all.size(); ++wanted) {
            std::vector<float> alone(all[wanted].size());
            std::vector<float*> targets(all.size(), nullptr);
            targets[wanted] = alone.data();
            field.fill(box, targets);
            RC_ASSERT(alone == all[wanted]);
        }
    }));
}

// How far a shaped float may be from the reference: the noise's error times H, passed on by what
// follows. Where that is steep (soft edges of 1e-6, hard ones) a voxel may fall on the other side.
double slope_of(const config::Cloud& cloud, double largest_base) {
    const double erosion = std::max(cloud.erosion[0], cloud.erosion[1]);
    double slope = (1 + largest_base) / ((1 - erosion) * (1 - erosion));
    if (cloud.threshold_at == config::ThresholdAt::bake && cloud.edge_softness > 0) {
        slope *= 1 + 1.5 * largest_base / ((1 - erosion) * cloud.edge_softness);
    }
    return cloud.full_at ? slope * std::max(1.0, 1 / *cloud.full_at) : slope;
}

TEST(RandomClouds, SpecificationIsNearTheReference) {
    int compared = 0;
    EXPECT_TRUE(rc::check([&] {
        const CloudCase any = any_cloud();
        const CloudPlan plan = any.plan();
        const CloudReference reference(any.cloud, any.base, any.detail_noise(), any.size, any.maps);
        double towers = 0;
        for (const config::Tower& tower : any.cloud.towers) towers += 2 * tower.amplitude + 60;
        for (int i = 0; i < 50; ++i) {
            noise::Voxel voxel;
            for (std::size_t a = 0; a < 3; ++a) voxel[a] = *rc::gen::inRange(0, any.size[a]);
            const std::vector<float> found = cloud_at(plan, voxel);
            const std::vector<double> wanted =
                reference({(static_cast<double>(voxel[0]) + 0.5) / any.size[0],
                           (static_cast<double>(voxel[1]) + 0.5) / any.size[1],
                           (static_cast<double>(voxel[2]) + 0.5) / any.size[2]});
            const bool hard =
                any.cloud.threshold_at == config::ThresholdAt::bake && any.cloud.edge_softness == 0;
            for (std::size_t c = 0; c < found.size(); ++c) {
                const double error = std::fabs(double{found[c]} - wanted[c]);
                const double scale = std::max(1.0, std::fabs(wanted[c]));
                if (hard && (found[c] == 0) != (wanted[c] == 0)) {
                    const double value = std::max(double{found[c]}, wanted[c]);
                    const double full = any.cloud.full_at.value_or(1);
                    const double after = any.cloud.full_at
                                             ? std::min(any.cloud.threshold / full, 1.0)
                                             : any.cloud.threshold;
                    RC_ASSERT(std::fabs(value - after) < 1e-4 * scale / full);
                    continue;
                }
                RC_ASSERT(error < 4e-6 * scale * slope_of(any.cloud, 4 + towers));
                ++compared;
            }
        }
    }));
    EXPECT_GT(compared, 1000);
}

}  // namespace
}  // namespace skybake::cloud
