#include "bakers/plot/label_placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace skybake {

namespace {

constexpr double kGap = 1.5;  // between a label and anything else
constexpr std::array<double, 7> kDistances = {9, 14, 22, 32, 46, 64, 86};
constexpr int kDirections = 16;
constexpr double kPriceOfCrossing = 14;  // as much as so many pixels further away
constexpr double kPriceOfLeaning = 5;    // of a place above or below, where a leader reads worse

bool overlap(const Box& a, const Box& b) {
    return a.left < b.right + kGap && b.left < a.right + kGap && a.top < b.bottom + kGap &&
           b.top < a.bottom + kGap;
}

bool within(const Box& box, const Box& area) {
    return box.left >= area.left && box.right <= area.right && box.top >= area.top &&
           box.bottom <= area.bottom;
}

// Whether a segment passes through a box, by clipping its parameter range.
bool crosses(const Segment& line, const Box& box) {
    double from = 0;
    double to = 1;
    const auto clip = [&](double start, double step, double low, double high) {
        if (step == 0) return start >= low && start <= high;
        const double a = (low - start) / step;
        const double b = (high - start) / step;
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
        return from <= to;
    };
    return clip(line.x0, line.x1 - line.x0, box.left, box.right) &&
           clip(line.y0, line.y1 - line.y0, box.top, box.bottom);
}

// The box whose nearest side or corner lies at a distance in a direction.
Box box_at(const Label& label, double distance, double angle) {
    const double across = std::cos(angle);
    const double down = std::sin(angle);
    const double x = label.x + distance * across + across * label.width / 2;
    const double y = label.y + distance * down + down * label.height / 2;
    return {x - label.width / 2, y - label.height / 2, x + label.width / 2, y + label.height / 2};
}

// From the point to the nearest place of its label.
Segment leader_of(const Label& label, const Box& box) {
    return {label.x, label.y, std::clamp(label.x, box.left, box.right),
            std::clamp(label.y, box.top, box.bottom)};
}

}  // namespace

std::vector<std::optional<Box>> place_labels(const std::vector<Label>& labels, const Box& area,
                                             const std::vector<Box>& obstacles,
                                             const std::vector<Segment>& lines) {
    std::vector<Box> taken = obstacles;
    std::vector<Segment> drawn = lines;
    std::vector<std::optional<Box>> boxes;
    for (const Label& label : labels) {
        std::optional<Box> best;
        double best_price = 0;
        for (const double distance : kDistances) {
            for (int i = 0; i < kDirections; ++i) {
                const double angle = 2 * std::numbers::pi * i / kDirections;
                const Box box = box_at(label, distance, angle);
                if (!within(box, area)) continue;
                const auto hit = [&](const Box& other) { return overlap(box, other); };
                if (std::any_of(taken.begin(), taken.end(), hit)) continue;
                double price = distance + kPriceOfLeaning * std::fabs(std::sin(angle));
                for (const Segment& line : drawn) {
                    if (crosses(line, box)) price += kPriceOfCrossing;
                }
                if (!best || price < best_price) {
                    best = box;
                    best_price = price;
                }
            }
        }
        if (best) {
            taken.push_back(*best);
            drawn.push_back(leader_of(label, *best));
        }
        boxes.push_back(best);
    }
    return boxes;
}

}  // namespace skybake
