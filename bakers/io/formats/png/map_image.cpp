#include "bakers/io/formats/png/map_image.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/exr/exr_heads.h"
#include "bakers/math/hash.h"
#include "bakers/math/transcendental.h"
#include "config/text/text.h"

namespace skybake {
namespace {

// Makes a diagnostic at a place in the recipe, or in the picture if no recipe names it.
Diagnostic map_error(std::string code, const config::CloudMap& map,
                     const config::SourceRange& place, const std::string& reason) {
    const std::string file = map.path.string();
    Diagnostic diagnostic = file_error(std::move(code), file,
                                       fmt::format("cannot read the map `{}`: {}", file, reason));
    if (!place.source.empty()) diagnostic.where = place;
    return diagnostic;
}

Diagnostic not_a_map(const config::CloudMap& map, const std::string& reason) {
    return map_error("E0304", map, map.file_place, reason);
}

// "it has no channel `r`, but `R`, `G`, `B`; did you mean `R`?"
std::string no_such_channel(const std::string& channel, const std::vector<std::string>& known) {
    const std::vector<std::string_view> names(known.begin(), known.end());
    const std::string suggestion = config::did_you_mean(channel, names);
    return fmt::format("it has no channel `{}`, only `{}`{}{}", channel, fmt::join(known, "`, `"),
                       suggestion.empty() ? "" : "; ", suggestion);
}

// The inverse transfer function of IEC 61966-2-1, continued beyond [0, 1]. For v = 1 the quotient is
// exactly 1 and its logarithm 0, so white stays 1.
double linear_of_srgb(double v) {
    if (v <= 0.04045) return v / 12.92;
    return exponential(2.4 * logarithm((v + 0.055) / 1.055));
}

template <class T>
std::string_view bytes_of(const T& numbers) {
    return {reinterpret_cast<const char*>(numbers.data()),
            numbers.size() * sizeof(typename T::value_type)};
}

// Makes the map's numbers of the picture's. Describes the first one that is none, or returns nothing.
std::optional<std::string> make_shares(const config::CloudMap& map, MapPixels& pixels) {
    for (std::size_t i = 0; i < pixels.values.size(); ++i) {
        const double stored = pixels.values[i];
        const bool is_srgb = map.color_space == config::MapColorSpace::srgb;
        double share = map.factor * (is_srgb ? linear_of_srgb(stored) : stored);
        if (map.clamp && !std::isnan(share)) share = std::clamp(share, 0.0, 1.0);
        if (!(share >= 0 && share <= 1)) {
            const auto width = static_cast<std::size_t>(pixels.width);
            return fmt::format(
                "the pixel in column {}, row {} (from 0, the first row is 0) is {}, and a map's "
                "values "
                "are in [0, 1]{}",
                i % width, i / width, pixels.values[i],
                std::isnan(share) ? "" : "; `factor` scales them, and `clamp = true` limits them");
        }
        pixels.values[i] = static_cast<float>(share);
    }
    return std::nullopt;
}

MapImage finished(MapPixels pixels) {
    MapImage image{pixels.width, pixels.height, std::move(pixels.values), ""};
    Hasher hasher;
    hasher.update(bytes_of(std::array<std::int32_t, 2>{image.width, image.height}));
    hasher.update(bytes_of(image.values));
    image.content_hash = hasher.hex();
    return image;
}

}  // namespace

Outcome<MapImage> read_map_image(const config::CloudMap& map) {
    const std::string file = map.path.string();
    const Outcome<FileInput> opened = FileInput::open(map.path);  // says why it cannot be
    if (!opened.value) {
        const std::string words = fmt::format("cannot read `{}`: ", file);
        const std::string& message = opened.diagnostics.at(0).message;
        assert(message.starts_with(words));
        return map_error("E0300", map, map.file_place, message.substr(words.size()));
    }
    const LoadedCodec<ImageCodec>& loaded = image_codec();
    if (loaded.codec == nullptr) return map_error("E0300", map, map.file_place, loaded.reason);
    // The library would fail without a word.
    const auto parts = read_exr_heads(map.path);
    const std::string subsampled = parts.value ? subsampled_channel(*parts.value) : "";
    if (!subsampled.empty()) return not_a_map(map, subsampled);
    MapPixels pixels = loaded.codec->read(map.path, map.channel, 1);
    if (!pixels.problem.empty()) return not_a_map(map, pixels.problem);
    if (pixels.values.empty()) {
        return map_error("E0304", map, map.channel_place,
                         no_such_channel(map.channel, pixels.channel_names));
    }
    if (const auto problem = make_shares(map, pixels)) return not_a_map(map, *problem);
    return {finished(std::move(pixels)), {}};
}

double map_pixels(const config::CloudMap& map) {
    const ImageCodec* codec = map.file.empty() ? nullptr : image_codec().codec;
    if (codec == nullptr) return 0;
    const MapPixels pixels = codec->read(map.path, "", 0);
    return double{1} * pixels.width * pixels.height;
}

const LoadedCodec<ImageCodec>& image_codec() {
    static const auto loaded = load_codec<ImageCodec>(image_module_name, image_codec_symbol);
    return loaded;
}

}  // namespace skybake
