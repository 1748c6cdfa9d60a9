// Assets as KTX2 files: textures as GPUs hold them, with all levels of detail in one file, and with
// the description of the asset.
//
// A table is a 2-D texture, a volume a 3-D texture, and a table of the faces of a cube a cube texture:
// +x, -x, +y, -y, +z, -z, in a left-handed system whose y points up and whose z points ahead, each
// face with its upper row first. A volume of layers is an array of 2-D textures. Channels are R, RG or RGBA of unorm8, unorm16,
// half or float; three channels are stored as four, the fourth of which is 1; or blocks of BC4, BC5
// or BC6H, slice by slice. Levels are stored from
// the smallest to the largest, each either as it is or as a Zstandard frame of its own. The key
// skybake/asset holds the description, KTXorientation says that texel (0, 0, 0) has the smallest
// texture coordinates (`rd`, `rdi`), and KTXwriter names the release. The data format descriptor
// says that the numbers are linear and no colours of certain primaries, so that readers leave them
// as they are.
//
// Source: Khronos, "KTX File Format Specification", version 2.0, and "Khronos Data Format
// Specification", version 1.3. Version 1.4 wants the bytes of a texel in the descriptor of
// compressed files too; the files have them.
#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/field/stored_voxels.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/to_string.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/formats/ktx2/ktx2_head.h"
#include "bakers/io/formats/ktx2/zstd_stream.h"
#include "bakers/io/formats/texture.h"
#include "bakers/io/manifest/release.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

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
        return output_.finished(complete);
    }

  private:
    bool is_compressed() const { return baked_.ktx2_compression != config::Ktx2Compression::none; }

    void write_head() {
        const TextureExtent extent =
            texture_extent(baked_.levels.front().size, !baked_.is_table(), texture_parts(baked_));
        Ktx2Header header = ktx2_header(extent, stored_, baked_.pixel_type, places_.size());
        std::string values;
        append_ktx2_value("KTXorientation", ktx2_orientation(header), values);
        append_ktx2_value("KTXwriter", fmt::format("{} {}", tool_name(), release()), values);
        append_ktx2_value(metadata_name, content_.metadata, values);
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
        const bool complete =
            is_compressed() ? write_frame(level)
                            : write_texture(content_, static_cast<int>(level), texel_sink(output_));
        place.bytes = output_.position() - place.offset;
        return complete;
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
        return contradiction(path, *reason);
    }
    return Ktx2Writer(content, path).write();
}

// --- Reading ------------------------------------------------------------------------------------

// A file that has been opened, with its header and its index of levels.
class Ktx2File {
  public:
    static Outcome<Ktx2File> open(FileInput& file) {
        Ktx2File opened(file);
        if (const auto problem = opened.read_head()) return *problem;
        return {std::move(opened), {}};
    }

    const Ktx2Header& header() const { return header_; }
    const LevelPlace& place(int level) const { return places_[static_cast<std::size_t>(level)]; }

    // Reads a part of the head. Nothing: it is not in the file, or longer than `most`.
    std::optional<std::string> part(std::uint32_t offset, std::uint32_t bytes, std::uint32_t most) {
        return bytes > most ? std::nullopt : file_part(file_, offset, bytes);
    }

  private:
    explicit Ktx2File(FileInput& file) : file_(file) {}

    std::optional<config::Diagnostic> read_head() {
        const auto done = file_.read(0, reinterpret_cast<char*>(&header_), sizeof header_);
        if (!done) return file_.diagnostic();
        if (*done < sizeof header_)
            return damaged_file(file_.path(), "KTX2", "it ends within its header");
        if (const auto reason = unread()) return damaged_file(file_.path(), "KTX2", *reason);
        places_.resize(header_.levels);
        const std::size_t bytes = places_.size() * sizeof(LevelPlace);
        const auto index =
            file_.read(sizeof header_, reinterpret_cast<char*>(places_.data()), bytes);
        if (!index) return file_.diagnostic();
        if (*index < bytes)
            return damaged_file(file_.path(), "KTX2", "it ends within its index of levels");
        for (const LevelPlace& place : places_) {
            if (place.offset <= file_.size() && place.bytes <= file_.size() - place.offset)
                continue;
            return damaged_file(file_.path(), "KTX2", "a level lies beyond its end");
        }
        return std::nullopt;
    }

    // Returns what the header contains that skybake does not write, in words, or nothing.
    std::optional<std::string> unread() const {
        if (header_.identifier != Ktx2Header{}.identifier) return "it does not begin with `KTX 20`";
        const bool may_be_array = header_.depth == 0 && header_.faces == 1;
        if (header_.layers != 0 && !may_be_array) return "it is an array of cubes or of volumes";
        if (header_.faces != 1 && header_.faces != 6) {
            return fmt::format("it has {} faces", header_.faces);
        }
        if (header_.levels == 0 || header_.levels > most_levels) {
            return fmt::format("it has {} levels", header_.levels);
        }
        if (header_.compression != uncompressed && header_.compression != zstandard) {
            return fmt::format("its supercompression scheme is {}", header_.compression);
        }
        return std::nullopt;
    }

    FileInput& file_;
    Ktx2Header header_;
    std::vector<LevelPlace> places_;
};

Outcome<FileFacts> inspect_ktx2(FileInput& input) {
    Outcome<Ktx2File> file = Ktx2File::open(input);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    const Ktx2Header& header = file.value->header();
    FileFacts facts;
    const auto kind = ktx2_texels(header.vk_format);
    if (!kind) {
        return damaged_file(input.path(), "KTX2",
                            fmt::format("its VkFormat is {}", header.vk_format));
    }
    facts.pixel_type = kind->type;
    facts.channels = kind->channels;
    const auto descriptor =
        file.value->part(header.descriptor_offset, header.descriptor_bytes, most_descriptor);
    if (descriptor != data_format_descriptor(*facts.pixel_type, facts.channels)) {
        return damaged_file(input.path(), "KTX2",
                            "its data format descriptor is not that of its VkFormat");
    }
    const auto values = file.value->part(header.values_offset, header.values_bytes, most_values);
    if (!values) return damaged_file(input.path(), "KTX2", "it ends within its keys and values");
    const std::string_view wanted = ktx2_orientation(header);
    if (ktx2_value(*values, "KTXorientation") != wanted) {
        return damaged_file(input.path(), "KTX2",
                            fmt::format("its KTXorientation is not {}", wanted));
    }
    facts.metadata = ktx2_value(*values, metadata_name).value_or("");
    facts.compression = to_string(header.compression == zstandard ? config::Ktx2Compression::zstd
                                                                  : config::Ktx2Compression::none);
    return {std::move(facts), {}};
}

// Whether the header is that of a file of this shape.
bool fits_ktx2(const Ktx2Header& header, const FileShape& shape) {
    const bool is_volume = header.depth != 0 || shape.size[2] != 1;
    const TextureExtent extent = texture_extent(shape.size, is_volume, shape.parts);
    const Ktx2Header wanted = ktx2_header(extent, stored_channels(shape.channels), shape.pixel_type,
                                          static_cast<std::size_t>(shape.levels));
    return has_square_faces(shape.size, shape.levels, shape.parts) &&
           header.vk_format == wanted.vk_format && header.type_size == wanted.type_size &&
           header.extent() == extent && header.levels == wanted.levels;
}

Outcome<bool> read_ktx2_file(FileInput& input, const FileShape& shape, int level,
                             const VoxelVisitor& visit) {
    Outcome<Ktx2File> file = Ktx2File::open(input);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    const Ktx2Header& header = file.value->header();
    if (!fits_ktx2(header, shape)) return other_size(input.path());
    const LevelPlace& place = file.value->place(level);
    std::array<int, 3> size = shape.size;
    for (int i = 0; i < level; ++i) size = next_texture_size(size, shape.parts);
    const std::uint64_t bytes = texture_bytes(size, shape.pixel_type, shape.channels);
    const bool is_compressed = header.compression == zstandard;
    if (place.uncompressed_bytes != bytes || (!is_compressed && place.bytes != bytes)) {
        return other_size(input.path());
    }
    if (!is_compressed) {
        return read_texture(texel_input(input, place.offset), size, shape.pixel_type,
                            shape.channels, visit);
    }
    ZstdReader frame(input, place.offset, place.bytes);
    const config::Diagnostic problem =
        damaged_file(input.path(), "KTX2", "its Zstandard stream is damaged");
    const auto next = [&](char* to, std::size_t count) -> std::optional<config::Diagnostic> {
        if (frame.read(to, count)) return std::nullopt;
        return problem;
    };
    Outcome<bool> read = read_texture(next, size, shape.pixel_type, shape.channels, visit);
    if (read.value == true && !frame.is_at_end()) return problem;
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
