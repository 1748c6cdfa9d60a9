#include "bakers/plot/svg_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "bakers/plot/label_placement.h"
#include "bakers/plot/log_axis.h"
#include "bakers/plot/svg_elements.h"

namespace skybake {

namespace {

constexpr double kLabelSize = 11;
constexpr double kSamePlace = 24;  // px between points that one label tells of

// Below the resolution of a double on a scale of 1 there is nothing to tell apart.
constexpr double kSmallestShown = 1e-17;

// A panel whose axes cross at (left, bottom).
class PanelDrawing {
  public:
    PanelDrawing(const PlotPanel& panel, double left, double top)
        : panel_(panel),
          area_{left, top, left + kPanelWidth, top + kPanelHeight},
          x_axis_(values(&PlotPoint::x), kSmallestShown),
          y_axis_(values(&PlotPoint::y), kSmallestShown) {}

    std::string svg() const { return frame() + grid() + titles() + front() + markers() + labels(); }

  private:
    std::vector<double> values(double PlotPoint::*member) const {
        std::vector<double> all;
        for (const PlotPoint& point : panel_.points) all.push_back(point.*member);
        return all;
    }

    double x_of(double value) const {
        return area_.left + x_axis_.position(value) * (area_.right - area_.left);
    }
    double y_of(double value) const {
        return area_.bottom - y_axis_.position(value) * (area_.bottom - area_.top);
    }

    std::string frame() const {
        return fmt::format(
            "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" "
            "stroke=\"{}\" stroke-width=\"1\"/>\n",
            area_.left, area_.top, area_.right - area_.left, area_.bottom - area_.top, kPaper,
            kPaleInk);
    }

    std::string grid() const {
        std::string text;
        for (const LogTick& mark : x_axis_.ticks()) {
            const double x = x_of(mark.value);
            if (!mark.label.empty()) {
                text += line_between({x, area_.top + 1, x, area_.bottom - 1}, kGridInk, 1);
                text += text_at(x, area_.bottom + 18, mark.label, "text-anchor=\"middle\"");
            }
            text += line_between({x, area_.bottom, x, area_.bottom - (mark.label.empty() ? 3 : 6)},
                                 kPaleInk, 1);
        }
        for (const LogTick& mark : y_axis_.ticks()) {
            const double y = y_of(mark.value);
            if (!mark.label.empty()) {
                text += line_between({area_.left + 1, y, area_.right - 1, y}, kGridInk, 1);
                text += text_at(area_.left - 7, y + 4, mark.label, "text-anchor=\"end\"");
            }
            text += line_between({area_.left, y, area_.left + (mark.label.empty() ? 3 : 6), y},
                                 kPaleInk, 1);
        }
        return text;
    }

    std::string titles() const {
        const double middle = (area_.left + area_.right) / 2;
        const double centre = (area_.top + area_.bottom) / 2;
        const double beside = area_.left - kRoomLeft + 14;
        return text_at(area_.left, area_.top - 9, panel_.title, "font-weight=\"bold\"") +
               text_at(middle, area_.bottom + 38, panel_.x_title, "text-anchor=\"middle\"") +
               text_at(beside, centre, panel_.y_title,
                       fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 {:.1f} {:.1f})\"",
                                   beside, centre));
    }

    std::vector<Segment> front_lines() const {
        std::vector<const PlotPoint*> front;
        for (const PlotPoint& point : panel_.points) {
            if (point.on_front && std::isfinite(point.x)) front.push_back(&point);
        }
        std::sort(front.begin(), front.end(),
                  [](const PlotPoint* a, const PlotPoint* b) { return a->x < b->x; });
        std::vector<Segment> lines;
        for (std::size_t i = 1; i < front.size(); ++i) {
            lines.push_back({x_of(front[i - 1]->x), y_of(front[i - 1]->y), x_of(front[i]->x),
                             y_of(front[i]->y)});
        }
        return lines;
    }

    std::string front() const {
        std::string text;
        for (const Segment& line : front_lines()) {
            text += line_between(line, kFrontInk, kFrontWidth);
        }
        return text;
    }

    std::string markers() const {
        std::string plain;
        std::string emphasised;  // on top of all others
        // The first on top: later families are variations of earlier ones.
        for (auto at = panel_.points.rbegin(); at != panel_.points.rend(); ++at) {
            const PlotPoint& point = *at;
            const double x = x_of(point.x);
            const double y = y_of(point.y);
            std::string& text = point.emphasised ? emphasised : plain;
            if (point.emphasised) {
                text += fmt::format(
                    "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"none\" stroke=\"{}\" "
                    "stroke-width=\"1.3\"/>\n",
                    x, y, kMarkerSize + 3.5, kInk);
            }
            text += marker_at(x, y, point.family, point.tooltip);
        }
        return plain + emphasised;
    }

    // The points with labels, those that matter most first. Points that share a label and all but
    // share a place are told once.
    std::vector<const PlotPoint*> labelled() const {
        std::vector<const PlotPoint*> points;
        for (const bool emphasised : {true, false}) {
            for (const PlotPoint& point : panel_.points) {
                const bool told = std::any_of(points.begin(), points.end(), [&](const auto* other) {
                    return !point.emphasised && other->label.ends_with(point.label) &&
                           std::hypot(x_of(other->x) - x_of(point.x),
                                      y_of(other->y) - y_of(point.y)) < kSamePlace;
                });
                if (point.emphasised == emphasised && !point.label.empty() && !told) {
                    points.push_back(&point);
                }
            }
        }
        return points;
    }

    std::string labels() const {
        const std::vector<const PlotPoint*> points = labelled();
        std::vector<Label> wanted;
        for (const PlotPoint* point : points) {
            wanted.push_back({x_of(point->x), y_of(point->y),
                              width_of(point->label, kLabelSize, point->emphasised),
                              kLabelSize + 1});
        }
        std::vector<Box> obstacles;
        for (const PlotPoint& point : panel_.points) {
            const double half = kMarkerSize + (point.emphasised ? 4 : 1);
            const double x = x_of(point.x);
            const double y = y_of(point.y);
            obstacles.push_back({x - half, y - half, x + half, y + half});
        }
        const Box inner = {area_.left + 8, area_.top + 4, area_.right - 4, area_.bottom - 8};
        const auto boxes = place_labels(wanted, inner, obstacles, front_lines());
        std::string text;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (boxes[i]) text += label(*points[i], wanted[i], *boxes[i]);
        }
        return text;
    }

    std::string label(const PlotPoint& point, const Label& wanted, const Box& box) const {
        const Segment leader = {wanted.x, wanted.y, std::clamp(wanted.x, box.left, box.right),
                                std::clamp(wanted.y, box.top, box.bottom)};
        const double length = std::hypot(leader.x1 - leader.x0, leader.y1 - leader.y0);
        const double clear = kMarkerSize + (point.emphasised ? 4 : 1);
        std::string text;
        if (length > clear + 11) {
            const double t = clear / length;
            text += line_between({leader.x0 + t * (leader.x1 - leader.x0),
                                  leader.y0 + t * (leader.y1 - leader.y0), leader.x1, leader.y1},
                                 kPaleInk, 0.7);
        }
        // A broad white stroke below keeps lines off the letters.
        const std::string style =
            fmt::format("font-size=\"{}\" text-anchor=\"middle\"{}", kLabelSize,
                        point.emphasised ? " font-weight=\"bold\"" : "");
        const double x = (box.left + box.right) / 2;
        const double y = box.bottom - 2.5;
        text += text_at(x, y, point.label,
                        fmt::format("{} stroke=\"{}\" stroke-width=\"3\" stroke-linejoin=\"round\" "
                                    "aria-hidden=\"true\"",
                                    style, kPaper));
        return text + text_at(x, y, point.label, style);
    }

    const PlotPanel& panel_;
    Box area_;
    LogAxis x_axis_;
    LogAxis y_axis_;
};

}  // namespace

std::string svg_panel(const PlotPanel& panel, double left, double top) {
    return PanelDrawing(panel, left, top).svg();
}

}  // namespace skybake
