// Voxels of any program's VDB files, read leaf by leaf (vdb_source.h).
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openvdb/io/Compression.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <sstream>
#include <utility>

#include "bakers/io/formats/vdb/vdb_grid_tree.h"
#include "bakers/io/files/system_call.h"
#include "bakers/io/formats/vdb/vdb_input.h"
#include "bakers/io/formats/vdb/vdb_library.h"
#include "bakers/io/volumes/leaf_cubes.h"

namespace skybake::vdb {
namespace {

using config::Outcome;
namespace io = openvdb::io;
using Coord = openvdb::Coord;

// The values of a leaf, in OpenVDB's order: z fastest.
using LeafValues = std::array<float, Leaf::NUM_VALUES>;

Coord corner_of(const VoxelBox& box) { return {box.origin[0], box.origin[1], box.origin[2]}; }

class GridVoxels : public VoxelSource {
  public:
    GridVoxels(const std::filesystem::path& path, const Grid& grid, GridTree tree, Input& input)
        : tree_(std::move(tree)),
          half_(grid.descriptor.saveFloatAsHalf()),
          settings_(std::ios::binary),
          file_(uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC); })) {
        expect(file_.valid(), "it has gone while it was read");
        settings_.copyfmt(input.stream());
        settings_.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
        io::setStreamMetadataPtr(settings_, metadata_, false);
        io::setDataCompression(settings_, grid.compression);
        io::setGridBackgroundValuePtr(settings_, &tree_.background);
    }

    // Decodes every leaf once. Returns the largest value of the grid.
    float survey() {
        float largest =
            std::max(tree_.density(tree_.least_tile), tree_.density(tree_.largest_tile));
        expect(tree_.finite_tiles, "a tile of it is not finite");
        Decoder decoder(*this);
        for (LeafRecord& leaf : tree_.leaves) {
            LeafValues& values = decoder.decode(leaf);
            const auto is_finite = [](float value) { return std::isfinite(value); };
            expect(std::all_of(values.begin(), values.end(), is_finite),
                   "a voxel of it is not finite");
            to_densities(values);
            largest = std::max(largest, *std::max_element(values.begin(), values.end()));
            leaf.is_zero =
                std::all_of(values.begin(), values.end(), [](float value) { return value == 0; });
        }
        return largest;
    }

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        Decoder decoder(*this);
        for_cubes(box, vdb_leaf_edge, [&](const VoxelBox& part) {
            const GridTree::Place place = tree_.find(corner_of(part));
            if (place.leaf == nullptr || place.leaf->is_zero) {
                copy_leaf(
                    part, box, [&](auto) { return place.value; }, channels[0]);
            } else {
                LeafValues& values = decoder.decode(*place.leaf);
                to_densities(values);
                copy_leaf(
                    part, box, [&](auto at) { return values[at]; }, channels[0]);
            }
            return true;
        });
    }

    bool is_empty(const VoxelBox& box) const override {
        return is_empty_by(box, vdb_upper_node_edge);
    }

  private:
    void to_densities(LeafValues& values) const {
        if (!tree_.density.changes()) return;
        for (float& value : values) value = tree_.density(value);
    }

    // Looks at cubes of an edge, and at smaller ones where a cube has children.
    bool is_empty_by(const VoxelBox& box, int edge) const {
        bool empty = true;
        for_cubes(box, edge, [&](const VoxelBox& part) {
            const GridTree::Place place = tree_.find(corner_of(part));
            if (place.edge < edge) {
                const int next = edge == vdb_upper_node_edge ? vdb_node_edge : vdb_leaf_edge;
                empty = is_empty_by(part, next);
            } else {
                empty = place.leaf != nullptr ? place.leaf->is_zero : place.value == 0;
            }
            return empty;
        });
        return empty;
    }

    // Reads leaves one after the other.
    class Decoder {
      public:
        explicit Decoder(const GridVoxels& voxels) : voxels_(voxels), in_(std::ios::binary) {
            in_.copyfmt(voxels.settings_);
        }

        // Returns the numbers as the file has them.
        LeafValues& decode(const LeafRecord& leaf) {
            bytes_.resize(leaf.bytes);
            voxels_.read(leaf.begin, bytes_);
            in_.clear();
            in_.str(bytes_);
            Leaf::NodeMaskType active;
            active.load(in_);
            // The file may have changed since its lengths were checked.
            const auto end =
                end_of_values(in_, leaf.bytes, Leaf::NUM_VALUES, active.countOn(), voxels_.half_);
            expect(end == leaf.bytes, "it has changed while it was read");
            io::readCompressedValues(in_, values_.data(), Leaf::NUM_VALUES, active, voxels_.half_);
            return values_;
        }

      private:
        const GridVoxels& voxels_;
        std::istringstream in_;
        std::string bytes_;
        LeafValues values_{};
    };

    void read(std::int64_t begin, std::string& bytes) const {
        std::size_t done = 0;
        while (done < bytes.size()) {
            const ssize_t count = ::pread(file_.get(), bytes.data() + done, bytes.size() - done,
                                          static_cast<off_t>(begin) + static_cast<off_t>(done));
            if (count < 0 && errno == EINTR) continue;
            expect(count > 0, "it has changed while it was read");
            done += static_cast<std::size_t>(count);
        }
    }

    GridTree tree_;
    const bool half_;
    io::StreamMetadata::Ptr metadata_{new io::StreamMetadata};
    std::istringstream settings_;  // of the streams that leaves are decoded from
    const FileDescriptor file_;
};

// Returns the grid of that name, which must be one of floats.
const Grid& find_grid(const std::vector<Grid>& grids, const std::string& name) {
    std::vector<std::string> names;
    for (const Grid& grid : grids) {
        names.push_back(io::GridDescriptor::nameAsString(grid.descriptor.uniqueName()));
        if (names.back() != name) continue;
        if (!grid.grid->isType<openvdb::FloatGrid>()) {
            throw Damaged(fmt::format("its grid `{}` holds {}, and only grids of floats are read",
                                      name, grid.grid->valueType()));
        }
        expect(!grid.descriptor.isInstance(), "grids share a tree");
        return grid;
    }
    if (names.empty()) throw Damaged("it has no grids");
    throw Damaged(fmt::format("it has no grid `{}`, only `{}`", name, fmt::join(names, "`, `")));
}

// Fills in the edges of a voxel and the corner of voxel (0, 0, 0).
void read_transform(const openvdb::GridBase& grid, FileVoxels& voxels) {
    expect(grid.transform().isLinear(), "its transform is not linear");
    const openvdb::Mat4d matrix = grid.transform().baseMap()->getAffineMap()->getMat4();
    constexpr double rounding = 1e-9;
    for (int i = 0; i < 3; ++i) {
        const double edge = matrix[i][i];
        for (int j = 0; j < 3; ++j) {
            expect(i == j || std::fabs(matrix[i][j]) <= rounding * std::fabs(edge),
                   "its transform turns or shears the axes");
        }
        expect(std::isfinite(edge) && std::isfinite(matrix[3][i]), "its transform is not finite");
        expect(edge > 0, "its transform mirrors an axis");
        // Indices are of the centres of voxels.
        voxels.voxel_size[static_cast<std::size_t>(i)] = edge;
        voxels.index_origin[static_cast<std::size_t>(i)] = matrix[3][i] - edge / 2;
    }
}

// Fills in the box of the voxels: what the grid's metadata says, else what is active.
void read_bounds(const openvdb::GridBase& grid, const GridTree& tree, FileVoxels& voxels) {
    constexpr std::int64_t most_voxels = 16384;
    const std::optional<Vector> stated = stated_vector(grid, vdb_size_name);
    expect(stated || !tree.active.empty(), "it has no active voxels");
    const Vector first = stated ? Vector{} : tree.active.first;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::int64_t size = stated ? (*stated)[i] : tree.active.last[i] - first[i] + 1;
        expect(size > 0, "its size is damaged");
        if (size > most_voxels) {
            throw Damaged(
                fmt::format("its active voxels span {} voxels along {}, and at most {} are "
                            "read",
                            size, "xyz"[i], most_voxels));
        }
        voxels.first[i] = static_cast<int>(first[i]);
        voxels.size[i] = static_cast<int>(size);
    }
}

}  // namespace

Outcome<FileVoxels> open_grid(const std::filesystem::path& path, const std::string& name,
                              VolumePart part) {
    return reported<FileVoxels>(path, [&] {
        Input input(path);
        openvdb::MetaMap metadata;
        input.read_metadata(metadata);
        const std::vector<Grid> grids = read_grid_heads(input);
        const Grid& grid = find_grid(grids, name);
        FileVoxels voxels;
        read_transform(*grid.grid, voxels);
        GridTree tree = read_grid_tree(input, grid);
        read_bounds(*grid.grid, tree, voxels);
        voxels.background = tree.density(tree.background);
        if (part == VolumePart::shape) return voxels;
        auto source = std::make_shared<GridVoxels>(path, grid, std::move(tree), input);
        voxels.largest = source->survey();
        voxels.voxels = std::move(source);
        return voxels;
    });
}

}  // namespace skybake::vdb
