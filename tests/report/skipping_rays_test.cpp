#include "bakers/report/occupancy_report.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace skybake {
namespace {

// With a tile of 600 units they are those that are kept, to the digits printed there.
TEST(SkippingRays, AreThoseOfTheFiles) {
    const auto sets = skipping_rays({600, 600, 600}, 3000);
    for (const RaySet& set : sets) {
        std::ifstream file(SKYBAKE_TEST_DATA "/rays_" + set.name + ".csv");
        std::string line;
        ASSERT_TRUE(std::getline(file, line)) << set.name;
        for (const occupancy::Ray& ray : set.rays) {
            for (const auto& triple : {ray.origin, ray.direction}) {
                for (const double number : triple) {
                    double kept = 0;
                    char comma = 0;
                    ASSERT_TRUE(file >> kept) << set.name;
                    EXPECT_NEAR(number, kept, 1e-6) << set.name;
                    if (file.peek() == ',') file >> comma;
                }
            }
        }
        EXPECT_FALSE(file >> line) << set.name << " has more rays";
    }
}

}  // namespace
}  // namespace skybake
