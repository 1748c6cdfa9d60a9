// This file does not use fmt, because OpenImageIO's headers turn fmt's exceptions into aborts.
#include "bakers/io/formats/png/map_reader.h"

#include <OpenImageIO/imageio.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "bakers/io/files/system_call.h"
#include "bakers/io/formats/png/map_image.h"

namespace skybake {
namespace {

using OIIO::ImageInput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

// An exception for a picture that is refused. It is caught at the end of this file.
struct Refused : std::runtime_error {
    using std::runtime_error::runtime_error;
};

void expect(bool condition, const std::string& otherwise) {
    if (!condition) throw Refused(otherwise);
}

// --- Opening ------------------------------------------------------------------------------------

// The formats that are read. Left alone, the library would try all its formats, including films and
// text, for any file.
struct Format {
    const char* name;  // the library's
    std::string_view first_bytes;
};
using namespace std::string_view_literals;
constexpr std::array<Format, 8> formats = {{
    {"png", "\x89PNG\r\n\x1a\n"sv},
    {"openexr", "\x76\x2f\x31\x01\x02"sv},  // of version 2
    {"tiff", "II*\0"sv},
    {"tiff", "MM\0*"sv},
    {"tiff", "II+\0"sv},  // files beyond 4 GiB
    {"tiff", "MM\0+"sv},
    {"hdr", "#?RADIAN"sv},
    {"hdr", "#?RGBE"sv},
}};

// Returns the file's format, if it may be opened. Before its pixels are read, a PNG file is checked.
const char* format_of(const std::filesystem::path& path, bool reads_pixels) {
    std::array<char, 8> bytes{};
    std::ifstream file;
    open_to_read(file, path);
    file.read(bytes.data(), bytes.size());
    const std::string_view begin(bytes.data(), static_cast<std::size_t>(file.gcount()));
    file.clear();
    const auto format = std::find_if(formats.begin(), formats.end(), [&](const Format& known) {
        return begin.substr(0, known.first_bytes.size()) == known.first_bytes;
    });
    expect(format != formats.end(), "it is neither PNG nor TIFF nor OpenEXR nor Radiance");
    if (format->name == "png"sv && reads_pixels) {
        if (const auto damage = png_damage(file)) throw Refused(*damage);
    }
    // Deep images are refused here, because the library would abort the program for a channel of
    // unknown type in them.
    constexpr std::size_t flags_at = 5;
    constexpr int deep_flag = 0x08;
    const bool deep = begin.size() > flags_at && (begin[flags_at] & deep_flag) != 0;
    expect(format->name != "openexr"sv || !deep, "it is a deep image");
    return format->name;
}

// Returns the first line of the library's error message, which says most, without the file's name,
// which stands in front of it already.
std::string reason(const ImageInput& input, const std::string& file = "") {
    std::string words = input.geterror();
    words = words.substr(0, words.find('\n'));
    if (words.empty()) return "it is damaged";
    for (const std::string& name : {"\"" + file + "\"", file}) {
        const std::size_t at = file.empty() ? words.npos : words.find(name);
        if (at != words.npos) words.replace(at, name.size(), "it");
    }
    return "OpenImageIO says: " + words;
}

std::unique_ptr<ImageInput> open(const std::filesystem::path& path, const char* format,
                                 ImageSpec& specification) {
    // The library uses one thread. The value -1 leaves OpenEXR's own number of threads, which the
    // whole program shares, unchanged.
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    std::unique_ptr<ImageInput> input = ImageInput::create(format);
    expect(input != nullptr, "the library does not know " + std::string(format));
    ImageSpec as_stored;
    as_stored.attribute("oiio:UnassociatedAlpha", 1);
    as_stored.attribute("oiio:RawColor", 1);
    expect(input->open(path.string(), specification, as_stored), reason(*input, path.string()));
    return input;
}

// --- What is read -------------------------------------------------------------------------------

// Far more than any picture has. A damaged count would otherwise allocate a row of many GiB.
constexpr int most_channels = 1024;

void expect_plain_picture(const ImageSpec& picture) {
    expect(picture.depth == 1 && picture.tile_depth <= 1, "it is a volume");
    expect(picture.width > 0 && picture.height > 0, "it has no pixels");
    const auto fits = [](int width, int height) {
        return width <= largest_map_edge && height <= largest_map_edge;
    };
    expect(fits(picture.width, picture.height) && fits(picture.tile_width, picture.tile_height) &&
               fits(picture.full_width, picture.full_height),
           "it has " + std::to_string(std::max(picture.width, picture.full_width)) + " x " +
               std::to_string(std::max(picture.height, picture.full_height)) + " pixels, at most " +
               std::to_string(largest_map_edge) + " along each edge are read");
    expect(picture.nchannels > 0 && picture.nchannels <= most_channels,
           "it has " + std::to_string(picture.nchannels) + " channels");
    expect(picture.get_int_attribute("Orientation", 1) == 1,
           "its orientation tag turns or mirrors it; store it upright");
}

// Refuses TIFF files that the library would convert from another colour model, invert for some
// types only, or scale inexactly.
void expect_plain_samples(const ImageSpec& picture) {
    constexpr int black_is_zero = 1, rgb = 2;
    const int model = picture.get_int_attribute("tiff:PhotometricInterpretation", black_is_zero);
    expect(model == black_is_zero || model == rgb,
           "its colour model is neither grey from black to white nor RGB");
    const int bits = picture.get_int_attribute("oiio:BitsPerSample", 8);
    constexpr std::array exact = {1, 2, 4, 8, 16, 32};
    expect(std::find(exact.begin(), exact.end(), bits) != exact.end(),
           "its values have " + std::to_string(bits) + " bits");
}

// --- Pixels -------------------------------------------------------------------------------------

// Channels first ... end - 1, which are interleaved where they are read.
struct Channels {
    int first = 0;
    int end = 0;
};

// Calls `rows_ready` with the first row's number and some rows of channels, top to bottom, as values of
// `type`.
//
// Without tiles, it reads row by row: the library decodes whole strips of TIFF with its own
// decoder, which reports success even if it fails.
template <class T, class Visit>
void read_rows(ImageInput& input, const ImageSpec& picture, Channels channels, TypeDesc type,
               Visit&& rows_ready) {
    const bool tiled = picture.tile_width > 0;
    const int rows = tiled ? picture.tile_height : 1;
    const int end = picture.y + picture.height;
    std::vector<T> band;
    for (int y = picture.y; y < end; y += rows) {
        const int y_end = std::min(y + rows, end);
        band.resize(static_cast<std::size_t>(y_end - y) * static_cast<std::size_t>(picture.width) *
                    static_cast<std::size_t>(channels.end - channels.first));
        const bool read = tiled ? input.read_tiles(0, 0, picture.x, picture.x + picture.width, y,
                                                   y_end, picture.z, picture.z + 1, channels.first,
                                                   channels.end, type, band.data())
                                : input.read_scanlines(0, 0, y, y_end, picture.z, channels.first,
                                                       channels.end, type, band.data());
        // Some failures are reported only by an error message.
        expect(read && !input.has_error(), reason(input));
        rows_ready(y, band);
    }
}

// Reads integers and divides them by their largest value; the quotient is rounded to nearest. What
// the file does not have of its display window is 0.
template <class T>
std::vector<float> read_values(ImageInput& input, const ImageSpec& picture, Channels channels,
                               TypeDesc type, float largest) {
    std::vector<float> values;
    const int each = channels.end - channels.first;
    const auto width =
        static_cast<std::size_t>(picture.full_width) * static_cast<std::size_t>(each);
    const auto count = width * static_cast<std::size_t>(picture.full_height);
    // Reserved memory costs nothing until it is written to, and a damaged size causes an error
    // before that.
    values.reserve(count);
    const int shift = (picture.x - picture.full_x) * each;
    const int begin = std::max(shift, 0);
    const int end = std::min(shift + picture.width * each, picture.full_width * each);
    read_rows<T>(input, picture, channels, type, [&](int y, const std::vector<T>& band) {
        const T* row = band.data();
        for (; row < band.data() + band.size(); row += picture.width * each, ++y) {
            const int to = y - picture.full_y;
            if (to < 0 || to >= picture.full_height || begin >= end) continue;
            values.resize(static_cast<std::size_t>(to) * width + static_cast<std::size_t>(begin));
            for (int x = begin; x < end; ++x) {
                values.push_back(static_cast<float>(row[x - shift]) / largest);
            }
        }
    });
    values.resize(count);
    return values;
}

std::vector<float> read_channels(ImageInput& input, const ImageSpec& picture, Channels channels) {
    const TypeDesc type = picture.channelformat(channels.first);
    if (type == TypeDesc::UINT8) {
        return read_values<std::uint8_t>(input, picture, channels, type, 255.0F);
    }
    if (type == TypeDesc::UINT16) {
        return read_values<std::uint16_t>(input, picture, channels, type, 65535.0F);
    }
    expect(type == TypeDesc::HALF || type == TypeDesc::FLOAT,
           std::string("its values are of type ") + type.c_str() +
               ": 8 or 16 bit integers, half and float are read");
    return read_values<float>(input, picture, channels, TypeDesc::FLOAT, 1.0F);
}

// --- Channels ----------------------------------------------------------------------------------

MapPixels read_picture(const std::filesystem::path& path, const std::string& channel, int count) {
    ImageSpec picture;
    const char* const format = format_of(path, count > 0);
    const std::unique_ptr<ImageInput> input = open(path, format, picture);
    if (format != "openexr"sv) {  // windows of others are not the picture's
        picture.full_x = picture.x;
        picture.full_y = picture.y;
        picture.full_width = picture.width;
        picture.full_height = picture.height;
    }
    expect_plain_picture(picture);
    if (format == "tiff"sv) expect_plain_samples(picture);
    MapPixels pixels;
    pixels.width = picture.full_width;
    pixels.height = picture.full_height;
    pixels.channel_names = picture.channelnames;
    const auto& names = pixels.channel_names;
    const auto found =
        channel.empty() ? names.begin() : std::find(names.begin(), names.end(), channel);
    if (count == 0 || names.end() - found < count) return pixels;
    const auto first = static_cast<int>(found - names.begin());
    pixels.values = read_channels(*input, picture, {first, first + count});
    return pixels;
}

}  // namespace

MapPixels read_map(const std::filesystem::path& path, const std::string& channel, int count) {
    MapPixels pixels;
    try {
        return read_picture(path, channel, count);
    } catch (const std::bad_alloc&) {
        pixels.problem = "it does not fit in memory";
    } catch (const std::exception& error) {
        pixels.problem = error.what();
    }
    return pixels;
}

namespace {

constexpr std::streamoff signature_bytes = 8;

// Reads a big-endian number.
std::uint32_t number_of(const char* bytes) {
    std::uint32_t number = 0;
    for (int i = 0; i < 4; ++i) number = number << 8U | static_cast<unsigned char>(bytes[i]);
    return number;
}

std::uint32_t checksum(std::uint32_t before, const char* bytes, std::size_t count) {
    return static_cast<std::uint32_t>(
        ::crc32(before, reinterpret_cast<const Bytef*>(bytes), static_cast<uInt>(count)));
}

}  // namespace

// A chunk consists of the length of its data, its type, the data, and the checksum of type and data
// (ISO/IEC 15948, 5.3).
std::optional<std::string> png_damage(std::istream& file) {
    std::vector<char> piece(std::size_t{1} << 16);
    file.seekg(signature_bytes);
    while (true) {
        std::array<char, 8> head{};
        if (!file.read(head.data(), head.size())) return "it ends early";
        std::uint32_t crc = checksum(0, head.data() + 4, 4);
        for (std::size_t left = number_of(head.data()); left > 0;) {
            const std::size_t count = std::min(left, piece.size());
            if (!file.read(piece.data(), static_cast<std::streamsize>(count))) {
                return "it ends early";
            }
            crc = checksum(crc, piece.data(), count);
            left -= count;
        }
        std::array<char, 4> stored{};
        if (!file.read(stored.data(), stored.size())) return "it ends early";
        if (number_of(stored.data()) != crc) return "a checksum does not match";
        if (std::string_view(head.data() + 4, 4) == "IEND") return std::nullopt;
    }
}

}  // namespace skybake
