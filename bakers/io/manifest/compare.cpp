#include "bakers/io/manifest/compare.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "bakers/io/files/to_string.h"
#include "bakers/io/formats/format.h"

namespace skybake {
namespace {

std::string layout_of(const ComparedImage& image) {
    return fmt::format("{} x {} {}", image.rows.width, image.rows.height,
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

// Adds the differences of some rows of one channel. The first of them is row `y` of the image.
void add_rows(const Image2<float>& first, const Image2<float>& second, int rows, int y,
              ChannelDifference& result, std::size_t channel, double& squares) {
    for (int row = 0; row < rows; ++row) {
        for (int x = 0; x < first.width; ++x) {
            const double a = first.texel(x, row)[channel];
            const double b = second.texel(x, row)[channel];
            const double absolute = distance(a, b);
            squares += absolute * absolute;
            result.differing += absolute > 0 ? 1 : 0;
            result.max_relative = std::max(result.max_relative, relative(absolute, a, b));
            if (absolute > result.max_absolute) {
                result.max_absolute = absolute;
                result.worst_x = x;
                result.worst_y = y + row;
            }
        }
    }
}

// Compares the channels of two images of the same layout.
config::Outcome<std::vector<ChannelDifference>> compare_channels(const ComparedImage& first,
                                                                 const ComparedImage& second) {
    std::vector<ChannelDifference> channels(first.channel_names.size());
    std::vector<double> squares(channels.size(), 0.0);
    int step = std::min(first.rows.rows_per_piece, first.rows.height);
    const int interleaved = static_cast<int>(channels.size());
    Image2<float> a(first.rows.width, step, interleaved);
    Image2<float> b(first.rows.width, step, interleaved);
    for (int y = 0; y < first.rows.height; y += step) {
        step = std::min(step, first.rows.height - y);
        if (auto problem = first.rows.read(y, step, a.texels.data())) return {{}, {*problem}};
        if (auto problem = second.rows.read(y, step, b.texels.data())) return {{}, {*problem}};
        for (std::size_t c = 0; c < channels.size(); ++c) {
            add_rows(a, b, step, y, channels[c], c, squares[c]);
        }
    }
    const double texels = static_cast<double>(first.rows.width) * first.rows.height;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        channels[c].channel = first.channel_names[c];
        channels[c].rms = std::sqrt(squares[c] / texels);
    }
    return {std::move(channels), {}};
}

std::map<std::string, std::string> facts_of(const ComparedImage& image) {
    std::map<std::string, std::string> facts(image.attributes.begin(), image.attributes.end());
    facts["pixel type"] = to_string(image.pixel_type);
    facts["compression"] = to_string(image.compression);
    return facts;
}

std::optional<std::string> find_fact(const std::map<std::string, std::string>& facts,
                                     const std::string& name) {
    const auto found = facts.find(name);
    return found != facts.end() ? std::optional(found->second) : std::nullopt;
}

std::vector<AttributeDifference> compare_facts(const std::map<std::string, std::string>& first,
                                               const std::map<std::string, std::string>& second) {
    std::set<std::string> names;
    for (const auto& fact : first) names.insert(fact.first);
    for (const auto& fact : second) names.insert(fact.first);
    std::vector<AttributeDifference> differences;
    for (const std::string& name : names) {
        AttributeDifference entry{name, find_fact(first, name), find_fact(second, name)};
        if (entry.first != entry.second) differences.push_back(std::move(entry));
    }
    return differences;
}

// Returns the members of an entry by their paths, or nothing if the text is not an entry.
std::map<std::string, std::string> members_of(const std::string& text) {
    std::map<std::string, std::string> members;
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object()) return members;
    const nlohmann::json flat = json.flatten();
    for (const auto& [path, value] : flat.items()) {
        members[path.substr(1)] = value.is_string() ? value.get<std::string>() : value.dump();
    }
    return members;
}

// Compares entries member by member, except for members that follow from the texels.
std::vector<AttributeDifference> compare_attributes(const ComparedImage& first,
                                                    const ComparedImage& second) {
    std::vector<AttributeDifference> differences;
    for (AttributeDifference& entry : compare_facts(facts_of(first), facts_of(second))) {
        if (entry.name != metadata_name || !entry.first || !entry.second) {
            differences.push_back(std::move(entry));
            continue;
        }
        for (AttributeDifference& member : metadata_differences(*entry.first, *entry.second)) {
            const bool is_of_texels =
                member.name.starts_with("probes/") || member.name.starts_with("statistics/");
            if (!is_of_texels) differences.push_back(std::move(member));
        }
    }
    return differences;
}

}  // namespace

std::vector<AttributeDifference> metadata_differences(const std::string& first,
                                                      const std::string& second) {
    const auto members = members_of(first);
    const auto others = members_of(second);
    if (first != second && (members.empty() || others.empty())) {
        return {{metadata_name, first, second}};
    }
    return compare_facts(members, others);
}

ComparedImage compared(ExrRows& file) {
    return {rows_of(file), file.channel_names(), file.pixel_type(), file.compression(),
            file.attributes()};
}

config::Outcome<ImageDifference> compare_images(const ComparedImage& first,
                                                const ComparedImage& second) {
    ImageDifference difference;
    difference.attributes = compare_attributes(first, second);
    if (layout_of(first) != layout_of(second)) {
        difference.layout = fmt::format("{} against {}", layout_of(first), layout_of(second));
        return {std::move(difference), {}};
    }
    auto channels = compare_channels(first, second);
    if (!channels.value) return {{}, std::move(channels.diagnostics)};
    difference.channels = std::move(*channels.value);
    return {std::move(difference), {}};
}

bool equal_within(const ImageDifference& difference, double tolerance) {
    return difference.layout.empty() &&
           std::ranges::all_of(difference.channels, [tolerance](const ChannelDifference& channel) {
               return channel.max_absolute <= tolerance;
           });
}

}  // namespace skybake
