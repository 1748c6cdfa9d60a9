// Volumes as images: where their slices lie, and how the rows of such an image are written and read
// in bounded memory.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "bakers/field/level.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/memory.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/forward.h"
#include "config/sections/pixel_types.h"

namespace skybake {

struct Baked;

// Slices z = 0, 1, ... fill the cells of a grid row by row from the top left. Each slice has its
// row y = 0 on top. A stack is a grid of one column; a table is a stack of one slice.
struct SheetGrid {
    config::SheetLayout kind{};  // a stack
    int columns = 1;             // of cells
    int rows = 1;                // of cells
    bool flipped = false;        // the whole image is upside down: its last row is stored first
};

// Returns the grid for a volume of `size` voxels. If the recipe does not give an atlas's columns,
// they are chosen as config/sections/files.h says.
SheetGrid sheet_grid(const std::array<int, 3>& size, const config::AssetFiles& files);

// Returns the width and the height of the image.
std::array<std::int64_t, 2> image_size(const std::array<int, 3>& size, const SheetGrid& grid);

// Describes the layout in one line: "atlas of 12 x 11 cells of 128 x 128 texels, ...".
std::string sheet_line(const std::array<int, 3>& size, const SheetGrid& grid);

// The rows of the image that one box of voxels fills, as files store them.
struct SheetRows {
    int first = 0;  // row of the image
    int count = 0;
    const char* texels = nullptr;  // channel after channel, each `count` rows of the image's width
    std::size_t plane = 0;         // bytes of a channel
};

// Makes the rows of a level's image in parallel and writes them in the order of the file. Cells of
// an atlas without a slice are 0.
class SheetWriter {
  public:
    SheetWriter(const Baked& baked, int level, int threads, Progress* progress);

    int width() const;
    int height() const;

    // How many boxes may be in memory at a time, and how many threads each can have, so that an
    // image of few boxes keeps all of them busy.
    int slots() const;
    int threads_per_box() const;

    // Passes the rows of each box to `prepare`, on the thread that made them and in any order, and
    // then to `put`, one box at a time, top to bottom. `slot`, below slots(), is the same in both
    // and is no other box's in between. `put` may throw, `prepare` may not. Returns false after an
    // interruption.
    using Visitor = std::function<void(const SheetRows& rows, int slot)>;
    bool write(const Visitor& put, const Visitor& prepare = nullptr);

  private:
    struct Slot {
        AlignedFloats values;  // channel after channel, as the source gives them
        std::string rows;      // channel after channel, as the file stores them
        SheetRows made;
    };
    VoxelBox box_at(int i) const;
    int height_of(const VoxelBox& box) const;
    void make(const VoxelBox& box, Slot& slot) const;
    void arrange(const VoxelBox& box, const float* values, char* out) const;
    void turn_over(char* rows, std::size_t count) const;

    const Level& level_;
    const std::size_t channels_;
    const config::PixelType type_;
    const SheetGrid grid_;
    const BoxSequence boxes_;
    const int threads_;
    Progress* const progress_;
};

// Receives voxels `first` ... `first + count - 1` in the order x, y, z, channels interleaved. If it
// returns false, reading ends.
using VoxelVisitor =
    std::function<bool(std::int64_t first, std::int64_t count, const float* values)>;

// The source of an image's rows. It is a file, so that images may be larger than memory.
struct RowSource {
    int width = 0;
    int height = 0;
    std::size_t channels = 0;
    int rows_per_piece = 1;
    // Reads rows first ... first + count - 1, channels interleaved.
    std::function<std::optional<config::Diagnostic>(int first, int count, float* texels)> read;
};

// Passes all voxels of an image to `visit`, piece after piece. The image must have the size that
// the grid gives. Returns false once visit has returned false. Diagnostics come from the source.
config::Outcome<bool> read_sheet(const RowSource& image, const std::array<int, 3>& size,
                                 const SheetGrid& grid, const VoxelVisitor& visit);

}  // namespace skybake
