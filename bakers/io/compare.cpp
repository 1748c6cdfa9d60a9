#include "bakers/io/compare.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "bakers/io/spelling.h"

namespace skybake {
namespace {

std::string layout_of(const ExrImage& image) {
    return fmt::format("{} x {} {}", image.pixels.width, image.pixels.height,
                       fmt::join(image.channel_names, " "));
}

double distance(double a, double b) {
    if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
    const double difference = std::abs(a - b);
    return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
}

double relative(double absolute, double a, double b) {
    if (absolute == 0 || std::isinf(absolute)) return absolute;
    return absolute / std::max(std::abs(a), std::abs(b));
}

ChannelDifference compare_channel(const Image2<float>& first, const Image2<float>& second,
                                  int channel) {
    ChannelDifference result;
    double squares = 0;
    for (int y = 0; y < first.height; ++y) {
        for (int x = 0; x < first.width; ++x) {
            const double a = first.texel(x, y)[channel];
            const double b = second.texel(x, y)[channel];
            const double absolute = distance(a, b);
            squares += absolute * absolute;
            result.differing += absolute > 0 ? 1 : 0;
            result.max_relative = std::max(result.max_relative, relative(absolute, a, b));
            if (absolute > result.max_absolute) {
                result.max_absolute = absolute;
                result.worst_x = x;
                result.worst_y = y;
            }
        }
    }
    result.rms = std::sqrt(squares / (static_cast<double>(first.width) * first.height));
    return result;
}

std::map<std::string, std::string> facts_of(const ExrImage& image) {
    std::map<std::string, std::string> facts(image.attributes.begin(), image.attributes.end());
    facts["pixel type"] = spell(image.pixel_type);
    facts["compression"] = spell(image.compression);
    return facts;
}

std::optional<std::string> find_fact(const std::map<std::string, std::string>& facts,
                                     const std::string& name) {
    const auto found = facts.find(name);
    return found != facts.end() ? std::optional(found->second) : std::nullopt;
}

std::vector<AttributeDifference> compare_attributes(const ExrImage& first, const ExrImage& second) {
    const auto facts = facts_of(first);
    const auto others = facts_of(second);
    std::set<std::string> names;
    for (const auto& fact : facts) names.insert(fact.first);
    for (const auto& fact : others) names.insert(fact.first);
    std::vector<AttributeDifference> differences;
    for (const std::string& name : names) {
        AttributeDifference entry{name, find_fact(facts, name), find_fact(others, name)};
        if (entry.first != entry.second) differences.push_back(std::move(entry));
    }
    return differences;
}

}  // namespace

ImageDifference compare_images(const ExrImage& first, const ExrImage& second) {
    ImageDifference difference;
    difference.attributes = compare_attributes(first, second);
    if (layout_of(first) != layout_of(second)) {
        difference.layout = fmt::format("{} against {}", layout_of(first), layout_of(second));
        return difference;
    }
    for (int channel = 0; channel < first.pixels.channels; ++channel) {
        ChannelDifference entry = compare_channel(first.pixels, second.pixels, channel);
        entry.channel = first.channel_names[static_cast<std::size_t>(channel)];
        difference.channels.push_back(std::move(entry));
    }
    return difference;
}

bool equal_within(const ImageDifference& difference, double tolerance) {
    return difference.layout.empty() &&
           std::all_of(difference.channels.begin(), difference.channels.end(),
                       [tolerance](const ChannelDifference& channel) {
                           return channel.max_absolute <= tolerance;
                       });
}

}  // namespace skybake
