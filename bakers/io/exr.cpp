#include "bakers/io/exr.h"

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfVersion.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <exception>
#include <optional>
#include <stdexcept>

#include "bakers/io/file_diagnostic.h"
#include "bakers/io/read_file.h"

namespace skybake {
namespace {

using config::Compression;
using config::Outcome;
using config::PixelType;

static_assert(std::endian::native == std::endian::little,
              "texels are stored as they lie in memory");

constexpr std::size_t longest_attribute_name = 31;
constexpr float largest_half = 65504.0f;
// Pinned, since the library's default has changed between releases and bytes must not.
constexpr int deflate_level = 4;
// No codec of the profile makes more of a byte than deflate, 1032. A header that promises more
// texels than that is damaged, and would otherwise have them allocated.
constexpr double largest_expansion = 1100;
constexpr double expansion_slack = 65536;

struct CompressionName {
    Compression ours;
    Imf::Compression theirs;
};
constexpr std::array<CompressionName, 4> compression_names = {{
    {Compression::none, Imf::NO_COMPRESSION},
    {Compression::zip, Imf::ZIP_COMPRESSION},
    {Compression::zips, Imf::ZIPS_COMPRESSION},
    {Compression::piz, Imf::PIZ_COMPRESSION},
}};

Imf::Compression to_library(Compression compression) {
    for (const CompressionName& name : compression_names) {
        if (name.ours == compression) return name.theirs;
    }
    return Imf::NO_COMPRESSION;
}

std::optional<Compression> from_library(Imf::Compression compression) {
    for (const CompressionName& name : compression_names) {
        if (name.theirs == compression) return name.ours;
    }
    return std::nullopt;
}

// --- Streams ------------------------------------------------------------------------------------

class MemoryOutput : public Imf::OStream {
  public:
    MemoryOutput() : Imf::OStream("memory") {}
    void write(const char bytes[], int count) override {
        const auto size = static_cast<std::size_t>(count);
        if (position_ + size > bytes_.size()) bytes_.resize(position_ + size);
        std::memcpy(bytes_.data() + position_, bytes, size);
        position_ += size;
    }
    uint64_t tellp() override { return position_; }
    void seekp(uint64_t position) override { position_ = static_cast<std::size_t>(position); }
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
    std::size_t position_ = 0;
};

class MemoryInput : public Imf::IStream {
  public:
    explicit MemoryInput(std::string_view bytes) : Imf::IStream("memory"), bytes_(bytes) {}
    bool read(char out[], int count) override {
        const std::size_t left = position_ < bytes_.size() ? bytes_.size() - position_ : 0;
        if (count < 0 || static_cast<std::size_t>(count) > left) {
            throw std::runtime_error("it ends early");
        }
        std::memcpy(out, bytes_.data() + position_, static_cast<std::size_t>(count));
        position_ += static_cast<std::size_t>(count);
        return position_ < bytes_.size();
    }
    uint64_t tellg() override { return position_; }
    void seekg(uint64_t position) override { position_ = static_cast<std::size_t>(position); }

  private:
    std::string_view bytes_;
    std::size_t position_ = 0;
};

// --- Writing ------------------------------------------------------------------------------------

Outcome<std::string> refused(std::string code, std::string message) {
    return {{}, {file_error(std::move(code), "", std::move(message))}};
}

// What would make a file that this profile does not know, as a mistake of the program.
std::optional<std::string> contradiction(const ExrImage& image) {
    const Image2<float>& pixels = image.pixels;
    if (pixels.width < 1 || pixels.height < 1 || pixels.channels < 1)
        return "an image without texels";
    if (image.channel_names.size() != static_cast<std::size_t>(pixels.channels)) {
        return fmt::format("{} channels with {} names", pixels.channels,
                           image.channel_names.size());
    }
    if (pixels.texels.size() != pixels.offset(0, pixels.height)) {
        return "an image whose texels do not match its size";
    }
    for (const auto& [name, text] : image.attributes) {
        if (name.empty() || name.size() > longest_attribute_name) {
            return fmt::format("the attribute name `{}` has {} characters, {} are the most", name,
                               name.size(), longest_attribute_name);
        }
    }
    return std::nullopt;
}

// The first texel that the file cannot hold. The place is given as users count: column, row,
// channel.
std::optional<config::Diagnostic> unstorable_texel(const ExrImage& image) {
    const bool half = image.pixel_type == PixelType::half;
    const Image2<float>& pixels = image.pixels;
    for (std::size_t i = 0; i < pixels.texels.size(); ++i) {
        const float value = pixels.texels[i];
        const bool finite = std::isfinite(value);
        if (finite && !(half && std::abs(value) > largest_half)) continue;
        const std::size_t channel = i % static_cast<std::size_t>(pixels.channels);
        const std::size_t texel = i / static_cast<std::size_t>(pixels.channels);
        const auto width = static_cast<std::size_t>(pixels.width);
        const std::string place = fmt::format("column {}, row {}, channel {}", texel % width,
                                              texel / width, image.channel_names[channel]);
        if (!finite) {
            return file_error("E0401", "", fmt::format("the texel at {} is {}", place, value));
        }
        return file_error("E0402", "",
                          fmt::format("the texel at {} is {}: a half holds at most {}", place,
                                      value, largest_half));
    }
    return std::nullopt;
}

template <class T>
std::vector<T> converted(const std::vector<float>& values) {
    std::vector<T> result;
    result.reserve(values.size());
    for (const float value : values) result.push_back(T(value));
    return result;
}

// Slices that let the library walk over interleaved texels of type T.
template <class T>
Imf::FrameBuffer interleaved(T* texels, const Image2<float>& shape, Imf::PixelType type,
                             const std::vector<std::string>& names) {
    Imf::FrameBuffer buffer;
    const std::size_t texel = sizeof(T) * names.size();
    const std::size_t row = texel * static_cast<std::size_t>(shape.width);
    for (std::size_t channel = 0; channel < names.size(); ++channel) {
        buffer.insert(names[channel],
                      Imf::Slice(type, reinterpret_cast<char*>(texels + channel), texel, row));
    }
    return buffer;
}

Imf::Header make_header(const ExrImage& image) {
    Imf::Header header(image.pixels.width, image.pixels.height, 1.0f, Imath::V2f(0, 0), 1.0f,
                       Imf::INCREASING_Y, to_library(image.compression));
    header.zipCompressionLevel() = deflate_level;
    const Imf::PixelType type = image.pixel_type == PixelType::half ? Imf::HALF : Imf::FLOAT;
    for (const std::string& name : image.channel_names) {
        header.channels().insert(name, Imf::Channel(type));
    }
    for (const auto& [name, text] : image.attributes) {
        header.insert(name, Imf::StringAttribute(text));
    }
    return header;
}

template <class T>
std::string write_texels(const ExrImage& image, const T* texels, Imf::PixelType type) {
    MemoryOutput stream;
    {
        Imf::OutputFile file(stream, make_header(image), 0);  // 0: no threads but this one
        // The library only reads through the pointer that it wants without const.
        file.setFrameBuffer(
            interleaved(const_cast<T*>(texels), image.pixels, type, image.channel_names));
        file.writePixels(image.pixels.height);
    }  // the destructor goes back and writes the table of line offsets
    return stream.take();
}

// --- Reading ------------------------------------------------------------------------------------

// Channels as texels hold them: colours as R G B [A] rather than in the file's alphabetical order.
std::vector<std::string> texel_order(std::vector<std::string> names) {
    const std::vector<std::string> rgba = {"R", "G", "B", "A"};
    const std::vector<std::string> rgb = {"R", "G", "B"};
    for (const auto& order : {rgba, rgb}) {
        if (std::is_permutation(names.begin(), names.end(), order.begin(), order.end()))
            return order;
    }
    return names;
}

// Everything about the header that this reader does not take, or nothing.
std::optional<std::string> unknown_layout(const Imf::Header& header, int version) {
    if (Imf::isTiled(version)) return "tiled images are not read";
    if (Imf::isMultiPart(version)) return "images of several parts are not read";
    if (Imf::isNonImage(version)) return "deep images are not read";
    if (!from_library(header.compression()))
        return "its compression is not one of none, zip, zips, piz";
    std::optional<Imf::PixelType> type;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) {
            return "subsampled channels are not read";
        }
        if (channel.channel().type == Imf::UINT) return "integer channels are not read";
        if (type.value_or(channel.channel().type) != channel.channel().type) {
            return "channels of different types are not read";
        }
        type = channel.channel().type;
    }
    if (!type) return "it has no channels";
    return std::nullopt;
}

ExrImage empty_image(const Imf::Header& header) {
    ExrImage image;
    std::vector<std::string> names;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        names.emplace_back(channel.name());
        image.pixel_type =
            channel.channel().type == Imf::HALF ? PixelType::half : PixelType::float32;
    }
    image.channel_names = texel_order(std::move(names));
    image.compression = *from_library(header.compression());
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
        if (text != nullptr) image.attributes.emplace_back(attribute.name(), text->value());
    }
    return image;
}

Outcome<ExrImage> damaged(const std::string& name, const std::string& reason) {
    return {{},
            {file_error("E0304", name,
                        fmt::format("cannot read `{}` as an OpenEXR image: {}", name, reason))}};
}

Outcome<ExrImage> decode(std::string_view bytes, const std::string& name) {
    MemoryInput stream(bytes);
    Imf::InputFile file(stream, 0);  // 0: no threads but this one
    const Imf::Header& header = file.header();
    if (const auto reason = unknown_layout(header, file.version())) return damaged(name, *reason);

    const Imath::Box2i window = header.dataWindow();
    const double width = static_cast<double>(window.max.x) - window.min.x + 1;
    const double height = static_cast<double>(window.max.y) - window.min.y + 1;
    ExrImage image = empty_image(header);
    const double bytes_per_texel = (image.pixel_type == PixelType::half ? 2.0 : 4.0) *
                                   static_cast<double>(image.channel_names.size());
    if (width * height * bytes_per_texel >
        largest_expansion * static_cast<double>(bytes.size()) + expansion_slack) {
        return damaged(name, fmt::format("its {} bytes cannot hold {} x {} texels", bytes.size(),
                                         width, height));
    }
    image.pixels = Image2<float>(static_cast<int>(width), static_cast<int>(height),
                                 static_cast<int>(image.channel_names.size()));
    // Slices are addressed from the origin, the data window may start elsewhere.
    Imf::FrameBuffer buffer;
    const std::size_t texel = sizeof(float) * image.channel_names.size();
    const std::size_t row = texel * static_cast<std::size_t>(width);
    for (std::size_t channel = 0; channel < image.channel_names.size(); ++channel) {
        buffer.insert(
            image.channel_names[channel],
            Imf::Slice::Make(Imf::FLOAT, image.pixels.texels.data() + channel, window, texel, row));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    return {std::move(image), {}};
}

}  // namespace

Outcome<std::string> encode_exr(const ExrImage& image) {
    if (const auto reason = contradiction(image)) return refused("E0500", *reason);
    if (auto diagnostic = unstorable_texel(image)) return {{}, {std::move(*diagnostic)}};
    try {
        if (image.pixel_type == PixelType::half) {
            const auto texels = converted<half>(image.pixels.texels);
            return {write_texels(image, texels.data(), Imf::HALF), {}};
        }
        return {write_texels(image, image.pixels.texels.data(), Imf::FLOAT), {}};
    } catch (const std::exception& error) {
        return refused("E0500", fmt::format("OpenEXR cannot encode the image: {}", error.what()));
    }
}

Outcome<ExrImage> decode_exr(std::string_view bytes, const std::string& name) {
    if (bytes.empty()) return damaged(name, "it is empty");
    try {
        return decode(bytes, name);
    } catch (const std::exception& error) {
        return damaged(name, error.what());
    }
}

Outcome<ExrImage> read_exr(const std::filesystem::path& path) {
    Outcome<std::string> bytes = read_file(path);
    if (!bytes.value) return {{}, std::move(bytes.diagnostics)};
    return decode_exr(*bytes.value, path.string());
}

std::string stored_bytes(const Image2<float>& image, PixelType type) {
    const auto bytes_of = [](const auto& values) {
        return std::string(reinterpret_cast<const char*>(values.data()),
                           values.size() * sizeof(values[0]));
    };
    if (type == PixelType::half) return bytes_of(converted<half>(image.texels));
    return bytes_of(image.texels);
}

}  // namespace skybake
