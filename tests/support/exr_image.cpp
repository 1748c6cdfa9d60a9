#include "tests/support/exr_image.h"

#include <ImfFrameBuffer.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>

#include <bit>
#include <cstring>
#include <exception>
#include <stdexcept>

#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/exr/exr_library.h"

namespace skybake {
namespace {

static_assert(std::endian::native == std::endian::little,
              "texels are stored as they lie in memory");

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

std::vector<half> halves_of(const std::vector<float>& values) {
    return {values.begin(), values.end()};
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
    return make_exr_header({image.pixels.width, image.pixels.height, image.channel_names,
                            image.pixel_type, image.compression, image.attributes});
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

Outcome<ExrImage> damaged(const std::string& name, const std::string& reason) {
    return {{}, {damaged_exr(name, reason)}};
}

Outcome<ExrImage> decode(std::string_view bytes, const std::string& name) {
    MemoryInput stream(bytes);
    if (const auto reason = unreadable_header(stream, bytes.size())) return damaged(name, *reason);
    Imf::InputFile file(stream, 0);  // 0: no threads but this one
    const Imf::Header& header = file.header();
    ExrFacts facts = facts_of(header);
    ExrImage image{
        Image2<float>(facts.width, facts.height, static_cast<int>(facts.channel_names.size())),
        std::move(facts.channel_names), facts.pixel_type, facts.compression,
        std::move(facts.attributes)};
    const Imath::Box2i window = header.dataWindow();
    // Slices are addressed from the origin, the data window may start elsewhere.
    Imf::FrameBuffer buffer;
    const std::size_t texel = sizeof(float) * image.channel_names.size();
    const std::size_t row = texel * static_cast<std::size_t>(image.pixels.width);
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
    if (image.pixel_type == PixelType::half) {
        const auto texels = halves_of(image.pixels.texels);
        return {write_texels(image, texels.data(), Imf::HALF), {}};
    }
    return {write_texels(image, image.pixels.texels.data(), Imf::FLOAT), {}};
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
    if (type == PixelType::half) return bytes_of(halves_of(image.texels));
    return bytes_of(image.texels);
}

}  // namespace skybake
