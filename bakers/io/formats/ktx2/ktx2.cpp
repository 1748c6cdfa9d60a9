#include "bakers/io/formats/ktx2/ktx2.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/field/pixel_type.h"
#include "bakers/field/stored_voxels.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/to_string.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/formats/ktx2/zstd_stream.h"
#include "bakers/io/formats/texture.h"
#include "bakers/io/manifest/release.h"

namespace skybake {
namespace {

using config::Outcome;
using config::PixelType;
namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little,
              "headers are stored as they lie in memory");

// The members of the file's header in their order.
struct Ktx2Header {
    std::array<unsigned char, 12> identifier = {0xAB, 'K',  'T',  'X',  ' ',  '2',
                                                '0',  0xBB, '\r', '\n', 0x1A, '\n'};
    std::uint32_t vk_format = 0;
    std::uint32_t type_size = 0;  // bytes of a number
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t depth = 0;   // 0 of a 2-D texture
    std::uint32_t layers = 0;  // 0: no array
    std::uint32_t faces = 1;
    std::uint32_t levels = 0;
    std::uint32_t compression = 0;
    std::uint32_t descriptor_offset = 0;
    std::uint32_t descriptor_bytes = 0;
    std::uint32_t values_offset = 0;
    std::uint32_t values_bytes = 0;
    std::uint64_t globals_offset = 0;
    std::uint64_t globals_bytes = 0;
};
static_assert(sizeof(Ktx2Header) == 80);

// Where a level lies in the file.
struct LevelPlace {
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
    std::uint64_t uncompressed_bytes = 0;
};

constexpr std::uint32_t uncompressed = 0;
constexpr std::uint32_t zstandard = 2;
constexpr std::uint32_t most_levels = 32;         // of any texture
constexpr std::uint32_t most_values = 64U << 20;  // bytes of keys and values that are read
constexpr std::uint32_t most_descriptor = 64U << 10;

// VkFormat values.
constexpr std::array<TexelCodes, 7> vulkan = {{
    {PixelType::float32, {100, 103, 109}},
    {PixelType::half, {76, 83, 97}},
    {PixelType::unorm8, {9, 16, 37}},
    {PixelType::unorm16, {70, 77, 91}},
    {PixelType::bc4, {139, 0, 0}},
    {PixelType::bc5, {0, 141, 0}},
    {PixelType::bc6h, {0, 0, 143}},
}};

// --- Head ---------------------------------------------------------------------------------------

void append_number(std::string& bytes, const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// What the data format descriptor says of a part of a texel or a block.
struct Sample {
    std::size_t first_bit = 0;
    std::size_t bits = 0;
    std::uint8_t channel = 0;  // with qualifiers
    std::uint32_t lower = 0;   // what stands for 0, or -1
    std::uint32_t upper = 0;   // what stands for 1
};

constexpr std::uint8_t is_signed = 0x40;
constexpr std::uint8_t is_float = 0x80;

// Returns the parts of a texel of numbers, in the order red, green, blue, alpha.
std::vector<Sample> samples_of_numbers(PixelType type, std::size_t stored) {
    constexpr std::array<std::uint8_t, 4> channels = {0, 1, 2, 15};
    const auto bits = static_cast<std::size_t>(8 * bytes_per_value(type));
    const bool is_unorm = type == PixelType::unorm8 || type == PixelType::unorm16;
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < stored; ++i) {
        Sample sample{i * bits, bits, channels[i], 0, (1U << (bits % 32)) - 1};
        if (!is_unorm) {
            sample.channel |= is_signed | is_float;
            sample.lower = std::bit_cast<std::uint32_t>(-1.0F);
            sample.upper = std::bit_cast<std::uint32_t>(1.0F);
        }
        samples.push_back(sample);
    }
    return samples;
}

std::vector<Sample> samples_of(PixelType type, std::size_t stored) {
    constexpr std::uint32_t all = 0xFFFFFFFFU;
    if (type == PixelType::bc4) return {{0, 64, 0, 0, all}};
    if (type == PixelType::bc5) return {{0, 64, 0, 0, all}, {64, 64, 1, 0, all}};
    if (type == PixelType::bc6h) {
        return {{0, 128, is_float, 0, std::bit_cast<std::uint32_t>(1.0F)}};
    }
    return samples_of_numbers(type, stored);
}

std::uint8_t color_model(PixelType type) {
    if (type == PixelType::bc4) return 131;
    if (type == PixelType::bc5) return 132;
    return type == PixelType::bc6h ? 133 : 1;  // RGB
}

// Returns the basic descriptor block of the Khronos Data Format Specification, after its length.
std::string data_format_descriptor(PixelType type, std::size_t stored) {
    constexpr std::uint16_t version_1_3 = 2;
    constexpr std::array<std::uint8_t, 3> unspecified_linear_straight = {0, 1, 0};
    const std::uint8_t last = config::is_block_coded(type) ? 3 : 0;  // row and column of a block
    const std::vector<Sample> samples = samples_of(type, stored);
    const std::size_t block = 24 + 16 * samples.size();
    std::string bytes;
    append_number(bytes, static_cast<std::uint32_t>(block + 4));
    append_number(bytes, std::uint32_t{0});  // of Khronos, basic
    append_number(bytes, version_1_3);
    append_number(bytes, static_cast<std::uint16_t>(block));
    append_number(bytes, color_model(type));
    append_number(bytes, unspecified_linear_straight);
    append_number(bytes, std::array<std::uint8_t, 4>{last, last});
    append_number(
        bytes, std::array<std::uint8_t, 8>{static_cast<std::uint8_t>(texel_bytes(type, stored))});
    for (const Sample& sample : samples) {
        append_number(bytes, static_cast<std::uint16_t>(sample.first_bit));
        append_number(bytes, static_cast<std::uint8_t>(sample.bits - 1));
        append_number(bytes, sample.channel);
        append_number(bytes, std::uint32_t{0});  // position in the block
        append_number(bytes, sample.lower);
        append_number(bytes, sample.upper);
    }
    return bytes;
}

void append_ktx2_value(std::string_view key, std::string_view value, std::string& values) {
    append_number(values, static_cast<std::uint32_t>(key.size() + value.size() + 2));
    values.append(key).push_back('\0');
    values.append(value).push_back('\0');
    values.resize((values.size() + 3) / 4 * 4);
}

// Where levels that are not compressed begin: at multiples of their texels, and of 4 bytes.
std::uint64_t aligned_level(std::uint64_t offset, PixelType type, std::size_t stored) {
    const std::uint64_t unit = std::max<std::uint64_t>(4, texel_bytes(type, stored));
    return (offset + unit - 1) / unit * unit;
}

// Returns the header of a texture, but for what is said of keys and values.
Ktx2Header ktx2_header(const std::array<int, 3>& size, bool is_flat, std::size_t stored,
                       PixelType type, std::size_t levels) {
    Ktx2Header header;
    header.vk_format = texel_code(vulkan, type, stored);
    const int number = config::is_block_coded(type) ? 1 : bytes_per_value(type);
    header.type_size = static_cast<std::uint32_t>(number);
    header.width = static_cast<std::uint32_t>(size[0]);
    header.height = static_cast<std::uint32_t>(size[1]);
    header.depth = is_flat ? 0 : static_cast<std::uint32_t>(size[2]);
    header.levels = static_cast<std::uint32_t>(levels);
    header.descriptor_offset =
        static_cast<std::uint32_t>(sizeof(Ktx2Header) + levels * sizeof(LevelPlace));
    header.descriptor_bytes =
        static_cast<std::uint32_t>(data_format_descriptor(type, stored).size());
    header.values_offset = header.descriptor_offset + header.descriptor_bytes;
    return header;
}

// --- Writing ------------------------------------------------------------------------------------

class Ktx2Writer {
  public:
    Ktx2Writer(const FileContent& content, const fs::path& path)
        : content_(content),
          baked_(content.baked),
          stored_(stored_channels(baked_.channel_names.size())),
          places_(baked_.levels.size()),
          output_(path) {}

    Outcome<bool> write() {
        write_head();
        bool complete = true;
        for (std::size_t level = places_.size(); complete && level-- > 0;) {
            complete = write_level(level);
        }
        output_.seek(sizeof(Ktx2Header));
        write_places();
        if (!output_.finish()) return {{}, {output_.diagnostic()}};
        return {complete, {}};
    }

  private:
    bool is_compressed() const { return baked_.ktx2_compression != config::Ktx2Compression::none; }

    void write_head() {
        std::string values;
        append_ktx2_value("KTXorientation", baked_.is_table() ? "rd" : "rdi", values);
        append_ktx2_value("KTXwriter", fmt::format("{} {}", tool_name(), release()), values);
        append_ktx2_value(metadata_name, content_.metadata, values);
        Ktx2Header header = ktx2_header(baked_.levels.front().size, baked_.is_table(), stored_,
                                        baked_.pixel_type, places_.size());
        header.compression = is_compressed() ? zstandard : uncompressed;
        header.values_bytes = static_cast<std::uint32_t>(values.size());
        output_.write({reinterpret_cast<const char*>(&header), sizeof header});
        write_places();
        output_.write(data_format_descriptor(baked_.pixel_type, stored_));
        output_.write(values);
    }

    void write_places() {
        output_.write(
            {reinterpret_cast<const char*>(places_.data()), places_.size() * sizeof(LevelPlace)});
    }

    bool write_level(std::size_t level) {
        LevelPlace& place = places_[level];
        place.uncompressed_bytes =
            texture_bytes(baked_.levels[level].size, baked_.pixel_type, stored_);
        if (!is_compressed()) {
            const std::uint64_t begin =
                aligned_level(output_.position(), baked_.pixel_type, stored_);
            output_.write(std::string(begin - output_.position(), '\0'));
        }
        place.offset = output_.position();
        const bool complete = is_compressed() ? write_frame(level) : write_as_it_is(level);
        place.bytes = output_.position() - place.offset;
        return complete;
    }

    bool write_as_it_is(std::size_t level) {
        return write_texture(content_, static_cast<int>(level), texel_sink(output_));
    }

    bool write_frame(std::size_t level) {
        ZstdWriter frame(output_, places_[level].uncompressed_bytes);
        const auto put = [&](std::string_view bytes) {
            frame.write(bytes);
            return output_.error() == 0;
        };
        const bool complete = write_texture(content_, static_cast<int>(level), put);
        if (complete) frame.finish();
        return complete;
    }

    const FileContent& content_;
    const Baked& baked_;
    const std::size_t stored_;
    std::vector<LevelPlace> places_;
    FileOutput output_;
};

Outcome<bool> write_ktx2_file(const FileContent& content, const fs::path& path) {
    if (const auto reason = texture_obstacle(content.baked, "KTX2")) {
        return {{}, {contradiction(path, *reason)}};
    }
    return Ktx2Writer(content, path).write();
}

// --- Reading ------------------------------------------------------------------------------------

config::Diagnostic damaged_ktx2_file(const fs::path& path, const std::string& reason) {
    return file_error(
        "E0304", path.string(),
        fmt::format("`{}` is no KTX2 file that skybake reads: {}", path.string(), reason));
}

// A file that has been opened, with its header and its index of levels.
class Ktx2File {
  public:
    static Outcome<Ktx2File> open(const fs::path& path) {
        Outcome<FileInput> file = FileInput::open(path);
        if (!file.value) return {{}, std::move(file.diagnostics)};
        Ktx2File opened(path, std::move(*file.value));
        if (const auto problem = opened.read_head()) return {{}, {*problem}};
        return {std::move(opened), {}};
    }

    const Ktx2Header& header() const { return header_; }
    const LevelPlace& place(int level) const { return places_[static_cast<std::size_t>(level)]; }
    FileInput& file() { return file_; }

    // Reads a part of the head. Nothing: it is not in the file, or longer than `most`.
    std::optional<std::string> part(std::uint32_t offset, std::uint32_t bytes, std::uint32_t most) {
        if (bytes > most) return std::nullopt;
        std::string part(bytes, '\0');
        const auto done = file_.read(offset, part.data(), bytes);
        if (!done || *done < bytes) return std::nullopt;
        return part;
    }

  private:
    Ktx2File(const fs::path& path, FileInput file) : path_(path), file_(std::move(file)) {}

    std::optional<config::Diagnostic> read_head() {
        const auto done = file_.read(0, reinterpret_cast<char*>(&header_), sizeof header_);
        if (!done) return file_.diagnostic();
        if (*done < sizeof header_) return damaged_ktx2_file(path_, "it ends within its header");
        if (const auto reason = unread()) return damaged_ktx2_file(path_, *reason);
        places_.resize(header_.levels);
        const std::size_t bytes = places_.size() * sizeof(LevelPlace);
        const auto index =
            file_.read(sizeof header_, reinterpret_cast<char*>(places_.data()), bytes);
        if (!index) return file_.diagnostic();
        if (*index < bytes) return damaged_ktx2_file(path_, "it ends within its index of levels");
        for (const LevelPlace& place : places_) {
            if (place.offset <= file_.size() && place.bytes <= file_.size() - place.offset)
                continue;
            return damaged_ktx2_file(path_, "a level lies beyond its end");
        }
        return std::nullopt;
    }

    // Returns what the header contains that skybake does not write, in words, or nothing.
    std::optional<std::string> unread() const {
        if (header_.identifier != Ktx2Header{}.identifier) return "it does not begin with `KTX 20`";
        if (header_.layers != 0 || header_.faces != 1) return "it is an array or a cube";
        if (header_.levels == 0 || header_.levels > most_levels) {
            return fmt::format("it has {} levels", header_.levels);
        }
        if (header_.compression != uncompressed && header_.compression != zstandard) {
            return fmt::format("its supercompression scheme is {}", header_.compression);
        }
        return std::nullopt;
    }

    fs::path path_;
    FileInput file_;
    Ktx2Header header_;
    std::vector<LevelPlace> places_;
};

// Returns the value of a key, without the 0 at its end; nothing if the key is not among them.
std::optional<std::string> ktx2_value(std::string_view values, std::string_view key) {
    while (values.size() >= 4) {
        std::uint32_t bytes = 0;
        std::memcpy(&bytes, values.data(), sizeof bytes);
        values.remove_prefix(4);
        if (bytes > values.size()) return std::nullopt;
        const std::string_view pair = values.substr(0, bytes);
        const std::size_t end = pair.find('\0');
        if (end != pair.npos && pair.substr(0, end) == key) {
            std::string_view value = pair.substr(end + 1);
            if (value.ends_with('\0')) value.remove_suffix(1);
            return std::string(value);
        }
        values.remove_prefix(std::min<std::size_t>(values.size(), (bytes + 3U) / 4 * 4));
    }
    return std::nullopt;
}

Outcome<FileFacts> inspect_ktx2(const fs::path& path) {
    Outcome<Ktx2File> file = Ktx2File::open(path);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    const Ktx2Header& header = file.value->header();
    FileFacts facts;
    const auto kind = texel_kind(vulkan, header.vk_format);
    if (!kind) {
        return {{}, {damaged_ktx2_file(path, fmt::format("its VkFormat is {}", header.vk_format))}};
    }
    facts.pixel_type = kind->type;
    facts.channels = kind->channels;
    const auto descriptor =
        file.value->part(header.descriptor_offset, header.descriptor_bytes, most_descriptor);
    if (descriptor != data_format_descriptor(*facts.pixel_type, facts.channels)) {
        return {
            {},
            {damaged_ktx2_file(path, "its data format descriptor is not that of its VkFormat")}};
    }
    const auto values = file.value->part(header.values_offset, header.values_bytes, most_values);
    if (!values) return {{}, {damaged_ktx2_file(path, "it ends within its keys and values")}};
    const char* wanted = header.depth == 0 ? "rd" : "rdi";
    if (ktx2_value(*values, "KTXorientation") != wanted) {
        return {{}, {damaged_ktx2_file(path, fmt::format("its KTXorientation is not {}", wanted))}};
    }
    facts.metadata = ktx2_value(*values, metadata_name).value_or("");
    facts.compression = to_string(header.compression == zstandard ? config::Ktx2Compression::zstd
                                                                  : config::Ktx2Compression::none);
    return {std::move(facts), {}};
}

// Whether the header is that of a file of this shape.
bool fits_ktx2(const Ktx2Header& header, const FileShape& shape) {
    const bool is_flat = header.depth == 0 && shape.size[2] == 1;
    const Ktx2Header wanted = ktx2_header(shape.size, is_flat, stored_channels(shape.channels),
                                          shape.pixel_type, static_cast<std::size_t>(shape.levels));
    return header.vk_format == wanted.vk_format && header.type_size == wanted.type_size &&
           header.width == wanted.width && header.height == wanted.height &&
           header.depth == wanted.depth && header.levels == wanted.levels;
}

Outcome<bool> read_ktx2_file(const fs::path& path, const FileShape& shape, int level,
                             const VoxelVisitor& visit) {
    Outcome<Ktx2File> file = Ktx2File::open(path);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    const Ktx2Header& header = file.value->header();
    if (!fits_ktx2(header, shape)) return {{}, {other_size(path)}};
    const LevelPlace& place = file.value->place(level);
    std::array<int, 3> size = shape.size;
    for (int i = 0; i < level; ++i) size = next_mip_size(size);
    const std::uint64_t bytes = texture_bytes(size, shape.pixel_type, shape.channels);
    const bool is_compressed = header.compression == zstandard;
    if (place.uncompressed_bytes != bytes || (!is_compressed && place.bytes != bytes)) {
        return {{}, {other_size(path)}};
    }
    if (!is_compressed) {
        return read_texture(texel_input(file.value->file(), place.offset), size, shape.pixel_type,
                            shape.channels, visit);
    }
    ZstdReader frame(file.value->file(), place.offset, place.bytes);
    const config::Diagnostic problem = damaged_ktx2_file(path, "its Zstandard stream is damaged");
    const auto next = [&](char* to, std::size_t count) -> std::optional<config::Diagnostic> {
        if (frame.read(to, count)) return std::nullopt;
        return problem;
    };
    Outcome<bool> read = read_texture(next, size, shape.pixel_type, shape.channels, visit);
    if (read.value == true && !frame.is_at_end()) return {{}, {problem}};
    return read;
}

}  // namespace

Format ktx2_format() {
    return {.format = config::FileFormat::ktx2,
            .write = write_ktx2_file,
            .inspect = inspect_ktx2,
            .read = read_ktx2_file,
            .compression = [](const config::AssetFiles& files) {
                return to_string(files.ktx2_compression);
            }};
}

}  // namespace skybake
