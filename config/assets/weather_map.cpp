#include "config/assets/weather_map.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/assets/octave_checks.h"
#include "config/fields/fields.h"
#include "config/fields/number_reader.h"
#include "config/fields/section_decoder.h"
#include "config/sections/frames.h"
#include "config/sections/parameters.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

// A noise has at most so many channels.
constexpr int most_shares = 4;

std::optional<FieldValue> read_shares(const Reader& reader, const Value& value) {
    return read_one_or_more(reader, value, "number");
}

constexpr ValueKind share_kind = list_kind(
    "a share, such as 0.3 or \"30 %\", or a list of one per channel of the noise", read_shares,
    one_or_numbers_schema, &Scales::fraction, 1, most_shares, RangeOver::numbers);

constexpr Choice weather_content_choices[] = {
    {WeatherContent::amounts, "amounts",
     "how much there is of what each channel stands for: 0 none, 1 all"},
    {WeatherContent::directions, "directions",
     "the unit vector along the channels R, G and B: (1 + vector) / 2"},
};
constexpr Choice cover_edge_choices[] = {
    {CoverEdge::linear, "linear", "in proportion to the noise"},
    {CoverEdge::smooth, "smooth", "smoothstep of that"},
};

const Row<WeatherMapBake> weather_map_table[] = {
    {"noise", Kind::text, &WeatherMapBake::noise,
     "NAME of the [noise.NAME] whose plane z = 1/2 is taken", KeyFlag::required,
     Cited{schneider_2015}},
    {"size", Kind::size, &WeatherMapBake::size,
     "texels along x and y; by default those of the noise's size", texel_range},
    {"content", Kind::choice, &WeatherMapBake::content, "what a texel holds",
     weather_content_choices, Default{R"("amounts")"}},
    {"covered", share_kind, &WeatherMapBake::covered,
     "share of the texels of a channel that are above 0, exactly", unit_range, Default{"0.5"},
     Hint{"0.3 for fair weather, 1 for channels without gaps"}, When{"content", "amounts"}},
    {"full", share_kind, &WeatherMapBake::full,
     "share of the texels that are 1; with 0 the greatest one is", unit_range, Default{"0"},
     When{"content", "amounts"}},
    {"edge", Kind::choice, &WeatherMapBake::edge, "how a channel rises from 0 to 1",
     cover_edge_choices, Default{R"("linear")"}, When{"content", "amounts"}},
    {"yields_to", Kind::text_list, &WeatherMapBake::yields_to,
     "for each channel, another one whose finished values are taken from its noise, or \"\"",
     Hint{"for example, [\"G\", \"\", \"\"] puts low clouds only where there are no middle clouds"},
     When{"content", "amounts"}},
    {"streaks", share_kind, &WeatherMapBake::streaks,
     "length in tiles over which the wind draws a channel's noise out, falling to 1/e", Range{0, 1},
     Default{"0"}, Hint{"0.05 for cirrus"}, When{"content", "amounts"}},
    {"wind", Kind::angle, &WeatherMapBake::wind,
     "where the wind draws streaks to, from +x towards +y", turn_range, Default{R"("0 deg")"},
     When{"content", "amounts"}},
};

// This is one section while it is resolved.
struct WeatherMapResolver {
    DecodedSection& bake;
    Decoder& decoder;
    std::vector<std::string> names;  // of the noise's channels

    void resolve_channels() const {
        for (const std::string_view key : {"covered", "full", "streaks"}) spread(key);
        resolve_yields();
        check_full();
        check_directions();
    }

    void report_count(std::string_view key, std::size_t count) const {
        decoder.report("E0156", bake, key,
                       fmt::format("has {} items, and the noise has {} channel{}", count,
                                   names.size(), names.size() == 1 ? "" : "s"),
                       "give one item for each channel, or one for all");
    }

    // Gives each channel its number.
    void spread(std::string_view key) const {
        DecodedField& decoded = bake.at(key);
        if (!decoded.value) return;
        auto& shares = std::get<std::vector<double>>(*decoded.value);
        if (shares.size() == 1) shares.resize(names.size(), shares.front());
        if (shares.size() != names.size()) report_count(key, shares.size());
    }

    void resolve_yields() const {
        const auto* yields = bake.value<std::vector<std::string>>("yields_to");
        if (!yields || yields->empty()) return;
        if (yields->size() != names.size()) return report_count("yields_to", yields->size());
        for (std::size_t i = 0; i < yields->size(); ++i) check_yield(*yields, i);
    }

    void check_yield(const std::vector<std::string>& yields, std::size_t channel) const {
        const std::string& name = yields[channel];
        if (name.empty()) return;
        const auto found = std::ranges::find(names, name);
        const auto index = static_cast<std::size_t>(found - names.begin());
        if (found != names.end() && index != channel && yields[index].empty()) return;
        decoder.report(
            "E0156", bake, "yields_to",
            fmt::format(": channel {} cannot yield to `{}`", names[channel], shorten(name)),
            "a channel may yield to another one of the noise that yields to none");
    }

    void check_full() const {
        const auto* covered = bake.value<std::vector<double>>("covered");
        const auto* full = bake.value<std::vector<double>>("full");
        if (!covered || !full) return;
        for (std::size_t i = 0; i < std::min(covered->size(), full->size()); ++i) {
            if ((*full)[i] <= (*covered)[i]) continue;
            decoder.report("E0156", bake, "full",
                           fmt::format(": {} of a channel cannot be 1 where {} is above 0",
                                       (*full)[i], (*covered)[i]),
                           "`full` is at most `covered`");
            return;
        }
    }

    void check_directions() const {
        const auto content = choice_of<WeatherContent>(bake.at("content"));
        if (content != WeatherContent::directions || names.size() == 3) return;
        decoder.report(
            "E0156", bake, "content",
            fmt::format(": directions need three channels, and the noise has {}", names.size()),
            "a noise of type = \"curl\" with the components x, y and z is usual");
    }
};

// Fills in `size` from the noise, and an item for each channel. It reports a noise that does not
// exist (E0130), channels that the map cannot have (E0156), and frames of a noise that stands still
// (E0174). It warns of octaves that add nothing at that size (W0208) or are too fine for it (W0203).
// Files are checked as those of all tables.
void resolve_weather_map(DecodedSection& bake, const RecipeSoFar& recipe, Decoder& decoder) {
    const std::span<const Noise> noises = recipe.parameters.noises;
    const Noise* noise = find_named(bake, "noise", noises, noise_reference, decoder);
    if (!noise) return;
    const auto& [width, height, depth] = noise->size;
    if (width > 0) derive(bake.at("size"), std::array{width, height});
    const bool has_none = noise->pack == NoisePacking::none && noise->channels.empty();
    const auto names = has_none ? std::vector<std::string>{} : channel_names(*noise);
    WeatherMapResolver{bake, decoder, names}.resolve_channels();
    check_frames(bake, std::array{motion_of(*noise)}, decoder);
    const auto* size = bake.value<std::array<int, 2>>("size");
    if (!size) return;
    OctaveChecks checks({(*size)[0], (*size)[1], 1});
    checks.add(*noise, noise->channels, {.sampling = noise->sampling});
    checks.report(bake.place_of("size", "noise"), decoder);
}

std::vector<Read> reads_of(const Parameters& parameters, const WeatherMapBake& bake) {
    const Noise& noise = noise_named(parameters, bake.noise);
    return reads_of_noise(noise, noise.channels);
}

}  // namespace

AssetKind asset_kind(Tag<WeatherMapBake>) {
    return make_asset_kind<WeatherMapBake>(
        {.name = "weather_map",
         .documentation = "where clouds are and how much of each kind, or directions, in a plane",
         .is_table = true},
        with_file_fields(weather_map_table, {.formats = R"(["png"])", .pixel_type = R"("unorm8")"}),
        reads_of, resolve_weather_map);
}

}  // namespace skybake::config
