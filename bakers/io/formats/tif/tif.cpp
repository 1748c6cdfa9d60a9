// Assets as TIFF images of 32-bit floats, a page for each slice, which libtiff and most image programs
// read: the texels of all pages, the asset's description, and a directory for each page. Channels are
// interleaved, without compression; the first page carries what the file says of itself as its
// ImageDescription.
//
// Source: Adobe, "TIFF Revision 6.0" (1992). Files are smaller than 4 GiB.
#include <fmt/format.h>

#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "bakers/field/baked.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/formats/little_endian.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t tif_head_size = 8;
constexpr std::size_t tif_entry_size = 12;
constexpr std::size_t tif_short_entries = 9;  // entries that are no offsets or texts

enum class TifType : std::uint16_t { text = 2, short_number = 3, long_number = 4 };

// The directories of a file.
struct TifPages {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t count = 0;
    std::size_t channels = 0;
    std::string description;

    std::uint64_t page_bytes() const { return std::uint64_t{width} * height * channels * 4; }
    std::uint64_t texel_bytes() const { return page_bytes() * count; }
};

// One page's directory, with the lists that its entries point to behind it.
class TifDirectory {
  public:
    explicit TifDirectory(std::uint64_t begin, std::size_t entries)
        : lists_at_(begin + 2 + entries * tif_entry_size + 4) {
        append_little(entries, 2, entries_);
    }

    void add(std::uint16_t tag, TifType type, std::uint64_t value, std::uint64_t count = 1) {
        append_little(tag, 2, entries_);
        append_little(static_cast<std::uint16_t>(type), 2, entries_);
        append_little(count, 4, entries_);
        append_little(value, 4, entries_);
    }
    // The same short number for each channel; up to two stand in the entry itself.
    void add_each(std::uint16_t tag, std::uint64_t value, std::size_t count) {
        if (count <= 2) {
            return add(tag, TifType::short_number, count == 2 ? value << 16 | value : value, count);
        }
        add(tag, TifType::short_number, lists_at_ + lists_.size(), count);
        for (std::size_t i = 0; i < count; ++i) append_little(value, 2, lists_);
    }
    // Returns the bytes of the directory; another one follows it or none does.
    std::string finished(bool is_last) const {
        std::string bytes = entries_;
        const std::string lists = lists_ + std::string(lists_.size() % 2, '\0');
        append_little(is_last ? 0 : lists_at_ + lists.size(), 4, bytes);
        return bytes + lists;
    }

  private:
    std::uint64_t lists_at_;
    std::string entries_;
    std::string lists_;
};

std::string tif_directory(const TifPages& pages, std::uint32_t page, std::uint64_t begin,
                          std::uint64_t description_at) {
    const bool describes = page == 0;
    const std::size_t colours = pages.channels >= 3 ? 3 : 1;
    const std::size_t extra = pages.channels - colours;
    TifDirectory directory(begin,
                           tif_short_entries + 4 + (describes ? 1 : 0) + (extra > 0 ? 1 : 0));
    directory.add(254, TifType::long_number, pages.count > 1 ? 2 : 0);  // a page of several
    directory.add(256, TifType::long_number, pages.width);
    directory.add(257, TifType::long_number, pages.height);
    directory.add_each(258, 32, pages.channels);                      // bits
    directory.add(259, TifType::short_number, 1);                     // no compression
    directory.add(262, TifType::short_number, colours == 3 ? 2 : 1);  // R G B, or 0 is black
    if (describes) {
        directory.add(270, TifType::text, description_at, pages.description.size() + 1);
    }
    directory.add(273, TifType::long_number, tif_head_size + page * pages.page_bytes());
    directory.add(277, TifType::short_number, pages.channels);
    directory.add(278, TifType::long_number, pages.height);  // all rows are one strip
    directory.add(279, TifType::long_number, pages.page_bytes());
    directory.add(284, TifType::short_number, 1);  // interleaved
    directory.add(297, TifType::short_number, pages.count << 16 | page, 2);
    if (extra > 0) directory.add_each(338, 0, extra);  // no alpha
    directory.add_each(339, 3, pages.channels);        // IEEE floats
    return directory.finished(page + 1 == pages.count);
}

std::uint64_t first_directory(const TifPages& pages) {
    const std::uint64_t end = tif_head_size + pages.texel_bytes() + pages.description.size() + 1;
    return end + end % 2;
}

std::string tif_head(const TifPages& pages) {
    std::string head = {'I', 'I', 42, 0};
    append_little(first_directory(pages), 4, head);
    return head;
}

// Returns what follows the texels.
std::string tif_tail(const TifPages& pages) {
    const std::uint64_t description_at = tif_head_size + pages.texel_bytes();
    std::string tail = pages.description;
    tail.resize(first_directory(pages) - description_at, '\0');
    for (std::uint32_t page = 0; page < pages.count; ++page) {
        tail += tif_directory(pages, page, description_at + tail.size(), description_at);
    }
    return tail;
}

TifPages tif_pages(const std::array<int, 3>& size, std::size_t channels, std::string description) {
    return {static_cast<std::uint32_t>(size[0]), static_cast<std::uint32_t>(size[1]),
            static_cast<std::uint32_t>(size[2]), channels, std::move(description)};
}

std::optional<std::string> tif_obstacle(const Baked& baked, const TifPages& pages) {
    if (baked.pixel_type != PixelType::float32) return "TIFF files hold float";
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    if (pages.count <= 0xFFFF && tif_head_size + pages.texel_bytes() < most - (64U << 20)) {
        return std::nullopt;
    }
    return fmt::format("{} pages of {} bytes do not fit into 4 GiB", pages.count,
                       pages.page_bytes());
}

Outcome<bool> write_tif_file(const FileContent& content, const fs::path& path) {
    const Baked& baked = content.baked;
    const TifPages pages = tif_pages(baked.levels[static_cast<std::size_t>(content.level)].size,
                                     baked.channel_names.size(), content.metadata);
    if (const auto reason = tif_obstacle(baked, pages)) return contradiction(path, *reason);
    FileOutput output(path);
    output.write(tif_head(pages));
    const bool complete = write_texels(content, content.level, texel_sink(output));
    output.write(tif_tail(pages));
    return output.finished(complete);
}

// Reads the first page's directory, whose entries stand where skybake writes them.
Outcome<FileFacts> inspect_tif(FileInput& file) {
    const auto head = file_part(file, 0, tif_head_size);
    if (!head || head->substr(0, 4) != std::string({'I', 'I', 42, 0})) {
        return damaged_file(file.path(), "TIFF", "it does not begin with `II*`");
    }
    const auto entries = file_part(file, little(*head, 4, 4), 2 + 10 * tif_entry_size);
    const auto value = [&](std::size_t entry) { return little(*entries, 10 + 12 * entry, 4); };
    if (!entries || little(*entries, 2 + 6 * tif_entry_size, 2) != 270 ||
        little(*entries, 2 + 8 * tif_entry_size, 2) != 277) {
        return damaged_file(file.path(), "TIFF", "its first directory is that of another program");
    }
    FileFacts facts;
    facts.pixel_type = PixelType::float32;
    facts.channels = value(8);
    const std::uint32_t length = little(*entries, 6 + 12 * 6, 4);
    const auto text = file_part(file, value(6), length);
    if (!text || text->empty() || text->back() != '\0') {
        return damaged_file(file.path(), "TIFF", "it ends within its description");
    }
    facts.metadata = text->substr(0, text->size() - 1);
    return {std::move(facts), {}};
}

// All but the texels is what skybake writes of such pages with the file's own description.
Outcome<bool> read_tif_file(FileInput& file, const FileShape& shape, int,
                            const VoxelVisitor& visit) {
    Outcome<FileFacts> facts = inspect_tif(file);
    if (!facts.value) return {{}, std::move(facts.diagnostics)};
    const TifPages pages = tif_pages(shape.size, shape.channels, facts.value->metadata);
    const std::uint64_t texels_end = tif_head_size + pages.texel_bytes();
    const std::string tail = tif_tail(pages);
    if (file.size() != texels_end + tail.size() ||
        file_part(file, 0, tif_head_size) != tif_head(pages) ||
        file_part(file, texels_end, tail.size()) != tail) {
        return other_size(file.path());
    }
    return read_texels(texel_input(file, tif_head_size),
                       {shape.size, shape.channels, shape.channels, PixelType::float32}, visit);
}

}  // namespace

Format tif_format() {
    return {.format = config::FileFormat::tif,
            .write = write_tif_file,
            .inspect = inspect_tif,
            .read = read_tif_file};
}

}  // namespace skybake
