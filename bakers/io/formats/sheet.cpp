#include "bakers/io/formats/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "bakers/field/baked.h"
#include "bakers/field/pixel_type.h"
#include "bakers/math/parallel.h"

namespace skybake {

SheetGrid sheet_grid(const std::array<int, 3>& size, const config::AssetFiles& files) {
    const config::SliceSheet sheet = config::slice_sheet(size, files.layout, files.columns);
    return {files.layout, sheet.columns, sheet.rows, files.flip};
}

std::array<std::int64_t, 2> image_size(const std::array<int, 3>& size, const SheetGrid& grid) {
    return config::sheet_size(size, {grid.columns, grid.rows});
}

std::string sheet_line(const std::array<int, 3>& size, const SheetGrid& grid) {
    if (grid.kind == config::SheetLayout::stack && grid.flipped) {
        return fmt::format(
            "stack of {} slices of {} x {} texels, upside down: slice 0 last, row 0 last", size[2],
            size[0], size[1]);
    }
    if (grid.kind == config::SheetLayout::stack) {
        return fmt::format("stack of {} slices of {} x {} texels, slice 0 first, row 0 first",
                           size[2], size[0], size[1]);
    }
    const std::string line = fmt::format(
        "atlas of {} x {} cells of {} x {} texels, {} slices row by row from the top left, row 0 "
        "first",
        grid.columns, grid.rows, size[0], size[1], size[2]);
    return grid.flipped ? line + ", all of it upside down" : line;
}

// --- Writing ------------------------------------------------------------------------------------

SheetWriter::SheetWriter(const Baked& baked, int level, int threads, Progress* progress)
    : level_(baked.levels[static_cast<std::size_t>(level)]),
      channels_(baked.channel_names.size()),
      type_(baked.pixel_type),
      grid_(sheet_grid(level_.size, baked)),
      boxes_(level_.size, static_cast<int>(channels_), grid_.columns),
      threads_(thread_count(threads)),
      progress_(progress) {}

int SheetWriter::width() const { return level_.size[0] * grid_.columns; }

int SheetWriter::height() const { return level_.size[1] * grid_.rows; }

int SheetWriter::slots() const { return box_slots(threads_); }

int SheetWriter::threads_per_box() const {
    return (threads_ + boxes_.count() - 1) / boxes_.count();
}

bool SheetWriter::write(const Visitor& put, const Visitor& prepare) {
    std::vector<Slot> slots(static_cast<std::size_t>(this->slots()));
    std::exception_ptr failure;
    bool complete = true;
    ordered_pipeline(
        boxes_.count(), threads_, static_cast<int>(slots.size()),
        [&](int i, int slot) {
            if (is_cancelled(progress_)) return;
            Slot& made = slots[static_cast<std::size_t>(slot)];
            make(box_at(i), made);
            if (prepare) prepare(made.made, slot);
        },
        [&](int i, int slot) {
            complete = !is_cancelled(progress_);
            if (!complete) return false;
            try {
                put(slots[static_cast<std::size_t>(slot)].made, slot);
            } catch (...) {
                failure = std::current_exception();
                return false;
            }
            if (progress_ != nullptr) progress_->advance("write", (i + 1.0) / boxes_.count());
            return true;
        });
    if (failure) std::rethrow_exception(failure);
    return complete;
}

// Returns the boxes in the order of the file's rows.
VoxelBox SheetWriter::box_at(int i) const {
    return boxes_[grid_.flipped ? boxes_.count() - 1 - i : i];
}

// Returns the number of image rows that a box fills.
int SheetWriter::height_of(const VoxelBox& box) const {
    return ((box.size[2] - 1) / grid_.columns + 1) * box.size[1];
}

void SheetWriter::make(const VoxelBox& box, Slot& slot) const {
    const auto count = static_cast<std::size_t>(box.count());
    slot.values.resize(count * channels_);
    std::vector<float*> planes;
    for (std::size_t c = 0; c < channels_; ++c) planes.push_back(&slot.values[c * count]);
    level_.voxels->fill(box, planes);
    const int rows = height_of(box);
    const int first = box.origin[2] / grid_.columns * level_.size[1] + box.origin[1];
    slot.made.first = grid_.flipped ? height() - first - rows : first;
    slot.made.count = rows;
    slot.made.plane =
        static_cast<std::size_t>(width()) * static_cast<std::size_t>(rows) * bytes_per_value(type_);
    if (grid_.columns == 1 && type_ == config::PixelType::float32 && !grid_.flipped) {
        slot.made.texels = reinterpret_cast<const char*>(slot.values.data());
        return;
    }
    slot.rows.resize(slot.made.plane * channels_);
    slot.made.texels = slot.rows.data();
    for (std::size_t c = 0; c < channels_; ++c) {
        arrange(box, planes[c], &slot.rows[c * slot.made.plane]);
        if (grid_.flipped) {
            turn_over(&slot.rows[c * slot.made.plane], static_cast<std::size_t>(rows));
        }
    }
}

void SheetWriter::turn_over(char* rows, std::size_t count) const {
    const std::size_t row = static_cast<std::size_t>(width()) * bytes_per_value(type_);
    for (std::size_t y = 0; y < count / 2; ++y) {
        std::swap_ranges(rows + y * row, rows + (y + 1) * row, rows + (count - 1 - y) * row);
    }
}

// Arranges one channel of a box as rows of the image.
void SheetWriter::arrange(const VoxelBox& box, const float* values, char* out) const {
    if (grid_.columns == 1) {
        store_values(values, static_cast<std::size_t>(box.count()), type_, out);
        return;
    }
    const auto row = static_cast<std::size_t>(box.size[0]);
    const auto rows = static_cast<std::size_t>(box.size[1]);
    const auto depth = static_cast<std::size_t>(box.size[2]);
    const auto columns = static_cast<std::size_t>(grid_.columns);
    const auto width_bytes = bytes_per_value(type_);
    const std::size_t cells = (depth - 1) / columns * columns + columns;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        for (std::size_t y = 0; y < rows; ++y) {
            const std::size_t image_row = cell / columns * rows + y;
            char* to = out + (image_row * columns * row + cell % columns * row) * width_bytes;
            if (cell < depth) {
                store_values(values + (cell * rows + y) * row, row, type_, to);
            } else {
                std::fill_n(to, row * width_bytes, '\0');
            }
        }
    }
}

// --- Reading ------------------------------------------------------------------------------------

namespace {

// Reads rows of an image in the order that they have if it is not upside down.
std::optional<config::Diagnostic> read_rows(const RowSource& image, const SheetGrid& grid,
                                            int first, int count, float* texels) {
    if (!grid.flipped) return image.read(first, count, texels);
    if (auto problem = image.read(image.height - first - count, count, texels)) return problem;
    const std::size_t row = static_cast<std::size_t>(image.width) * image.channels;
    for (int y = 0; y < count / 2; ++y) {
        float* upper = texels + static_cast<std::size_t>(y) * row;
        std::swap_ranges(upper, upper + row,
                         texels + static_cast<std::size_t>(count - 1 - y) * row);
    }
    return std::nullopt;
}

// Reads whole slices from one row of an atlas's cells. The image's rows are read again for each
// piece, because a row of cells may be larger than memory.
class AtlasReader {
  public:
    AtlasReader(const RowSource& image, const std::array<int, 3>& size, const SheetGrid& grid)
        : image_(image),
          grid_(grid),
          columns_(grid.columns),
          voxel_(image.channels),
          row_(static_cast<std::size_t>(size[0]) * voxel_),
          height_(static_cast<std::size_t>(size[1])),
          piece_(static_cast<std::size_t>(image.rows_per_piece) *
                 static_cast<std::size_t>(image.width) * voxel_) {}

    // Reads slices z ... z + count - 1, which lie in one row of cells, into `out`.
    std::optional<config::Diagnostic> read(int z, int count, float* out) {
        const int first_row = z / columns_ * static_cast<int>(height_);
        const int first_column = z % columns_;
        int step = image_.rows_per_piece;
        for (int y = 0; y < static_cast<int>(height_); y += step) {
            step = std::min(step, static_cast<int>(height_) - y);
            if (auto problem = read_rows(image_, grid_, first_row + y, step, piece_.data())) {
                return problem;
            }
            copy(y, step, first_column, count, out);
        }
        return std::nullopt;
    }

  private:
    void copy(int y, int rows, int first_column, int count, float* out) const {
        const std::size_t image_row = static_cast<std::size_t>(image_.width) * voxel_;
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

    const RowSource& image_;
    const SheetGrid grid_;
    const int columns_;
    const std::size_t voxel_;
    const std::size_t row_;
    const std::size_t height_;
    std::vector<float> piece_;
};

config::Outcome<bool> read_atlas(const RowSource& image, const std::array<int, 3>& size,
                                 const SheetGrid& grid, const VoxelVisitor& visit) {
    constexpr std::int64_t most_floats = std::int64_t{32} << 20;
    const std::int64_t slice = std::int64_t{size[0]} * size[1];
    const std::int64_t floats = slice * static_cast<std::int64_t>(image.channels);
    const int together = static_cast<int>(
        std::clamp<std::int64_t>(most_floats / floats, 1, std::min(grid.columns, size[2])));
    std::vector<float> values(static_cast<std::size_t>(floats * together));
    AtlasReader reader(image, size, grid);
    int count = 0;
    for (int z = 0; z < size[2]; z += count) {
        count = std::min({together, grid.columns - z % grid.columns, size[2] - z});
        if (auto problem = reader.read(z, count, values.data())) return *problem;
        if (!visit(z * slice, count * slice, values.data())) return {false, {}};
    }
    return {true, {}};
}

config::Outcome<bool> read_stack(const RowSource& image, const SheetGrid& grid,
                                 const VoxelVisitor& visit) {
    int step = image.rows_per_piece;
    const std::size_t row = static_cast<std::size_t>(image.width) * image.channels;
    std::vector<float> values(static_cast<std::size_t>(step) * row);
    for (int y = 0; y < image.height; y += step) {
        step = std::min(step, image.height - y);
        if (auto problem = read_rows(image, grid, y, step, values.data())) return *problem;
        const std::int64_t width = image.width;
        if (!visit(y * width, step * width, values.data())) return {false, {}};
    }
    return {true, {}};
}

}  // namespace

config::Outcome<bool> read_sheet(const RowSource& image, const std::array<int, 3>& size,
                                 const SheetGrid& grid, const VoxelVisitor& visit) {
    if (grid.columns == 1) return read_stack(image, grid, visit);
    return read_atlas(image, size, grid, visit);
}

}  // namespace skybake
