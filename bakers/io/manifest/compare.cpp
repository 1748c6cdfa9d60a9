#include "bakers/io/manifest/compare.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "bakers/io/files/to_string.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/formats/hdr/hdr.h"

namespace skybake {
namespace {

std::string layout_of(const ComparedImage& image) {
    return fmt::format("{} x {} {}{}{}", image.rows.width, image.rows.height,
                       fmt::join(image.channel_names, " "), image.window.empty() ? "" : " at ",
                       image.window);
}

// Adds the differences of some rows of one channel. The first of them is row `y` of the image.
void add_rows(const Image2<float>& first, const Image2<float>& second, int rows, int y,
              std::size_t channel, DifferenceSum& sum) {
    for (int row = 0; row < rows; ++row) {
        for (int x = 0; x < first.width; ++x) {
            sum.add(first.texel(x, row)[channel], second.texel(x, row)[channel], [&] {
                return std::vector{x, y + row};
            });
        }
    }
}

// Compares the channels of two images of the same layout.
config::Outcome<std::vector<ChannelDifference>> compare_channels(const ComparedImage& first,
                                                                 const ComparedImage& second) {
    std::vector<DifferenceSum> sums(first.channel_names.size());
    int step = std::min(first.rows.rows_per_piece, first.rows.height);
    const int interleaved = static_cast<int>(sums.size());
    Image2<float> a(first.rows.width, step, interleaved);
    Image2<float> b(first.rows.width, step, interleaved);
    for (int y = 0; y < first.rows.height; y += step) {
        step = std::min(step, first.rows.height - y);
        if (auto problem = first.rows.read(y, step, a.texels.data())) return {{}, {*problem}};
        if (auto problem = second.rows.read(y, step, b.texels.data())) return {{}, {*problem}};
        for (std::size_t c = 0; c < sums.size(); ++c) add_rows(a, b, step, y, c, sums[c]);
    }
    std::vector<ChannelDifference> channels;
    for (DifferenceSum& sum : sums) {
        sum.channel.channel = first.channel_names[channels.size()];
        channels.push_back(sum.finished());
    }
    return {std::move(channels), {}};
}

Attributes facts_of(const ComparedImage& image) {
    Attributes facts = image.attributes;
    facts.emplace_back("pixel type", to_string(image.pixel_type));
    facts.emplace_back("compression", image.compression);
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

std::vector<AttributeDifference> attribute_differences(const Attributes& first,
                                                       const Attributes& second) {
    std::vector<AttributeDifference> differences;
    for (AttributeDifference& entry :
         compare_facts({first.begin(), first.end()}, {second.begin(), second.end()})) {
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

ComparedImage compared(ExrRows& file) {
    const ExrFacts& facts = file.facts();
    return {rows_of(file), facts.channel_names, facts.pixel_type,
            facts.codec,   facts.attributes,    facts.window};
}

config::Outcome<ComparedImage> compared_radiance(const std::filesystem::path& path) {
    config::Outcome<HdrPicture> picture = read_hdr_picture(path);
    if (!picture.value) return {{}, std::move(picture.diagnostics)};
    ComparedImage image{std::move(picture.value->rows), {"R", "G", "B"}, config::PixelType::rgbe};
    if (const std::string& entry = picture.value->entry; !entry.empty()) {
        image.attributes.emplace_back(metadata_name, entry);
    }
    return {std::move(image), {}};
}

config::Outcome<ImageDifference> compare_images(const ComparedImage& first,
                                                const ComparedImage& second) {
    ImageDifference difference;
    difference.attributes = attribute_differences(facts_of(first), facts_of(second));
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
