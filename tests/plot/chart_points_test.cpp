#include "bakers/plot/chart_points.h"

#include <gtest/gtest.h>

namespace skybake {
namespace {

bool overlap(const Box& a, const Box& b) {
    return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

constexpr Box area = {0, 0, 400, 300};

TEST(LabelPlacement, LabelsOfACrowdTouchNeitherEachOtherNorThePointsNorTheEdge) {
    std::vector<Label> labels;
    std::vector<Box> points;
    for (int i = 0; i < 12; ++i) {
        const double x = 190 + 3 * i;
        const double y = 150 + 2 * (i % 5);
        labels.push_back({x, y, 60, 12});
        points.push_back({x - 4, y - 4, x + 4, y + 4});
    }
    const auto boxes = place_labels(labels, area, points, {});
    ASSERT_EQ(boxes.size(), labels.size());
    int placed = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (!boxes[i]) continue;
        ++placed;
        EXPECT_GE(boxes[i]->left, area.left);
        EXPECT_LE(boxes[i]->right, area.right);
        EXPECT_GE(boxes[i]->top, area.top);
        EXPECT_LE(boxes[i]->bottom, area.bottom);
        for (const Box& point : points) EXPECT_FALSE(overlap(*boxes[i], point));
        for (std::size_t j = 0; j < i; ++j) {
            if (boxes[j]) {
                EXPECT_FALSE(overlap(*boxes[i], *boxes[j]));
            }
        }
    }
    EXPECT_GE(placed, 8);
}

TEST(LabelPlacement, PrefersAPlaceWithoutALine) {
    const std::vector<Segment> lines = {{200, 150, 400, 150}};
    const auto boxes = place_labels({{200, 150, 50, 12}}, area, {}, lines);
    ASSERT_TRUE(boxes[0]);
    EXPECT_FALSE(boxes[0]->right > 200 && boxes[0]->top < 150 && boxes[0]->bottom > 150);
}

TEST(LabelPlacement, LeavesOutWhatDoesNotFit) {
    EXPECT_FALSE(place_labels({{200, 150, 500, 12}}, area, {}, {})[0]);
}

}  // namespace
}  // namespace skybake
