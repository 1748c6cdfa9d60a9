#include "tests/support/exr_image.h"

#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>

#include <bit>

#include "bakers/io/formats/exr/exr_library.h"

namespace skybake {
namespace {

static_assert(std::endian::native == std::endian::little,
              "texels are stored as they lie in memory");

std::vector<half> halves_of(const std::vector<float>& values) {
    return {values.begin(), values.end()};
}

// Slices that let the library walk over interleaved texels of type T.
template <class T>
Imf::FrameBuffer interleaved(T* texels, int width, Imf::PixelType type,
                             const std::vector<std::string>& names) {
    Imf::FrameBuffer buffer;
    const std::size_t texel = sizeof(T) * names.size();
    const std::size_t row = texel * static_cast<std::size_t>(width);
    for (std::size_t channel = 0; channel < names.size(); ++channel) {
        buffer.insert(names[channel],
                      Imf::Slice(type, reinterpret_cast<char*>(texels + channel), texel, row));
    }
    return buffer;
}

template <class T>
std::string write_texels(const ExrImage& image, std::vector<T> texels, Imf::PixelType type) {
    Imf::StdOSStream stream;
    {
        const Imf::Header header =
            make_exr_header({image.pixels.width, image.pixels.height, image.channel_names,
                             image.pixel_type, image.compression, image.attributes});
        Imf::OutputFile file(stream, header, 0);  // 0: no threads but this one
        file.setFrameBuffer(
            interleaved(texels.data(), image.pixels.width, type, image.channel_names));
        file.writePixels(image.pixels.height);
    }  // the destructor goes back and writes the table of line offsets
    return stream.str();
}

}  // namespace

std::string encode_exr(const ExrImage& image) {
    if (image.pixel_type == PixelType::half) {
        return write_texels(image, halves_of(image.pixels.texels), Imf::HALF);
    }
    return write_texels(image, image.pixels.texels, Imf::FLOAT);
}

ExrImage read_exr(const std::filesystem::path& path) {
    Imf::InputFile file(path.c_str(), 0);
    ExrFacts facts = facts_of(file.header());
    ExrImage image{
        Image2<float>(facts.width, facts.height, static_cast<int>(facts.channel_names.size())),
        std::move(facts.channel_names), facts.pixel_type, facts.compression,
        std::move(facts.attributes)};
    file.setFrameBuffer(interleaved(image.pixels.texels.data(), image.pixels.width, Imf::FLOAT,
                                    image.channel_names));
    file.readPixels(0, image.pixels.height - 1);
    return image;
}

std::string stored_bytes(const Image2<float>& image, PixelType type) {
    const auto bytes_of = [](const auto& values) {
        return std::string(reinterpret_cast<const char*>(values.data()),
                           values.size() * sizeof(values[0]));
    };
    if (type == PixelType::half) return bytes_of(halves_of(image.texels));
    return bytes_of(image.texels);
}

}  // namespace skybake
