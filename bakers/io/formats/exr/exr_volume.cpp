#include "bakers/io/formats/exr/exr_volume.h"

#include <ImfFrameBuffer.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfThreading.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "bakers/field/voxel_boxes.h"
#include "bakers/field/voxel_bytes.h"
#include "bakers/io/files/file_diagnostic.h"
#include "bakers/io/files/file_output.h"
#include "bakers/io/formats/exr/exr_library.h"
#include "bakers/math/aligned_floats.h"
#include "bakers/math/parallel.h"

namespace skybake {
namespace {

using config::PixelType;

SliceLayout layout_of(const BakedVolume& volume, int level) {
    SliceLayout layout = volume_layout(volume.levels[static_cast<std::size_t>(level)].size,
                                       volume.layout, volume.columns);
    layout.flipped = volume.flipped;
    return layout;
}

class OutputStream : public Imf::OStream {
  public:
    explicit OutputStream(FileOutput& file) : Imf::OStream("file"), file_(file) {}
    void write(const char bytes[], int count) override {
        file_.write({bytes, static_cast<std::size_t>(count)});
        if (file_.error() != 0) throw std::runtime_error("the file cannot be written");
    }
    uint64_t tellp() override { return file_.position(); }
    void seekp(uint64_t position) override { file_.seek(position); }

  private:
    FileOutput& file_;
};

// The library compresses on threads of its own, which all files share; with one thread it does so
// on the caller's.
class CompressionThreads {
  public:
    explicit CompressionThreads(int threads) : count_(threads > 1 ? threads : 0) {
        Imf::setGlobalThreadCount(count_);
    }
    ~CompressionThreads() { Imf::setGlobalThreadCount(0); }
    CompressionThreads(const CompressionThreads&) = delete;
    CompressionThreads& operator=(const CompressionThreads&) = delete;
    int count() const { return count_; }

  private:
    int count_;
};

// A box on its way to the file.
struct Slot {
    AlignedFloats values;             // channel after channel, as the source gives them
    std::string rows;                 // channel after channel, as the file stores them
    const char* first_row = nullptr;  // of channel 0: in `values` or in `rows`
};

class VolumeWriter {
  public:
    VolumeWriter(const BakedVolume& volume, int level, int threads, Progress* progress)
        : level_(volume.levels[static_cast<std::size_t>(level)]),
          channels_(volume.channel_names),
          type_(volume.pixel_type),
          layout_(layout_of(volume, level)),
          boxes_(level_.size, static_cast<int>(channels_.size()), layout_.columns),
          threads_(thread_count(threads)),
          progress_(progress) {}

    // False after an interruption. Throws what the library throws.
    bool write(Imf::OutputFile& file) {
        std::vector<Slot> slots(static_cast<std::size_t>(box_slots(threads_)));
        std::exception_ptr failure;
        bool complete = true;
        ordered_pipeline(
            boxes_.count(), threads_, static_cast<int>(slots.size()),
            [&](int i, int slot) {
                if (!cancelled()) make(box_at(i), slots[static_cast<std::size_t>(slot)]);
            },
            [&](int i, int slot) {
                complete = !cancelled();
                if (!complete) return false;
                try {
                    put(box_at(i), slots[static_cast<std::size_t>(slot)], file);
                } catch (...) {
                    failure = std::current_exception();
                    return false;
                }
                if (progress_ != nullptr) {
                    progress_->advance("write", (i + 1.0) / boxes_.count());
                }
                return true;
            });
        if (failure) std::rethrow_exception(failure);
        return complete;
    }

  private:
    bool cancelled() const { return progress_ != nullptr && progress_->cancelled(); }

    // Boxes in the order of the file's rows.
    VoxelBox box_at(int i) const { return boxes_[layout_.flipped ? boxes_.count() - 1 - i : i]; }

    std::size_t bytes_per_value() const { return type_ == PixelType::half ? 2 : 4; }
    std::size_t width() const {
        return static_cast<std::size_t>(level_.size[0]) * static_cast<std::size_t>(layout_.columns);
    }
    // Image rows that a box fills.
    std::size_t height_of(const VoxelBox& box) const {
        return static_cast<std::size_t>((box.size[2] - 1) / layout_.columns + 1) *
               static_cast<std::size_t>(box.size[1]);
    }

    void make(const VoxelBox& box, Slot& slot) const {
        const auto count = static_cast<std::size_t>(box.count());
        slot.values.resize(count * channels_.size());
        std::vector<float*> planes;
        for (std::size_t c = 0; c < channels_.size(); ++c)
            planes.push_back(&slot.values[c * count]);
        level_.voxels->fill(box, planes);
        if (layout_.columns == 1 && type_ == PixelType::float32 && !layout_.flipped) {
            slot.first_row = reinterpret_cast<const char*>(slot.values.data());
            return;
        }
        const std::size_t plane = width() * height_of(box) * bytes_per_value();
        slot.rows.resize(plane * channels_.size());
        slot.first_row = slot.rows.data();
        for (std::size_t c = 0; c < channels_.size(); ++c) {
            arrange(box, planes[c], &slot.rows[c * plane]);
            if (layout_.flipped) turn_over(&slot.rows[c * plane], height_of(box));
        }
    }

    void turn_over(char* rows, std::size_t count) const {
        const std::size_t row = width() * bytes_per_value();
        for (std::size_t y = 0; y < count / 2; ++y) {
            std::swap_ranges(rows + y * row, rows + (y + 1) * row, rows + (count - 1 - y) * row);
        }
    }

    // One channel of a box as rows of the image.
    void arrange(const VoxelBox& box, const float* values, char* out) const {
        if (layout_.columns == 1) {
            store_values(values, static_cast<std::size_t>(box.count()), type_, out);
            return;
        }
        const auto row = static_cast<std::size_t>(box.size[0]);
        const auto rows = static_cast<std::size_t>(box.size[1]);
        const auto depth = static_cast<std::size_t>(box.size[2]);
        const auto columns = static_cast<std::size_t>(layout_.columns);
        const std::size_t cells = (depth - 1) / columns * columns + columns;
        for (std::size_t cell = 0; cell < cells; ++cell) {
            for (std::size_t y = 0; y < rows; ++y) {
                const std::size_t image_row = cell / columns * rows + y;
                char* to = out + (image_row * width() + cell % columns * row) * bytes_per_value();
                if (cell < depth) {
                    store_values(values + (cell * rows + y) * row, row, type_, to);
                } else {
                    std::fill_n(to, row * bytes_per_value(), '\0');
                }
            }
        }
    }

    void put(const VoxelBox& box, const Slot& slot, Imf::OutputFile& file) const {
        const std::size_t height = height_of(box);
        const std::size_t plane = width() * height * bytes_per_value();
        const int first = box.origin[2] / layout_.columns * level_.size[1] + box.origin[1];
        const int image_height = layout_.rows * level_.size[1];
        const Imath::V2i origin(
            0, layout_.flipped ? image_height - first - static_cast<int>(height) : first);
        Imf::FrameBuffer buffer;
        for (std::size_t c = 0; c < channels_.size(); ++c) {
            buffer.insert(channels_[c],
                          Imf::Slice::Make(type_ == PixelType::half ? Imf::HALF : Imf::FLOAT,
                                           slot.first_row + c * plane, origin,
                                           static_cast<std::int64_t>(width()),
                                           static_cast<std::int64_t>(height), bytes_per_value(),
                                           width() * bytes_per_value()));
        }
        file.setFrameBuffer(buffer);
        file.writePixels(static_cast<int>(height));
    }

    const VolumeLevel& level_;
    const std::vector<std::string>& channels_;
    const PixelType type_;
    const SliceLayout layout_;
    const BoxSequence boxes_;
    const int threads_;
    Progress* const progress_;
};

config::Outcome<bool> contradiction(const std::string& path, const std::string& what) {
    return {{}, {file_error("E0500", path, what)}};
}

// --- Reading ------------------------------------------------------------------------------------

// Rows of an image as they would stand if it were not upside down.
std::optional<config::Diagnostic> read_rows(ExrRows& image, const SliceLayout& layout, int first,
                                            int count, float* texels) {
    if (!layout.flipped) return image.read(first, count, texels);
    if (auto problem = image.read(image.height() - first - count, count, texels)) return problem;
    const std::size_t row = static_cast<std::size_t>(image.width()) * image.channel_names().size();
    for (int y = 0; y < count / 2; ++y) {
        float* upper = texels + static_cast<std::size_t>(y) * row;
        std::swap_ranges(upper, upper + row,
                         texels + static_cast<std::size_t>(count - 1 - y) * row);
    }
    return std::nullopt;
}

// Reads whole slices from one row of an atlas' cells; an image's rows are read again for each piece
// of them, since a cell row may be larger than memory.
class AtlasReader {
  public:
    AtlasReader(ExrRows& image, const std::array<int, 3>& size, const SliceLayout& layout)
        : image_(image),
          layout_(layout),
          columns_(layout.columns),
          voxel_(image.channel_names().size()),
          row_(static_cast<std::size_t>(size[0]) * voxel_),
          height_(static_cast<std::size_t>(size[1])),
          piece_(static_cast<std::size_t>(image.rows_per_piece()) *
                 static_cast<std::size_t>(image.width()) * voxel_) {}

    // Slices z ... z + count - 1, which lie in one row of cells, into `out`.
    std::optional<config::Diagnostic> read(int z, int count, float* out) {
        const int first_row = z / columns_ * static_cast<int>(height_);
        const int first_column = z % columns_;
        int step = image_.rows_per_piece();
        for (int y = 0; y < static_cast<int>(height_); y += step) {
            step = std::min(step, static_cast<int>(height_) - y);
            if (auto problem = read_rows(image_, layout_, first_row + y, step, piece_.data())) {
                return problem;
            }
            copy(y, step, first_column, count, out);
        }
        return std::nullopt;
    }

  private:
    void copy(int y, int rows, int first_column, int count, float* out) const {
        const std::size_t image_row = static_cast<std::size_t>(image_.width()) * voxel_;
        for (int i = 0; i < rows; ++i) {
            for (int slice = 0; slice < count; ++slice) {
                const float* from = piece_.data() + static_cast<std::size_t>(i) * image_row +
                                    static_cast<std::size_t>(first_column + slice) * row_;
                std::copy_n(from, row_,
                            out + (static_cast<std::size_t>(slice) * height_ +
                                   static_cast<std::size_t>(y + i)) *
                                      row_);
            }
        }
    }

    ExrRows& image_;
    const SliceLayout layout_;
    const int columns_;
    const std::size_t voxel_;
    const std::size_t row_;
    const std::size_t height_;
    std::vector<float> piece_;
};

config::Outcome<bool> read_atlas(ExrRows& image, const std::array<int, 3>& size,
                                 const SliceLayout& layout, const VoxelVisitor& visit) {
    constexpr std::int64_t most_floats = std::int64_t{32} << 20;
    const std::int64_t slice = std::int64_t{size[0]} * size[1];
    const std::int64_t floats = slice * static_cast<std::int64_t>(image.channel_names().size());
    const int together = static_cast<int>(
        std::clamp<std::int64_t>(most_floats / floats, 1, std::min(layout.columns, size[2])));
    std::vector<float> values(static_cast<std::size_t>(floats * together));
    AtlasReader reader(image, size, layout);
    int count = 0;
    for (int z = 0; z < size[2]; z += count) {
        count = std::min({together, layout.columns - z % layout.columns, size[2] - z});
        if (auto problem = reader.read(z, count, values.data())) return {{}, {*problem}};
        if (!visit(z * slice, count * slice, values.data())) return {false, {}};
    }
    return {true, {}};
}

config::Outcome<bool> read_stack(ExrRows& image, const SliceLayout& layout,
                                 const VoxelVisitor& visit) {
    int step = image.rows_per_piece();
    const std::size_t row = static_cast<std::size_t>(image.width()) * image.channel_names().size();
    std::vector<float> values(static_cast<std::size_t>(step) * row);
    for (int y = 0; y < image.height(); y += step) {
        step = std::min(step, image.height() - y);
        if (auto problem = read_rows(image, layout, y, step, values.data())) {
            return {{}, {*problem}};
        }
        const std::int64_t width = image.width();
        if (!visit(y * width, step * width, values.data())) return {false, {}};
    }
    return {true, {}};
}

}  // namespace

config::Outcome<bool> write_exr_volume(const BakedVolume& volume, int level,
                                       const Attributes& attributes, int threads,
                                       Progress* progress, const std::filesystem::path& path) {
    if (volume.pixel_type != PixelType::half && volume.pixel_type != PixelType::float32) {
        return contradiction(path.string(), "EXR files hold float and half");
    }
    const std::array<int, 3>& size = volume.levels[static_cast<std::size_t>(level)].size;
    const auto [width, height] = image_size(size, layout_of(volume, level));
    constexpr std::int64_t largest = std::numeric_limits<int>::max();
    if (width > largest || height > largest) {
        return contradiction(path.string(),
                             fmt::format("an image of {} x {} texels is too large", width, height));
    }
    if (const auto reason = bad_attribute_name(attributes)) {
        return contradiction(path.string(), *reason);
    }
    FileOutput output(path);
    bool complete = false;
    std::string reason;
    try {
        OutputStream stream(output);
        const CompressionThreads compression(thread_count(threads));
        Imf::OutputFile file(stream,
                             make_exr_header({static_cast<int>(width), static_cast<int>(height),
                                              volume.channel_names, volume.pixel_type,
                                              volume.compression, attributes}),
                             compression.count());
        complete = VolumeWriter(volume, level, threads, progress).write(file);
    } catch (const std::exception& error) {
        reason = error.what();
    }
    // The library's destructor, which writes the table of line offsets, keeps failures to itself.
    if (!output.finish()) return {{}, {output.diagnostic()}};
    if (!reason.empty()) {
        return contradiction(path.string(),
                             fmt::format("OpenEXR cannot encode the image: {}", reason));
    }
    return {complete, {}};
}

config::Outcome<bool> read_exr_volume(ExrRows& image, const std::array<int, 3>& size,
                                      const SliceLayout& layout, const VoxelVisitor& visit) {
    if (layout.columns == 1) return read_stack(image, layout, visit);
    return read_atlas(image, size, layout, visit);
}

}  // namespace skybake
